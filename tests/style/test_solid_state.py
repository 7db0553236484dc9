"""The state of solids beyond their run: data files, restarts, fixes that go and come back; scatter of damage."""

import numpy as np
import pytest
from dumps import read_dump
from solid_runs import material as metal
from solid_runs import run
from solid_scenes import FIXES, MATERIAL, NEIGHBOR, OUT, PAIR, READ, compare, factor, read, reader, start, state
from sph_scenes import Fluid, scene


@pytest.mark.parametrize("words, jc, nranks, map", [
    ("viscosity 1 2", "", 1, "array"), ("viscosity 1 2", "", 3, "hash"), ("h variable", "spall pressure", 1, "hash"),
    ("h variable", "weibull 4 17 temperature work", 2, "array")])
def test_data_file(lmp, tmp_path, material, words, jc, nranks, map):
    """30 steps, write_data, read_data, 30 more: the state to the digits of data files, and then the run as if not interrupted"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, words, steps=0, jc=jc) + "run 30\nwrite_data half.data\n" + OUT.format("half") + "run 30\n" + OUT.format("whole"))
    r = lmp(reader(material, words, jc, map) + OUT.format("read") + "run 30\n" + OUT.format("part"), nranks=nranks)
    assert not [w for w in r.warnings if "image flags" not in w], r.warnings
    half, whole, again, part = (read(tmp_path / f) for f in ("half", "whole", "read", "part"))
    assert whole["damage"].max() >= 1 and 0 < half["damage"].max() and half["eps"].max() > 0.05 and np.abs(half["S"]).max() > 0.2
    compare(half, again, 1e-13)
    assert np.array_equal(half["damage"], again["damage"]) and np.array_equal(half["eps"], again["eps"])
    compare(whole, part, 1e-9)


def test_data_file_for_another_fix(lmp, tmp_path, material):
    """sections of fixes with other IDs, given by name"""
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=30) + "write_data half.data\n" + OUT.format("half"))
    text = reader(material).replace("fix jc all", "fix solids all").replace("fix jc NULL NULL fix jc NULL jc_forces",
                                                                           "fix solids NULL jc fix solids NULL jc_forces")
    lmp(text + OUT.format("read"))
    compare(read(tmp_path / "half"), read(tmp_path / "read"), 1e-13)


def test_data_file_before_a_run_and_after_changes(lmp, tmp_path, material):
    """particles that were new, or changed after the run, start anew from a data file as they would have without it"""
    s = state(seed=25)
    head = start(s, tmp_path, material, steps=0)
    for name, text in (("new", ""), ("changed", "run 30\nvelocity all ramp vx 0.0 0.3 x 0.0 8.0 sum yes units box\n")):
        lmp(head + text + "write_data half.data\nrun 20\n" + OUT.format("whole"))
        lmp(reader(material) + "run 20\n" + OUT.format("part"))
        compare(read(tmp_path / "whole"), read(tmp_path / "part"), 1e-9)


def test_wrong_data_files(lmp, tmp_path, material):
    s = state(seed=23)
    lmp(start(s, tmp_path, material, steps=3) + "write_data half.data\n")
    good = (tmp_path / "half.data").read_text()
    head, section = good.split("\njc # id Sxx Syy Szz Sxy Sxz Syz eps damage spalled\n\n")
    line = section.splitlines()[0]
    for wrong, message in ((line + " 1", "Section jc of data file: 11 values in the line, not 10"),
                           ("513 " + line.split(" ", 1)[1], "Section jc of data file: there is no particle 513"),
                           (line.replace(line.split()[1], "stiff"), "Section jc of data file"),
                           (line.replace(line.split()[1], "nan"), "not a finite number in the line")):
        (tmp_path / "half.data").write_text(good.replace(line, wrong))
        r = lmp(reader(material), expect_fail=True)
        assert message in r.error, r.error
    (tmp_path / "half.data").write_text(good)
    r = lmp(reader(material).replace("fix jc NULL jc_forces", ""), expect_fail=True)
    assert "Unknown identifier in data file: jc_forces" in r.error
    r = lmp(READ.split("read_data")[0].format(map="array", fixes="fix Atoms all hvi/sph"), expect_fail=True)
    assert "Fix ID Atoms must not be the name of a section" in r.error
    # without the state, as other programs read it
    lmp(start(s, tmp_path, material, steps=3) + "write_data half.data nofix\n")
    assert "jc" not in (tmp_path / "half.data").read_text()


@pytest.mark.parametrize("nranks", [1, 3])
def test_weibull(lmp, tmp_path, nranks):
    """as long as nothing fails, damage with scatter is damage without it over the factor of the particle, on any ranks and after a restart"""
    path = tmp_path / "tough.hvi"
    path.write_text(MATERIAL.format(sigma_p=1e3).replace("D1 0.02", "D1 50"))
    s = state(seed=26)
    lmp(start(s, tmp_path, path, steps=40) + OUT.format("even"))
    lmp(start(s, tmp_path, path, steps=0, jc="weibull 3 71") + "run 20\nwrite_restart half\n", nranks=nranks)
    lmp("read_restart half\n" + NEIGHBOR + FIXES.format("weibull 3 71") + "run 20\n" + OUT.format("scatter"), nranks=nranks)
    even, scattered = read(tmp_path / "even")["damage"], read(tmp_path / "scatter")["damage"]
    assert 0 < even.max() < 0.1
    k = even > 1e-4 * even.max()
    assert k.sum() > 400
    want = factor(3, 71, np.arange(1, len(even) + 1))
    assert even[k] / scattered[k] == pytest.approx(want[k], rel=1e-7)
    assert want.mean() == pytest.approx(1, abs=0.06) and want.std() == pytest.approx(0.363, abs=0.05)


@pytest.mark.parametrize("words, other", [
    ("", "damage no"), ("", "spall zero"), ("", "temperature work"), ("thermal no", ""), ("", "weibull 3 1"), ("weibull 3 1", "weibull 3 2")])
def test_restart_with_other_settings(lmp, tmp_path, material, words, other):
    lmp(start(state(), tmp_path, material, steps=3, jc=words) + "write_restart half\n")
    again = "read_restart half\n" + NEIGHBOR
    r = lmp(again + FIXES.format(other) + "run 1\n", expect_fail=True)
    assert "Fix hvi/johnson-cook: the restart file was written with strength johnson-cook damage johnson-cook" in r.error, r.error
    assert (words or "thermal yes, this run") in r.error and other in r.error.split("this run uses")[1]
    lmp(again + FIXES.format(words) + "run 1\n")
    # once it runs, a script may change its mind
    lmp(again + FIXES.format(words) + f"run 1\nunfix jc\nfix jc all hvi/johnson-cook {other}\nrun 1\n")


@pytest.mark.parametrize("nranks", [1, 2])
def test_fix_goes_and_comes_back(lmp, tmp_path, material, nranks):
    """the fix is taken away and given again while particles join: all start without stress, under the new fix's limit of tension at once"""
    material.write_text(MATERIAL.format(sigma_p=0.2))
    text = start(state(seed=27), tmp_path, material, steps=10, more="compute book all hvi/energy\nthermo_style custom step atoms c_book[1] c_book[29]\n")
    text += "unfix jc\nrun 5\ngroup old type 1 2\ncreate_atoms 1 random 700 5 NULL overlap 0.3 maxtry 500\ngroup new subtract all old\n"
    text += "set group new sph/rho 1.0 sph/e 0.0\n"
    text += "compute p all hvi/atom p\ndump p all custom 1 fluid id c_p\ndump_modify p format float %.17g sort id\nrun 0\nundump p\nuncompute p\n"
    text += "fix jc all hvi/johnson-cook spall pressure\n"
    r = lmp(text + OUT.format("fresh") + "run 10\n" + OUT.format("f"), nranks=nranks)
    n = int(r.thermo["Atoms"][-1])
    assert n > 512 + 300
    fresh, got = (read(tmp_path / f) for f in ("fresh", "f"))
    fluid = read_dump(tmp_path / "fluid").table[:, 1]
    assert len(got["x"]) == n and not fresh["eps"].any() and not fresh["damage"].any() and fresh["vm"].max() == 0
    assert (fluid < -0.25).sum() > 5
    assert np.abs(fresh["p"] - np.maximum(fluid, -0.2)).max() < 1e-12
    assert got["eps"].max() > 0 and got["p"].min() == -0.2
    assert [run["c_book[29]"][-1] > 0 for run in r.runs][:2] == [True, False]  # there is no plastic work without the fix


def test_plastic_work(lmp, tmp_path):
    """a block in simple shear: the ledger's plastic work is Y times the strain of all particles, (gamma - gamma_y)/sqrt(3) inside, and what the internal
    energy has beyond that of compression and elastic shear"""
    G, K, Y, end = 6.0, 16.0, 0.05, 0.6
    path = metal(tmp_path / "metal.hvi", f"eos linear rho0 1 K {K}", f"strength perfect G {G} Y {Y}")
    x = np.zeros((24 * 24, 3))
    x[:, :2] = np.stack(np.meshgrid(np.arange(24), np.arange(24), indexing="ij"), -1).reshape(-1, 2) + [30.5, 4.5]
    n = len(x)
    s = Fluid(x, np.zeros((n, 3)), np.ones(n), np.zeros(n), np.ones(n, int), {1: 1.0}, {1: 2.0}, np.array([84.0, 32.0, 1.0]), (False, False, True), 2)
    s.v[:, 0] = s.x[:, 1] - 16
    r = run(lmp, tmp_path, s, "pair_style hvi/sph quintic dim 2 viscosity 0 0\n" + f"pair_coeff 1 1 file {path} h 2.0\n", "strength perfect damage no spall none",
            300, dt=end / 300, frames=300, more="fix hold all setforce 0 0 0\nthermo_style custom step c_book[2] c_book[28] c_book[29]", ledger="clamps all")
    f, internal, plastic = r.frames[-1], r.thermo["c_book[2]"][-1], r.thermo["c_book[29]"][-1]
    elastic = (f["vm"] ** 2 / 6 / G / f["rho"]).sum() + (K * (np.log(f["rho"]) + 1 / f["rho"] - 1)).sum()
    inside = (np.abs(s.x - [42, 16, 0]) < 4).all(1)
    print("plastic", plastic, "Y eps", (Y * f["eps"] * (0.5 + 0.5 / f["rho"])).sum(), "internal", internal, "elastic", elastic, "eps inside", f["eps"][inside].mean())
    assert r.thermo["c_book[28]"][-1] == 0.0 and plastic > 5 * elastic
    assert plastic == pytest.approx((Y * f["eps"] * (0.5 + 0.5 / f["rho"])).sum(), rel=2e-3)  # work per mass, with the density between start and end
    assert internal == pytest.approx(plastic + elastic, rel=5e-3)
    assert f["eps"][inside] == pytest.approx((end - Y / np.sqrt(3) / G) / np.sqrt(3), rel=5e-3)


def test_plastic_work_that_leaves(lmp, tmp_path, material):
    """plastic work goes on counting what has left the box"""
    s = state(seed=28, periodic=False)
    s.x += 0.5
    s.box += 1.0
    pair = PAIR.format(kernel="cubic", words="viscosity 1 2", path=material) + "pair_coeff 1 2 tension yes\n"
    book = "compute book all hvi/energy\nthermo 10\nthermo_style custom step atoms c_book[2] c_book[6] c_book[8] c_book[21] c_book[29]\n"
    text = scene(s, tmp_path / "s.data", pair) + "fix jc all hvi/johnson-cook\ntimestep 0.004\n" + book
    t = lmp(text + "thermo_modify norm no format float %.17g lost ignore\nrun 400\n").thermo
    plastic = t["c_book[29]"]
    assert t["c_book[21]"][-1] > 20 and plastic[-1] > 1
    assert (np.diff(plastic) >= -1e-12 * plastic[-1]).all()


def test_clamped_rim(lmp, tmp_path, material):
    """the rim of a plate is held in three ways: its books of momentum close to round-off"""
    s = state(seed=29)
    s.periodic = (False, False, False)
    s.x += 4.0
    s.box += 8.0
    s.v *= 0.1
    center = 0.5 * s.box
    s.v[np.abs(s.x - center).max(1) < 2] += [0.0, 0.0, 0.8]
    lo, hi = s.x.min(0)[:2] + 1.2, s.x.max(0)[:2] - 1.2
    regions = f"region inner block {lo[0]} {hi[0]} {lo[1]} {hi[1]} INF INF\ngroup inner region inner\ngroup rim subtract all inner\n"
    book = "compute book all hvi/energy clamps rim\nthermo 10\nthermo_style custom step c_book[1] c_book[8] c_book[9] " + " ".join(
        f"c_book[{k}]" for k in range(10, 19)) + "\nthermo_modify norm no format float %.17g lost error\n"
    pair = PAIR.format(kernel="cubic", words="viscosity 1 2", path=material) + "pair_coeff 1 2 tension yes\n"
    for kept, fixes in ((True, "fix sph all hvi/sph\nfix hold rim setforce 0 0 0\n"), (True, "fix sph inner hvi/sph\nfix rim rim sph/stationary\n"),
                        (False, "fix sph inner hvi/sph\n")):
        text = scene(s, tmp_path / "s.data", pair, fix="") + regions + book + "velocity rim set 0 0 0\nfix jc all hvi/johnson-cook\n" + fixes
        t = lmp(text + "timestep 0.004\nrun 100\n", nranks=2 if "setforce" in fixes else 1).thermo
        impulse = np.array([t[f"c_book[{16 + k}]"] for k in range(3)])
        p = np.array([t[f"c_book[{10 + k}]"] for k in range(3)])
        assert np.abs(impulse[2]).max() > 0.5, fixes
        assert np.abs(p - impulse - p[:, :1]).max() <= 1e-12 * np.abs(impulse).max() * len(s.x) ** 0.5, fixes
        # what nobody integrates takes up no heat
        print(fixes, "energy", np.abs(t["c_book[9]"] - 1).max(), "momentum", np.abs(p - impulse - p[:, :1]).max(), "impulse", np.abs(impulse[2]).max())
        assert np.abs(t["c_book[9]"] - 1).max() < 1e-3 or not kept
