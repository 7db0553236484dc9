"""Spall voids in a scene: restart, data files, layouts, mirrors, what is reported, what is refused."""

import itertools

import hybrid_scenes
import mirror_scenes
import numpy as np
import pytest
import solid_scenes
from solid_scenes import FIXES, MATERIAL, NEIGHBOR, PAIR, reader, start, state
from sph_scenes import Fluid, scene
from voids_scenes import OUT, VOIDS, read

JC = "damage no spall voids"


@pytest.fixture
def material(tmp_path):
    path = tmp_path / "voids.hvi"
    path.write_text(MATERIAL.format(sigma_p=3.0) + VOIDS)
    return path


def grown(f):
    """some have voids, some none, some have parted"""
    assert f["spalled"].sum() > 5 and ((f["voids"] > 1e-3) & (f["spalled"] == 0)).sum() > 5 and (f["voids"] == 0).sum() > 5
    assert (f["spalled"] == (f["void_damage"] >= 1)).all()


@pytest.mark.parametrize("nranks, words", [(1, "viscosity 1 2"), pytest.param(2, "viscosity 1 2", marks=pytest.mark.long), (2, "viscosity 1 2 h variable")])
def test_restart(lmp, tmp_path, material, nranks, words):
    """30 steps, restart, 30 more: the same bits as 60 at once"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, words, steps=0, sort=False, jc=JC, more="restart 30 half\n") + "run 59\n" + OUT.format("whole"), nranks=nranks)
    lmp("read_restart half.30\n" + NEIGHBOR + FIXES.format(JC) + "run 29\n" + OUT.format("part"), nranks=nranks)
    one, two = read(tmp_path / "whole"), read(tmp_path / "part")
    grown(one)
    for name in one:
        assert np.array_equal(one[name], two[name]), name


@pytest.mark.parametrize("nranks", [1, *(pytest.param(n, marks=pytest.mark.long) for n in (2, 3)), 4])
def test_layouts(lmp, tmp_path, material, nranks):
    """newton on and off, brick and tiled: as on one rank"""
    s = state(seed=22)
    s.rho *= 0.97
    cases = list(itertools.product(("on", "off"), ("brick", "tiled")))
    text = "".join("clear\n" + start(s, tmp_path, material, steps=20, newton=newton, comm=comm, jc=JC) + OUT.format(f"f.{k}")
                   for k, (newton, comm) in enumerate(cases))
    lmp(start(s, tmp_path, material, steps=20, jc=JC) + OUT.format("one"))
    lmp(text, nranks=nranks)
    one = read(tmp_path / "one")
    assert one["voids"].max() > 0.01
    for k, case in enumerate(cases):
        got = read(tmp_path / f"f.{k}")
        for name in ("x", "v", "f", "p", "sxx", "eps", "de", "voids", "void_damage"):
            assert np.abs(got[name] - one[name]).max() <= 1e-9 * np.abs(one[name]).max(), (case, name)


@pytest.mark.parametrize("nranks", [1, 3])
def test_data_file(lmp, tmp_path, material, nranks):
    """30 steps, write_data, read_data, 30 more: as if not interrupted; voids are in a section of their own, which without them is not there"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=0, jc=JC) + "run 30\nwrite_data half.data\n" + OUT.format("half") + "run 30\n" + OUT.format("whole"))
    assert "\njc_voids # id voids damage work initiation\n" in (tmp_path / "half.data").read_text()
    text = reader(material, jc=JC).replace("fix jc NULL jc_forces", "fix jc NULL jc_forces fix jc NULL jc_voids")
    lmp(text + OUT.format("read") + "run 30\n" + OUT.format("part"), nranks=nranks)
    half, whole, again, part = (read(tmp_path / f) for f in ("half", "whole", "read", "part"))
    grown(whole)
    assert np.array_equal(half["voids"], again["voids"]) and np.array_equal(half["void_damage"], again["void_damage"])
    for one, two, tolerance in ((half, again, 1e-13), (whole, part, 1e-9)):
        for name in one:
            assert np.abs(one[name] - two[name]).max() <= tolerance * max(1.0, np.abs(one[name]).max()), name
    # a file from before, or of another law, has none
    lmp(start(s, tmp_path, material, steps=3, jc="damage no") + "write_data half.data\n")
    assert "jc_voids" not in (tmp_path / "half.data").read_text()
    lmp(reader(material, jc=JC) + OUT.format("read"))
    assert not read(tmp_path / "read")["voids"].any()


def test_pressure(lmp, tmp_path, material):
    """p is (1 - phi) p_eos(rho/(1 - phi), e) where it is tension and voids are, and no more than 0 of what has parted"""
    lmp(start(state(seed=23), tmp_path, material, steps=60, jc=JC) + OUT.format("f"))
    f = read(tmp_path / "f")
    grown(f)
    mu = f["rho"] / (1 - f["voids"]) - 1
    alone = 16 * mu + (2.0 + 0.5 * mu) * f["esph"]  # expanded; rho0 1, c0 4, masses 1
    x, h = 1 + mu, 2 / 3 / 1.5  # hot matter becomes a gas: hvi_eos_expansion.h
    alone = np.where(alone > 0, alone * (1 - (1 - x) ** 2 * (1 + (2 - h) * x)), alone)
    borne = np.where(f["voids"] > 0, (1 - f["voids"]) * np.minimum(alone, 0), alone)
    sound = (f["spalled"] == 0) & (mu < 0)
    assert (sound & (f["voids"] > 0.001)).sum() > 5 and (f["p"][sound] < -0.1).sum() > 5
    assert np.abs(f["p"] - borne)[sound].max() < 1e-9
    assert (f["p"][f["spalled"] == 1] >= 0).all()


def test_as_the_whole(lmp, tmp_path, material):
    """half, quarter and eighth models with mirror planes"""
    text = "".join("clear\n" + mirror_scenes.start(p, tmp_path, material)[0].replace("hvi/johnson-cook", f"hvi/johnson-cook {JC}") +
                   solid_scenes.OUT.format("f" + p).replace("damage spalled", "void_damage voids") for p in ("", "x", "xyz"))
    lmp(text)
    whole = solid_scenes.read(tmp_path / "f")
    assert (whole["spalled"] > 1e-4).sum() > 20
    for planes in ("x", "xyz"):
        mirror_scenes.same(whole, solid_scenes.read(tmp_path / f"f{planes}"), mirror_scenes.part(planes)[1], planes)


@pytest.mark.parametrize("nranks", [1, 2])
def test_hybrid_as_without(lmp, tmp_path, material, nranks):
    """beside lj or hvi/contact: as alone, newton on and off"""
    s = state(seed=22)
    s.rho *= 0.97
    t = hybrid_scenes.others(s)
    pair = PAIR.format(kernel="cubic", words="viscosity 1 2", path=material) + "pair_coeff 1 2 tension yes\n"
    both, fix = hybrid_scenes.together(s, t), f"fix jc {{0}} hvi/johnson-cook {JC}\n"
    cases = list(itertools.product(hybrid_scenes.COEFF, ("on", "off")))
    commands = hybrid_scenes.text(s, pair, fix, OUT, tmp_path, "alone", more="run 20\n")
    for k, (beside, newton) in enumerate(cases):
        commands += hybrid_scenes.text(both, hybrid_scenes.hybrid(pair, "hybrid", beside), fix, OUT, tmp_path, f"f{k}", "ours", more="run 20\n", newton=newton)
    lmp(commands, nranks=nranks)
    alone, n = read(tmp_path / "alone"), len(s.x)
    assert (alone["voids"] > 1e-3).sum() > 5 and (alone["voids"] == 0).sum() > 5
    for k, case in enumerate(cases):
        got = read(tmp_path / f"f{k}")
        for name in alone:
            assert np.abs(got[name][:n] - alone[name]).max() <= 1e-11 * np.abs(alone[name]).max(), (case, name)
        assert not got["voids"][n:].any() and not got["p"][n:].any(), case


def test_opening_at_failure(lmp, tmp_path, material):
    """delta_c, at either spacing: voids of delta_c/spacing; and phi_c, where that is less"""
    for spacing, delta_c, critical in ((1.0, 0.02, 0.02), (0.5, 0.02, 0.04), (0.5, 0.2, 0.1)):
        material.write_text(MATERIAL.format(sigma_p=3.0) + VOIDS.replace("0.04", "0.1") + f"  delta_c {delta_c}\n")
        x = spacing * (np.stack(np.meshgrid(*[np.arange(k) for k in (12, 4, 4)], indexing="ij"), -1).reshape(-1, 3) + 0.5)
        n, mass, h = len(x), {1: spacing**3, 2: spacing**3}, {1: 1.25 * spacing, 2: 1.25 * spacing}
        s = Fluid(x, np.zeros((n, 3)), np.ones(n), np.zeros(n), np.ones(n, int), mass, h, spacing * np.array([12.0, 4.0, 4.0]), (False, True, True))
        pair = PAIR.format(kernel="cubic", words="viscosity 1 2", path=material).replace("h 1.25", f"h {1.25 * spacing}") + "pair_coeff 1 2 tension yes\n"
        lines = scene(s, tmp_path / "s.data", pair).replace("boundary f", "boundary s") + f"fix jc all hvi/johnson-cook {JC}\n"
        lmp(lines + f"velocity all ramp vx -0.6 0.6 x 0 {12 * spacing} units box\ntimestep {0.002 * spacing}\nrun 800\n" + OUT.format("f"))
        f = read(tmp_path / "f")
        failed = f["spalled"] == 1
        opening = f["voids"][failed] / critical
        # some have been closed for a while, and fail with less
        assert (opening >= 1).sum() >= 16 and opening.max() < 1.5, (spacing, failed.sum(), opening)
        assert (f["voids"] <= critical * (f["void_damage"] + 1e-9))[~failed].all()


@pytest.mark.parametrize("nranks", [1, 2])
def test_not_integrated(lmp, tmp_path, material, nranks):
    """what fix hvi/sph does not integrate keeps density and energy: its voids, and the tension that they leave, do not depend on what flies off"""
    s = state(seed=23)
    s.rho[:] = 0.97
    jc = f"fix jc all hvi/johnson-cook {JC}\n"
    pair = PAIR.format(kernel="cubic", words="viscosity 1 2", path=material) + "pair_coeff 1 2 tension yes\n"
    lines = scene(s, tmp_path / "s.data", pair, fix="group ours type 1\ngroup walls type 2\nfix sph ours hvi/sph walls walls\n") + jc
    lmp(lines + "timestep 0.004\nrun 3\n" + OUT.format("f"), nranks=nranks)
    f, walls = read(tmp_path / "f"), s.type == 2
    assert np.ptp(f["p"][~walls]) > 1e-3 and (f["p"][walls] < -0.1).all() and (f["p"][walls] > -0.47).all()
    assert f["voids"][walls].min() > 1e-3
    for name in ("p", "voids", "rho"):
        assert np.ptp(f[name][walls]) < 1e-12, name


def test_books(lmp, tmp_path, material):
    """energy is kept; the work of opening voids is a part of the internal one, and only grows"""
    more = "fix step all hvi/dt 0.2\ncompute book all hvi/energy\nthermo 5\nthermo_style custom step c_book[1] c_book[2] c_book[8] c_book[9] c_book[29] c_book[31]\n"
    s = state(seed=24)
    r = lmp(start(s, tmp_path, material, steps=0, jc=JC, more=more + "thermo_modify format float %.17g\nrun 200\n"))
    t = r.thermo
    assert np.abs(t["c_book[9]"] - 1).max() < 1e-3
    assert (np.diff(t["c_book[31]"]) >= 0).all() and 0 < t["c_book[31]"][-1] < t["c_book[2]"][-1] - t["c_book[29]"][-1]
    assert np.array_equal(t["c_book[8]"], sum([t["c_book[1]"], t["c_book[2]"]]))
    assert "spall voids" in r.log


def test_settings_and_warnings(lmp, tmp_path, material):
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=3, jc=JC) + "write_restart half\n")
    r = lmp("read_restart half\n" + NEIGHBOR + FIXES.format("damage no") + "run 1\n", expect_fail=True)
    assert "was written with strength johnson-cook damage no spall voids" in r.error and "spall principal" in r.error
    for wrong, message in (("m 0.2", "m = 0"), ("phi_c 0.04", "phi_c = 1.5"), ("sigma 0.6", "sigma = -1"), ("rate 1.0", "rate = 0")):
        material.write_text(MATERIAL.format(sigma_p=3.0) + VOIDS.replace(wrong, message.replace(" = ", " ")))
        r = lmp(start(s, tmp_path, material, steps=0, jc=JC), expect_fail=True)
        assert "spall voids" in r.error and message in r.error, r.error
    material.write_text(MATERIAL.format(sigma_p=3.0))
    r = lmp(start(s, tmp_path, material, steps=1, jc=JC))
    assert any("has no section spall voids and does not spall" in w for w in r.warnings)


MELT = """
units si
newton {newton}
atom_style sph
boundary f f f
region box block -1e-2 1e-2 -1e-2 1e-2 -1e-2 1e-2 units box
create_box 1 box
lattice sc 1e-4
region ball sphere 0 0 0 6e-4 units box
create_atoms 1 region ball
mass 1 $(2703*1e-4^3)
pair_style hvi/sph cubic dissipation riemann
pair_coeff 1 1 file Al6061-T6.hvi spacing 1e-4
set group all sph/e $(2703*1e-4^3*{e})
variable vx atom 1e6*x
variable vy atom 1e6*y
variable vz atom 1e6*z
velocity all set v_vx v_vy v_vz
"""
MODEL = """
fix move all hvi/sph
fix solid all hvi/johnson-cook damage no spall voids{melt}
fix step all hvi/dt 0.3
compute state all hvi/atom spalled p T
compute sums all reduce sum c_state[1]
compute least all reduce min c_state[2]
compute T all reduce ave c_state[3]
thermo_style custom step atoms c_sums c_least c_T
thermo 1
run {steps}
"""


@pytest.mark.parametrize("above, nranks, newton", [(-150, 1, "on"), (150, 1, "on"), (150, 3, "off")])
def test_melts(lmp, root, tmp_path, above, nranks, newton):
    """a ball that opens evenly, below and above its melting temperature: with melt yes the hot one parts as soon as there is tension, else as long as voids bear it"""
    e = 885 * (775 + above - 300) * 1.1  # it cools as it expands
    env = {"LAMMPS_POTENTIALS": str(root / "potentials")}
    runs = {melt: lmp(MELT.format(e=e, newton=newton) + MODEL.format(melt=melt, steps=60) + "write_restart melt.restart\n", nranks=nranks, env=env, cwd=tmp_path).thermo for melt in ("", " melt yes")}
    plain, melts = runs[""], runs[" melt yes"]
    tension = np.array(plain["c_least"]) < -0.2e9
    assert tension.any() and (np.array(plain["c_sums"])[np.argmax(tension)] == 0)
    at = np.argmax(tension)
    assert (above > 0) == (plain["c_T"][at] > 775)
    if above < 0:
        assert np.array_equal(plain["c_least"], melts["c_least"])
        return
    assert melts["c_sums"][at] > 0.2 * melts["Atoms"][at]
    again = lmp("units si\natom_modify map array\nread_restart melt.restart\n" + MODEL.format(melt="", steps=0), env=env, cwd=tmp_path, expect_fail=True)
    assert "melt yes" in again.error and "spall voids" in again.error
