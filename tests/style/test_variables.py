"""hvi/variables: what -var may say. Names that nobody asks for end the input, in all examples too."""

import re

import pytest

TEXT = """
variable dx index 0.4
variable thickness index 1 2 3
{more}
hvi/variables {words}
print "dx is ${{dx}}"
"""
WORDS = "known dx thickness optional gap"


def test_known_names_pass(lmp):
    r = lmp(TEXT.format(words=WORDS, more=""), vars={"dx": 0.2, "thickness": [0.8, 3.2], "gap": [0, 100]})
    assert "dx is 0.2" in r.stdout


@pytest.mark.each_value
@pytest.mark.parametrize("nranks", [1, 2])
@pytest.mark.parametrize("name, message", [
    ("thicknes", "Unknown variable thicknes: did you mean thickness? This input knows: dx thickness gap"),
    ("gaps", "Unknown variable gaps: did you mean gap?"), ("DX", "Unknown variable DX. This input knows"),
    ("velocity", "Unknown variable velocity. This input knows")])
def test_unknown_name_ends_the_input(lmp, nranks, name, message):
    r = lmp(TEXT.format(words=WORDS, more=""), vars={name: [1, 3.2]}, nranks=nranks, expect_fail=True)
    assert message in r.error and "dx is" not in r.stdout


def test_other_styles_are_no_settings(lmp):
    """their values, which may look like a style, do not matter either"""
    more = ("variable k loop 3\nvariable t equal step\nvariable s string 'style = index, here'\nvariable r getenv PATH\n"
            "variable w timer\nvariable f format t %g\nvariable gone index 1\nvariable gone delete")
    assert "dx is 0.4" in lmp(TEXT.format(words=WORDS, more=more)).stdout


def test_included_files_are_looked_at(lmp, tmp_path):
    (tmp_path / "more.in").write_text("variable extra index 1\n")
    more = "include more.in"
    assert "Unknown variable extra" in lmp(TEXT.format(words=WORDS, more=more), expect_fail=True).error
    assert "dx is 0.4" in lmp(TEXT.format(words=WORDS + " extra", more=more)).stdout


def test_plugin(lmp, lmp_stock, plugin):
    text = f"plugin load {plugin}\n" + TEXT.format(words=WORDS, more="")
    assert "did you mean thickness?" in lmp(text, vars={"thicknes": 1}, exe=lmp_stock, expect_fail=True).error
    assert "dx is 0.4" in lmp(text, exe=lmp_stock).stdout


def test_every_example_knows_its_variables(lmp, root):
    """and refuses others, before it does anything else; its defaults and its list are the same"""
    inputs = sorted(root.glob("examples/*/in.*"))
    assert len(inputs) > 10
    for path in inputs:
        text = path.read_text()
        assert "hvi/variables" in text, path
        (name, *_) = re.findall(r"^variable\s+(\w+)\s+index\b", text, re.M)
        r = lmp(path, vars={name + "x": 1}, expect_fail=True)
        assert f"Unknown variable {name}x" in r.error, (path, r.error)
        assert "Created" not in r.stdout, path


def test_examples_are_straight(root):
    """from top to bottom: no label, jump, condition or loop, in what they include neither; nothing for the shell"""
    files = [path for folder in root.glob("examples/*") for pattern in ("in.*", "legs.*", "*.shock", "*.collapse") for path in folder.glob(pattern)]
    assert len(files) > 15
    words = r"^\s*(label|jump|next|if|shell|python|clear|quit)\b|\bvariable\s+\w+\s+loop\b"
    assert {path.name: found for path in files if (found := re.findall(words, path.read_text(), re.M))} == {}


@pytest.mark.parametrize("script, values, message", [
    ("standard-shocks/in.sod", {"n": 100}, "n_fills_both_halves: Divide by 0"), ("layered-shock/in.layers", {"n": 128}, "n_is_a_multiple_of_10: Divide by 0"),
    ("standard-shocks/in.flyer", {"file_t": "Al1100-O.hvi"}, "Hugoniots_are_of_the_files: Divide by 0"),
    ("standard-shocks/in.flyer", {"file_t": "Cu-OFHC.hvi"}, "Hugoniots_are_of_the_files: Divide by 0")])
def test_values_that_do_not_fit(lmp, root, tmp_path, script, values, message):
    """of which LAMMPS alone would make wrong numbers: the name of a variable says what must hold"""
    r = lmp(root / "examples" / script, vars=values, expect_fail=True, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert message in r.error and "Loop time" not in r.stdout and not (tmp_path / "result.yaml").exists()
