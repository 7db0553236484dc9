"""The scenes of hard_solids.py and hard_impacts.py with LAMMPS's package MACHDYN: smd/tlsph, with smd/hertz between bodies, and smd/ulsph.

They stand beside those of this package; nothing is asked of them. Kernels reach 2.4 spacings, as ours; viscosity, hourglass control and the factor of
the time step (0.1) are those of MACHDYN's examples. Energy is what they say of it: kinetic, internal, contacts (pe).
"""

import hvi
import numpy as np
from face_scenes import CL, RHO, G, K, block
from tensile_scenes import RING, nearest, pieces

AL = dict(rho=2703.0, K=2703 * 5240.0**2, G=27.6e9)
AL_TL = "*JOHNSON_COOK 324.1e6 113.8e6 0.42 0.002 1.0 300 775 1.34 *EOS_SHOCK 5240 1.4 1.97"  # Al6061-T6.hvi
AL_UL = "*EOS_TAIT 4.6 *STRENGTH_LINEAR_PLASTIC 27.6e9 350e6 0"  # 4 S1 - 1; without hardening

SCENE = """units {units}
dimension {dim}
boundary {boundary}
newton off
atom_style smd
atom_modify map array
comm_modify vel yes
neighbor {skin:.17g} bin
neigh_modify every 5 delay 0 check yes
read_data smd.data
group {style} union all
{pair}
{more}
fix move all smd/integrate_{style}
fix step all smd/adjust_dt 0.1
timestep {dt:.17g}
compute e all smd/internal/energy
compute eint all reduce sum c_e
variable e equal pe+ke+c_eint
dump d all custom {every} smd.dump id type mass x y z vx vy vz
dump_modify d sort id format float %.17g
variable left equal {t_end:.17g}-time
fix end all halt 1 v_left < 0.0 error continue message no
thermo 20
thermo_style custom step time dt atoms pe ke v_e {columns}
thermo_modify norm no lost ignore format float %.17g
run {steps}
write_dump all custom end.dump id type mass x y z vx vy vz modify sort id format float %.17g
"""


def smd(lmp, folder, style, x, v, kind, dx, law, t_end, *, rho, K, G, dim=3, every=50, failure="", more="", columns="", box=None, units="lj",
        steps=200000, timeout=300):
    """kind: types, bodies of their own with tlsph; law: what follows *COMMON. Result; frames with x, v, mass, type of those that are there"""
    n, E, nu = len(x), 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G)
    size = np.ptp(x, axis=0)
    low, high = (x.min(0) - 2 * size - 9 * dx, x.max(0) + 2 * size + 9 * dx) if box is None else box
    if dim == 2:
        low[2], high[2] = -0.5, 0.5
    volume = dx**dim
    lines = ["smd", "", f"{n} atoms", f"{int(kind.max())} atom types", ""]
    lines += [f"{low[k]:.17g} {high[k]:.17g} {c}lo {c}hi" for k, c in enumerate("xyz")]
    lines += ["", "Atoms # smd", ""]
    radii = f"{volume:.17g} {rho * volume:.17g} {1.2 * dx:.17g} {0.5 * dx:.17g}"
    lines += [f"{i + 1} {kind[i]} {kind[i]} {radii} " + " ".join(f"{a:.17g}" for a in [*x[i], *x[i]]) for i in range(n)]
    lines += ["", "Velocities", ""] + [f"{i + 1} " + " ".join(f"{a:.17g}" for a in v[i]) for i in range(n)]
    (folder / "smd.data").write_text("\n".join(lines) + "\n")
    t = range(1, int(kind.max()) + 1)
    if style == "tlsph":
        pair = f"pair_style hybrid/overlay smd/tlsph smd/hertz 1.5\npair_coeff * * smd/hertz {E:.17g}\n"
        pair += "".join(f"pair_coeff {k} {k} smd/tlsph *COMMON {rho} {E:.17g} {nu:.17g} 0.06 1.0 10 1.0 {law} {failure} *END\n" for k in t)
    else:
        pair = "pair_style smd/ulsph *DENSITY_CONTINUITY *VELOCITY_GRADIENT *GRADIENT_CORRECTION\n"
        pair += "".join(f"pair_coeff {k} {k} *COMMON {rho} {np.sqrt(K / rho):.17g} 1.0 1.0 0.0 {law} *END\n" for k in t)
        pair += "".join(f"pair_coeff {a} {b} *CROSS\n" for a in t for b in t if a < b)
    c = np.sqrt((K + 4 / 3 * G) / rho)
    r = lmp(SCENE.format(units=units, dim=dim, boundary="f f p" if dim == 2 else "f f f", skin=0.3 * dx, pair=pair, more=more, style=style,
                         dt=0.05 * dx / c, every=every, t_end=t_end, columns=columns, steps=steps), timeout=timeout)
    dumps = (hvi.Dump(folder / name, mirror=["none"]) for name in ("smd.dump", "end.dump"))
    return r, [dict(type=f["type"].astype(int), m=f.m, x=np.column_stack([f[k] for k in "xyz"]),
                    v=np.column_stack([f[k] for k in ("vx", "vy", "vz")])) for dump in dumps for f in dump]


def books(r, frames, first):
    """energy and momentum as hard_solids.books, of what is there; first: sum of |p|, and p, at the start"""
    p = [(f["m"][:, None] * f["v"]).sum(0) for f in frames]
    e = r.thermo["v_e"]
    return dict(energy=np.abs(e / e[0] - 1).max(), momentum=np.abs(np.array(p) - p[0]).max() / first)


def elastic(style, law="", **more):
    return dict(law="*STRENGTH_LINEAR *EOS_LINEAR" if style == "tlsph" else f"*EOS_LINEAR *STRENGTH_LINEAR {more['G']:.17g}", **more)


def stock_rings(lmp, folder, style):
    dx, u = 0.2, RING["speed"]
    k = int(np.ceil(RING["outer"] / dx))
    q = dx * (np.arange(-k, k) + 0.5)
    ring = np.stack(np.meshgrid(q, q, indexing="ij"), -1).reshape(-1, 2)
    r = np.hypot(ring[:, 0], ring[:, 1])
    ring = np.pad(ring[(r > RING["inner"]) & (r < RING["outer"])], ((0, 0), (0, 1)))
    n, apart = len(ring), np.array([RING["outer"] + 1.5 * dx, 0, 0])
    x, kind = np.concatenate([ring - apart, ring + apart]), np.repeat([1, 2], n)
    v = np.zeros_like(x)
    v[:, 0] = np.repeat([u, -u], n)
    how = elastic(style, rho=RING["rho0"], K=RING["rho0"], G=RING["mu"] * RING["rho0"])
    r, frames = smd(lmp, folder, style, x, v, kind, dx, how.pop("law"), 160.0, dim=2, **how)
    left = [f["type"] == 1 for f in frames]
    return dict(books(r, frames, RING["rho0"] * dx**2 * 2 * n * u),
                pieces=max(pieces(f["x"][a, :2], 1.7 * dx) for f, k in zip(frames, left) for a in (k, ~k)),
                nearest=min(np.quantile(nearest(f["x"][:, :2]), 0.01) / dx for f in frames),
                pairs=max((nearest(f["x"][:, :2]) < 0.5 * dx).mean() for f in frames), rebound=-frames[-1]["v"][left[-1], 0].mean() / u)


def stock_square(lmp, folder, style, turns=3.0):
    x = block([8, 8])
    w = 0.05 * CL / (3.5 * np.sqrt(2))
    v = np.cross([0, 0, w], x)
    how = elastic(style, rho=RHO, K=K, G=G)
    r, frames = smd(lmp, folder, style, x, v, np.ones(len(x), int), 1.0, how.pop("law"), turns * 2 * np.pi / w, dim=2, **how)
    J = np.array([np.cross(f["x"], f["v"])[:, 2].sum() for f in frames])
    return dict(books(r, frames, np.hypot(v[:, 0], v[:, 1]).sum()), spin=np.abs(J / J[0] - 1).max(),
                kinetic=(frames[-1]["v"] ** 2).sum() / (v**2).sum())


def stock_bar(lmp, folder, style, considere, n=5, length=20, dx=0.5e-3, V=100.0, strain=0.8):
    """tlsph fails at the plastic strain of Johnson-Cook's damage in a bar, 0.47; ulsph has no law of failure"""
    x = dx * block([length + 6, n, n])
    L = length * dx
    kind = np.ones(len(x), int)
    v = np.zeros_like(x)
    v[:, 0] = np.clip(2 * V * x[:, 0] / L, -V, V)
    ends = np.abs(x[:, 0]) > 0.5 * L
    groups = [" ".join(str(i + 1) for i in np.flatnonzero(ends & (s * x[:, 0] > 0))) for s in (-1, 1)]
    more = f"group lo id {groups[0]}\ngroup hi id {groups[1]}\nfix lo lo setforce 0 0 0\nfix hi hi setforce 0 0 0\n"
    r, frames = smd(lmp, folder, style, x, v, kind, dx, AL_TL if style == "tlsph" else AL_UL, strain * L / (2 * V), more=more,
                    columns="f_lo[1] f_hi[1]", units="si", failure="*FAILURE_MAX_PLASTIC_STRAIN 0.47", **AL)
    t = r.thermo
    force = 0.5 * (t["f_lo[1]"] - t["f_hi[1]"])
    force = np.convolve(force, np.ones(5) / 5, "same")
    top, e = force.argmax(), 2 * V * t["Time"] / L
    fallen = np.flatnonzero(force[top:] < 0.5 * force[top])
    return dict(strength=force[top] / (n * dx) ** 2 / considere, elongation=e[top + fallen[0]] if len(fallen) else e[-1],
                load_end=np.abs(force[-10:]).max() / force[top], pairs=(nearest(frames[-1]["x"]) < 0.5 * dx).mean())


def stock_plate(lmp, folder, style, v0, dx=1e-3, D=10e-3, t=2e-3, Rplate=20e-3):
    """the whole, coarser than ours; tlsph fails at a plastic strain of 1"""
    q = dx * block([int(2 * Rplate / dx) + 2] * 2 + [round(t / dx)])
    plate = q[np.hypot(q[:, 0], q[:, 1]) < Rplate]
    ball = dx * block([int(D / dx) + 2] * 3)
    ball = ball[(ball**2).sum(1) < 0.25 * D * D]
    ball[:, 2] -= 0.5 * (D + t) + 0.5 * dx
    x, kind = np.concatenate([ball, plate]), np.repeat([1, 2], [len(ball), len(plate)])
    v = np.where((kind == 1)[:, None], [0.0, 0.0, v0], 0.0)
    t_end = 30e-3 / v0 + 4e-6
    reach = 1.5 * v0 * t_end + 2 * Rplate
    r, frames = smd(lmp, folder, style, x, v, kind, dx, AL_TL if style == "tlsph" else AL_UL, t_end, units="si",
                    failure="*FAILURE_MAX_PLASTIC_STRAIN 1.0", box=(np.full(3, -reach), np.full(3, reach)), **AL)
    return dict(books(r, frames, 2703 * dx**3 * len(ball) * v0), mass=abs(len(frames[-1]["x"]) / len(x) - 1))


def stock(lmp, folder, scene, setting, **how):
    return globals()[f"stock_{scene}"](lmp, folder, setting.split()[1], **how)
