"""Scenes the tests share: small states made here, the laws again in NumPy, the LAMMPS input for them, readers.

Reduced units (lj): sigma = mass = epsilon = 1 unless said otherwise; springs with r_eq = 2^(1/6).
"""

import dataclasses
import itertools
import pathlib

import numpy as np
from dumps import read_dump

R_EQ = 2.0 ** (1 / 6)
KAPPA, R_CUT = 27.0, 1.5  # of the main case of Watson & Steinhauser, reduced; its impact speed is 15.8
PAIR = "pair_style hvi/contact\npair_coeff * * 1.0 1.0\n"
BOND = f"bond_style hvi/spring\nbond_coeff 1 {KAPPA} {R_EQ!r} {R_CUT}\n"

# the vector of compute hvi/energy
LEDGER = ("kinetic internal contact spring broken left clamps total ratio px py pz left_px left_py left_pz jx jy jz mass "
          "left_mass left_count bonds_broken bonds_left p0x p0y p0z mass0 viscous plastic missed voids frozen").split()


@dataclasses.dataclass
class State:
    """x, v: (n, 3); bonds: (m, 2) of indices from 0; types from 1; box: (3, 2)"""

    x: np.ndarray
    v: np.ndarray
    bonds: np.ndarray
    box: np.ndarray
    periodic: bool = False
    types: np.ndarray = None
    masses: tuple = (1.0,)
    bond_types: np.ndarray = None

    def __post_init__(self):
        self.x, self.box = np.array(self.x, dtype=float), np.array(self.box, dtype=float)
        self.v = np.zeros_like(self.x) + self.v
        self.bonds = np.array(self.bonds, dtype=int).reshape(-1, 2)
        self.types = np.ones(len(self.x), dtype=int) if self.types is None else np.array(self.types)
        self.bond_types = np.ones(len(self.bonds), dtype=int) if self.bond_types is None else np.array(self.bond_types)

    def separation(self, i, j):
        d = self.x[i] - self.x[j]
        if self.periodic:
            length = self.box[:, 1] - self.box[:, 0]
            d -= length * np.round(d / length)
        return d

    def write(self, path):
        """a data file; every number is read back to the last bit"""
        n, nb = len(self.x), max(self.bond_types, default=1)
        lines = ["a state of the tests", "", f"{n} atoms", f"{len(self.bonds)} bonds",
                 f"{len(self.masses)} atom types", f"{nb} bond types", "2 extra bond per atom", ""]
        lines += [f"{lo!r} {hi!r} {c}lo {c}hi" for (lo, hi), c in zip(self.box.tolist(), "xyz")]
        lines += ["", "Masses", ""] + [f"{t + 1} {m!r}" for t, m in enumerate(self.masses)]
        lines += ["", "Atoms # bond", ""]
        lines += [f"{i + 1} 1 {t} {x!r} {y!r} {z!r}" for i, (t, (x, y, z)) in enumerate(zip(self.types, self.x.tolist()))]
        lines += ["", "Velocities", ""] + [f"{i + 1} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(self.v.tolist())]
        if len(self.bonds):
            lines += ["", "Bonds", ""] + [f"{k + 1} {t} {i + 1} {j + 1}" for k, (t, (i, j)) in enumerate(zip(self.bond_types, self.bonds))]
        path.write_text("\n".join(lines) + "\n")


def cube(n=6, jitter=0.04, speed=0.5, cut=0.0, periodic=False, seed=1, margin=6.0, types=1):
    """n^3 particles near a cubic lattice, neighbors bonded but for the part cut; if periodic, bonded across the box"""
    n = np.broadcast_to(n, 3)
    rng = np.random.default_rng(seed)
    cells = np.array(list(itertools.product(*map(range, n))))
    number = {tuple(c): k for k, c in enumerate(cells)}
    bonds = []
    for k, c in enumerate(cells):
        for step in np.eye(3, dtype=int):
            other = tuple((c + step) % n) if periodic else tuple(c + step)
            if other in number:
                bonds.append((k, number[other]))
    bonds = np.array(bonds)[rng.permutation(len(bonds))[int(cut * len(bonds)):]]
    x = (cells + 0.5) * R_EQ + rng.uniform(-jitter, jitter, (len(cells), 3))
    v = rng.normal(0.0, speed, x.shape)
    edge = 0.0 if periodic else margin
    box = np.stack([np.full(3, -edge), n * R_EQ + edge], axis=1)
    kinds = rng.integers(1, types + 1, len(x))
    return State(x, v - v.mean(axis=0), bonds, box, periodic, kinds, tuple(1.0 + 0.5 * t for t in range(types)))


def collision(n=5, speed=15.8, periodic=False, seed=3):
    """two bonded blocks that smash each other; margin enough for a short run"""
    a, b = cube(n, 0.01, 0.1, seed=seed), cube(n, 0.01, 0.1, seed=seed + 1)
    shift = np.array([n * R_EQ + 0.2, 0.37, 0.23])
    a.v[:, 0] += 0.5 * speed
    b.v[:, 0] -= 0.5 * speed
    box = [[-12.0, 2 * n * R_EQ + 12.0], [-12.0, n * R_EQ + 12.0], [-12.0, n * R_EQ + 12.0]]
    return State(np.vstack([a.x, b.x + shift]), np.vstack([a.v, b.v]), np.vstack([a.bonds, b.bonds + n**3]), box, periodic)


def chain(n=6, length=R_EQ, axis=0, box=((-40.0, 40.0),) * 3, start=0.0, periodic=False):
    """n particles in a row, bonded"""
    x = np.zeros((n, 3))
    x[:, axis] = start + length * np.arange(n)
    return State(x, 0.0, [(i, i + 1) for i in range(n - 1)], box, periodic)


# ------------------------------------------------------------------ the laws once more, by brute force


def contact(r, eps=1.0, sigma=1.0, F=1.0):
    """energy and force of Watson & Steinhauser eqs 2 and 3, the shift put right"""
    q = (sigma / r) ** 6
    near = r < R_EQ * sigma
    return np.where(near, F * eps * (q * q - q + 0.25), 0.0), np.where(near, F * eps * (12 * q * q - 6 * q) / r, 0.0)


def spring(r, kappa=KAPPA, r_eq=R_EQ):
    """energy and force of eqs 8 and 9"""
    d = np.maximum(r - r_eq, 0.0)
    return 0.5 * kappa * d * d, -kappa * d


def forces(s, eps=None, sigma=None, F=1.0, kappa=KAPPA, r_eq=R_EQ):
    """forces, contact and spring energy, virial sums xx yy zz xy xz yz; eps and sigma: matrices by type"""
    eps, sigma = (np.ones((9, 9)) if a is None else np.asarray(a) for a in (eps, sigma))
    t = s.types - 1
    f, virial = np.zeros_like(s.x), np.zeros(6)
    i, j = np.triu_indices(len(s.x), 1)
    energies = []
    for i, j, law in ((i, j, lambda r: contact(r, eps[t[i], t[j]], sigma[t[i], t[j]], F)),
                      (s.bonds[:, 0], s.bonds[:, 1], lambda r: spring(r, kappa, r_eq))):
        d = s.separation(i, j)
        r = np.linalg.norm(d, axis=1)
        e, push = law(r)
        fij = (push / r)[:, None] * d
        np.add.at(f, i, fij)
        np.add.at(f, j, -fij)
        virial += [np.sum(d[:, a] * fij[:, b]) for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        energies.append(e.sum())
    return f, *energies, virial


# ------------------------------------------------------------------ input for LAMMPS


def header(boundary="f f f", newton="on", comm="brick", processors="* * *", units="lj", sort=True):
    """everything before the box"""
    return (f"units {units}\natom_style bond\natom_modify map array{'' if sort else ' sort 0 0'}\nnewton {newton}\n"
            f"boundary {boundary}\nprocessors {processors}\ncomm_style {comm}\nspecial_bonds lj/coul 1 1 1\n")


def scene(state, path, pair=PAIR, bond=BOND, skin=0.3, **how):
    """input that reads a state, ready to run; how: see header()"""
    path = pathlib.Path(path)
    state.write(path)
    how.setdefault("boundary", "p p p" if state.periodic else "f f f")
    text = header(**how) + f"read_data {path.name}\n"
    if how.get("comm") == "tiled":
        text += "balance 1.0 rcb\n"
    return text + f"neighbor {skin} bin\nneigh_modify every 1 delay 0 check yes\n{pair}{bond}compute B all property/local batom1 batom2\n"


def ledger(clamps="", every=10, more=""):
    """compute hvi/energy and thermo output of all its entries, in full precision"""
    return (f"compute book all hvi/energy {clamps}\nthermo {every}\nthermo_style custom step time dt atoms bonds {more} "
            "c_book[*]\nthermo_modify format float %.16e\n")


def books(thermo):
    """the ledger's columns by name, from a thermo table"""
    return {name: thermo[f"c_book[{k + 1}]"] for k, name in enumerate(LEDGER)}


def momentum_error(book, state):
    """change of sum + left - impulse, relative to the sum of |p| at the start"""
    p = np.array([book[f"p{c}"] + book[f"left_p{c}"] - book[f"j{c}"] for c in "xyz"])
    scale = np.sum(np.linalg.norm(state.v, axis=1) * np.array(state.masses)[state.types - 1])
    return np.abs(p - p[:, :1]).max() / scale


DUMP = "write_dump all custom {} id x y z vx vy vz fx fy fz modify format float %.17g sort id\n"
BONDS = "write_dump all local {} c_B[1] c_B[2]\n"  # after a run


def read_bonds(path):
    """the bonds of the last frame of a dump local: a set of (lower, higher ID); none is there twice"""
    pairs = [tuple(sorted(map(int, row[-2:]))) for row in read_dump(path).table]
    assert len(set(pairs)) == len(pairs)
    return set(pairs)


def impact(n=4000, tD=0.425, rp=20.0, v0=6700.0, newton="on", comm="tiled", sort="sort 500 0.0", tstop=2.0, data=None):
    """the debris cloud of examples/debris-cloud (Watson & Steinhauser) with n particles, to tstop microseconds

    data: a file of write_data to start from, for the same IDs on any number of ranks; else all is created
    """
    d = 9.53
    volume = np.pi * d**3 / 6 + np.pi * rp**2 * tD * d
    a, a0 = (volume * 1e-9 / n) ** (1 / 3), 2.738e-4  # spacing, and that of the paper's main case
    sigma, s = a / R_EQ, a / a0
    rs, t, half = 0.5e-3 * d, 1e-3 * tD * d, 2.5e-3 * rp
    styles = """pair_style hvi/contact
bond_style hvi/spring
"""
    coeffs = f"""pair_coeff * * {0.01 * s**3} {sigma}
bond_coeff 1 {4.56e6 * s} {a} {1.5 * sigma}
neighbor {0.3 * a} bin
"""
    create = f"""lattice sc {a} origin 0.25 0.25 0.25
region box block -{half} {half} -{half} {half} {-2e-3 * rp} {t + 1.3e-6 * max(tstop, 2.0) * v0} units box
create_box 2 box bond/types 1 extra/bond/per/atom 12 extra/special/per/atom 12
region ball sphere 0 0 {-(rs + 1.2 * a)} {rs} units box
region plate cylinder z 0 0 {1e-3 * rp} 0 {t} units box
create_atoms 1 region ball
create_atoms 2 region plate
mass * {2700 * a**3}
group ball type 1
group plate type 2
{styles}{coeffs}
special_bonds lj/coul 0 1 1
create_bonds many ball ball 1 0.0 {1.1 * a}
create_bonds many plate plate 1 0.0 {1.1 * a}
special_bonds lj/coul 1 1 1
velocity all create 300 4711 loop geom mom yes rot yes
velocity ball set NULL NULL {v0} sum yes units box
"""
    return f"""units si
boundary f f f
newton {newton}
atom_style bond
atom_modify map array {sort}
comm_style {comm}
{f"{styles}special_bonds lj/coul 1 1 1{chr(10)}read_data {data}{chr(10)}{coeffs}" if data else create}
{"balance 1.0 rcb" if comm == "tiled" else ""}
compute B all property/local batom1 batom2
fix move all nve
fix step all hvi/dt 0.1
variable us equal 1e6*f_step[2]
fix stop all halt 5 v_us >= {tstop} error continue message no
"""
