"""Random small scenes, the same on any ranks and layout, with inactive particles and other list criteria; turned, mirrored, shifted, in two runs; closed balances.

Scenes are drawn by hypothesis, always the same ones; the long form draws more. Where there is an independent form of the equations in NumPy, forces and rates are
its, too, both of what has loops in vectors and of what has not.
"""

import dataclasses

import numpy as np
import pytest
from corrected import Solid
from corrected import rates as solid_rates
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from solid_scenes import MATERIAL
from sph_scenes import Fluid, ideal_gas, rates, riemann_rates, tait

FEW = dict(derandomize=True, deadline=None, database=None, phases=[Phase.generate], suppress_health_check=list(HealthCheck))
SHORT, LONG = settings(max_examples=6, **FEW), settings(max_examples=60, **FEW)

RHO0 = {1: 1.0, 2: 1.7}
EOS = {  # of each kind: words of pair_coeff by type, laws of Python by type
    "liquid": ({1: "eos tait 1.0 4.0 7", 2: "eos tait 1.7 3.0 7"}, {1: tait(1.0, 4.0), 2: tait(1.7, 3.0)}),
    "gas": ({1: "eos idealgas 1.4", 2: "eos idealgas 1.6"}, {1: ideal_gas(1.4), 2: ideal_gas(1.6)}),
    "solid": ({1: "file m1.hvi", 2: "file m2.hvi"}, None),
}
FLUID_WORDS = {  # of pair_style: what NumPy has for it
    "": dict(), "form symmetric": dict(form="symmetric"), "interface 0.3": dict(alpha=0.3), "viscosity 0.5 0.25": dict(visc=(0.5, 0.25)),
    "interface auto form symmetric": dict(alpha="auto", form="symmetric"), "dissipation riemann": dict(riemann=True)}
SOLID_WORDS = {"": dict(), "viscosity 0.7 0.3": dict(visc=(0.7, 0.3)), "interface 0.3": dict(alpha=0.3), "artstress 0.3 4": dict(art=(0.3, 4)), "dissipation riemann": None}
STEP, STEPS = 0.01, 8
OUT = """compute S all hvi/atom p c {solid}
compute R all property/atom drho desph rho esph
dump d all custom 1 {file} id type x y z vx vy vz fx fy fz c_R[1] c_R[2] c_R[3] c_R[4] c_S[*]
dump_modify d format float %.17g sort id
run 0
undump d
uncompute S
uncompute R
"""
OF_SOLIDS = "eps damage spalled sxx syy szz sxy sxz syz"


@dataclasses.dataclass
class Scene:
    """kind: of EOS; walls: a letter for each direction, of the command boundary; mirror: a plane at the lower end of x; low: corner of the box"""

    state: Fluid
    kind: str
    walls: str
    words: str
    kernel: str
    variable: bool
    tension: bool
    mirror: bool
    low: np.ndarray

    @property
    def box(self):
        return self.state.box

    def text(self, name, newton="on", comm="brick", processors="* * *", sleep="no", lists="relative", skin=0.3, steps=(0,), out=None, axis="x", anew=""):
        """Input that ends with a dump; out: name of the file, steps: of runs before it, anew: a command after them; what else: the layout"""
        s = self.state
        _write(s, self.low, f"{name}.data")
        mirror = f" mirror {axis} {self.low['xyz'.index(axis)]:.17g} lo" if self.mirror else ""
        solid = self.kind == "solid"
        text = f"clear\nunits lj\ndimension {s.dim}\nnewton {newton}\nboundary {' '.join(self.walls)}\nprocessors {processors}\natom_style sph\natom_modify map array\n"
        text += f"comm_style {comm}\nread_data {name}.data\n" + ("balance 1.0 rcb\n" if comm == "tiled" else "")
        text += f"pair_style hvi/sph {self.kernel} dim {s.dim} {self.words}{' h variable' if self.variable else ''}{mirror}\n"
        text += "".join(f"pair_coeff {t} {t} {law} h {s.h[t]}\n" for t, law in EOS[self.kind][0].items())
        text += f"pair_coeff 1 2 tension {'yes' if self.tension else 'no'}\nneighbor {skin} bin\nneigh_modify every 1 delay 0 check yes\n"
        text += f"fix sph all hvi/sph sleep {sleep} lists {lists}\n" + ("fix jc all hvi/johnson-cook\n" if solid else "") + f"timestep {STEP}\n"
        text += BOOK + "".join(f"run {n}\n" for n in steps if n) + anew
        return text + OUT.format(file=out, solid=OF_SOLIDS if solid else "")


BOOK = """compute book all hvi/energy
thermo 1
thermo_style custom step c_book[*]
thermo_modify norm no lost error format float %.17g
"""


def _write(s, low, path):
    """as Fluid.write, the box somewhere"""
    n, high = len(s.x), low + s.box
    lines = ["state", "", f"{n} atoms", "2 atom types", ""] + [f"{low[a]:.17g} {high[a]:.17g} {'xyz'[a]}lo {'xyz'[a]}hi" for a in range(3)]
    lines += ["", "Masses", ""] + [f"{t} {m:.17g}" for t, m in s.mass.items()] + ["", "Atoms # sph", ""]
    lines += [f"{i + 1} {s.type[i]} {s.rho[i]:.17g} {s.esph[i]:.17g} 1 {s.x[i][0]:.17g} {s.x[i][1]:.17g} {s.x[i][2]:.17g}" for i in range(n)]
    lines += ["", "Velocities", ""] + [f"{i + 1} {s.v[i][0]:.17g} {s.v[i][1]:.17g} {s.v[i][2]:.17g}" for i in range(n)]
    with open(path, "w", encoding="ascii") as out:
        out.write("\n".join(lines) + "\n")


def _dump(path):
    lines = open(path, encoding="ascii").read().splitlines()
    start = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    a = np.array([line.split() for line in lines[start:]], dtype=float)
    ends = dict(type=(1, 2), x=(2, 5), v=(5, 8), f=(8, 11), drho=(11, 12), de=(12, 13), rho=(13, 14), esph=(14, 15), p=(15, 16), c=(16, 17))
    ends.update(eps=(17, 18), damage=(18, 19), spalled=(19, 20), S=(20, 26))
    return {name: a[:, slice(*columns)] for name, columns in ends.items() if a.shape[1] > columns[0]}


def drawn_scene(rng):
    """rng: of NumPy, from one number that hypothesis draws: choices of its own begin with the same few small scenes"""
    def pick(*words):
        return words[rng.integers(len(words))]

    kind, dim, kernel = pick("solid", "solid", "liquid", "gas"), pick(3, 3, 2), pick("cubic", "cubic", "gauss", "wendland2", "quintic")
    words = pick(*(SOLID_WORDS if kind == "solid" else FLUID_WORDS))
    shape = pick("filled", "bodies", "plate") if kind != "gas" else pick("filled", "bodies")
    filled = shape == "filled"
    jitter = {"filled": 0.15, "bodies": pick(0.05, 0.15, 0.0), "plate": 0.0}[shape]
    if filled:  # both types mixed, all over a periodic box
        counts = np.array([9, 8, 8] if dim == 3 else [14, 12, 1])
        x = _sites(counts)
        type_, box, walls = rng.integers(1, 3, len(x)), counts.astype(float), "ppp"
    else:  # two bodies, in a box with room; a plate is at rest, and most of it undisturbed
        one, two = ([*rng.integers(1, 6 if dim == 3 else 10, dim), 1][:3] for _ in range(2))
        if shape == "plate":
            one, two = [3, 3, 3 if dim == 3 else 1], [4, 18, 3 if dim == 3 else 1]
        x1, x2 = _sites(one), _sites(two)
        x2 = x2 + [one[0] + pick(0.0, 0.4, 0.8), *rng.uniform(-1, 1, 2)]
        x, type_ = np.concatenate([x1, x2]) + 4.0, np.repeat([1, 2], [len(x1), len(x2)])
        box = np.ceil(x.max(0)) + 5.0
        walls = "".join(pick(*"fpm") for _ in range(dim)) + ("p" if dim == 2 else "")
    x[:, :dim] += rng.uniform(-jitter, jitter, (len(x), dim))
    mirror = not filled and walls[0] != "p" and pick(True, False)
    if mirror:
        x[:, 0] -= x[:, 0].min() - 0.5
    if dim == 2:
        x[:, 2], box[2] = 0.0, 20.0
    v = np.zeros_like(x)
    speed = pick(0.1, 0.6, 2.0)
    v[:, :dim] = rng.normal(0, 0.15, (len(x), dim)) if jitter else 0.0
    v[:, 0] += np.where(type_ == 1, speed, 0.0 if shape == "plate" else -speed)
    rho = np.array([RHO0[t] for t in type_]) * (rng.uniform(0.97, 1.06, len(x)) if jitter else 1.0 if shape == "plate" else 1.01)
    mass = dict(RHO0)
    esph = np.array([mass[t] for t in type_]) * (rng.uniform(0.5, 1.5, len(x)) if kind == "gas" else 0.0)
    h = {1: 1.3, 2: pick(1.3, 1.15)}
    low = np.zeros(3) if dim == 3 else np.array([0.0, 0.0, -10.0])
    state = Fluid(x, v, rho, esph, type_, mass, h, box, tuple(wall == "p" for wall in walls), dim)
    return Scene(state, kind, walls, words, kernel, pick(True, False), pick(True, False), mirror, low)


def _sites(counts):
    return np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), -1).reshape(-1, 3) + 0.5


LAYOUTS = dict(newton=("on", "off"), comm=("brick", "tiled"), processors=("1 1 *", "* * 1", "* 1 1", "1 * *"), sleep=("no", "exact"), lists=("relative", "displacement"),
               skin=(0.1, 0.3, 1.0))


def drawn_layouts(rng, dim):
    known = dict(LAYOUTS, processors=LAYOUTS["processors"][1 if dim == 2 else 0:])
    return {n: [{name: values[rng.integers(len(values))] for name, values in known.items()} for _ in range(2)] for n in (1, 2, 3)}


SEEDS = st.binary(min_size=8, max_size=8).map(lambda seed: np.random.default_rng(list(seed)))


def apart(got, want, names=None):
    """by name: the largest difference over the largest value"""
    return {name: np.abs(got[name] - want[name]).max() / max(np.abs(want[name]).max(), 1e-300) for name in names or want}


def same(got, want, bound, what, names=None):
    wrong = {name: error for name, error in apart(got, want, names).items() if not error <= bound}
    assert not wrong, (wrong, what)


FIRST = ("f", "de", "drho")  # of a state, before any step


# changes all particles: forces of solids are then those of the state in the dump, without a velocity that is extrapolated
ANEW = "velocity all set 0.01 0 0 sum yes units box\n"


def check_layouts(lmp, folder, scene, layouts):
    """forces and rates of the first state to 1e-12, all of the state after some steps to 1e-9: the bounds of test_layouts and test_solid_forces"""
    (folder / "m1.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    (folder / "m2.hvi").write_text(MATERIAL.format(sigma_p=3.0).replace("rho0 1.0", "rho0 1.7"))

    def both(name, **how):
        return scene.text(name, out=f"first.{name}", **how) + scene.text(name, out=f"last.{name}", steps=(STEPS,), anew=ANEW, **how)

    ledger = lmp(both("one")).runs[1]
    for nranks, some in layouts.items():
        lmp("".join(both(f"{nranks}.{k}", **how) for k, how in enumerate(some)), nranks=nranks)
        for k, how in enumerate(some):
            same(_dump(f"first.{nranks}.{k}"), _dump("first.one"), 1e-12, (nranks, how), FIRST)
            same(_dump(f"last.{nranks}.{k}"), _dump("last.one"), 1e-9, (nranks, how))
    check_equations(scene)
    check_balances(scene, ledger)


def check_equations(scene):
    """against all pairs in NumPy: fluids in their first state, to 1e-12; solids after some steps, too, to the 1e-10 of test_corrected"""
    s = scene.state
    if scene.kind == "solid":
        for name in ("first.one", "last.one"):
            if SOLID_WORDS[scene.words] is not None:
                check_solid(scene, _dump(name), name)
    elif not scene.mirror:
        eos, terms = EOS[scene.kind][1], dict(FLUID_WORDS[scene.words], tension=scene.tension)
        if terms.pop("riemann", False):
            want = riemann_rates(s, eos, scene.kernel, follows=np.full(len(s.x), scene.variable), rho0={} if scene.kind == "gas" else RHO0, **terms)
        else:
            want = rates(s, eos, scene.kernel, **terms)
        got = {name: column if name == "f" else column[:, 0] for name, column in _dump("first.one").items()}
        same(got, want, 1e-12, "equations", FIRST)


def check_solid(scene, d, name):
    s, kind = scene.state, scene.state.type
    rho0, h = (np.array([a[t] for t in kind]) for a in (RHO0, s.h))
    d = {key: column if column.shape[1] > 1 else column[:, 0] for key, column in d.items()}
    failed = (d["damage"] >= 1) | (d["spalled"] > 0)
    now = np.clip(h * (s.rho / d["rho"]) ** (1 / s.dim), 0.5 * h, 1.25 * h) if scene.variable else h
    xx, yy, zz, xy, xz, yz = (d["S"] + np.outer(d["p"], [1, 1, 1, 0, 0, 0])).T
    S = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
    state = Solid(x=d["x"], v=d["v"], m=s.m, rho=d["rho"], rho0=rho0, p=d["p"], S=S, c=np.sqrt(d["c"] ** 2 + 4 / 3 * np.where(failed, 0, 6.0) / d["rho"]), h=now, kind=kind,
                  failed=failed, box=s.box * s.periodic, kernel=scene.kernel, dim=s.dim)
    terms = dict(SOLID_WORDS[scene.words])
    if "art" in terms:
        terms["art"] = (*terms["art"], np.tile(h, 2) if scene.mirror else h)
    want = solid_rates(state.mirrored(0, scene.low[0]) if scene.mirror else state, scene.tension, **terms)
    same(d, {key: want[key][:len(s.x)] for key in FIRST}, 1e-10, ("equations", name), FIRST)


def check_balances(scene, ledger):
    """pairs give nothing to momentum, and take from kinetic energy what internal ones get; over a run no mass or momentum is missing, and energy to 1e-2"""
    s, d = scene.state, _dump("first.one")
    size = np.abs(d["f"]).sum()
    for k in range(1 if scene.mirror else 0, s.dim):
        assert abs(d["f"][:, k].sum()) <= 1e-13 * size, k
    power = np.abs(d["f"] * d["v"]).sum() + np.abs(d["de"]).sum()
    assert abs(d["de"].sum() + (d["f"] * d["v"]).sum()) <= 1e-12 * power
    book = np.array([ledger[f"c_book[{k + 1}]"] for k in range(21)])
    momentum = book[9:12] + book[12:15] - book[15:18]
    assert np.abs(momentum - momentum[:, :1]).max() <= 1e-12 * (s.m[:, None] * np.abs(s.v)).sum()
    assert np.abs(book[18] + book[19] - s.m.sum()).max() <= 1e-13 * s.m.sum()
    assert np.abs(book[8] - 1).max() <= 1e-2  # LARGE_DRIFT of compute_hvi_energy.cpp, from which on it warns


@given(SEEDS)
@SHORT
def test_layouts(lmp, tmp_path, rng):
    scene = drawn_scene(rng)
    check_layouts(lmp, tmp_path, scene, drawn_layouts(rng, scene.state.dim))


@pytest.mark.long
@given(SEEDS)
@LONG
def test_more_layouts(lmp, tmp_path, rng):
    scene = drawn_scene(rng)
    check_layouts(lmp, tmp_path, scene, drawn_layouts(rng, scene.state.dim))


# ---------------------------------------------------------------------- the same scene elsewhere
def changed(scene, matrix, shift):
    """x -> matrix x + shift; matrix: of a permutation, with signs"""
    s = scene.state
    corners = np.array([scene.low, scene.low + s.box]) @ matrix.T + shift
    walls = "".join(scene.walls[np.flatnonzero(matrix[k])[0]] for k in range(3))
    state = dataclasses.replace(s, x=s.x @ matrix.T + shift, v=s.v @ matrix.T, box=np.abs(corners[1] - corners[0]), periodic=tuple(wall == "p" for wall in walls))
    return dataclasses.replace(scene, state=state, walls=walls, low=corners.min(0))


def back(d, matrix, shift):
    """of the changed scene, as the first had it"""
    found = dict(d, x=(d["x"] - shift) @ matrix, v=d["v"] @ matrix, f=d["f"] @ matrix)
    if "S" in d:
        xx, yy, zz, xy, xz, yz = d["S"].T
        S = matrix.T @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1) @ matrix
        found["S"] = S[:, [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return found


TURN = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
FLIP = np.diag([1, -1, 1])


def check_elsewhere(lmp, folder, scene):
    """turned by 90 degrees, mirrored, shifted, and in two runs, after some steps: to 1e-9"""
    (folder / "m1.hvi").write_text(MATERIAL.format(sigma_p=3.0))
    (folder / "m2.hvi").write_text(MATERIAL.format(sigma_p=3.0).replace("rho0 1.0", "rho0 1.7"))
    ways = {"turned": (TURN, np.zeros(3)), "mirrored": (FLIP, np.array([0.0, 3.0, 0.0])), "shifted": (np.eye(3), np.array([-17.0, 5.25, 0.0]))}
    text = scene.text("one", out="one", steps=(STEPS,)) + scene.text("two", out="two", steps=(3, STEPS - 3))
    for name, (matrix, shift) in ways.items():
        axis = "xyz"[np.flatnonzero(matrix[:, 0])[0]]
        text += changed(scene, matrix, shift).text(name, out=name, steps=(STEPS,), axis=axis)
    lmp(text)
    want = _dump("one")
    for name, (matrix, shift) in ways.items():
        got = back(_dump(name), matrix, shift)
        for k, wall in enumerate(scene.walls):  # the same place of a periodic box
            if wall == "p":
                got["x"][:, k] -= scene.box[k] * np.round((got["x"] - want["x"])[:, k] / scene.box[k])
        same(got, want, 1e-9, name)
    same(_dump("two"), want, 1e-9, "two runs")


@given(SEEDS)
@SHORT
def test_elsewhere(lmp, tmp_path, rng):
    check_elsewhere(lmp, tmp_path, drawn_scene(rng))


@pytest.mark.long
@given(SEEDS)
@LONG
def test_more_elsewhere(lmp, tmp_path, rng):
    check_elsewhere(lmp, tmp_path, drawn_scene(rng))
