"""Damage that takes plastic displacement, and thresholds of particles of their own, in scenes: restart, ranks, data files, statistics, what is refused."""

import numpy as np
import pytest
import voids_scenes as voids
from dumps import read_dump
from solid_scenes import FIXES, MATERIAL, NEIGHBOR, SOFT, factor, reader, start, state

ALWAYS = "neigh_modify check no\n"
JC = "spall voids weibull 6 17 weibull_size 2"


@pytest.fixture
def material(tmp_path):
    path = tmp_path / "soft.hvi"
    path.write_text(SOFT.format(sigma_p=3.0) + voids.VOIDS)
    return path


def melt(material):
    """at the temperature of the start; spalls within some steps"""
    material.write_text(material.read_text().replace("Tref 300", "Tref 200").replace("Tm 900", "Tm 290").replace("sigma 0.6", "sigma 0.2"))


def softened(f):
    """some have begun to fail, some have failed, by damage and by voids; nothing is damaged that has not begun, and what softens bears less"""
    soft = (f["damage"] > 0) & (f["damage"] < 1)
    assert soft.sum() > 20 and (f["damage"] >= 1).sum() > 5 and ((f["initiation"] > 0) & (f["initiation"] < 1)).sum() > 20
    assert (f["initiation"][f["damage"] > 0] >= 1).all() and f["spalled"].sum() > 5
    assert (f["vm"][f["damage"] >= 1] == 0).all() and (f["vm"][soft] > 0).sum() > 20


@pytest.mark.parametrize("nranks, words", [(1, "viscosity 1 2"), (2, "viscosity 1 2 h variable")])
def test_restart(lmp, tmp_path, material, nranks, words):
    """30 steps, restart, 30 more: the same bits as 60 at once"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, words, steps=0, sort=False, jc=JC, more="restart 30 half\n") + "run 59\n" + voids.OUT.format("whole"), nranks=nranks)
    lmp("read_restart half.30\n" + NEIGHBOR + FIXES.format(JC) + "run 29\n" + voids.OUT.format("part"), nranks=nranks)
    one, two = voids.read(tmp_path / "whole"), voids.read(tmp_path / "part")
    softened(one)
    for name in one:
        assert np.array_equal(one[name], two[name]), name


@pytest.mark.parametrize("nranks, newton", [(1, "off"), (2, "on"), pytest.param(3, "off", marks=pytest.mark.long)])
def test_restart_of_the_melted(lmp, tmp_path, material, nranks, newton):
    """from steps in which melted particles spall: the same bits, newton on and off"""
    melt(material)
    text = start(state(seed=23), tmp_path, material, steps=0, sort=False, jc=JC, newton=newton, more="restart 1 half\n" + ALWAYS)
    lmp(text + "".join(f"run 1\n{voids.OUT.format(f'f{k}')}" for k in range(1, 31)), nranks=nranks)
    f = {k: voids.read(tmp_path / f"f{k}") for k in range(1, 31)}
    failed = [f[k]["spalled"].sum() for k in f]
    steps = [k for k in range(2, 30) if failed[k - 1] > failed[k - 2]][::3]
    print(failed, steps)
    assert len(steps) > 2 and not f[30]["vm"].any()
    again = f"clear\nnewton {newton}\n" + "read_restart half.{}\n" + NEIGHBOR + ALWAYS + FIXES.format(JC)
    lmp("".join(again.format(k) + f"run {30 - k}\n" + voids.OUT.format(f"from{k}") for k in steps), nranks=nranks)
    wrong = [(k, name) for k in steps for name, a in voids.read(tmp_path / f"from{k}").items() if not np.array_equal(a, f[30][name])]
    assert not wrong, wrong


@pytest.mark.parametrize("melted", [False, True])
def test_ranks(lmp, tmp_path, material, melted):
    """1 to 4 ranks, newton on and off; melted particles spall by voids only"""
    if melted:
        melt(material)

    def text(name, newton="on"):
        return start(state(seed=23), tmp_path, material, steps=40, jc=JC, newton=newton) + voids.OUT.format(name)

    lmp(text("one"))
    one = voids.read(tmp_path / "one")
    assert (one["spalled"].sum() > 5 and not one["vm"].any()) if melted else 5 < ((one["damage"] > 0) & (one["damage"] < 1)).sum() < 500
    for nranks, newton in ((1, "off"), (2, "on"), (3, "off"), (4, "off")):
        lmp(text("all", newton), nranks=nranks)
        got = voids.read(tmp_path / "all")
        for name in one:
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * max(1.0, np.abs(one[name]).max()), (nranks, newton, name)


@pytest.mark.parametrize("jc", ["spall none", JC])
def test_data_file(lmp, tmp_path, material, jc):
    """30 steps, write_data, read_data, 30 more: as if not interrupted; with softening the section is there without voids, too"""
    lmp(start(state(seed=23), tmp_path, material, steps=0, jc=jc) + "run 30\nwrite_data half.data\n" + voids.OUT.format("half") + "run 30\n" + voids.OUT.format("whole"))
    assert "\njc_voids # id voids damage work initiation\n" in (tmp_path / "half.data").read_text()
    text = reader(material, jc=jc).replace("fix jc NULL jc_forces", "fix jc NULL jc_forces fix jc NULL jc_voids")
    lmp(text + voids.OUT.format("read") + "run 30\n" + voids.OUT.format("part"), nranks=2)
    half, whole, again, part = (voids.read(tmp_path / f) for f in ("half", "whole", "read", "part"))
    assert np.array_equal(half["initiation"], again["initiation"]) and ((half["damage"] > 0) & (half["damage"] < 1)).sum() > 5
    for one, two, tolerance in ((half, again, 1e-13), (whole, part, 1e-9)):
        for name in one:
            assert np.abs(one[name] - two[name]).max() <= tolerance * max(1.0, np.abs(one[name]).max()), name


def test_softening(lmp, tmp_path, material):
    """damage of a step is its plastic strain times the spacing, 1, over u_f, from initiation on; what flows bears what is left of the yield stress"""
    material.write_text(SOFT.format(sigma_p=3.0).replace("strength johnson-cook\n", "strength perfect\n  G 6.0\n  Y 0.3\nstrength johnson-cook\n"))
    frames = "".join(f"run 1\n{voids.OUT.format(f'f.{k}')}" for k in range(8))
    lmp(start(state(seed=23), tmp_path, material, steps=20, jc="strength perfect spall none") + frames)
    f = [voids.read(tmp_path / f"f.{k}") for k in range(8)]
    n = 0
    for one, two in zip(f, f[1:]):
        sound = (one["initiation"] >= 1) & (two["damage"] < 1)
        assert (two["damage"] - one["damage"])[sound] == pytest.approx((two["eps"] - one["eps"])[sound] / 0.04, abs=1e-12)
        assert not two["damage"][two["initiation"] < 1].any()
        flows = sound & (two["eps"] > one["eps"])
        assert two["vm"][flows] == pytest.approx(0.3 * (1 - one["damage"][flows]), rel=1e-12)
        n += flows.sum()
    assert n > 100


@pytest.mark.parametrize("nranks", [1, 3])
def test_limits_of_their_own(lmp, tmp_path, material, nranks):
    """spall pressure: p is not below -sigma_p times Weibull's factor of the particle times (1/2)^(-3/6), and stands there where more was asked for"""
    text = SOFT.format(sigma_p=0.2)
    material.write_text(text[:text.index("damage")] + text[text.index("spall"):])
    s = state(seed=23)
    s.rho *= 0.97  # -p 0.48
    lmp(start(s, tmp_path, material, steps=3, jc="damage no spall pressure weibull 6 17 weibull_size 2") + voids.OUT.format("f"), nranks=nranks)
    f = voids.read(tmp_path / "f")
    limit = 0.2 * factor(6, 17, np.arange(1, len(f["p"]) + 1)) * np.sqrt(2)
    at = f["p"] <= -limit * (1 - 1e-12)
    assert at.sum() > 400 and f["p"][at] == pytest.approx(-limit[at], rel=1e-12)


def test_refinement(lmp, tmp_path):
    """the weakest of the particles of a length of 8 bears on average the same with 2, 8 and 32 of them; without their size ever less"""
    (tmp_path / "row.hvi").write_text("# UNITS: lj\neos linear\n  rho0 1\n  K 100\nspall limit\n  sigma_p 1\n")
    length, volumes = 8, 256
    without = []
    for parts in (2, 8, 32):
        a = length / parts
        n = parts * volumes
        lmp(f"""units lj
boundary f f f
atom_style sph
atom_modify map array
region box block 0 {n * a} {-4 * a} {4 * a} {-4 * a} {4 * a} units box
create_box 1 box
lattice sc {1 / a**3} origin 0.5 0 0
region row block 0 {n * a} {-0.1 * a} {0.1 * a} {-0.1 * a} {0.1 * a} units box
create_atoms 1 region row
mass 1 {a}
set group all sph/rho 0.9
pair_style hvi/sph cubic dim 1
pair_coeff 1 1 file row.hvi h {1.2 * a}
fix move all hvi/sph
fix jc all hvi/johnson-cook strength none spall pressure weibull 4 {100 + parts} weibull_size {length}
compute p all hvi/atom p
dump d all custom 1 out id c_p
dump_modify d sort id format float %.17g
run 0
""")
        tag, p = read_dump(tmp_path / "out").table.T
        assert len(p) == n and p.min() > -10, parts  # all stand at their limits
        weakest = -p.reshape(volumes, parts).max(1)
        print(f"{parts} particles: weakest {weakest.mean():.4f} +- {weakest.std() / volumes**0.5:.4f}")
        assert abs(weakest.mean() - 1) < 3 * weakest.std() / volumes**0.5, parts
        without.append(factor(4, 100 + parts, tag).reshape(volumes, parts).min(1).mean())
    assert without[2] < 0.6 * without[0]


@pytest.mark.parametrize("nranks", [1, 3])
def test_spacing_of_softening(lmp, tmp_path, material, nranks):
    """a spacing of 1, G 6, Y 0.25: u_f must be above 0.25/18 = 0.01389; once per type, whatever ranks have it"""
    for u_f, n in (("0.0138", 2), ("0.0139", 0)):
        material.write_text(SOFT.format(sigma_p=3.0).replace("u_f 0.04", f"u_f {u_f}"))
        r = lmp(start(state(), tmp_path, material, steps=0, jc="spall none") + "run 1\n", nranks=nranks)
        said = [w for w in r.warnings if "3 G u_f/Y" in w]
        assert len(said) == n, r.warnings
        for itype, w in enumerate(said, 1):
            assert f"the spacing 1 of material {material} (type {itype}) must be less than 3 G u_f/Y = 0.9936" in w and "u_f above 0.01389" in w, w


@pytest.mark.parametrize("words, message", [
    ("weibull_size", "Illegal fix hvi/johnson-cook weibull_size command: missing argument"),
    ("weibull_size 1", "weibull_size needs weibull"),
    ("weibull 3 1 weibull_size -1", "weibull_size must be >= 0, not -1"),
    ("weibull 3 1 weibull_size inf", "inf"),
    ("weibull 0.5 1 weibull_size 1", "weibull_size needs a modulus of 1 or more, not 0.5"),
    ("weibull 3 1 weibull_size 1 damage no spall none", "scatters damage and spall: it needs one of them"),
    ("weibull 3 1 weibull_size 0 damage no", "weibull scatters damage: it needs damage yes, or weibull_size")])
def test_wrong_words(lmp, tmp_path, material, words, message):
    r = lmp(start(state(), tmp_path, material, jc=words), expect_fail=True)
    assert message in r.error, r.error


@pytest.mark.parametrize("line, message", [
    ("u_f -1", "u_f = -1 must be >= 0"), ("eps_min 0", "eps_min = 0 must be > 0"), ("sigma_spall -2", "sigma_spall = -2 must be >= 0")])
def test_wrong_values(lmp, tmp_path, material, line, message):
    material.write_text(MATERIAL.format(sigma_p=3.0).replace("spall limit", f"  {line}\nspall limit"))
    r = lmp(start(state(), tmp_path, material), expect_fail=True)
    assert message in r.error, r.error


def test_restart_with_another_size(lmp, tmp_path, material):
    lmp(start(state(seed=23), tmp_path, material, steps=3, jc=JC) + "write_restart half\n")
    r = lmp("read_restart half\n" + NEIGHBOR + FIXES.format(JC.replace("size 2", "size 3")) + "run 1\n", expect_fail=True)
    assert "weibull 6 17 weibull_size 2, this run" in r.error and "weibull_size 3" in r.error, r.error


TORN = """units si
boundary s s s
atom_style sph
atom_modify map array
lattice sc 1e-3 origin 0.5 0.5 0.5
region bar block 0 4 0 4 0 10
region far block 30 31 0 1 0 1
region box block -1 40 -1 11 -1 11
create_box 1 box
"""
LAWS = """pair_style hvi/sph cubic dissipation riemann
pair_coeff * * file Al2024-T3.hvi spacing 1e-3
fix step all hvi/dt 0.3
compute st all hvi/atom damage spalled
variable failed atom "c_st[1]>=1 || c_st[2]>0"
compute many all reduce sum v_failed
thermo_style custom step c_many
"""
SCATTER = "fix move all hvi/sph\nfix solid all hvi/johnson-cook spall principal weibull 2 4711 weibull_size 1e-3\n"


@pytest.mark.parametrize("nranks", [1, 3])
def test_thresholds_stay_with_their_particles(lmp, root, monkeypatch, nranks):
    """whatever IDs commands give them later: delete_atoms, which closes gaps, and read_data add"""
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(root / "potentials"))
    text = TORN + "create_atoms 1 region far\ncreate_atoms 1 region bar\ngroup far region far\ngroup bar region bar\n" + SCATTER + LAWS
    text += "velocity bar ramp vz -120 120 z 0 10e-3 units box\nrun 25\n{}run 75\n"
    want, _, got = (lmp(text.format(line), nranks=nranks).thermo["c_many"][-1] for line in (
        "delete_atoms group far compress no\n", "write_data torn.data\n", "delete_atoms group far\n"))
    assert want > 20 and got == want
    sections = "".join(f" fix {of} NULL {of}{part}" for of, part in (("move", "_rates"), ("move", "_step"), ("solid", "_forces")))
    again = TORN + "create_atoms 1 single 35.5 0.5 0.5\n" + SCATTER + f"read_data torn.data add append fix move NULL NULL fix solid NULL NULL{sections}\n" + LAWS
    assert lmp(again + "run 75\n", nranks=nranks).thermo["c_many"][-1] == want
