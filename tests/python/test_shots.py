"""python3 -m hvi shots: lists read and refused, the rule of spacings, the choice, and what is counted; LAMMPS is a fake here."""

import collections
import csv
import importlib.util
import re

import pytest
import yaml
from front_runs import case_folder, front, tries  # noqa: F401
from hvi.errors import HVIError
from hvi.jobs import machine
from hvi.shield import ble, shots

HEAD = "source,shotID,proj_mat,proj_diam,angle,velocity,bumper_mat,bumper_thick,standoff,wall_mat,wall_yield,wall_thick,result\n"
LIST = "# a remark\n" + HEAD + """A,small,AA2017-T4,0.318,0,6.5,AA6061-T6,0.08,5.08,AA6061-T6,40,0.159,NP
A,"two, large",AA99.9%,0.635,30,4,AA6061-T6,0.16,10.16,AA2219-T87,55,0.318,P
B,middle,AA1100-O,0.4,0,7,AA6061-T6,0.1,10,AA7075-T6,73,0.12,P
"""
STUDY = """list: mine.csv
spacing: {across: 10, bumper_layers: 2, wall_layers: 3, ratio: 1}
materials: {AA1100-O: Al1100-O, AA2017-T4: Al2017-T4, AA6061-T6: Al6061-T6, AA7075-T6: Al7075-T6, AA2219-T87: Al2219-T87}
stand_ins: {AA99.9%: Al1100-O}
finer: {factor: 0.75, shots: [small]}
"""


@pytest.fixture(name="mine")
def mine_folder(folder):
    (folder / "mine.csv").write_text(LIST)
    (folder / "mine.yaml").write_text(STUDY)
    return folder


# ---------------------------------------------------------------------- lists
def test_list_of_the_example():
    found = shots.read_list(shots.SETTINGS.parent / "shots.csv")
    assert len(found) == 80 and collections.Counter(shot.observed for shot in found) == {"P": 41, "NP": 39}
    first = found[0]
    assert (first.name, first.source, first.projectile, first.diameter_mm, first.bumper_mm, first.gap_mm, first.wall_mm) == (
        "E-50", "CR-915", "AA2017-T4", 3.18, 1.59, 50.8, 3.18)
    assert (first.wall, first.yield_ksi, first.angle_deg, first.speed_km_s, first.observed) == ("AA7075-T6", 73, 0, 2.14, "NP")


WRONG = [
    ("0.318,0,6.5", "0.318,90,6.5", "line 3: angle must be below 90 degrees, not 90"),
    ("0.318,0,6.5", "0.318,-1,6.5", "line 3: angle must be a number above 0 or 0, not '-1'"),
    ("0.318,0,6.5", "3 mm,0,6.5", "line 3: proj_diam must be a number above 0, not '3 mm'"),
    ("0.318,0,6.5", "0.318,0,nan", "line 3: velocity must be a number above 0, not 'nan'"),
    ("0.318,0,6.5", "0.318,0,0", "line 3: velocity must be a number above 0, not '0'"),
    ("7075-T6,73,0.12,P", "7075-T6,73,0.12,PERF", "line 5: result must be P or NP, not 'PERF'"),
    ("7075-T6,73,0.12,P", "7075-T6,73,0.12", "line 5: 12 values in 13 columns"),
    ("B,middle,", "B,small,", "line 5: shot small is there twice"),
    ("B,middle,", "B,,", "line 5: shotID is empty"),
    ("standoff,", "gap,", "no column standoff"),
    (LIST[LIST.index("A,small"):], "", "no shots"),
]


@pytest.mark.parametrize("old, new, message", WRONG)
def test_refused_lists(tmp_path, old, new, message):
    assert old in LIST
    (tmp_path / "mine.csv").write_text(LIST.replace(old, new))
    with pytest.raises(HVIError, match=message.replace("'", ".")):
        shots.read_list(tmp_path / "mine.csv")


# ---------------------------------------------------------------------- studies
def test_one_rule_for_all_shots(mine):
    (mine / "mine.yaml").write_text(STUDY.replace("ratio: 1}", "ratio: 2}"))
    study = shots.Study("mine.yaml")
    small, large, middle = (study.case(shot) for shot in study.shots)
    assert small.spacings_mm == (0.318, 0.2385)  # D/10, and finer
    assert small.walls[1].spacings_mm == (0.53, 0.3975)  # wall/3
    assert large.spacings_mm == (0.635,) and large.walls[1].spacings_mm == (1.06,)
    assert middle.spacings_mm == (0.4,) and middle.walls[1].spacings_mm == (0.4,)  # wall/3 again, and no ratio
    (mine / "mine.csv").write_text(LIST.replace("AA6061-T6,0.08", "AA6061-T6,0.03"))
    thin = study.case(shots.Study("mine.yaml").shots[0])
    assert thin.spacings_mm == (0.15, 0.1125) and thin.walls[1].spacings_mm == (0.3, 0.225)  # bumper/2, and twice that
    assert large.angle_deg == 30 and large.walls[1].gap_mm == 101.6
    assert (large.material, *(wall.material for wall in large.walls)) == ("Al1100-O.hvi", "Al6061-T6.hvi", "Al2219-T87.hvi")


def test_a_rule_with_a_core(mine):
    """as fine as the projectile, in a part of the gap"""
    (mine / "mine.yaml").write_text(STUDY.replace("ratio: 1}", "ratio: 1, core: 0.25}"))
    small = shots.Study("mine.yaml").case(shots.Study("mine.yaml").shots[0])
    assert small.walls[1].spacings_mm == small.spacings_mm == (0.318, 0.2385) and small.walls[1].core_mm == 12.7 and small.walls[0].core_mm is None


def test_all_shots_of_the_example_are_cases():
    study = shots.Study(shots.SETTINGS)
    cases = [study.case(shot) for shot in study.shots]
    assert len(cases) == 80 and set(study.stand_ins) == {"AA99.9%", "AA2219-T851"}
    for case in cases:
        assert case.walls[1].thickness_mm / case.walls[1].spacings_mm[0] > 2.99  # as a verdict asks for
    assert not study.settings and study.shifts == (0.0,)


@pytest.mark.parametrize("old, new, message", [
    ("AA7075-T6: Al7075-T6, ", "", "shot middle: no material for AA7075-T6; give it one in materials"),
    ("AA99.9%: Al1100-O", "AA99.9%: Al1100", "line 4: stand_ins: AA99.9%: no material Al1100; did you mean Al1100-O"),
    ("{AA99.9%", "{AA6061-T6: Al6061-T6, AA99.9%", "AA6061-T6 is among materials, too"),
    ("shots: [small]", "shots: [smal]", "no shot smal; did you mean small"),
    ("across: 10, ", "", "line 2: spacing: across: is missing"),
    ("10, bumper_layers: 2, wall_layers: 3", "3, bumper_layers: 1, wall_layers: 1", "shot small: spacings_mm: 0.8 mm leaves fewer than 4 particles across"),
    ("list: mine.csv", "list: mine.csv\nsettings: {tstopp: 4}", "settings: tstopp: no such key; did you mean tstop"),
])
def test_refused_studies(mine, capsys, old, new, message):
    assert old in STUDY
    (mine / "mine.yaml").write_text(STUDY.replace(old, new))
    assert front("shots", case="mine.yaml") == 1
    assert re.search(message, capsys.readouterr().err)


def test_list_by_itself_is_run_as_the_example_is(mine):
    study, example = shots.Study("mine.csv"), shots.Study(shots.SETTINGS)
    assert study.name == "mine" and [shot.name for shot in study.shots] == ["small", "two, large", "middle"]
    assert (study.rule, study.materials) == (example.rule, example.materials) and not study.finer


# ---------------------------------------------------------------------- runs
def test_table_and_counts(mine, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_LIMIT", "3.0")  # + dx + (wall - 1.2): small holds, large and middle fail
    assert front("shots", case="mine.yaml") == 0
    said = capsys.readouterr().out
    assert "stand-in: AA99.9% is computed as Al1100-O.hvi" in said and "AA6061-T6 is computed" not in said
    assert "3 shots, 4 runs, 0 done before, 4 to run" in said
    with open("runs/mine/shots.csv", newline="") as table:
        rows = {line["shot"]: line for line in csv.DictReader(table)}
    assert {name: (line["observed"], line["predicted"], line["finer"], line["both"]) for name, line in rows.items()} == {
        "small": ("NP", "holds", "holds", "holds"), "two, large": ("P", "fails", "", ""), "middle": ("P", "fails", "", "")}
    assert rows["middle"]["reasons"] == "wall 2 is perforated by a hole of 5 mm; wall 2 has detached spall of 4 mg"
    assert float(rows["small"]["core_h"]) == pytest.approx((round(0.318**-4, 1) + round(0.2385**-4, 1)) / 3600, abs=1e-4)
    assert rows["two, large"]["JSC"] == f"{0.635 / critical('JSC', 'two, large'):.2f}" and rows["two, large"]["Reimerdes"].endswith("*")
    text = (mine / "runs/mine/shots.md").read_text()
    assert "| simulation | 2 | 0 | 0 | 0 | 0 | 1 | 3 | 0 |" in text and "| NNO | " in text and "| both spacings | 0 | 0 | 0 | 0 | 0 | 1 | 1 | 0 |" in text
    assert front("shots", case="mine.yaml") == 0
    assert set(tries(mine).values()) == {1} and "4 done before, 0 to run" in capsys.readouterr().out


def critical(name, shot):
    study = shots.Study("mine.yaml")
    case = study.case(shots.named(study.shots, [shot], "here")[0])
    found = ble.from_case(case)
    assert found.wall_yield_ksi == 55  # of the list, not of a table, which has 57
    return ble.critical_diameter(name, found, case.speed_km_s, case.angle_deg)[0]


def test_what_is_undecided_and_what_fails_to_run(mine, capsys, monkeypatch):
    monkeypatch.setenv("FAKE_LIMIT", "2.6")  # small: 3.308 at the coarse spacing, 3.2285 at the fine one
    monkeypatch.setenv("FAKE_FAIL", "middle")
    monkeypatch.setenv("FAKE_UNSURE", "0.2")
    (mine / "mine.csv").write_text(LIST.replace("0.318,0,6.5", "0.325,0,6.5"))
    assert front("shots", case="mine.yaml") == 1
    assert "1 failed: middle_dx-0.4_shift-0.0" in capsys.readouterr().out
    with open("runs/mine/shots.csv", newline="") as table:
        rows = {line["shot"]: line for line in csv.DictReader(table)}
    assert (rows["small"]["predicted"], rows["small"]["finer"], rows["small"]["both"]) == ("holds", "undecided", "undecided")
    assert rows["middle"]["predicted"] == "" and rows["two, large"]["predicted"] == "fails"


def test_only_these(mine, capsys):
    assert front("shots", "--only", "middle", case="mine.yaml") == 0
    assert list(tries(mine)) == ["dx-0.4_shift-0.0"] and "stand-in" not in capsys.readouterr().out
    assert front("shots", "--only", "small", "small", case="mine.yaml") == 0  # once, and what was done before stays in the table
    said = capsys.readouterr().out
    assert "mine: 1 shots, 2 runs, 0 done before" in said and "2 of 3 shots are done, and counted:" in said
    with open("runs/mine/shots.csv", newline="") as table:
        assert {line["shot"]: bool(line["predicted"]) for line in csv.DictReader(table)} == {"small": True, "two, large": False, "middle": True}
    assert "2 of 3 shots are done" in (mine / "runs/mine/shots.md").read_text()
    assert front("shots", "--only", "midle", case="mine.yaml") == 1
    assert "no shot midle; did you mean middle?" in capsys.readouterr().err


def test_what_does_not_fit_is_refused(mine, capsys, monkeypatch):
    """of the runs that are to be made; a plan is there to choose shots by"""
    monkeypatch.setattr(machine, "free_memory", lambda: 50)
    assert front("shots", case="mine.yaml") == 1 and not tries(mine)
    assert "MB of memory, and 50 are free: take " in (err := capsys.readouterr().err) and err.endswith(" or more by the study's rule, or --only other shots\n")
    assert front("shots", "--dry-run", case="mine.yaml") == 0


def test_equations_alone(mine, capsys):
    assert front("shots", "--equations", case="mine.yaml") == 0
    said = capsys.readouterr().out
    assert not tries(mine) and "two, large" in said
    line = next(line for line in said.splitlines() if line.split()[:1] == ["modNNO"])
    assert sum(map(int, line.split()[1:7])) == 3


def test_plans(mine, capsys, monkeypatch):
    assert front("shots", "--nodes", "2", "--dry-run", case="mine.yaml") == 1 and "--nodes is for --engine slurm" in capsys.readouterr().err
    assert front("shots", "--dry-run", case="mine.yaml") == 0
    with open("runs/mine/plans.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert [(line["shot"], line["dx_mm"]) for line in rows] == [("small", "0.318"), ("small", "0.2385"), ("two, large", "0.635"), ("middle", "0.4")]
    count = [sum(float(line[f"{body}_particles"]) for body in ("projectile", "wall1", "wall2")) * float(line["steps"]) for line in rows]
    assert [float(line["particle_steps"]) for line in rows] == pytest.approx(count, rel=1e-3) and not tries(mine)
    monkeypatch.setenv("PATH", "/nowhere")  # a machine without Slurm
    assert front("shots", "--engine", "slurm", "--dry-run", case="mine.yaml") == 0 and "\nnot checked by Slurm: sbatch is not there" in capsys.readouterr().out


def test_margins(mine):
    study = shots.Study("mine.yaml")
    outcome = shots.Outcome(study.shots[2], study.case(study.shots[2]), mine / "runs")
    job = outcome.jobs[0, 0.0]
    job.folder.mkdir(parents=True)
    (job.folder / "job.yaml").write_text(yaml.safe_dump(job.record, sort_keys=False))
    margins = "margins: {hole_mm: %s, apart_mass_mg: %s, bulge_over_thickness: 0.51, deepest_failed_layer: 2, layers: 3}\nverdict: %s\npackage_version: 1\n"
    for numbers, text in (((0, 0, "holds"), "bulge 0.51 t, layer 2 of 3 failed"), ((2.5, 31, "fails"), "hole 2.5 mm, 31 mg apart"),
                          ((0, 0, "undecided"), "bulge 0.51 t, layer 2 of 3 failed"), ((".nan", 3, "undecided"), "hole nan mm, 3 mg apart"), ((".nan", 0, "undecided"), "hole nan mm, 0 mg apart")):
        (job.folder / "result.yaml").write_text(margins % numbers)
        assert outcome.margin() == text


# ---------------------------------------------------------------------- counts
def test_confusion():
    table = shots.confusion([("P", "fails"), ("P", "fails"), ("P", "holds"), ("NP", "fails"), ("NP", "undecided"), ("NP", "holds"), ("NP", "")])
    assert table == {("P", "fails"): 2, ("P", "undecided"): 0, ("P", "holds"): 1, ("NP", "fails"): 1, ("NP", "undecided"): 1, ("NP", "holds"): 1}
    names, (line,) = shots.counts_table([("it", table)])
    assert names[-2:] == ("right", "wrong") and line == ("it", 2, 0, 1, 1, 1, 1, 3, 2)
    assert [shots.by_equation((ratio, [])) for ratio in (0.99, 1.0, 1.5)] == ["holds", "fails", "fails"]
    assert shots.shown((0.987, [])) == "0.99" and shots.shown((1.2, ["too thin"])) == "1.20*"


# ---------------------------------------------------------------------- the choice
@pytest.fixture(name="choose")
def choose_module():
    spec = importlib.util.spec_from_file_location("choose", shots.SETTINGS.parent / "choose.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def shot(name, speed=5.0, angle=0.0, bumper=1.0, wall="a", seen="P"):
    return shots.Shot(name, "", "p", 4.0, angle, speed, "b", bumper, 50.0, wall, 40.0, 2.0, seen)


def test_what_is_eligible(choose):
    found = [shot("good"), shot("slow", 1.9), shot("fast", 7.51), shot("thick", bumper=1.61), shot("foil", bumper=0.1), shot("dear"), shot("oblique", angle=30),
             shot("thin", bumper=0.5), shot("dearest", angle=45), shot("planless")]
    cost = {s.name: 1e7 for s in found if s.name != "planless"} | {"dear": 121e6, "oblique": 121e6, "thin": 121e6, "dearest": 451e6}
    kept, out = choose.eligible(found, cost)
    assert [s.name for s in kept] == ["good", "oblique", "thin"]
    assert {name for names in out.values() for name in names} == {"slow", "fast", "thick", "foil", "dear", "dearest", "planless"}
    assert out["cost"] == ["dear", "dearest"]


def test_order_of_the_choice(choose):
    crowd = [shot(f"n{k}") for k in range(30)]
    others = [shot("o1", angle=30), shot("o2", angle=45), shot("o3", angle=60), shot("o4", angle=60), shot("thin", bumper=0.5), shot("thinner", bumper=0.4),
              shot("slow", 2.2, wall="c", seen="NP"), shot("fast", 7.0, bumper=1.4, wall="d", seen="NP")]
    far = {s.name: k for k, s in enumerate(crowd + others)}
    names = [s.name for s in choose.choose(crowd + others, far)]
    assert names[:8] == [f"n{k}" for k in range(8)]  # the nearest, whatever they are
    assert names[8:12] == ["o1", "o2", "o3", "thin"] and len(names) == 16 == len(set(names))
    assert set(names[12:14]) == {"slow", "fast"}  # what is not there yet comes first, however far
    tilted = [shot(f"n{k}", angle=30 * (k == 3)) for k in range(30)]
    names = [s.name for s in choose.choose(tilted + others, far)]
    assert names[3] == "n3" and names[8:11] == ["o1", "o2", "thin"]  # one oblique shot is there already
    fine = choose.finer(choose.choose(crowd + others, far), far, {s.name: 1e9 if s.name == "n1" else 1e7 for s in crowd + others})
    assert [s.name for s in fine] == ["n0", "n2", "n3", "n4", "n5", "n6"]


def test_distance_counts_both_sides_alike(choose):
    assert choose.distance({"a": (2.0, []), "b": (0.5, ["x"])}) == pytest.approx(0.693147, abs=1e-5)


def test_the_choice_of_the_example(choose):
    """what was asked for; that it was made beforehand is in the history of chosen.yaml"""
    study, everything = shots.Study(shots.SETTINGS.parent / "chosen.yaml"), shots.Study(shots.SETTINGS)
    assert len(study.shots) >= 16 and len(study.finer) == 6
    assert (study.rule, study.materials, study.shifts, study.settings) == (everything.rule, everything.materials, everything.shifts, everything.settings)
    assert {s.observed for s in study.shots} == {"P", "NP"} and len({s.wall for s in study.shots}) >= 3 and sum(s.angle_deg > 0 for s in study.shots) >= 3
    assert all(2 <= s.speed_km_s <= 7.5 and 0.05 <= choose.thin(s) <= 0.4 for s in study.shots)
