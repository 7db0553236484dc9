"""Scenes of fix hvi/fem that mechanics has exact answers to: patches, spinning blocks, waves, Taylor's cylinder, Verney's shell, collisions.

Unless said otherwise of an aluminum that stays elastic, in SI units, elements without particles.

    python3 tests/lib/fem_mechanics_scenes.py --lmp build/lmp verney radial=8 t_end=115 "fem=hourglass/viscous 0.1"
"""

import pathlib
import re
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "python")]
from hvi.model.mesh import assemble, block, volumes  # noqa: E402
from hvi.model.mesh_plate import plate  # noqa: E402
from lammps_runs import command_line  # noqa: E402
from solid_runs import material  # noqa: E402

RHO, C, G = 2703.0, 5240.0, 27.6e9
K = RHO * C**2
M = K + 4 / 3 * G  # of longitudinal waves
E = 9 * K * G / (3 * K + G)
NU = (3 * K - 2 * G) / (2 * (3 * K + G))
PLATE = E / (1 - NU**2)
EOS = f"eos gruneisen rho0 {RHO} C {C} S1 1.4 g0 1.97"
ELASTIC = f"strength perfect G {G} Y 1e11"
GRADIENT = np.array([[0.02, 0.1, 0.03], [-0.05, 0.01, 0.07], [0.04, -0.06, -0.025]]) * 1e6  # of patches, 1/s
PROBE = "p sxx syy szz sxy sxz syz vm vx vy vz".split()

SCENE = """units {units}
boundary {boundary}
atom_style sph
atom_modify map yes sort 0 0
fix prop all property/atom rmass ghost yes
region box block {box} units box
create_box {types} box
{masses}
pair_style hvi/sph {kernel} {pair}
{coeffs}
pair_coeff {types} {types} nodes
fix move all hvi/sph
fix solid all hvi/johnson-cook strength {strength} damage no spall none
fix wall all hvi/fem nodes {types} convert {convert} {fem}
read_data {name}.data add append fix wall elements Elements
group nodes type {types}
neighbor {skin:.17g} bin
neigh_modify every 1 delay 0 check yes
{velocity}
compute book all hvi/energy
{step}
{more}
thermo {every}
thermo_style custom step time dt c_book c_book[1] c_book[2] c_book[8] c_book[9] c_book[10] c_book[11] c_book[12] c_book[29] f_wall f_wall[8] f_wall[10] f_wall[11] {columns}
thermo_modify format float %.17g lost {lost} norm no
{run}
"""


def run(lmp, folder, mesh, v, steps, *, laws=(EOS, ELASTIC), fem="", pair="", kernel="cubic", dt=None, courant=None, every=None, columns="",
        more="", probes=False, dump=None, convert="no", lost="error", t_end=None, eta=1.2, skin=0.2, name="f", units="si", **how):
    """v: of nodes, (N, 3), from their places; dt, or else the step is that of fix hvi/dt; probes: of all elements

    Of the result: nodes, ID to place in the dump of nodes at the end; elements, the table PROBE at the end
    """
    if isinstance(laws, tuple):
        path, strength, rho = material(folder / f"{name}.hvi", *laws, units=units), laws[1].split()[1], float(laws[0].split("rho0")[1].split()[0])
    else:
        path, strength, rho = laws, "johnson-cook", float(re.search(r"rho0 +([0-9.]+)", laws.read_text()).group(1))
    mesh.write(folder / f"{name}.data", rho)
    box = mesh.box if mesh.box is not None else mesh._box()
    spacing = np.linalg.norm(mesh.corners[:, 0] - mesh.corners[:, 1], axis=-1).min() / max(mesh.per_edge, 2)
    materials = range(1, mesh.node_type)
    x = mesh.nodes
    velocity = v(x) if callable(v) else np.asarray(v)
    where = []
    if probes:
        where = mesh.corners.mean(axis=1)
        fem += "".join(" probe {:.17g} {:.17g} {:.17g}".format(*c) for c in where)
        more += (f"\nfix see all ave/time {probes} 1 {probes} {' '.join(f'f_wall[{k + 1}]' for k in range(len(PROBE)))} "
                 f"mode vector file {name}.probes format ' %.17g'\n")
    others = np.concatenate([mesh.embedded.reshape(-1, 3), mesh.free])  # the former are moved by nodes
    velocity = np.concatenate([velocity, v(others) if callable(v) else np.zeros_like(others)])
    n = len(velocity)
    set_v = "\n".join(f"variable v{a} atomfile {name}.v{a}" for a in "xyz") + "\nvelocity all set v_vx v_vy v_vz units box"
    for k, a in enumerate("xyz"):
        with open(folder / f"{name}.v{a}", "w", encoding="ascii") as out:
            out.write(f"{n}\n")
            np.savetxt(out, np.column_stack([np.arange(1, n + 1), velocity[:, k]]), fmt="%d %.17g")
    text = SCENE.format(
        boundary=" ".join("p" if p else "f" for p in mesh.periodic), box=" ".join(f"{a:.16g}" for a in box.T.ravel()), types=mesh.node_type,
        masses="mass * 1", kernel=kernel, pair=pair, coeffs="\n".join(f"pair_coeff {t} {t} file {path} h {eta * spacing:.17g}" for t in materials),
        convert=convert, fem=fem, name=name, strength=strength, units=units, skin=skin * spacing, velocity=set_v, step=f"timestep {dt:.17g}" if dt else f"fix step all hvi/dt {courant or 0.2}",
        every=every or max(1, steps // 20), columns=columns, lost=lost,
        more=more + (f"\ndump d all custom {dump} {name}.dump id type mass x y z vx vy vz fx fy fz\ndump_modify d format float %.17g sort id\n" if dump else "")
        + (f"\nvariable t equal time\nfix stop all halt 1 v_t > {t_end} error continue\n" if t_end else ""), run=f"run {steps}" if steps else "")
    r = lmp(text, **how)
    if probes:
        lines = [line.split() for line in (folder / f"{name}.probes").read_text().splitlines() if line[0] != "#"]
        rows = np.array([line[1:] for line in lines if len(line) > 2], dtype=float).reshape(-1, len(where), len(PROBE))
        r.elements = [dict(zip(PROBE, frame.T)) for frame in rows]
    if dump:
        r.frames = frames(folder / f"{name}.dump")
    return r


def frames(path):
    out, lines, k = [], path.read_text().splitlines(), 0
    while k < len(lines):
        n = int(lines[k + 3])
        a = np.array([line.split() for line in lines[k + 9:k + 9 + n]], dtype=float)
        out.append(dict(step=int(lines[k + 1]), id=a[:, 0].astype(int), type=a[:, 1].astype(int), mass=a[:, 2], x=a[:, 3:6], v=a[:, 6:9], f=a[:, 9:12]))
        k += 9 + n
    return out


def stable(edge, factor=0.5):
    """part of a cube's edge over the speed of longitudinal waves"""
    return factor * edge / np.sqrt(M / RHO)


def distorted(n, edge, share=0.25, seed=1, rim=True, room=1.0):
    """a block of n^3 cubes around the origin with nodes moved by up to that share of an edge; rim: also those of its faces"""
    m = block(n, n, n, n=0, map=lambda p: edge * (p - n / 2))
    outer = (np.abs(np.abs(m.nodes) - edge * n / 2) < 1e-9 * edge).any(axis=1)
    shift = np.random.default_rng(seed).uniform(-share, share, m.nodes.shape) * edge
    m.box = np.array([-1.0, 1.0])[:, None] * np.full(3, room * n * edge)
    m.nodes = m.nodes + np.where(outer[:, None] & (not rim), 0.0, shift)
    return m, outer


def patch(lmp, folder, gradient, steps, dt=None, n=5, edge=1e-3, laws=(EOS, ELASTIC), fem="viscosity 0 0"):
    """A distorted block whose outer nodes go on with the velocity gradient (times x), given to all at the start: uniform stress; nothing pulls at others"""
    m, outer = distorted(n, edge)
    rim = "group rim id " + " ".join(map(str, np.flatnonzero(outer) + 1)) + "\nfix rim rim setforce 0 0 0\n"
    r = run(lmp, folder, m, m.nodes @ np.asarray(gradient).T, steps, laws=laws, fem=fem, dt=dt or stable(edge, 0.1), more=rim, probes=steps, dump=steps)
    last, final = r.elements[-1], r.frames[-1]
    stress = np.stack([last[k] for k in PROBE[1:7]], axis=1)
    inner = ~outer[final["id"] - 1]
    size = np.abs(stress).max()
    return dict(stress=stress.mean(axis=0), size=size, spread=np.ptp(stress, axis=0).max() / size,
                volume=volumes(m.corners).sum(), force=np.abs(final["f"][inner]).max() / (size * edge**2),
                hourglass=np.abs(r.thermo["f_wall[8]"]).max() / r.thermo["f_wall[10]"][-1], thermo=r.thermo, x=final["x"], x0=m.nodes, dt=dt or stable(edge, 0.1))


def stress_of(gradient, t_end):
    """stress xx yy zz xy xz yz, energy per mass, and the volume over that of the start, of a body in which dv/dx of the start is that, and no velocity changes

    F = 1 + t gradient, L = gradient F^-1; S' = 2 G dev D + W S - S W; e' = (sigma:D)/rho; p by Gruneisen's law with a linear shock velocity
    """
    from scipy.integrate import solve_ivp

    S1, g0 = 1.4, 1.97

    def pressure(J, e):
        eta = 1 - J
        return RHO * C**2 * eta * (1 - 0.5 * g0 * eta) / (1 - S1 * eta) ** 2 + g0 * RHO * e if eta > 0 else C**2 * RHO * (1 / J - 1) + g0 * RHO * e

    def state(t, y):
        F = np.eye(3) + t * gradient
        return y[:9].reshape(3, 3), y[9], np.linalg.det(F), gradient @ np.linalg.inv(F)

    def rate(t, y):
        S, e, J, L = state(t, y)
        D, W = 0.5 * (L + L.T), 0.5 * (L - L.T)
        sigma = S - pressure(J, e) * np.eye(3)
        dS = 2 * G * (D - np.trace(D) / 3 * np.eye(3)) + W @ S - S @ W
        return np.append(dS.ravel(), (sigma * D).sum() * J / RHO)

    y = solve_ivp(rate, (0, t_end), np.zeros(10), rtol=1e-11, atol=1e-3).y[:, -1]
    S, e, J, _ = state(t_end, y)
    sigma = S - pressure(J, e) * np.eye(3)
    return sigma[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], e, J


def spin(lmp, folder, turns, speed=100.0, n=4, edge=1e-3, share=0.2, hourglass=0.0, factor=0.5, fem="viscosity 0 0 hourglass/viscous 0", **how):
    """A block that spins about a skew axis, its nodes at the corners at that speed; hourglass: speed of a motion that has no mean, too"""
    m, _ = distorted(n, edge, share)
    x = m.nodes
    m.nodes = x = x - volumes(m.corners) @ m.corners.mean(axis=1) / volumes(m.corners).sum()
    axis = np.array([1.0, 2.0, 2.0]) / 3
    omega = speed / (edge * n / 2 * np.sqrt(3))
    v = np.cross(omega * axis, x)
    if hourglass:
        lattice = np.round(x / edge + n / 2)
        v[:, 2] += hourglass * (-1.0) ** (lattice[:, 0] + lattice[:, 1])
    period = 2 * np.pi / omega
    dt = stable(edge, factor * (1 - share))
    steps = int(turns * period / dt)
    cols = " ".join(f"v_L{a}" for a in "xyz")
    more = "\n".join(f"variable L{a} equal angmom(nodes,{a})" for a in "xyz")
    r = run(lmp, folder, m, v, steps, fem=fem, dt=dt, columns=cols, more=more, every=max(1, steps // 200), probes=steps, **how)
    t = r.thermo
    L = np.stack([t[f"v_L{a}"] for a in "xyz"], axis=1)
    total = t["c_book[8]"]
    return dict(steps=steps, turns=turns, momentum=np.abs(L - L[0]).max() / np.linalg.norm(L[0]), drift=np.abs(total / total[0] - 1).max(),
                spring=t["f_wall[8]"] / total[0], spring_max=(t["f_wall[8]"] / total[0]).max(), kinetic=t["c_book[1]"] / total[0], vm=r.elements[-1]["vm"].max() / (RHO * speed**2), time=t["Time"])


def gap(lmp, folder, n=2, kernel="cubic", eta=1.2, ragged=False, spacing=1e-3, rate=1e3, pair="", shear=0.0, cells=(12, 4, 4)):
    """Elements and free particles side by side, periodic along the interface, in the same uniform velocity gradient: after a step their stress is uniform

    What is left of forces, of nodes over stress times the face of an element, of free particles over stress times that of their cell
    """
    edge = n * spacing
    grid = np.zeros(cells, bool)
    grid[cells[0] // 2:] = True
    if ragged:
        grid[cells[0] // 2 - 1:cells[0] // 2 + 1] = np.random.default_rng(4).random((2, *cells[1:])) < 0.5
    m = block(*cells, map=lambda p: edge * (p - [cells[0] / 2, 0, 0]), n=n, free=grid, periodic=(False, True, True), node_type=2)
    dt = 0.02 * stable(spacing, 1.0)
    r = run(lmp, folder, m, lambda x: rate * x[:, :1] * [1.0, shear, 0.0], 1, pair=pair, kernel=kernel, eta=eta, dt=dt, fem="viscosity 0 0", dump=1, every=1)
    f = r.frames[-1]
    sigma = M * rate * dt
    near = np.abs(f["x"][:, 0]) < edge * cells[0] / 2 - 2 * eta * spacing - 1.1 * edge
    size = np.linalg.norm(f["f"], axis=1) / sigma / np.where(f["type"] == 2, edge, spacing) ** 2
    nodes, free = near & (f["type"] == 2), near & (f["type"] == 1)
    return dict(kernel=kernel, ragged=ragged, nodes=int(nodes.sum()), node_force=size[nodes].max(), free_force=size[free].max(),
                momentum=np.abs(f["f"].sum(axis=0)).max() / (sigma * edge**2))


def standing(lmp, folder, kind, waves=1.0, nt=1, length=40, edge=1e-3, amp=0.1, factor=0.5, periods=2.0, fem="", across=None):
    """A standing wave, one length along x, of cubes: kind bulk, bar, plate (free along y, z; along z), bending (a plate, along z)

    Its frequency over that of theory, amplitude after some periods, hourglass energy over the total
    """
    ny = nt if kind == "bar" else 3
    nz = 3 if kind == "bulk" else nt
    free = {"bulk": (), "bar": (1, 2), "plate": (2,), "bending": (2,)}[kind]
    m = block(length * nt if kind != "bulk" else length, ny, nz, n=0, map=lambda p: edge * (p - [0, 0, nz / 2]), periodic=tuple(k not in free for k in range(3)))
    L = m.box[1, 0] - m.box[0, 0]
    k = 2 * np.pi * waves / L
    thickness = nt * edge
    if kind == "bending":
        omega = mindlin(k, thickness)
    else:
        omega = k * np.sqrt({"bulk": M, "bar": E, "plate": PLATE}[kind] / RHO)
    along = 2 if kind == "bending" else 0
    v = np.zeros_like(m.nodes)
    v[:, along] = amp * np.cos(k * m.nodes[:, 0])
    dt = stable(edge, factor)
    steps = int(periods * 2 * np.pi / omega / dt) + 1
    every = max(1, steps // (100 * int(np.ceil(periods))))
    more = (f"variable w atom mass*cos({k:.17g}*x)*v{'xyz'[along]}\ncompute w nodes reduce sum v_w\n")
    r = run(lmp, folder, m, v, steps, fem=fem, dt=dt, every=every, more=more, columns="c_w")
    t, a = r.thermo["Time"], r.thermo["c_w"] / r.thermo["c_w"][0]
    found, decay = damped_cosine(t, a, omega)
    total = r.thermo["c_book[8]"]
    return dict(kind=kind, layers=nt, elements=len(m.elements), steps=steps, frequency=found / omega, amplitude=np.exp(-decay * 2 * np.pi / omega),
                hourglass=r.thermo["f_wall[8]"][-1] / total[0], hourglass_max=np.abs(r.thermo["f_wall[8]"]).max() / total[0],
                drift=np.abs(total / total[0] - 1).max(), momentum=np.abs(r.thermo["c_book[10]"]).max())


def pulse(lmp, folder, length, wide, edge=1e-3, factor=0.5, fem=""):
    """A pulse of velocity runs along a bar in uniaxial strain from its free end, as face_scenes.wave: length, wide in edges

    L1 at the end against the pulse that a string carries, in units of what that has; height in units of the first
    """
    m = block(length, 1, 1, n=0, map=lambda p: edge * p, periodic=(False, False, False))
    m.box = np.array([[-length, -1, -1], [2 * length, 2, 2]]) * edge
    c, t_end = np.sqrt(M / RHO), 0.8 * length * edge / np.sqrt(M / RHO)
    v = np.zeros_like(m.nodes)
    v[:, 0] = 1e-4 * c * np.exp(-0.5 * (m.nodes[:, 0] / edge / wide) ** 2)
    steps = int(np.ceil(t_end / stable(edge, factor)))
    flat = "fix flat nodes setforce NULL 0.0 0.0"
    r = run(lmp, folder, m, v, steps, fem=fem, dt=t_end / steps, dump=steps, more=flat)
    f = r.frames[-1]
    x = m.nodes[f["id"] - 1, 0] / edge
    u, want = f["v"][:, 0] / (1e-4 * c), 0.5 * sum(np.exp(-0.5 * ((x - sign * 0.8 * length) / wide) ** 2) for sign in (1, -1))
    total = r.thermo["c_book[8]"]
    return dict(elements=len(m.elements), steps=steps, l1=np.abs(u - want).sum() / want.sum(), height=u.max(), drift=np.abs(total / total[0] - 1).max())


def yielding(lmp, folder, nt, over=4.0, Y=3e8, length=20, edge=1e-3, factor=0.5, fem="", thickness=None):
    """A plate that starts to bend as in standing(), at a velocity with which it would yield at its faces over times if it stayed elastic

    Deflection at its largest and what stays of it, over the largest of an elastic plate; plastic work and hourglass energy over the total
    """
    if thickness:
        edge = thickness / nt
    m = block(length * nt, 3, nt, n=0, map=lambda p: edge * (p - [0, 0, nt / 2]), periodic=(True, True, False))
    h = nt * edge
    m.box[:, 2] = -5 * h, 5 * h
    k = 2 * np.pi / (length * h)
    omega = mindlin(k, h)
    amp = over * 2 * Y * omega / (PLATE * h * k * k)
    v = np.zeros_like(m.nodes)
    v[:, 2] = amp * np.cos(k * m.nodes[:, 0])
    dt = stable(edge, factor)
    steps = int(2 * np.pi / omega / dt)
    more = f"variable w atom mass*cos({k:.17g}*x)*vz\ncompute w nodes reduce sum v_w\n"
    r = run(lmp, folder, m, v, steps, laws=(EOS, f"strength perfect G {G} Y {Y}"), fem=fem, dt=dt, every=max(1, steps // 200), more=more, columns="c_w")
    t = r.thermo
    a = t["c_w"] / t["c_w"][0]
    w = np.concatenate([[0.0], np.cumsum(0.5 * (a[1:] + a[:-1]) * np.diff(t["Time"]))]) * omega
    total = t["c_book[8]"][0]
    return dict(layers=nt, speed=amp, steps=steps, largest=w.max(), mean_late=w[len(w) // 3:].mean(), plastic=t["c_book[29]"][-1] / total,
                hourglass=t["f_wall[8]"][-1] / total, drift=np.abs(t["c_book[9]"] - 1).max())


def mindlin(k, h, shear=0.86):
    """frequency of bending waves of a plate of thickness h: Mindlin, J. Appl. Mech. 18 (1951) 31, the lower branch, with his factor of shear"""
    D, inertia, mass, S = PLATE * h**3 / 12, RHO * h**3 / 12, RHO * h, shear * G * h
    a, b, c = mass * inertia, mass * (D * k * k + S) + inertia * S * k * k, D * S * k**4
    return np.sqrt((b - np.sqrt(b * b - 4 * a * c)) / (2 * a))


def damped_cosine(t, a, omega):
    """frequency and decay of exp(-d t) cos(w t + phase), by least squares around omega"""
    from scipy.optimize import curve_fit
    (_, w, d, _), _ = curve_fit(lambda t, A, w, d, phase: A * np.exp(-d * t) * np.cos(w * t + phase), t, a, p0=(1.0, omega, 0.0, 0.0))
    return w, d


def taylor(lmp, folder, edge, laws, V=227.0, L=32.4e-3, R=3.2e-3, t_end=80e-6, fem="", **how):
    """A quarter of Taylor's cylinder, with its foot on a mirror plane: the rigid wall without friction (m, kg, s)"""
    m = plate(L, edge, radius=R, n=0, quarter=True)
    m.box = np.array([[0, 0, 0], [4 * R, 4 * R, 1.1 * L]])
    v = np.zeros_like(m.nodes)
    v[:, 2] = np.where(m.nodes[:, 2] > 0.0, -V, 0.0)
    r = run(lmp, folder, m, v, 200000, laws=laws, pair="mirror x 0 lo mirror y 0 lo mirror z 0 lo", fem=fem,
            t_end=t_end, every=200, dump=200, **how)
    x, t = r.frames[-1]["x"], r.thermo
    rad = np.hypot(x[:, 0], x[:, 1])
    internal = t["f_wall[10]"]
    return dict(over=(t["Dt"] / t["f_wall[11]"]).max(), edge=1e3 * edge, elements=len(m.elements), steps=int(t["Step"][-1]), length=1e3 * np.ptp(x[:, 2]), foot=1e3 * rad[x[:, 2] < 1e-9].max(),
                widest=1e3 * rad.max(), drift=np.abs(t["c_book[9]"] - 1).max(), hourglass=t["f_wall[8]"][-1] / internal[-1],
                kinetic=t["c_book[1]"][-1] / t["c_book[1]"][0], plastic=t["c_book[29]"][-1] / internal[-1])


# 42CrMo4 of the documentation of DynELA (O. Pantale, 2020: table of the impact samples; E 206.9 GPa, nu 0.3), at 287 m/s: there 26.52 mm and a foot
# of 11.18 mm, by Abaqus 26.55 and 11.22 mm, three-dimensional; nine tenths of the plastic work are heat there, all of it here

STEEL = ("eos gruneisen rho0 7830 C 4692.7 S1 1 g0 0 cp 460 T0 293.15",
         "strength johnson-cook G 79.577e9 A 806e6 B 614e6 n 0.168 C 0.0089 m 1.1 epsdot0 1 Tref 293.15 Tm 1813.15")

# as it is commonly quoted for copper at 227 m/s: E 117 GPa, nu 0.35, yield stress 400 MPa, hardening 100 MPa

COPPER = ("eos gruneisen rho0 8930 C 3815.4 S1 1.49 g0 2.0 cp 383 T0 300",
          "strength johnson-cook G 43.333e9 A 400e6 B 100e6 n 1 C 0 m 1 epsdot0 1 Tref 300 Tm 1e9")


def octant(radial, across, inner=8.0, outer=10.0):
    """An eighth of a shell, of three patches of squares between an axis and the diagonal; radial: layers, across: squares along an edge of a patch"""
    axes = np.eye(3)
    points, cells = [], []
    grid = block(across, across, radial, n=0)
    for k in range(3):
        a, b, c = axes[k], axes[(k + 1) % 3], axes[(k + 2) % 3]
        s, t = grid.nodes[:, :1] / across, grid.nodes[:, 1:2] / across
        ab, ac, abc = (q / np.linalg.norm(q) for q in (a + b, a + c, a + b + c))
        way = (1 - s) * (1 - t) * a + s * (1 - t) * ab + s * t * abc + (1 - s) * t * ac
        way /= np.linalg.norm(way, axis=1)[:, None]
        way[np.abs(way) < 1e-12] = 0.0
        cells.append(grid.elements + sum(map(len, points)))
        points.append(way * (inner + (outer - inner) * grid.nodes[:, 2:] / radial))
    points = np.concatenate(points)
    _, first, number = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    cells = number.ravel()[np.concatenate(cells)]
    none = np.zeros(len(cells), bool)
    box = np.array([[0, 0, 0], [1.2 * outer] * 3])
    return assemble(points[first], cells, 0, none, none, box=box)


def verney(lmp, folder, radial, across=None, t_end=150.0, fem="", viscosity="1.5 0.06", **how):
    """Verney's shell of beryllium, an eighth (cm, g, us, Mbar); from the radii 8 and 10 it stops at 4 where it is incompressible"""
    m = octant(radial, across or radial)
    r0 = np.linalg.norm(m.nodes, axis=1)
    v = -0.0619787 * (8 / r0**1.5)[:, None] ** 2 * m.nodes
    laws = ("eos gruneisen rho0 1.845 C 0.7998 S1 1.124 g0 1.11 a 0.16 T0 300", "strength perfect G 1.510 Y 0.0033")
    r = run(lmp, folder, m, v, 200000, laws=laws, units="lj", pair="mirror x 0 lo mirror y 0 lo mirror z 0 lo", fem=f"viscosity {viscosity} {fem}", t_end=t_end,
            every=20, dump=20, **how)
    size = np.array([np.linalg.norm(f["x"], axis=1) for f in r.frames])
    low, high = np.abs(r0 - 8) < 1e-6, np.abs(r0 - 10) < 1e-6
    mean = size[:, low].mean(axis=1)
    k = int(np.argmin(mean))
    t = r.thermo
    return dict(radial=radial, elements=len(m.elements), steps=int(t["Step"][-1]), inner=mean[k], spread=np.ptp(size[k, low]), outer=size[k, high].mean(),
                stops_at=t["Time"][min(k, len(t["Time"]) - 1)], kinetic=t["c_book[1]"].min() / t["c_book[1]"][0], drift=np.abs(t["c_book[9]"] - 1).max(),
                hourglass=t["f_wall[8]"][-1] / t["f_wall[10]"][-1])


def collision(lmp, folder, kind, speed, steps, n=2, edge=1e-3, share=0.0, fem="", factor=None, laws=(EOS, "strength perfect G 27.6e9 Y 3e8"), **how):
    """Two bodies of elements meet face to face, with the particles they hold between them, or one that is pressed together

    kind: blocks; thin (single elements side by side); distorted; shock (one block, half of it at each speed)
    """
    half = {"blocks": (3, 4, 4), "thin": (1, 5, 5), "distorted": (4, 4, 4), "shock": (12, 3, 3)}[kind]
    nx, ny, nz = half
    apart = 0 if kind == "shock" else 1
    grid = np.ones((2 * nx + apart, ny, nz), int)
    grid[nx:] = 1 if kind == "shock" else 2
    empty = np.zeros(grid.shape, bool)
    if apart:
        empty[nx] = True
    m = block(*grid.shape, map=lambda p: edge * (p - [(2 * nx + apart) / 2, ny / 2, nz / 2]), n=n, type=grid, empty=empty, node_type=3)
    if kind == "shock":
        m.node_type = 2
    shift = np.random.default_rng(2).uniform(-share, share, m.nodes.shape) * edge
    m.nodes = m.nodes + shift
    if apart:  # to one spacing of particles from face to face
        m.nodes[:, 0] += np.where(m.nodes[:, 0] < 0, 1, -1) * 0.5 * edge * (1 - 0.5 / max(n, 1) - share)
    m.box = np.array([-1.0, 1.0])[:, None] * np.full(3, 4 * edge * max(2 * nx, ny, nz))
    v = np.zeros_like(m.nodes)
    v[:, 0] = np.where(m.nodes[:, 0] < 0, speed, -speed)
    r = run(lmp, folder, m, v, steps, laws=laws, fem=fem, every=max(1, steps // 50), convert=how.pop("convert", "no"), dt=factor and stable(edge, factor), **how)
    if r.returncode:
        return r
    t = r.thermo
    unit = RHO * np.abs(v[:, 0]).max() * volumes(m.corners).sum() / 2
    return dict(kind=kind, speed=speed, steps=int(t["Step"][-1]), drift=np.abs(t["c_book[9]"] - 1).max(),
                momentum=max(np.abs(t[f"c_book[{k}]"] - t[f"c_book[{k}]"][0]).max() for k in (10, 11, 12)) / unit, hourglass=t["f_wall[8]"][-1] / t["f_wall[10]"].max(),
                kinetic=t["c_book[1]"][-1] / t["c_book[1]"][0], left=t["f_wall"][-1] / len(m.elements), dt=t["Dt"].min() / stable(edge, 1.0),
                over=(t["Dt"] / t["f_wall[11]"]).max(), thermo=t)


if __name__ == "__main__":
    command_line(__doc__, (patch, spin, gap, standing, yielding, pulse, taylor, verney, collision), GRADIENT=GRADIENT, STEEL=STEEL, COPPER=COPPER)
