"""hvi/recall: the variables of a run, lists and words with blanks too, for one that goes on with it."""

import pytest

SHOW = "print '${dx} ${pair} ${mark}'\nlabel more\nprint 'frame ${frame}'\nnext frame\njump SELF more\n"
GIVEN = {"dx": "0.5", "frame": ["4", "8 or 9", "12"], "pair": "dissipation riemann", "mark": "it's", "out": "."}
LINES = [f"{GIVEN['dx']} {GIVEN['pair']} {GIVEN['mark']}", "frame 4", "frame 8 or 9", "frame 12"]


def shown(result):
    return [line for line in result.stdout.splitlines() if line.startswith(("0.5", "frame"))]


@pytest.fixture
def written(lmp):
    """a run that writes its variables, and has them all afterwards"""
    r = lmp("variable k loop 3\nvariable e equal 1\nhvi/recall given run.given except out\n" + SHOW, vars=GIVEN)
    assert shown(r) == LINES
    return r.cwd / "run.given"


@pytest.mark.parametrize("nranks", [1, 2])
def test_taken_up(lmp, written, nranks):
    text = written.read_text()
    assert [line.split()[2] for line in text.splitlines()[1:]] == ["dx", "frame", "pair", "mark"]
    assert shown(lmp("include run.given\nvariable dx index 1\n" + SHOW, nranks=nranks)) == LINES
    assert shown(lmp("include run.given\n" + SHOW, vars={"dx": 0.5, "frame": GIVEN["frame"]})) == LINES


@pytest.mark.parametrize("name, value, was", [
    ("dx", "0.4", "0.5"), ("frame", ["4", "8"], "4 8 or 9 12"), ("frame", ["4", "8 or 9", "12", "16"], "4 8 or 9 12"),
    ("pair", "dissipation monaghan", "dissipation riemann")], ids=str)
def test_others_are_refused(lmp, written, name, value, was):
    r = lmp("include run.given\n" + SHOW, vars={name: value}, expect_fail=True)
    now = value if isinstance(value, str) else " ".join(value)
    assert f"a variable has changed: {name} was '{was}', and is '{now}' now" in r.error


Q = '"""'
STATE = f"""variable text string "two words"
variable quote string 'say "no"'
variable lines string {Q}first
  'second' and "third" ones{Q}
variable sum equal "v_dx + 0.25*count(all)"
variable number equal 0.1
variable cost atom vx
variable start timer
variable gone equal 1
variable gone delete
variable k loop 3
"""
TELL = f"print {Q}${{text}}; ${{quote}}; ${{sum}}; ${{number}}; $(v_number:%.17g); ${{frame}}{Q}\nprint {Q}${{lines}}{Q}\n"
BOX = "region b block 0 1 0 1 0 1\ncreate_box 1 b\n"


def told(result):
    lines = result.stdout.splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("two words;"))
    return lines[at : at + 3]


def test_in_the_middle_of_a_run(lmp):
    """variables stay in their places, which thermo output knows them by: lists too"""
    r = lmp("variable z index 'one value' another\nvariable a equal 5\nvariable b equal 7\n" + BOX + """mass 1 1
thermo_style custom step v_a v_b
thermo 4
run 0
run 8 pre no post no every 4 "hvi/recall state run.state"
""")
    assert (r.thermo["v_a"] == 5).all() and (r.thermo["v_b"] == 7).all()


def test_state(lmp):
    """as variables are, with their formulas; lists from where they are"""
    r = lmp(BOX + STATE + "next frame\n" + 2 * "hvi/recall state run.state except out\n" + TELL, vars=GIVEN)
    want = ['two words; say "no"; 0.5; 0.1; 0.10000000000000001; 8 or 9', "first", "  'second' and \"third\" ones"]
    assert told(r) == want
    more = "create_atoms 1 single 0.5 0.5 0.5\nprint 'now $(v_sum)'\nnext frame\nprint 'then ${frame}'\n"
    r = lmp(BOX + "include run.state\n" + TELL + more, vars={"frame": "4", "dx": 7})
    assert told(r) == want and "now 0.75\n" in r.stdout and "then 12\n" in r.stdout
    assert not list(r.cwd.glob("*.part"))
    for name in ("out", "cost", "k"):
        assert lmp(f"include run.state\nprint '${{{name}}}'\n", expect_fail=True).error


def test_the_file_before_stays_if_the_new_one_fails(lmp, tmp_path):
    lmp("hvi/recall given run.given\n", vars=GIVEN)
    old = (tmp_path / "run.given").read_text()
    (tmp_path / "run.given.part").mkdir()
    assert "cannot write file run.given" in lmp("hvi/recall given run.given\n", vars={"dx": 1}, expect_fail=True).error
    assert (tmp_path / "run.given").read_text() == old


@pytest.mark.parametrize("text, message", [
    ("hvi/recall given", "Illegal hvi/recall command: missing argument"), ("hvi/recall variable dx", "Illegal hvi/recall variable command"),
    ("hvi/recall read run.given", "must be followed by given, state or variable, not read"),
    ("hvi/recall state run.given but dx", "unknown keyword but"), ("hvi/recall given no/such/folder", "cannot write file no/such/folder"),
    ("variable dx equal 1\nhvi/recall variable dx 1", "variable dx is not of style index")], ids=str)
def test_wrong_input(lmp, text, message):
    assert message in lmp(text + "\n", expect_fail=True).error
