"""Metals that would be liquids without a word, laws that the files choose, and fixes given again: what is said, and how often."""

import numpy as np
import pytest
from solid_scenes import MATERIAL, OUT, read, state
from sph_scenes import scene

LIQUID = "has no section strength johnson-cook: its "
OUTSIDE = "are not in group "
NO_FIX = "has strength, but there is no fix hvi/johnson-cook"
LEFT_OUT = "particles with a material are integrated by no fix"
SPALL = "has no section spall limit and does not spall"
TOUGH = "has no section damage and does not fail by plastic strain"


def without(text, *kinds):
    """the text of a material file without sections of these kinds"""
    out, skip = [], False
    for line in text.splitlines(True):
        if not line.startswith((" ", "#")):
            skip = line.split()[0] in kinds
        if not skip:
            out.append(line)
    return "".join(out)


@pytest.fixture
def files(tmp_path):
    text = MATERIAL.format(sigma_p=3.0)
    for name, content in (("metal", text), ("water", without(text, "strength", "damage", "spall")), ("soft", without(text, "spall")), ("tough", without(text, "damage")),
                          ("declared", without(text, "strength", "damage", "spall") + "strength none\n")):
        (tmp_path / f"{name}.hvi").write_text(content)
    return tmp_path


def head(folder, one="metal", two="metal", jc="all hvi/johnson-cook", groups="", words="", fix="fix sph all hvi/sph\n"):
    pair = f"pair_style hvi/sph cubic\npair_coeff 1 1 file {one}.hvi h 1.25\npair_coeff 2 2 file {two}.hvi h 1.25 {words}\npair_coeff 1 2 tension yes\n"
    return scene(state(), folder / "s.data", pair, fix=groups + fix) + (f"fix jc {jc}\n" if jc else "") + "timestep 0.004\n"


def said(result, words):
    return [w for w in result.warnings if words in w]


def test_a_material_without_the_section(lmp, files):
    """once per type and run, with the number of particles; not where it is declared a liquid"""
    n = (state().type == 2).sum()
    r = lmp(head(files, two="water") + "run 1\nwrite_data d.data\nrun 1\n")
    assert len(said(r, LIQUID)) == 2 and all(f"water.hvi (type 2) {LIQUID}{n} particles in group all" in w for w in said(r, LIQUID)), r.warnings
    assert not said(r, OUTSIDE)
    r = lmp(head(files, two="declared") + "run 1\n")
    assert not r.warnings, r.warnings
    # of another group: its own business
    r = lmp(head(files, two="water", jc="metal hvi/johnson-cook", groups="group metal type 1\n") + "run 1\n")
    assert not r.warnings, r.warnings


def test_a_material_without_damage(lmp, files):
    """damage yes is for those that have a law of it, a law by its name for all; others are said once"""
    text = head(files, two="tough", jc="all hvi/johnson-cook damage {}")
    r = lmp(text.format("yes") + "compute damage all hvi/atom damage\nrun 20\ndump d all custom 1 d.* type c_damage\nrun 1\n")
    assert said(r, TOUGH) == [w for w in r.warnings if f"tough.hvi (type 2) {TOUGH}" in w] and len(said(r, TOUGH)) == 1, r.warnings
    rows = np.loadtxt(files / "d.21", skiprows=9)
    assert rows[rows[:, 0] == 1, 1].max() > 0 and rows[rows[:, 0] == 2, 1].max() == 0
    assert "tough.hvi (type 2) has no section damage johnson-cook; use damage no" in lmp(text.format("johnson-cook") + "run 0\n", expect_fail=True).error


def test_declared_liquids_are_as_others(lmp, files):
    lmp(head(files, two="water") + "run 5\n" + OUT.format("a"))
    lmp(head(files, two="declared") + "run 5\n" + OUT.format("b"))
    assert (files / "a").read_bytes() == (files / "b").read_bytes()


@pytest.mark.parametrize("nranks", [1, 2])
def test_particles_outside_the_group(lmp, files, nranks):
    s = state()
    n = ((s.type == 1) & (s.x[:, 0] >= 4.0)).sum()
    groups = "region left block INF 4.0 INF INF INF INF units box\ngroup left region left\ngroup two type 2\ngroup solid union left two\n"
    r = lmp(head(files, jc="solid hvi/johnson-cook", groups=groups) + "run 1\n", nranks=nranks)
    assert n > 50 and len(said(r, OUTSIDE)) == 1
    assert f": {n} particles of material metal.hvi (type 1) {OUTSIDE}solid" in said(r, OUTSIDE)[0], r.warnings
    # a liquid outside is one inside
    r = lmp(head(files, two="water", jc="one hvi/johnson-cook", groups="group one type 1\n") + "run 1\n", nranks=nranks)
    assert not r.warnings, r.warnings


def test_no_fix_of_strength(lmp, files):
    """once per type and run, whatever else asks LAMMPS to begin; not for what is meant to be a liquid, in a file or in pair_coeff"""
    r = lmp(head(files, jc="") + "run 1\nwrite_data d.data\nwrite_restart r\nrun 1\n")
    for itype in (1, 2):
        assert [f"type {itype} is a liquid: material metal.hvi {NO_FIX} (pair_coeff ... strength none" in w for w in said(r, NO_FIX)].count(True) == 2, r.warnings
    assert len(r.warnings) == 4, r.warnings
    for how in (dict(words="strength none"), dict(two="declared"), dict(two="water")):
        r = lmp(head(files, jc="", **how) + "run 1\n")
        assert len(r.warnings) == 1 and "type 1 is a liquid" in r.warnings[0], (how, r.warnings)
    assert not lmp(head(files) + "run 1\n").warnings


def test_strength_none_of_a_type(lmp, files):
    """a metal by its file, a liquid by pair_coeff: as one without strength, beside solids, and after a restart; whatever the order of words"""
    out = OUT.format
    text = head(files, words="volume 1.0 strength none") + "run 5\nwrite_restart r\n" + out("a") + "clear\n" + head(files, words="strength none volume 1.0") + "run 5\n" + out("b")
    r = lmp(text + "clear\n" + head(files, two="declared") + "run 5\n" + out("c"))
    again = lmp("read_restart r\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nfix sph all hvi/sph\nfix jc all hvi/johnson-cook\n" + out("d"))
    assert not r.warnings and not again.warnings, (r.warnings, again.warnings)
    a, d = read(files / "a"), read(files / "d")
    liquid = a["type"] == 2
    assert a["vm"][liquid].max() == 0.0 and a["vm"][~liquid].min() > 0.0
    assert (files / "a").read_bytes() == (files / "b").read_bytes() == (files / "c").read_bytes()
    for name in a:
        assert np.abs(a[name] - d[name]).max() <= 1e-12 * np.abs(a[name]).max(), name


@pytest.mark.parametrize("nranks", [1, 3])
def test_particles_that_nobody_integrates(lmp, files, nranks):
    """how many; not those of walls, of pistons, or whose density and energy another fix integrates, which nve does not; nor those without a material"""
    s = state()
    rest = s.x[:, 0] >= 4.0
    groups = "region left block INF 4.0 INF INF INF INF units box\nregion low block INF INF INF 2.5 INF INF units box\ngroup left region left\ngroup low region low\n"
    groups += "group rest subtract all left\ngroup both intersect rest low\n"
    cases = [("fix sph left hvi/sph\n", rest.sum()), ("fix sph left hvi/sph walls low\n", (rest & (s.x[:, 1] > 2.5)).sum()),
             ("fix sph left hvi/sph walls low walls rest\n", 0), ("fix sph left hvi/sph walls all\n", 0),
             ("fix sph left hvi/sph\nfix piston rest move linear 0.1 0 0\n", 0), ("fix sph left hvi/sph\nfix nve both nve\n", rest.sum()),
             ("fix sph left hvi/sph\nfix still low sph/stationary\n", (rest & (s.x[:, 1] > 2.5)).sum()),
             ("fix sph left hvi/sph\nfix hold rest setforce 0 0 0\n", rest.sum()), ("fix sph all hvi/sph\n", 0)]
    text = "".join("clear\n" + head(files, words="strength none", jc="left hvi/johnson-cook strength none spall none", groups=groups, fix=fix) + f"run 1\nprint 'case {k}'\n"
                   for k, (fix, n) in enumerate(cases))
    r = lmp(text, nranks=nranks)
    logs = r.log.split("print 'case ")
    assert rest.sum() > 100 and len(logs) == len(cases) + 1
    for (fix, n), log in zip(cases, logs):
        lines = [line for line in log.splitlines() if LEFT_OUT in line]
        assert len(lines) == (n > 0) and all(f"Fix hvi/sph: {n} {LEFT_OUT}" in line for line in lines), (fix, lines)


def test_no_section_spall_once(lmp, files):
    r = lmp(head(files, two="soft") + "run 1\nrun 1\nwrite_data d.data\nrun 1\n")
    assert len(said(r, SPALL)) == 1 and "soft.hvi (type 2)" in said(r, SPALL)[0], r.warnings


def test_no_material_of_the_group(lmp, files):
    r = lmp(head(files, two="water", jc="two hvi/johnson-cook", groups="group two type 2\n") + "run 1\n", expect_fail=True)
    assert "no material of group two has a section strength johnson-cook (there are: johnson-cook of metal.hvi, none of water.hvi); strength none is for those that bear no shear" in r.error, r.error
    r = lmp(head(files, jc="all hvi/johnson-cook strength cowper-symonds") + "run 1\n", expect_fail=True)
    assert "no material has a section strength cowper-symonds" in r.error, r.error
    # a group that is still empty has nothing against it
    lmp(head(files, jc="none hvi/johnson-cook", groups="group none empty\n") + "run 1\n")


def test_strength_none(lmp, files):
    """no shear in any material, whatever its file says; what spalls does so by its pressure, for good"""
    (files / "metal.hvi").write_text(MATERIAL.format(sigma_p=0.4))
    r = lmp(head(files, jc="all hvi/johnson-cook strength none") + "run 40\n" + OUT.format("f"))
    assert not r.warnings, r.warnings
    f = read(files / "f")
    assert f["vm"].max() == 0.0 and f["eps"].max() == 0.0 and f["damage"].max() == 0.0
    assert 5 < f["spalled"].sum() < 500 and (f["p"][f["spalled"] == 1] >= 0).all()
    r = lmp(head(files, jc="all hvi/johnson-cook strength none damage yes") + "run 1\n", expect_fail=True)
    assert "strength none brings no plastic strain, which damage needs: use damage no" in r.error, r.error


# ---------------------------------------------------------------------- the law of damage

def test_damage_by_its_name(lmp, files):
    """yes is the law of the file; its name says the same, in restarts too"""
    for name, words in (("a", ""), ("b", "damage johnson-cook")):
        lmp(head(files, jc=f"all hvi/johnson-cook {words}") + f"run 20\nwrite_restart r{name}\n" + OUT.format(name))
    assert (files / "a").read_bytes() == (files / "b").read_bytes() and read(files / "a")["damage"].max() > 0
    again = "read_restart ra\nneighbor 0.3 bin\nfix sph all hvi/sph\nfix jc all hvi/johnson-cook {}\ntimestep 0.004\nrun 1\n"
    lmp(again.format("damage johnson-cook"))
    r = lmp(again.format("damage no"), expect_fail=True)
    assert "was written with strength johnson-cook damage johnson-cook spall principal" in r.error, r.error


@pytest.mark.parametrize("words, message", [
    ("damage grady", "damage must be yes, no or a law (johnson-cook), not grady"),
    ("damage", "Illegal fix hvi/johnson-cook damage command: missing argument")])
def test_damage_words(lmp, files, words, message):
    r = lmp(head(files, jc=f"all hvi/johnson-cook {words}") + "run 1\n", expect_fail=True)
    assert message in r.error, r.error


# ---------------------------------------------------------------------- fixes given again

@pytest.mark.parametrize("fix", ["sph all hvi/sph", "jc all hvi/johnson-cook spall zero"])
def test_given_again(lmp, files, fix):
    """it would wipe out the state of all particles: refused, unless it is taken away first"""
    name = fix.split()[0]
    r = lmp(head(files) + f"run 5\nfix {fix}\nrun 1\n", expect_fail=True)
    assert f"Fix {name} {fix.split()[2]} is given again, which would wipe out" in r.error and f"unfix {name} first" in r.error, r.error
    lmp(head(files) + f"run 5\nunfix {name}\nfix {fix}\nrun 1\n")
    # other fixes may be
    lmp(head(files) + "fix step all hvi/dt 0.2\nrun 5\nfix step all hvi/dt 0.1\nrun 1\n")
