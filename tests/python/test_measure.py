"""python3 -m hvi measure: pull-backs of records that are known, and what is wrong with a folder."""

import math

import numpy as np
import pytest
import yaml
from hvi import cli
from hvi.errors import HVIError
from hvi.jobs import measures, pullback

RHO, C = 2700.0, 5000.0
RESULT = {"flyer": "a.hvi", "target": "b.hvi", "v0_m_s": 500, "flyer_mm": 2, "target_mm": 4, "n": 64, "spacing_um": 31.25, "target_density_kg_m3": RHO,
          "target_sound_speed_m_s": C, "spall": "voids", "failed_particles": 3, "void_work_J_m2": 47254.8, "energy_ratio": 0.999999815, "momentum_error": 3.36e-16,
          "particles": 192, "steps": 1200, "lammps_version": 20250204}
KEYS = {*RESULT, "record_us", "peak_GPa", "largest_tension_GPa", "top_m_s", "pull_back_m_s", "spall_strength_GPa", "strain_rate_per_s", "spall_plane_mm", "first_failure_us",
        "failed_from_mm", "failed_to_mm", "record", "plate", "package_version"}
STEP = 1.25e-3  # us
END = 3.0
SOUND = "# id type x0 x u p sxx vm eps damage spalled voids void_damage\n" + "".join(
    f"{k} {1 + (k > 2)} {1e-3 * x:.6f} 0 0 1e5 0 0 0 {damage} {spalled} 0 0\n"
    for k, x, damage, spalled in ((1, -1.5, 0, 0), (2, -0.5, 1, 0), (3, 1.5, 0.99, 0), (4, 2.0, 1, 0), (5, 2.5, 0.5, 1), (6, 3.0, 0, 0)))


def v_shape(t, low=350.0, again=460.0, top=500.0):
    """the shock arrives at 0.8 us; from 1.5 to 2 us the surface slows down to the least speed, and speeds up until 2.5 us"""
    return np.interp(t, [0.8, 0.82, 1.5, 2.0, 2.5], [0.0, top, top, low, again])


def write(folder, speed=v_shape, failing=((1.71625, 1, 2.0), (1.7175, 3, 6.6)), profile=SOUND, **changed):
    """a folder as in.spall leaves it; failing: (us, particles, sum of their depths) from then on"""
    folder.mkdir(exist_ok=True)
    steps = np.arange(round(END / STEP) + 1)
    t = STEP * steps
    u = speed(t)
    bad = np.zeros((len(t), 2))
    for when, number, depth in failing:
        bad[t > when - 0.5 * STEP] = number, depth
    pull, push = 1.5e9 * np.exp(-((t - 1.6) / 0.2) ** 2), np.where(t < 1, 3.9e9 * t, 0.0)
    (folder / "surface.dat").write_text("# t us, ...\n" + "".join(f"{t[k]:.9g} {u[k]:.9g} {pull[k]:.9g} {push[k]:.9g} {bad[k, 0]:.0f}\n" for k in steps[::2]))
    (folder / "failed.dat").write_text("# t us, ...\n" + "".join(f"{t[k]:.15g} {bad[k, 0]:.0f} {bad[k, 1]:.9g}\n" for k in steps))
    (folder / "profile.dat").write_text(profile)
    (folder / "result.yaml").write_text(yaml.safe_dump({**RESULT, "record_us": END, **changed, "package_version": "0.1.0"}, default_flow_style=True, sort_keys=False))
    return folder


def test_v_shape(tmp_path):
    """strength, rate and places by their definitions"""
    r = measures.measure(write(tmp_path / "run"))
    assert set(r) == KEYS and list(r)[-1] == "package_version"
    assert r == yaml.safe_load((tmp_path / "run/result.yaml").read_text()) and {key: r[key] for key in RESULT} == RESULT
    assert (r["top_m_s"], r["pull_back_m_s"]) == (500.0, 150.0)
    assert r["spall_strength_GPa"] == pytest.approx(0.5e-9 * RHO * C * 150, rel=1e-5)
    assert r["strain_rate_per_s"] == pytest.approx(150 / 0.5e-6 / (2 * C), rel=1e-4)
    assert r["peak_GPa"] == pytest.approx(3.9, rel=0.01) and r["largest_tension_GPa"] == 1.5
    assert r["first_failure_us"] == pytest.approx(1.71625) and r["spall_plane_mm"] == 2.0  # between two rows of surface.dat
    assert (r["failed_from_mm"], r["failed_to_mm"]) == (1.5, 2.0)  # of the target, damage or spall
    assert (r["record"], r["plate"]) == ("ok", "ok")


def test_several_fail_first(tmp_path):
    r = measures.measure(write(tmp_path / "run", failing=((1.8, 2, 4.1), (1.9, 3, 7.0))))
    assert r["spall_plane_mm"] == 2.05 and r["first_failure_us"] == pytest.approx(1.8)


@pytest.mark.parametrize("slope", [100.0, 300.0])
def test_rate_is_that_of_the_upper_half(tmp_path, slope):
    """voids bend the rest"""
    fall = lambda t: np.interp(t, [0.8, 0.82, 1.2, 1.2 + 75 / slope, 2.4, 2.9], [0, 500, 500, 425, 350, 450])  # noqa: E731
    r = measures.measure(write(tmp_path / "run", fall))
    assert r["pull_back_m_s"] == 150 and r["strain_rate_per_s"] == pytest.approx(1e6 * slope / (2 * C), rel=0.02)


@pytest.mark.parametrize("rows", [12, 40])
def test_rate_does_not_go_with_the_rows(rows):
    """of a straight fall, of so many rows; the first of them is anywhere"""
    for shift in np.arange(0, 1, 0.13):
        t = np.arange(0, 3, 0.5 / rows) + shift * 0.5 / rows
        u = v_shape(t)
        assert pullback.find(t, u, 0.2).slope == pytest.approx(300, rel=1e-9), shift


def ringing(t):
    """behind the shock it swings by 40 m/s, for 0.15 us"""
    swing = np.where((t > 0.82) & (t < 0.97), 40 * np.exp(-(t - 0.82) / 0.08) * np.cos(2 * np.pi * (t - 0.82) / 0.05), 0.0)
    return v_shape(t) + swing


@pytest.mark.parametrize("hf, top, fall", [(2, 500.0, 150.0), (0.4, 523.8, 45)])
def test_what_rings_behind_the_shock(tmp_path, hf, top, fall):
    """is passed over for half of the passage of a wave through the flyer, 0.2 us of 2 mm; of a flyer of 0.4 mm it would be taken for the signal"""
    r = measures.measure(write(tmp_path / "run", ringing, flyer_mm=hf))
    assert r["top_m_s"] == pytest.approx(top, abs=5) and r["pull_back_m_s"] == pytest.approx(fall, abs=15)


def test_ringing_counts_from_the_shock(tmp_path):
    """not from an elastic wave ahead of it, which moves the surface by less than half"""
    r = measures.measure(write(tmp_path / "run", lambda t: np.maximum(ringing(t), np.where(t > 0.6, 200.0, 0.0))))
    assert (r["top_m_s"], r["pull_back_m_s"]) == (500, 150)


def test_a_plateau_that_rises(tmp_path):
    """the top is the largest speed before the fall, and a dip by less than a fiftieth is none"""
    speed = lambda t: np.interp(t, [0.8, 0.82, 1.2, 1.25, 1.5, 2.0, 2.5], [0, 495, 498, 489, 500, 350, 460])  # noqa: E731
    assert measures.measure(write(tmp_path / "run", speed))["pull_back_m_s"] == 150
    deeper = lambda t: np.interp(t, [0.8, 0.82, 1.2, 1.25, 1.5, 2.0, 2.5], [0, 495, 498, 487, 500, 350, 460])  # noqa: E731
    assert measures.measure(write(tmp_path / "run", deeper))["pull_back_m_s"] == pytest.approx(11, abs=0.1)


@pytest.mark.parametrize("again, seen", [(364.0, False), (366.0, True)])
def test_a_rise_counts_from_a_tenth_of_the_fall(tmp_path, again, seen):
    r = measures.measure(write(tmp_path / "run", lambda t: v_shape(t, again=again)))
    assert (r["record"] == "ok") is seen and r["top_m_s"] == 500
    if not seen:
        assert r["record"].startswith("no pull-back")
        assert all(math.isnan(r[key]) for key in ("pull_back_m_s", "spall_strength_GPa", "strain_rate_per_s"))
        assert r["spall_plane_mm"] == 2.0


def test_nothing_has_arrived(tmp_path):
    """the surface is at rest until the end, or the record ends while it rings"""
    for speed in (lambda t: 0 * t, lambda t: 500.0 * (t > END - 0.1)):
        r = measures.measure(write(tmp_path / "run", speed))
        assert r["record"].startswith("no pull-back") and not r["top_m_s"] > 0 and math.isnan(r["pull_back_m_s"])


def test_no_failure(tmp_path):
    """a pull-back by itself is no spall"""
    r = measures.measure(write(tmp_path / "run", failing=(), profile=SOUND.replace(" 1 0 0 0\n", " 0 0 0 0\n").replace(" 0.5 1 ", " 0.5 0 ")))
    assert r["record"] == "a pull-back, but nothing has failed" and r["pull_back_m_s"] == 150
    assert all(math.isnan(r[key]) for key in ("spall_plane_mm", "first_failure_us", "failed_from_mm", "failed_to_mm"))


@pytest.mark.parametrize("n, said", [(31, "fewer than 32 particles"), (32, "ok")])
def test_few_particles(tmp_path, n, said):
    assert measures.measure(write(tmp_path / "run", n=n))["plate"].startswith(said)


def test_a_record_may_end_a_step_before_the_run(tmp_path):
    """surface.dat has every second one"""
    assert measures.measure(write(tmp_path / "run", record_us=END + STEP))["record"] == "ok"


def test_twice_is_the_same(tmp_path, capsys):
    """on the command line, of one folder and of several"""
    one, two = (str(write(tmp_path / name)) for name in ("one", "two"))
    assert cli.main(["measure", one]) == 0
    first, text = (tmp_path / "one/result.yaml").read_bytes(), capsys.readouterr().out
    assert first == text.encode() and yaml.safe_load(text)["pull_back_m_s"] == 150
    assert cli.main(["measure", one, two]) == 0
    assert (tmp_path / "one/result.yaml").read_bytes() == first == (tmp_path / "two/result.yaml").read_bytes()
    assert capsys.readouterr().out == f"# {one}\n{text}# {two}\n{text}"


def cut(name, keep):
    """the file without its last bytes or lines"""
    def change(folder):
        path = folder / name
        text = path.read_text()
        path.write_text(text[:keep] if keep is None or keep < 0 else "".join(text.splitlines(keepends=True)[:keep]))

    return change


def edit(name, old, new):
    def change(folder):
        text = (folder / name).read_text()
        assert old in text
        (folder / name).write_text(text.replace(old, new, 1))

    return change


@pytest.mark.parametrize("change, message", [
    (cut("surface.dat", 0), r"surface.dat has no rows"), (cut("surface.dat", 1), r"surface.dat has no rows"), (cut("surface.dat", 2), r"surface.dat has one row"),
    (cut("surface.dat", -1), r"surface.dat ends in the middle of a line"), (cut("failed.dat", -4), r"failed.dat ends in the middle of a line"),
    (edit("surface.dat", "\n1.5 500 ", "\n1.5 "), r"surface.dat, line 602: 4 numbers in place of 5 \(t u tension push failed\)"),
    (cut("surface.dat", 1100), r"surface.dat ends at 2.745 us, the run at 3 us"), (cut("surface.dat", 1200), r"surface.dat ends at 2.995 us"), (cut("failed.dat", 2300), r"failed.dat ends at 2.8725 us"),
    (cut("failed.dat", 0), r"failed.dat has no rows"), (cut("profile.dat", 0), r"profile.dat has no rows"), (edit("profile.dat", " 0 0\n", " 0\n"), r"profile.dat, line 2: 12 numbers"),
    (edit("surface.dat", "\n1.5 500 ", "\n1.5 nan "), r"surface.dat, line \d+: a number is not finite"),
    (edit("surface.dat", "\n1.5 500 ", "\n1.5 ERROR "), r"surface.dat, line \d+: '1.5 ERROR .*' is not numbers"),
    (edit("surface.dat", "\n1.5 500 ", "\n1.4 500 "), r"surface.dat: the time 1.4 us comes after 1.4975 us"),
    (lambda folder: (folder / "failed.dat").unlink(), r"cannot read \S*failed.dat: No such file"),
    (lambda folder: (folder / "result.yaml").unlink(), r"result.yaml is missing or not complete"), (cut("result.yaml", -20), r"result.yaml is missing or not complete"),
    (edit("result.yaml", "package_version", "version"), r"result.yaml is missing or not complete"),
    (edit("result.yaml", "target_mm: 4, ", ""), r"result.yaml: no number target_mm, which in.spall writes"),
    (edit("result.yaml", "record_us: 3.0", "record_us: 3.0e-"), r"result.yaml: no number record_us"),
    (lambda folder: (folder / "surface.dat").unlink(), r"run: nothing to measure: there is no surface.dat")])
def test_what_is_wrong_is_named(tmp_path, capsys, change, message):
    """and result.yaml stays as it is"""
    folder = write(tmp_path / "run")
    change(folder)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    with pytest.raises(HVIError, match=message):
        measures.measure(folder)
    assert cli.main(["measure", str(folder)]) == 1 and capsys.readouterr().err.startswith(f"hvi: {'cannot read ' if 'cannot' in message else ''}{folder}")
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_no_folder(tmp_path):
    with pytest.raises(HVIError, match="there is no such folder"):
        measures.measure(tmp_path / "none")


def test_time_of_the_fall():
    """rows of the top and of the least speed"""
    t = np.linspace(0, 3, 1201)
    found = pullback.find(t, v_shape(t), 0.2)
    assert (t[found.top], t[found.low]) == pytest.approx((1.5, 2.0), abs=3e-3) and found.slope == pytest.approx(300, rel=1e-9)
    found = pullback.find(t[:700], v_shape(t[:700]), 0.2)
    assert not found.seen and found.fall == pytest.approx(500 - v_shape(t[699])) and math.isnan(found.slope)
