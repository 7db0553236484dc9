"""Small scenes of fix hvi/fem: blocks of hexahedra that hold particles, free particles beside them, and what struck them."""

import pathlib

import numpy as np
from dumps import read_dump, vectors
from hvi.model.mesh import block

ALUMINUM = pathlib.Path(__file__).resolve().parents[2] / "potentials" / "Al6061-T6.hvi"

EDGE, N = 1.0e-3, 2  # of an element; particles along it
DX = EDGE / N
DENSITY = 2703.0  # of Al6061-T6.hvi
PAIR = "cubic dissipation riemann"
TOTAL, P, LEFT_P, J, MASS = 8, 10, 13, 16, 19  # of compute hvi/energy: where they begin

# nodes and embedded particles are of types 2 and 3, type 1 is free: a projectile; the order of fixes is that of the manual

HEAD = """units si
atom_style sph
atom_modify map yes {sort}
newton {newton}
boundary {boundary}
comm_style {comm}
processors * * *
fix prop all property/atom rmass ghost yes
region box block {box} units box
create_box 3 box
{create}
mass 1 {mass}
mass 2 {mass}
mass 3 1
"""
STYLES = """pair_style hvi/sph {pair}
pair_coeff 1 1 file {material} h {h}
pair_coeff 2 2 file {material} h {h}
pair_coeff 3 3 nodes
"""
FIXES = """fix move {sph} hvi/sph
fix solid all hvi/johnson-cook damage no spall {spall}
fix wall all hvi/fem nodes 3 {fem}
"""
REST = """fix step all hvi/dt {courant}
neighbor {skin} bin
compute book all hvi/energy {clamps}
compute state all hvi/atom p e eps sxx syy szz sxy sxz syz damage voids void_damage
compute rho all property/atom rho esph
thermo {every}
thermo_style custom step time dt atoms c_book[*] f_wall f_wall[*] {more}
thermo_modify norm no lost error format float %.17g
"""
STATE = """write_dump all custom {0} id type mass x y z vx vy vz fx fy fz c_rho[*] c_state[*] modify sort id format float %.17g
"""
VOIDS = "c_state[11]"  # of particles, and of the elements that hold them


def opens(path):
    """Words for start(): aluminum in which voids open early, and which bears them for long; at tensions of the scenes here no particle spalls"""
    text = ALUMINUM.read_text()
    first = text.index("spall voids")
    path.write_text(text[:first] + "spall voids\n  sigma 0.1e9\n  rate 1e5\n  m 0.2\n  phi_c 0.5\n")
    return dict(spall="voids", material=path)


# the plate apart: voids are in most elements by step 20, many are pressed shut by step 36
PULL = "velocity all ramp vz -100 100 z -2e-3 0 sum yes units box\n"


def laws(name, folder):
    """those words by the name of a law of spall, and what lets voids open"""
    return (opens(folder / "opens.hvi"), PULL) if name == "voids" else ({}, "")


def opened(path="open"):
    """Voids of particles in elements, from a dump made by OPEN: several elements have some"""
    phi = read_state(path)[VOIDS]
    assert (phi > 1e-4).sum() > 5 * N**3 and (phi < 0.5).all(), (phi > 1e-4).sum()


OPEN = STATE.replace("all custom {0}", "wall_embedded custom open")


def plate(nx=6, ny=6, nz=2, core=1.1, n=N, **more):
    """A plate in the plane x y, with its middle on the axis and its upper face at 0; free particles around the axis within core"""
    shift = np.array([nx / 2, ny / 2, nz]) if more.pop("whole", True) else np.array([0, 0, nz])
    free = (lambda x: np.hypot(x[:, 0], x[:, 1]) < core * EDGE) if core else None
    return block(nx, ny, nz, map=lambda x: (x - shift) * EDGE, n=n, free=free, type=2, node_type=3, **more)


def start(mesh, create="", boundary="s s s", box=None, newton="on", comm="brick", sort="sort 0 0", pair=PAIR, fem="", sph="all",
          clamps="", every=10, courant=0.4, more="", skin=0.3 * DX, data="mesh.data", read=True, density=DENSITY,
          spall="none", material=ALUMINUM):
    """Input up to the first run; the mesh is written to data"""
    if box is None:
        low, high = mesh._box()
        low, high = low - 2 * EDGE, high + 2 * EDGE
        if any(mesh.periodic):
            low, high = (np.where(mesh.periodic, mesh.box[k], a) for k, a in enumerate((low, high)))
        if "x 0 lo" in mesh.mirror:
            low[:2] = 0.0
        mesh.box = np.array([low, high])
    if read:
        mesh.write(data, density)
    if box is None:
        box = " ".join(f"{a:.17g} {b:.17g}" for a, b in zip(low, high))
    values = dict(create=create, boundary=boundary, box=box, newton=newton, comm=comm, sort=sort, pair=pair, fem=fem, sph=sph, clamps=clamps,
                  every=every, courant=courant, more=more, skin=skin, mass=density * DX**3, h=1.2 * DX, spall=spall, material=material)
    text = (HEAD + STYLES + FIXES).format(**values)
    text += f"read_data {data} add append fix wall elements Elements\n"
    return text + REST.format(**values)


def strike(mesh, radius=1.1, gap=0.5, v=3000.0, at=(0.0, 0.0)):
    """Puts a sphere of free particles of type 1 above the mesh; the command that lets it come down"""
    k = int(np.ceil(radius * N)) + 1
    cells = (np.indices((2 * k, 2 * k, 2 * k)).reshape(3, -1).T - k + 0.5) * DX
    x = cells[np.linalg.norm(cells, axis=1) < radius * EDGE] + [at[0], at[1], radius * EDGE + gap * DX]
    if "x 0 lo" in mesh.mirror:
        x = x[(x[:, :2] > 0.0).all(axis=1)]
    mesh.free = np.concatenate([mesh.free, x])
    mesh.free_type = np.concatenate([mesh.free_type, np.ones(len(x), int)])
    mesh.free_volume = np.concatenate([mesh.free_volume, np.full(len(x), DX**3)])
    return f"group ball type 1\nvelocity ball set 0 0 {-v:.17g} units box\n"


def strike_plate(v=3000.0, **more):
    """The plate with a sphere above it, and what lets that come down"""
    mesh = plate(**more)
    return mesh, strike(mesh, v=v)


def read_state(path):
    """{name: array by ID} of a dump made by STATE"""
    got = read_dump(path, sort=True)
    return {**got, **{name: vectors(got, what) for name, what in (("X", ""), ("V", "v"), ("F", "f"))}}
