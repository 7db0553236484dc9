"""python3 -m hvi limit: searches that end where they should, and say what they rest on; LAMMPS is a fake here."""

import csv
import os
import re
import subprocess
import sys

import pytest
import yaml
from front_runs import begun, case_folder, change, front, tries, wait_for  # noqa: F401
from hvi.jobs import engine, machine
from hvi.shield import limit


def answer(folder, on="D"):
    return yaml.safe_load((folder / f"runs/emi/limit-{on}/limit.yaml").read_text())


def test_limit(folder, capsys):
    """limits of the fake: 4.2 and 4.25 at 0.2 mm, 4.4 and 4.45 at 0.4 mm, here by steps of 0.1"""
    assert front("limit", "--on", "D", "--from", "2", "--to", "8", "--step", "0.1", "--jobs", "3") == 0
    out, found = capsys.readouterr().out, answer(folder)
    assert found["limit"] == pytest.approx(4.25) and found["limit_of_spacings"] == {"0.4 mm": 4.45, "0.2 mm": 4.25}
    assert found["change_by_spacing"] == -0.2 and found["range_over_shifts"] == 0 and found["undecided"] == [4.2, 4.5] and found["step"] == 0.1
    assert (found["holds"], found["fails"]) == ("up to 4.2", "from 4.5") and set(tries(folder).values()) == {1}
    assert "\nholds up to 4.2 mm, fails from 4.5, between them undecided: limit on diameter_mm, its middle 4.25 mm\n" in out
    assert found["runs"] == len(tries(folder)) <= 4 * 8 and f"cost: {found['runs']} runs" in out
    fine = [name for name in tries(folder) if name.startswith("dx-0.2")]
    assert len(fine) <= 2 * 5  # they begin about what the coarse ones have found
    before = begun(folder)
    assert front("limit", "--on", "D", "--from", "2", "--to", "8", "--step", "0.1") == 0
    assert begun(folder) == before and answer(folder) == found and found["notes"] == [] and "note:" not in out


def test_limit_of_walls_that_are_the_same_with_all_spacings(folder, capsys):
    (folder / "emi.yaml").write_text(change("spacings_mm: [0.2, 0.4]", "spacings_mm: [0.2, 0.4]\nsettings: {layers: [6, 12]}"))
    assert front("limit", "--on", "D", "--from", "2", "--to", "8", "--step", "0.5", "--jobs", "3") == 0
    (note,) = answer(folder)["notes"]
    assert note.startswith("settings: layers are the same") and f"\nnote: {note}\n" in capsys.readouterr().out


def test_limit_with_an_undecided_region(folder, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_UNSURE", "0.73")
    assert front("limit", "--on", "D", "--from", "2", "--to", "8", "--step", "0.1", "--jobs", "3") == 0
    found, out = answer(folder), capsys.readouterr().out
    assert found["undecided"] == [4.2, 5.2]  # holds up to 4.2 at least at all, fails beyond 4 + 0.4 + 0.05 + 0.73 at all
    assert re.search(r"^ *0.2 +0 +4.2 +4.3 to 4.9 +5 ", out, re.M)
    assert "dx-0.2_shift-0.0_D-4.3" in found["undecided_runs"] and "dx-0.2_shift-0.0_D-4.2" not in found["undecided_runs"]
    assert re.search(r"undecided: dx-0.2_shift-0.0_D-4.3\n  - 1 percent of the energy of the shot are still on their way to wall 2 at [\d.]+ us, the end at the latest -- take settings: {tstop: [\d.]+}\n", out)


@pytest.mark.parametrize("words, limit", [(("thickness2", "--from", "1.2", "--to", "3.2", "--step", "0.2"), 1.9), pytest.param(("D",), 4.25, marks=pytest.mark.long)])
def test_limit_on_what_holds_when_it_is_more(folder, monkeypatch, words, limit):
    """a wall that is thicker holds: D = 5 needs 1.95 mm and 1.9 mm at 0.2, 1.75 mm and 1.7 at 0.4"""
    monkeypatch.setenv("FAKE_LIMIT", "4.05")
    assert front("limit", "--on", *words) == 0
    found = answer(folder, words[0])
    assert found["limit"] == pytest.approx(limit, abs=0.25)
    if words[0] == "thickness2":
        assert found["holds"] == "from 2" and found["fails"] == "up to 1.6" and found["undecided"] == [1.6, 2.0]


@pytest.mark.long
def test_limit_on_speed(folder, monkeypatch):
    """4 mm (7.1 / v)^1 + 0.2 and 0.4 mm and what shifts add: 5 mm holds up to 5.9 and 6.2 km/s"""
    monkeypatch.setenv("FAKE_POWER", "1")
    assert front("limit", "--on", "speed", "--from", "4", "--to", "9", "--step", "0.1") == 0
    found = answer(folder, "speed")
    assert (found["on"], found["unit"]) == ("speed_km_s", "km/s") and found["limit"] == pytest.approx(4 * 7.1 / 4.8, abs=0.1) and found["holds"] == "up to 5.9"


@pytest.mark.long
def test_curve(folder, capsys, monkeypatch):
    """a limit for each speed, with the equations beside; what was run is left alone; a speed that has none in the range says so"""
    monkeypatch.setenv("FAKE_POWER", "1")
    words = ["curve", "--speeds", "5:7:2", "--from", "3", "--to", "7", "--step", "0.2", "--jobs", "3"]
    assert front(*words) == 0
    out, where = capsys.readouterr().out, folder / "runs/emi/curve-D"
    with open(where / "curve.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    for row in rows:
        v = float(row["speed_km_s"])
        assert float(row["limit_mm"]) == pytest.approx(4 * 7.1 / v + 0.2, abs=0.2) and float(row["low"]) < float(row["limit_mm"]) < float(row["high"]) and float(row["NNO"]) > 0
    assert [float(row["speed_km_s"]) for row in rows] == [5, 7] and "cost: " in out and (where / "curve.png").stat().st_size > 10_000
    before = begun(folder)
    assert front(*words) == 0 and begun(folder) == before
    assert front("curve", "--speeds", "3:7:2", "--from", "3", "--to", "7", "--step", "0.2") == 4
    assert "no limit at 3 km/s: an end of the range" in capsys.readouterr().out
    assert front("curve", "--speeds", "5:7:2", "--on", "thickness2", "--from", "1.2", "--to", "3.2", "--step", "0.8") == 4  # at 5 km/s 1.2 mm hold
    out = capsys.readouterr().out
    assert "equations: none: the equations are for a diameter" in out and "no limit at 5 km/s: an end of the range" in out and "no limit at 7 km/s" not in out


@pytest.mark.long
def test_curve_of_an_earlier_call(folder, capsys, monkeypatch):
    """does not stay where a later one with other speeds fails; a dry run leaves it"""
    monkeypatch.setenv("FAKE_POWER", "1")
    (folder / "emi.yaml").write_text(ONE)
    where = folder / "runs/emi/curve-D"
    words = ["--from", "3", "--to", "7", "--step", "1"]
    assert front("curve", "--speeds", "6:7:2", *words) == 0 and front("curve", "--speeds", "5:6:2", *words, "--dry-run") == 0
    of_it = {where / f"curve.{ending}" for ending in ("yaml", "csv", "png")}
    assert of_it <= set(where.iterdir())
    monkeypatch.setenv("FAKE_FAIL", "v-5")
    assert front("curve", "--speeds", "5:6:2", *words) == 1 and "no curve: " in capsys.readouterr().err
    assert not of_it & set(where.iterdir())


ONE = change("shifts: [0, 0.5]", "shifts: [0]")


@pytest.mark.long
def test_limit_on_gap_and_angle(folder, monkeypatch):
    """5 mm are held from 100 mm at 0.2 mm on, with 0.02 mm more for each mm of gap, and from 40 degrees on with the same for each degree; it says of which case"""
    monkeypatch.setenv("FAKE_GAP", "0.02")
    (folder / "emi.yaml").write_text(ONE)
    assert front("limit", "--on", "gap2", "--from", "60", "--to", "120", "--step", "10") == 0
    found = answer(folder, "gap2")
    assert (found["on"], found["unit"], found["own"]) == ("gap_mm of wall 2", "mm", 60) and found["holds"] == "from 100" and found["limit"] == 95
    assert found["calibration"].startswith("none: there are no measured limits over gap_mm of wall 2") and found["equations"]["NNO"]["low_side"] == "fails"
    monkeypatch.setenv("FAKE_ANGLE", "0.02")
    assert front("limit", "--on", "angle", "--from", "0", "--to", "60", "--step", "20") == 0
    found = answer(folder, "angle")
    assert (found["on"], found["unit"], found["own"]) == ("angle_deg", "degrees", 0) and found["holds"] == "from 40" and found["case"]["walls"][1]["gap_mm"] == 60


def test_limit_at_another_gap_and_angle(folder, monkeypatch, capsys):
    """4.2 mm of the case, 0.8 more by 40 mm of gap and 0.2 by 10 degrees, in a folder of its own"""
    monkeypatch.setenv("FAKE_GAP", "0.02")
    monkeypatch.setenv("FAKE_ANGLE", "0.02")
    (folder / "emi.yaml").write_text(ONE)
    assert front("limit", "--on", "D", "--at", "gap2=100", "angle=10", "--from", "4", "--to", "7", "--step", "0.5") == 0
    found = answer(folder, "D_gap2-100_angle-10")
    assert found["limit"] == 5.25 and found["case"]["angle_deg"] == 10 and found["case"]["walls"][1]["gap_mm"] == 100 and not (folder / "runs/emi/limit-D").exists()


def test_curve_over_gap(folder, capsys, monkeypatch):
    """a column with its name, equations at each gap; the picture says over what it is"""
    monkeypatch.setenv("FAKE_GAP", "0.02")
    (folder / "emi.yaml").write_text(ONE)
    assert front("curve", "--over", "gap2=60:100:2", "--at", "angle=20", "--from", "3", "--to", "7", "--step", "1") == 0
    where = folder / "runs/emi/curve-D_over-gap2_angle-20"
    with open(where / "curve.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert [(float(row["gap2_mm"]), float(row["limit_mm"])) for row in rows] == [(60, 4.5), (100, 5.5)] and 0 < float(rows[0]["NNO"]) < float(rows[1]["NNO"])
    found = yaml.safe_load((where / "curve.yaml").read_text())
    assert found["over"] == "gap2_mm" and found["case"]["angle_deg"] == 20 and [point["gap2_mm"] for point in found["points"]] == [60, 100] and (where / "curve.png").exists()
    for words, message in ((("--over", "gap2=60:100:2", "--on", "gap2"), "--on gap2: gap2 is what the curve is over"), (("--at", "speed=5"), "--at speed: speed varies here"),
                           (("--over", "gap2=0:100:2"), "--over gap2 0 mm: must be above 0"), (("--over", "mass=1:2:3"), "--over must be D, speed")):
        assert front("curve", *words) == 1 and message in capsys.readouterr().err, words


@pytest.mark.parametrize("on, sides", [("thickness2", ("from 2", "up to 1.6")), pytest.param("D", ("up to 4", "from 4.5"), marks=pytest.mark.long)])
def test_curve_says_which_side_holds(folder, capsys, monkeypatch, on, sides):
    """as hvi limit of the same runs"""
    if on != "D":
        monkeypatch.setenv("FAKE_LIMIT", "4.05")
    (folder / "emi.yaml").write_text(ONE)
    words = ["--on", on, *(("--from", "1.2", "--to", "3.2", "--step", "0.4") if on != "D" else ("--from", "3", "--to", "7", "--step", "0.5"))]
    assert front("curve", "--speeds", "7.1:7.2:2", *words) == 0
    out, (first, _) = capsys.readouterr().out, yaml.safe_load((folder / f"runs/emi/curve-{on}/curve.yaml").read_text())["points"]
    with open(folder / f"runs/emi/curve-{on}/curve.csv", newline="") as table:
        assert next(csv.DictReader(table)).items() >= {"holds": sides[0], "fails": sides[1]}.items()
    assert (first["holds"], first["fails"]) == sides and re.search(rf"^ *7.1 .* {sides[0]} +{sides[1]} ", out, re.M) and "holds, fails: of all runs, between them undecided" in out
    assert front("limit", *words) == 0 and (answer(folder, on)["holds"], answer(folder, on)["fails"]) == sides


@pytest.mark.parametrize("shape", [pytest.param("shape: cylinder, diameter_mm: 2, length_mm: 12", marks=pytest.mark.long), "shape: cube, side_mm: 3"])
def test_equations_of_a_curve_are_of_the_same_size(folder, capsys, shape):
    """as those of hvi limit: the diameter of a cylinder, not of the sphere of its mass"""
    (folder / "emi.yaml").write_text(ONE.replace("\n  diameter_mm: 5\n  material: Al2024-T3", f" {{{shape}, material: Al2024-T3}}").replace("[0.2, 0.4]", "[0.2, 0.1]"))
    words = ["--from", "1", "--to", "7", "--step", "0.5"]
    assert front("curve", "--speeds", "7.1:7.2:2", *words) == 0 and front("limit", "--on", "D", *words) == 0
    with open(folder / "runs/emi/curve-D/curve.csv", newline="") as table:
        row = next(csv.DictReader(table))
    (limit_,) = answer(folder)["equations"]["NNO"]["limits"]
    assert float(row["NNO"]) == pytest.approx(limit_, rel=1e-4)


def test_no_limit_in_the_range(folder, capsys):
    assert front("limit", "--on", "D", "--from", "5", "--to", "9") == 4
    out = capsys.readouterr().out
    assert "limit: not found\n  - an end of the range neither holds nor fails as it should: choose --from and --to" in out and "dx-0.2_shift-0.0: fails at 5 mm, fails at 9 mm" in out
    assert answer(folder)["limit"] is None


def test_a_wall_that_never_holds_has_no_limit(folder, capsys):
    (folder / "emi.yaml").write_text(change("material: Al6061-T6", "material: Ti-6Al-4V"))
    for words in (("limit", "--on", "thickness2"), ("curve", "--dry-run")):
        assert front(*words) == 1
        assert "hvi: emi: no limit: wall 2 is of Ti-6Al-4V.hvi, whose file has no law of spall (damage yes spall voids), so it does not fail in tension, and a shield that holds is undecided -- " in capsys.readouterr().err
    assert not (folder / "runs").exists()


def test_limit_goes_on_after_kill(folder, capsys):
    """kill -9 amid the search: what was run counts, what still runs is waited for"""
    words = ["limit", "emi.yaml", "--on", "D", "--from", "2", "--to", "8", "--step", "0.1", "--jobs", "2", "--mpirun", "./mpirun"]
    process = subprocess.Popen([sys.executable, "-m", "hvi", *words], cwd=folder, env={**os.environ, "FAKE_SLEEP": "0.3"}, stdout=subprocess.DEVNULL)
    wait_for(lambda: len(list(folder.glob("runs/emi/limit-D/*/result.yaml"))) >= 6)
    process.kill()
    process.wait()
    first = begun(folder)
    assert not (folder / "runs/emi/limit-D/limit.yaml").exists()
    assert front(words[0], *words[2:-2]) == 0
    assert answer(folder)["limit"] == pytest.approx(4.25) and len(begun(folder)) > len(first) and first.items() <= begun(folder).items()


@pytest.mark.parametrize("words, over", [(("limit", "--on", "D"), []), (("curve", "--speeds", "5:7:3"), [[5], [7]])])
def test_what_a_search_takes(folder, capsys, monkeypatch, words, over):
    """plans at the ends of the range, for each spacing; what does not fit at one of them is refused, with a plan and without, unless all is there already"""
    words, columns, searches = (*words, "--from", "4", "--to", "6", "--step", "0.5"), 2 + bool(over), 3 if over else 1
    assert front(*words, "--dry-run", "--jobs", "99") == 0
    out = capsys.readouterr().out
    head, *rows = [line.split() for line in out.splitlines() if not line.startswith(("/", "emi", "at most", "./"))]
    assert head == [*(["speed_km_s"] if over else []), "spacing_mm", "D_mm", "particles", "steps", "core_s", "memory_MB"]
    assert [[float(word) for word in line[:columns]] for line in rows] == [[*at, dx, D] for at in over or [[]] for dx in (0.4, 0.2) for D in (4, 6)]
    said = re.search(rf"^at most {searches * 32} runs, as a rule far fewer: at most about (.*) if the wall fails, up to 3 times that if it does not, {searches * 4} at a time on 2 ranks", out, re.M)
    if not over:  # 16 of each spacing, all as at 6 mm
        assert said[1] == engine.duration(16 * sum(float(line[-2]) for line in rows if float(line[1]) == 6) / (4 * 2))
    memory = float(rows[-1][-1])
    monkeypatch.setattr(machine, "free_memory", lambda: 0.9 * memory)
    for more in ((), ("--dry-run",)):
        assert front(*words, *more) == 1
        assert "6 mm: spacings_mm: 0.2 mm makes some " in (err := capsys.readouterr().err) and err.endswith("or a narrower range\n") and not (folder / "runs").exists()
    monkeypatch.setattr(machine, "free_memory", lambda: 1.5 * memory)
    assert front(*words, "--jobs", "2") == 1 and "in each of 2 runs at a time" in capsys.readouterr().err and not tries(folder)
    if not over:
        assert front(*words) == 0
        before = begun(folder)
        monkeypatch.setattr(machine, "free_memory", lambda: 1)
        assert front(*words) == 0 and begun(folder) == before


@pytest.mark.parametrize("words, message", [
    (("--on", "mass"), "--on must be D, speed, angle, thickness1, thickness2 or gap2, not mass"), (("--on", "thickness3"), "not thickness3"),
    (("--on", "D", "--from", "6", "--to", "5"), "there is nothing between"),
    (("--on", "thickness2", "--from", "0.1"), "--from 0.1 mm: spacings_mm: 0.4 mm is more than wall 2 is thick"),
    (("--on", "D", "--from", "4", "--to", "60"), "--to 60 mm: wall 2: radius_mm: with 40 mm a projectile of 60 mm at 0 degrees strikes its edge"),
    (("--on", "speed", "--from", "3000", "--to", "9000"), "--from 3000 km/s: speed_km_s: must be at least 0.1 and below 100 km/s, not 3000; is it in m/s?"),
    (("--on", "gap1"), "not gap1"), (("--on", "D", "--at", "gap2=0"), "--at gap2 0 mm: must be above 0"), (("--on", "angle", "--to", "90"), "--to 90 degrees: an angle must be at least 0 and below 90"),
    (("--on", "D", "--from", "0"), "--from 0 mm: must be above 0"), (("--on", "D", "--at", "gap3=5"), "--at must be D, speed"), (("--on", "D", "--at", "angle=5", "angle=6"), "--at angle: it is given twice"),
    (("--on", "D", "--at", "angle=60"), "--at angle 60 degrees: wall 2: radius_mm: with 40 mm a projectile of 5 mm at 60 degrees strikes its edge"),
    (("--on", "D", "--at", "D=4"), "--at D: D varies here: take it out"),
])
def test_wrong_limits(folder, capsys, words, message):
    (folder / "emi.yaml").write_text(change("gap_mm: 60", "gap_mm: 60\n    radius_mm: 40"))
    assert front("limit", *words) == 1 and message in capsys.readouterr().err and not (folder / "runs").exists()


def search(truth, n, **words):
    """(borders, number of tries) of a search over a function of places"""
    found = limit.Search(n, **words)
    while new := found.next():
        found.said.update({place: truth(place) for place in new})
    assert found.done
    assert len(found.said) <= limit.tries(n, bool(words.get("window")))
    return found.borders(), len(found.said)


def test_search():
    """every border in every range is found, whichever window it begins with; a few tries each"""
    for n in (1, 2, 7, 20):
        for border in range(1, n + 1):
            for turned in (False, True):
                def truth(place):
                    return "holds" if (place < border) != turned else "fails"
                low, high = border - 1, border
                want = (high, low, high, low) if turned else (low, high, low, high)
                for window in (None, (0, 1), (n - 1, n), (border - 2, border + 1)):
                    for known in (None, turned):
                        assert search(truth, n, window=window, turned=known)[0] == want
        assert search(truth, n)[1] <= 2 + 5
    for first in range(1, 10):
        for last in range(first, 10):
            def unsure(place):
                return "holds" if place < first else "undecided" if place <= last else "fails"
            found, count = search(unsure, 10)
            if found[1] != found[3]:  # a narrow region may lie between places that were tried
                assert (found[0], found[3]) == (first - 1, last + 1) and count <= 9
    assert search(lambda place: "holds", 10) == ((None,) * 4, 2)
    to_and_fro = {0: "holds", 5: "fails", 2: "holds", 3: "holds", 4: "holds", 7: "holds", 10: "fails"}
    assert search(lambda place: to_and_fro.get(place, "fails" if place > 7 else "holds"), 10)[0] in ((4, 5, 7, 8), (4, 5, 4, 5))
