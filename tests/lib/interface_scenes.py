"""Scenes where elements of fix hvi/fem and free particles meet: a bar through which pulses pass, a body at rest under stress, a block that spins.

Units of arguments: spacings of particles for lengths, steps for times.  The metal is 6061-T6; it stays elastic.
"""

import pathlib

import numpy as np
from hvi.model.mesh import block
from scipy.spatial import cKDTree

ALUMINUM = pathlib.Path(__file__).resolve().parents[2] / "potentials" / "Al6061-T6.hvi"

RHO, C0, G = 2703.0, 5240.0, 27.6e9  # of Al6061-T6.hvi
C = np.sqrt(C0**2 + 4 / 3 * G / RHO)  # of longitudinal waves
DX = 1e-3
DT = 0.26 * DX / C
SPEED = 1.0  # of a source, half of it goes either way
NEAR, WIDE = 30, 45  # the pulse is looked for that far from the interface, and around where it should be
LENGTH = 30  # of the waves in a packet

SCENE = """units si
atom_style sph
atom_modify map yes
boundary {boundary}
{masses}
region box block {box} units box
create_box {kinds} box
mass * {mass:.17g}
pair_style hvi/sph {kernel} {pair}
pair_coeff 1 1 file Al6061-T6.hvi h {h:.17g}
{nodes}
fix move all hvi/sph
fix solid all hvi/johnson-cook damage no spall none
{wall}
read_data {name}.data add append {section}
{more}
neighbor {skin:.17g} bin
timestep {dt:.17g}
thermo {every}
thermo_style custom step c_book[9] c_book[10] c_book[11] c_book[12] {left}
thermo_modify format float %.17g norm no
run {steps}
{then}
""".replace("Al6061-T6.hvi", str(ALUMINUM))


def scene(mesh, folder, name, kernel, pair, more, steps, fem="", then="", every=20):
    """text of the input of a mesh; kernel: name and h in spacings, as in "cubic 1.2" """
    mesh.write(folder / f"{name}.data", RHO)
    kind, eta = kernel.split()
    lo, hi = mesh.box
    there = len(mesh.elements) > 0
    return SCENE.format(boundary=" ".join("fp"[p] for p in mesh.periodic), box=" ".join(f"{a:.17g} {b:.17g}" for a, b in zip(lo, hi)),
                        mass=RHO * DX**3, kernel=kind, pair=pair, h=float(eta) * DX, name=name, skin=0.2 * DX, dt=DT, more=more, steps=steps, then=then,
                        every=every, masses="fix prop all property/atom rmass ghost yes" * there, kinds=2 if there else 1, nodes="pair_coeff 2 2 nodes" * there, wall=f"fix wall all hvi/fem nodes 2 {fem}" * there,
                        section="fix wall elements Elements" * there, left="f_wall" * there)


def frames(path):
    """of a dump: (ID, type, x, y, z, vx, vy, vz, ...) of each frame, sorted by ID"""
    out, lines, k = [], path.read_text().splitlines(), 0
    while k < len(lines):
        n = int(lines[k + 3])
        a = np.array([line.split() for line in lines[k + 9:k + 9 + n]], dtype=float)
        out.append(a[np.argsort(a[:, 0])])
        k += 9 + n
    return out


def velocity(pulse, at, angle=0.0, width=None):
    """of a source at x = at, as a variable of LAMMPS, along x and y: a bell, a plateau, or a packet of waves that go at an angle to x"""
    s = f"abs(x-({at * DX:.17g}))/{DX}"
    if pulse == "smooth":  # 10 spacings to 1/e
        return f"{SPEED}*exp(-1.0*({s}/10)^2)", "0"
    if pulse == "steep":  # 20 spacings wide, with ends of 4
        return f"{SPEED}*(({s}<10)+({s}>=10)*({s}<14)*(0.5+0.5*cos(PI*({s}-10)/4)))", "0"
    kx, ky = 2 * np.pi / LENGTH * np.cos(angle), 2 * np.pi / LENGTH * np.sin(angle)
    wave = f"{SPEED}*exp(-1.0*({s}/25)^2)*cos({kx:.17g}*x/{DX}+{ky:.17g}*y/{DX})"
    return f"{np.cos(angle):.17g}*{wave}", f"{np.sin(angle):.17g}*{wave}"


def bar(lmp, folder, free, n=2, kernel="cubic 1.2", pair="", fem="", pulse="smooth", angle=0.0, far=100, hold=2, ragged=False, side=-1, name="bar"):
    """A pulse on its way to the interface at x = 0 and back to where it came from, far away from it

    free: "right": particles there, elements on the left; "none", "all": to compare with
    hold: layers of elements at the interface that hold particles; ragged: two layers of cells are one or the other
    side: -1: the pulse comes from the left; 1: from the right
    """
    a = n * DX
    source, other = 2 * far + 40, (far + 60) / 2  # what comes back from the ends is not yet where the reflection is
    left, right = (int(-(-q // n)) for q in ((source, other) if side < 0 else (other, source)))
    across = max(3, -(-6 // n))
    high = round(LENGTH / np.sin(angle)) if angle else across * n
    ny = max(3, round(high / n))
    angle = np.arcsin(LENGTH / (ny * n)) if angle else 0.0  # as near as the cells allow
    shape = (left + right, ny, across)
    particles = np.zeros(shape, bool)
    particles[left:] = free == "right"
    if ragged:
        particles[left - 1:left + 1] = np.random.default_rng(3).random((2, ny, across)) < 0.5
    particles |= free == "all"
    holds = np.zeros(shape, bool)
    if free == "right":
        holds[left - hold - ragged:left + ragged] = True
    mesh = block(*shape, map=lambda p: (p - [left, 0, 0]) * a, n=n, free=particles, holds=holds & ~particles, periodic=(False, True, True), node_type=2)
    vx, vy = velocity(pulse, side * far, -side * angle)
    steps = round(far * DX / (C * np.cos(angle) * DT))
    more = f"""compute book all hvi/energy
variable vx atom {vx}
variable vy atom {vy}
velocity all set v_vx v_vy 0
dump d all custom {steps} {name}.dump id type x y z vx vy vz
dump_modify d format float %.10g"""
    result = lmp(scene(mesh, folder, name, kernel, pair, more, 2 * steps, fem))
    start, middle, end = frames(folder / f"{name}.dump")
    held = np.zeros(len(start), bool)  # slaves show what nodes do
    count = len(mesh.nodes)
    held[count:count + mesh.embedded.size // 3] = True
    t = result.thermo
    p = np.column_stack([t[f"c_book[{k}]"] for k in (10, 11, 12)])
    scale = RHO * DX**3 * SPEED * 10 * (across * n) * (ny * n)  # about that of the pulse
    return dict(x=start[~held, 2:5] / DX, middle=middle[~held, 5:8], end=end[~held, 5:8], side=side, far=far, drift=np.abs(t["c_book[9]"] - 1).max(),
                momentum=np.abs(p - p[0]).max() / scale, sideways=np.abs(end[:, 6:8]).max() / SPEED, result=result)


def reflection(one, reference):
    """largest velocity that the reference, in which nothing is at x = 0, does not have where the reflection should be; over that of the pulse as it
    arrived"""
    x = -one["side"] * one["x"][:, 0]  # from the left
    there = (x < -NEAR) & (x > -one["far"] - WIDE)
    distance, i = cKDTree(reference["x"]).query(one["x"][there])
    assert distance.max() < 1e-3, "the other run has other particles there"
    incident = np.linalg.norm(reference["middle"], axis=1)[np.abs(reference["x"][:, 0]) < WIDE].max()
    return np.linalg.norm(one["end"][there] - reference["end"][i], axis=1).max() / incident


def mistake(one, pulse):
    """of a bar of one kind at normal incidence: peak after the way to x = 0, and largest difference from the exact pulse, both over its peak"""
    x, v = one["x"][:, 0], one["middle"][:, 0]
    s = np.abs(x)
    exact = np.exp(-(s / 10) ** 2) if pulse == "smooth" else (s < 10) + (s >= 10) * (s < 14) * (0.5 + 0.5 * np.cos(np.pi * (s - 10) / 4))
    there = s < WIDE
    return v[there].max() / (0.5 * SPEED), np.abs(v - 0.5 * SPEED * exact)[there].max() / (0.5 * SPEED)


def squeezed(lmp, folder, n=2, kernel="cubic 1.2", pair="", ragged=False, strain=1e-3, steps=200, fem="", name="squeezed"):
    """Elements, particles, elements: all are moved so that strain along x is uniform, then set free at rest, the ends held

    Largest forces at once, on nodes and on free particles, over what the stress makes on one of their sides; largest speed since, over stress/(rho c)
    """
    a = n * DX
    m, across = -(-20 // n), max(3, -(-6 // n))
    shape = (4 * m, across, across)
    particles = np.zeros(shape, bool)
    particles[m:3 * m] = True
    if ragged:
        r = np.random.default_rng(3)
        for k in (m, 3 * m):
            particles[k - 1:k + 1] = r.random((2, across, across)) < 0.5
    holds = np.zeros(shape, bool)
    for k in (m, 3 * m):
        holds[k - 4:k + 4] = True
    mesh = block(*shape, map=lambda p: (p - [2 * m, 0, 0]) * a, n=n, free=particles, holds=holds & ~particles, periodic=(False, True, True), node_type=2)
    edge = 2 * m * a
    rate = -strain / (20 * DT)
    more = f"""region ends block {-0.99 * edge:.17g} {0.99 * edge:.17g} INF INF INF INF units box side out
group ends region ends
compute book all hvi/energy clamps all
velocity all ramp vx {rate * -edge:.17g} {rate * edge:.17g} x {-edge:.17g} {edge:.17g} units box
fix hold all setforce 0 0 0"""
    then = f"""unfix hold
fix hold ends setforce 0 0 0
velocity all set 0 0 0
dump d all custom {steps // 4} {name}.dump id type x y z vx vy vz fx fy fz
dump_modify d format float %.12g
run {steps}"""
    result = lmp(scene(mesh, folder, name, kernel, pair, more, 20, f"convert no {fem}", then))
    all_frames = frames(folder / f"{name}.dump")
    first = all_frames[0]
    count, inner = len(mesh.nodes), mesh.embedded.size // 3
    own = np.ones(len(first), bool)
    own[count:count + inner] = False
    x, f, node = first[own, 2], np.abs(first[own, 8:11]).max(axis=1), first[own, 1] == 2
    stress = RHO * C**2 * strain
    f /= stress * np.where(node, a, DX) ** 2
    inside = np.abs(x) < 0.9 * edge
    speed = max(np.abs(q[own, 5:8]).max() for q in all_frames[1:]) / (stress / (RHO * C))
    return dict(nodes=f[inside & node].max(), free=f[inside & ~node].max(), speed=speed, result=result)


def spun(lmp, folder, free="right", n=2, kernel="cubic 1.2", pair="", angle=0.8, turn=2e4, name="spun"):
    """a block of 6 x 6 x 12 spacings turns about y by an angle (rad), its half at x > 0 free particles; largest change of its angular momentum"""
    m = 6 // n
    a = n * DX
    particles = np.zeros((2 * m, m, m), bool)
    particles[m:] = free == "right"
    particles |= free == "all"
    mesh = block(2 * m, m, m, map=lambda p: (p - [m, m / 2, m / 2]) * a, n=n, free=particles, node_type=2)
    mesh.box = np.array([[-12.0], [12.0]]) * DX * np.ones(3)
    steps = round(angle / turn / DT)
    every = max(1, steps // 20)
    more = f"""compute book all hvi/energy
variable vx atom {turn}*z
variable vz atom -{turn}*x
velocity all set v_vx 0 v_vz
dump d all custom {every} {name}.dump id type x y z vx vy vz
dump_modify d format float %.17g"""
    result = lmp(scene(mesh, folder, name, kernel, pair, more, steps, "convert no", every=every))
    mass = np.zeros(len(mesh.nodes))
    np.add.at(mass, mesh.elements.ravel(), RHO * a**3 / 8)
    inner = mesh.embedded.size // 3
    mass = np.concatenate([mass, np.zeros(inner), np.full(len(mesh.free), RHO * DX**3)])
    L = np.array([(mass * (q[:, 4] * q[:, 5] - q[:, 2] * q[:, 7])).sum() for q in frames(folder / f"{name}.dump")])
    return np.abs(L / L[0] - 1).max(), np.abs(result.thermo["c_book[9]"] - 1).max(), result
