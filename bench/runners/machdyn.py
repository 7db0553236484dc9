# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Scenes of other runners in LAMMPS's package MACHDYN, driven as its own examples are (examples/PACKAGES/machdyn of LAMMPS).

tlsph: kernel radius 2.01 spacings (aluminum_strip_pull), hourglass control 10, smd/adjust_dt 0.1. Its neighbors are wrong across periodic
boundaries, so a strip in uniaxial strain has free sides and forces along x only. Bodies that meet are one from the start, as it has no other
contact than springs. ulsph: kernel radius 2.5 spacings, adjust_radius 1.01 10 15 (fluid_structure_interaction).
Settings: q1, q2 (viscosity), rows (of the strip), C (of smd/adjust_dt). One run each: it keeps its reference from the start of the first.
"""

import copy

import numpy as np

from . import answer

from conftest import read_thermo
from hard import Stopped, executor

SUPPORT = {"tlsph": 2.01, "ulsph": 2.5}
HOURGLASS = 10.0


def write_data(path, x, v, volume, mass, radius, box):
    """radius: half of the kernel's"""
    n = len(x)
    lines = ["machdyn", "", f"{n} atoms", "1 atom types", ""]
    lines += [f"{lo:.17g} {hi:.17g} {'xyz'[a]}lo {'xyz'[a]}hi" for a, (lo, hi) in enumerate(box)]
    place = [" ".join(f"{a:.17g}" for a in p) for p in x]
    lines += ["", "Atoms # smd", ""] + [f"{i + 1} 1 1 {volume:.17g} {mass:.17g} {radius:.17g} {radius:.17g} {p} {p}" for i, p in enumerate(place)]
    lines += ["", "Velocities", ""] + [f"{i + 1} " + " ".join(f"{a:.17g}" for a in u) for i, u in enumerate(v)]
    path.write_text("\n".join(lines) + "\n")


def go(folder, lmp, style, x, v, rho, dx, dim, box, boundary, coeff, t_end, courant=0.1, more="", ranks=1, timeout=600, every=None):
    """runs it; frames: list of dicts time (of the step), x, v, s (-sigma_x) by ID; energy: largest |E/E0 - 1|; coeff: words after *COMMON ..."""
    write_data(folder / "data", x, v, dx**dim, rho * dx**dim, 0.5 * SUPPORT[style] * dx, box)
    if style == "tlsph":
        pair, extra = "smd/tlsph", ""
    else:
        pair, extra = "smd/ulsph *DENSITY_CONTINUITY *VELOCITY_GRADIENT *NO_GRADIENT_CORRECTION", "adjust_radius 1.01 10 15"
    text = f"""units si
dimension {dim}
boundary {boundary}
atom_style smd
atom_modify map array
comm_modify vel yes
newton off
neigh_modify every 10 delay 0 check yes
read_data data
group tlsph type 1
neighbor {SUPPORT[style] * dx:.17g} bin
pair_style {pair}
pair_coeff 1 1 {coeff} *END
fix dtfix tlsph smd/adjust_dt {courant}
fix move tlsph smd/integrate_{style} {extra}
{more}
compute S all smd/{style}/stress
compute E all smd/internal/energy
compute energy all reduce sum c_E
variable total equal c_energy+ke
variable left equal {t_end:.17g}-f_dtfix
fix halt all halt 1 v_left < 0.0 error continue message no
thermo 20
thermo_style custom step f_dtfix ke c_energy v_total
thermo_modify format float %.12g norm no
{f'dump d all custom {every} frames id x y z vx vy vz c_S[1]' if every else ''}
{'dump_modify d sort id format float %.17g' if every else ''}
run 100000000
variable now equal f_dtfix
print "ended at $(v_now:%.17g)"
write_dump all custom last id x y z vx vy vz c_S[1] modify sort id format float %.17g
"""
    r = executor(lmp, folder)(text, nranks=ranks, timeout=timeout)
    t = r.thermo
    total = t["v_total"]
    end = float(r.log.split("ended at")[-1].split()[0])
    last = frame((folder / "last").read_text().splitlines()[9:])
    last["time"] = end
    return last, dict(zip(t["Step"].astype(int), t["f_dtfix"])), np.abs(total / total[0] - 1).max()


def frame(lines):
    a = np.array([line.split() for line in lines], dtype=float)
    return dict(x=a[:, 1:4], v=a[:, 4:7], s=-a[:, 7])


def strip(x, rows, dx):
    """particles at x in so many rows, in the plane z = 0; of a column, of a row"""
    y = (np.arange(rows) - 0.5 * (rows - 1)) * dx
    return np.stack([np.repeat(x, rows), np.tile(y, len(x)), np.zeros(rows * len(x))], axis=1)


def uniaxial(folder, lmp, style, x, u, rho, dx, rows, coeff, t_end, **how):
    """a strip in uniaxial strain; what it left, means over the middle third of the rows"""
    place = strip(x, rows, dx)
    v = np.zeros_like(place)
    v[:, 0] = np.repeat(u, rows)
    wide = 0.5 * rows * dx * (3 if style == "tlsph" else 1)
    box = [(x[0] - np.ptp(x), x[-1] + np.ptp(x)), (-wide, wide), (-0.5 * dx, 0.5 * dx)]
    flat, sides = ("fix flat all setforce NULL 0.0 0.0", "sm sm p") if style == "tlsph" else ("", "sm p p")
    last, _, energy = go(folder, lmp, style, place, v, rho, dx, 2, box, sides, coeff, t_end, more=flat, **how)
    keep = slice(rows // 3, rows - rows // 3)
    thin = {k: a.reshape(-1, rows, *a.shape[1:])[:, keep].mean(axis=1) for k, a in last.items() if k != "time"}
    # tlsph has a density of its own only inside; that of places is the same where all is uniform
    return dict(thin, p=thin["s"], rho=rho * dx / np.gradient(thin["x"][:, 0]), time=last["time"]), energy


def shock(case, s, folder, lmp, ranks, timeout):
    """fluid flyers (shock_scenes.Plates). tlsph: EOS_SHOCK without strength; ulsph: Tait's law, exponent 4 s - 1 as of Us = c0 + s u"""
    n, style, rows = s["n"], s["stock"], s.get("rows", 12)
    scene, metal = case.scene(n), case.solution.flyer
    K = metal.rho0 * metal.c0**2
    if style == "tlsph":  # E and nu make the speed of waves that steps and viscosity take: no shear, so 0.4999 would be right; 0.3 has the same M
        nu = 0.3
        E = K * (1 + nu) * (1 - 2 * nu) / (1 - nu)
        coeff = (f"*COMMON {metal.rho0} {E:.17g} {nu} {s['q1']} {s['q2']} {HOURGLASS} 1.0 "
                 f"*EOS_SHOCK {metal.c0} {metal.s} {metal.gamma}")
    else:
        coeff = f"*COMMON {metal.rho0} {metal.c0} {s['q1']} 1.0 0.0 *EOS_TAIT {4 * metal.s - 1:.6g}"
    case = copy.copy(case)
    try:
        last, energy = uniaxial(folder, lmp, style, scene.x[:, 0], scene.v[:, 0], metal.rho0, scene.spacing, rows, coeff, case.times[-1],
                                courant=s.get("smd_C", 0.1), ranks=ranks, timeout=timeout)
    except Stopped as why:
        return answer(folder, rows * len(scene.x), {}, failed=str(why))
    case.times = [last["time"]]  # its steps end where they end
    if not np.isfinite(last["x"]).all() or len(last["x"]) != len(scene.x):
        return answer(folder, rows * len(scene.x), {}, failed="not finite")
    l1 = case.errors(n, scene, last)[0]
    return answer(folder, rows * len(scene.x), {f"L1 {k}": 100 * v for k, v in l1.items()}, energy=energy)
