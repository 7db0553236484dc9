# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Scenes of other runners in LAMMPS's package MACHDYN, driven as its own examples are (examples/PACKAGES/machdyn of LAMMPS).

tlsph: kernel radius 2.01 spacings (aluminum_strip_pull), hourglass control 10, smd/adjust_dt 0.1. Its neighbors are wrong across periodic
boundaries, so a strip in uniaxial strain has free sides and forces along x only. Bodies that meet are one from the start, as it has no other
contact than springs. ulsph: kernel radius 2.5 spacings, adjust_radius 1.01 10 15 (fluid_structure_interaction).
Settings: q1, q2 (viscosity), rows (of the strip), smd_C (of smd/adjust_dt). One run each: it keeps its reference from the start of the first.
"""

import copy

import numpy as np

from . import Cannot, answer

from lammps_runs import Stopped
from face_scenes import CL, NU, RHO, E
from reference.elastic_plastic import impact
from state_scenes import LAYERS, SPACING, distance

SUPPORT = {"tlsph": 2.01, "ulsph": 2.5}
HOURGLASS = 10.0
SETTINGS = {"q1", "q2", "rows", "smd_C"}


def write_data(path, x, v, volume, mass, radius, box):
    """radius: half of the kernel's"""
    n = len(x)
    lines = ["machdyn", "", f"{n} atoms", "1 atom types", ""]
    lines += [f"{lo:.17g} {hi:.17g} {'xyz'[a]}lo {'xyz'[a]}hi" for a, (lo, hi) in enumerate(box)]
    place = [" ".join(f"{a:.17g}" for a in p) for p in x]
    lines += ["", "Atoms # smd", ""] + [f"{i + 1} 1 1 {volume:.17g} {mass:.17g} {radius:.17g} {radius:.17g} {p} {p}" for i, p in enumerate(place)]
    lines += ["", "Velocities", ""] + [f"{i + 1} " + " ".join(f"{a:.17g}" for a in u) for i, u in enumerate(v)]
    path.write_text("\n".join(lines) + "\n")


def go(folder, lmp, style, x, v, rho, dx, dim, box, boundary, coeff, t_end, courant=0.1, more=""):
    """runs it by lmp(text). What is left, dict of time, and of x, v, s (-sigma_x) by ID; and the largest |E/E0 - 1|. coeff: of pair_coeff 1 1"""
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
run 100000000
variable now equal f_dtfix
print "ended at $(v_now:%.17g)"
write_dump all custom last id x y z vx vy vz c_S[1] modify sort id format float %.17g
"""
    r = lmp(text)
    t = r.thermo
    total = t["v_total"]
    end = float(r.log.split("ended at")[-1].split()[0])
    last = frame((folder / "last").read_text().splitlines()[9:])
    last["time"] = end
    return last, np.abs(total / total[0] - 1).max()


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
    last, energy = go(folder, lmp, style, place, v, rho, dx, 2, box, sides, coeff, t_end, more=flat, **how)
    keep = slice(rows // 3, rows - rows // 3)
    thin = {k: a.reshape(-1, rows, *a.shape[1:])[:, keep].mean(axis=1) for k, a in last.items() if k != "time"}
    # tlsph has a density of its own only inside; that of places is the same where all is uniform
    return dict(thin, p=thin["s"], rho=rho * dx / np.gradient(thin["x"][:, 0]), time=last["time"]), energy


def moduli(K, G):
    """E, nu"""
    return 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G)


def shock(case, s, folder, lmp):
    """fluid flyers (shock_scenes.Plates). tlsph: EOS_SHOCK without strength; ulsph: Tait's law, exponent 4 s - 1 as of Us = c0 + s u"""
    n, style, rows = s["n"], s["stock"], s.get("rows", 12)
    scene, metal = case.scene(n), case.solution.flyer
    K = metal.rho0 * metal.c0**2
    if style == "tlsph":  # E and nu make the speed of waves that steps and viscosity take: no shear, so 0.4999 would be right; 0.3 has the same M
        nu = 0.3
        young = K * (1 + nu) * (1 - 2 * nu) / (1 - nu)
        coeff = (f"*COMMON {metal.rho0} {young:.17g} {nu} {s['q1']} {s['q2']} {HOURGLASS} 1.0 "
                 f"*EOS_SHOCK {metal.c0} {metal.s} {metal.gamma}")
    else:
        coeff = f"*COMMON {metal.rho0} {metal.c0} {s['q1']} 1.0 0.0 *EOS_TAIT {4 * metal.s - 1:.6g}"
    case = copy.copy(case)
    try:
        last, energy = uniaxial(folder, lmp, style, scene.x[:, 0], scene.v[:, 0], metal.rho0, scene.spacing, rows, coeff, case.times[-1],
                                courant=s.get("smd_C", 0.1))
    except Stopped as why:
        return answer(folder, rows * len(scene.x), {}, failed=str(why))
    case.times = [last["time"]]  # its steps end where they end
    if not np.isfinite(last["x"]).all() or len(last["x"]) != len(scene.x):
        return answer(folder, rows * len(scene.x), {}, failed="not finite")
    l1 = case.errors(n, scene, last)[0]
    return answer(folder, rows * len(scene.x), {f"L1 {k}": 100 * v for k, v in l1.items()}, energy=energy)


def flyer(flying, target, speed, s, folder, lmp):
    """solid flyers and the piston of state_scenes.py, without a gap. tlsph: EOS_SHOCK; ulsph: Tait's law; both perfectly plastic"""
    if flying != target:
        raise Cannot("bodies of two materials meet by springs only")
    n, style, rows, metal = s["n"], s["stock"], s.get("rows", 12), flying
    waves, dx = impact(flying, target, speed)[1], SPACING * LAYERS / s["n"]
    t_end = 0.9 * n * dx * metal.rho0 / waves[0].m
    K = metal.rho0 * metal.c0**2
    young, nu = moduli(K, metal.G)
    if style == "tlsph":
        coeff = (f"*COMMON {metal.rho0} {young:.17g} {nu:.17g} {s['q1']} {s['q2']} {HOURGLASS} 1.0 "
                 f"*EOS_SHOCK {metal.c0} {metal.s1} {metal.g0} *STRENGTH_LINEAR_PLASTIC {metal.Y} 0.0")
    else:
        coeff = (f"*COMMON {metal.rho0} {metal.c0} {s['q1']} 1.0 0.0 *EOS_TAIT {4 * metal.s1 - 1:.6g} "
                 f"*STRENGTH_LINEAR_PLASTIC {metal.G} {metal.Y} 0.0")
    x = (np.arange(2 * n) - n + 0.5) * dx
    try:
        last, energy = uniaxial(folder, lmp, style, x, np.where(x < 0, 0.5, -0.5) * speed, metal.rho0, dx, rows, coeff, t_end,
                                courant=s.get("smd_C", 0.1))
    except Stopped as why:
        return answer(folder, 2 * n * rows, {}, failed=str(why))
    if len(last["x"]) != 2 * n or not np.isfinite(last["x"]).all():
        return answer(folder, 2 * n * rows, {}, failed="not finite")
    layers = dict(sigma=last["s"][n:], rho=last["rho"][n:], u=last["v"][n:, 0] + 0.5 * speed, e=np.zeros(n))
    l1 = distance(layers, waves, metal.rho0, dx, last["time"])
    passed = waves[-1].m * last["time"] / (metal.rho0 * dx)
    plateau = layers["sigma"][int(0.25 * passed):int(0.75 * passed) + 1].mean() / waves[-1].sigma - 1
    errors = {f"L1 {f}": 100 * l1[f] for f in ("sigma", "rho", "u")}
    return answer(folder, 2 * n * rows, {**errors, "plateau sigma": 100 * abs(plateau)}, energy=energy)


def pulse(lmp, folder, length, wide, s):
    """face_scenes.wave in bulk: a strip in uniaxial strain with a free end, linear laws"""
    x = np.arange(length) + 0.5
    A = 1e-4 * CL
    coeff = f"*COMMON {RHO} {E:.17g} {NU:.17g} {s['q1']} {s['q2']} {HOURGLASS} 1.0 *EOS_LINEAR *STRENGTH_LINEAR"
    last, energy = uniaxial(folder, lmp, "tlsph", x, A * np.exp(-0.5 * (x / wide) ** 2), RHO, 1.0, s.get("rows", 12), coeff, 0.8 * length / CL,
                            courant=s.get("smd_C", 0.1))
    u = last["v"][:, 0]
    string = 0.5 * A * sum(np.exp(-0.5 * ((x - sign * CL * last["time"]) / wide) ** 2) for sign in (1, -1))
    return dict(particles=length * s.get("rows", 12), l1=np.abs(u - string).sum() / string.sum(), height=u.max() / A, drift=energy)


def taylor(lmp, folder, dx, laws, t_end, s, V=227.0, L=32.4e-3, R=3.2e-3):
    """Taylor's cylinder and its mirror image as one body: the wall without friction. laws: as of fem_mechanics_scenes.COPPER, linear hardening"""
    words = dict(zip(*[iter(laws[0].split()[2:])] * 2)), dict(zip(*[iter(laws[1].split()[2:])] * 2))
    (eos, jc), g = words, float(words[1]["G"])
    rho, K = float(eos["rho0"]), float(eos["rho0"]) * float(eos["C"]) ** 2
    young, nu = moduli(K, g)
    q = dx * (np.arange(-int(R / dx) - 1, int(R / dx) + 1) + 0.5)
    z = dx * (np.arange(-int(round(L / dx)), int(round(L / dx))) + 0.5)
    x = np.stack(np.meshgrid(z, q, q, indexing="ij"), -1).reshape(-1, 3)
    x = x[x[:, 1] ** 2 + x[:, 2] ** 2 < R * R]
    v = np.zeros_like(x)
    v[:, 0] = -V * np.sign(x[:, 0])
    coeff = (f"*COMMON {rho} {young:.17g} {nu:.17g} {s['q1']} {s['q2']} {HOURGLASS} {eos['cp']} *EOS_SHOCK {eos['C']} {eos['S1']} {eos['g0']} "
             f"*STRENGTH_LINEAR_PLASTIC {jc['A']} {jc['B']}")
    box = [(-1.1 * L, 1.1 * L), (-4 * R, 4 * R), (-4 * R, 4 * R)]
    last, energy = go(folder, lmp, "tlsph", x, v, rho, dx, 3, box, "sm sm sm", coeff, t_end, courant=s.get("smd_C", 0.1))
    if len(last["x"]) != len(x):
        raise Stopped(f"{len(x) - len(last['x'])} particles lost")
    y = last["x"][x[:, 0] > 0]
    rad = np.hypot(y[:, 1], y[:, 2])
    foot = rad[y[:, 0] < 1e-3]
    return dict(particles=len(x), length=1e3 * (np.ptp(y[:, 0]) + dx), foot=1e3 * np.sqrt(2 * (foot**2).mean()), widest=1e3 * rad.max(), drift=energy)
