"""Material files and tables of equations of state that are spoilt, through LAMMPS: an error that names file and line, no signal, no hang; or they are right."""

import pathlib

import pytest

HEAD = "# DATE: 2026-02-01 UNITS: si\n"
GOOD = HEAD + "eos gruneisen\n  rho0 2703\n  C 5240\n  S1 1.4\n  g0 1.97\n  cp 885\nstrength perfect\n  G 27e9\n  Y 3e8\n"
TABLE = HEAD + "rho0 2\ninterpolation bilinear\npressure 3 2\ne 0 1\n1 -1 0\n2 0 1\n3 1 2\n"
BIG = 100_000_000

# what is changed, and with what; "" is right, else what LAMMPS says
MATERIALS = {
    "as it is": ((), ""), "crlf": (("\n", "\r\n"), ""), "mark": (("# DATE", "\ufeff# DATE"), ""), "blanks": (("  C 5240", "\t C\t5240 \f"), ""), "latin": ((" UNITS", " \udcb5m UNITS"), ""),
    "no end of the last line": (("Y 3e8\n", "Y 3e8"), ""),
    "mark within": (("eos gr", "\ufeffeos gr"), ":2: expected a section"), "lone cr": (("\n", "\r"), "no section eos"), "zero byte": (("5240", "52\x0040"), "is no text: it has a byte of 0"),
    "binary": ((GOOD, "".join(map(chr, range(256)))), "is no text"), "empty": ((GOOD, ""), "no section eos"), "truncated": ((GOOD[GOOD.index("C 5240") + 1:], ""), ":4: eos gruneisen: key C has no value"),
    "truncated in a section": ((GOOD[GOOD.index("  g0"):], ""), ":2: eos gruneisen: missing key g0"), "negative": (("C 5240", "C -1"), ":4: eos gruneisen: C = -1 must be > 0"),
    "zero": (("rho0 2703", "rho0 0"), ":3: eos gruneisen: rho0 = 0 must be > 0"), "nan": (("C 5240", "C nan"), ":4: eos gruneisen: C: nan is not a number"),
    "infinite": (("C 5240", "C inf"), ":4: eos gruneisen: C: inf is not a number"), "too large": (("C 5240", "C 1e999"), ":4: eos gruneisen: C = inf is not a finite number"),
    "hexadecimal": (("C 5240", "C 0x10"), ":4: eos gruneisen: C: 0x10 is not a number"), "comma": (("1.97", "1,97"), ":6: eos gruneisen: g0: 1,97 is not a number"),
    "unit": (("C 5240", "C 5240 m/s"), ":4: eos gruneisen: C: unexpected text m/s after the value"), "unknown": (("  C ", "  c0 "), ":4: eos gruneisen: unknown key c0; known are"),
    "twice": (("  C 5240", "  C 5240\n  C 5240"), ":5: eos gruneisen: key C given twice, first in line 4"), "section twice": (("strength", "eos linear\nrho0 1\nK 1\nstrength"), ":8: second section eos, the first is in line 2"),
    "section unknown": (("strength perfect", "strength plastic"), ":8: unknown law strength plastic; known are"), "no law": (("strength perfect", "strength"), ":8: section strength names no law; known are"),
    "units unknown": (("UNITS: si", "UNITS: imperial"), ":1: unknown UNITS: imperial; known are"), "units twice": (("UNITS: si", "UNITS: si UNITS: si"), ":1: UNITS: given twice"),
    "no units": (("UNITS: si", ""), ":2: no UNITS: in the comments before the first section"), "units of lj": (("UNITS: si", "UNITS: lj"), "UNITS: lj cannot be converted to units si of the run"),
    "long word": (("C 5240", "C " + "5" * 100_000), "is not a finite number"), "ten megabytes of remarks": ((GOOD, GOOD + "# remark\n" * 1_200_000), ""),
    "braces": (("C 5240", "C {}{0}%s%n"), ":4: eos gruneisen: C: {}{0}%s%n is not a number"), "deep name": (("eos gruneisen", "eos table\n  file ../../../none.table\nstrength none\neos linear"), ":5: second section eos"),
}
TABLES = {
    "as it is": ((), ""), "crlf": (("\n", "\r\n"), ""), "mark": (("# DATE", "\ufeff# DATE"), ""), "zero byte": (("1 -1", "1\x00-1"), "is no text: it has a byte of 0"), "empty": ((TABLE, ""), "no pressure"),
    "no units": (("UNITS: si", ""), "no UNITS: in the comments before the first key"), "truncated": (("3 1 2\n", ""), ":4: pressure: the file ends after 2 of 3 densities"), "short row": (("2 0 1", "2 0"), ":7: pressure: 1 values in the row, not 2"),
    "huge counts": (("pressure 3 2", "pressure 1000000000 1000000000"), "pressure needs the numbers of densities and energies, found 1000000000"), "many that are not there": (("pressure 3 2", "pressure 1000000 1000000"), "values in the row, not 1000000"),
    "negative counts": (("pressure 3 2", "pressure -3 2"), "found -3"), "part of a count": (("pressure 3 2", "pressure 2.5 2"), "found 2.5"), "no counts": (("pressure 3 2", "pressure"), "found nothing"),
    "falling": (("\n2 0 1", "\n0.5 0 1"), "density 0.5 is not above that of the row before"), "negative density": (("\n1 -1", "\n-1 -1"), "density -1 must be > 0"), "nan": (("2 0 1", "2 nan 1"), "pressure: nan is not a number"),
    "infinite": (("2 0 1", "2 1e999 1"), "is not a finite number"), "energies fall": (("e 0 1", "e 1 0"), "energy 0 is not above the one before"), "unknown": (("rho0 2", "rho 2"), "unknown key rho; known are rho0"),
    "twice": (("rho0 2", "rho0 2\nrho0 2"), "rho0 given twice"), "temperature first": (("pressure 3", "temperature 3"), "temperature stands before pressure"), "units of lj": (("UNITS: si", "UNITS: lj"), ":1: UNITS: lj cannot be converted to units si of the run"), "long row": (("2 0 1", "2 0 1 2"), ":7: pressure: 3 values in the row, not 2"),
    "falls": (("3 1 2", "3 -1 -3"), "pressure falls with density at constant entropy"), "too few": (("bilinear", "bicubic"), "3 densities and 2 energies are too few, bicubic needs 4"),
    "reference": (("rho0 2", "rho0 4"), "the reference state, rho0 = 4 and energy 0, is not in the table"), "choice": (("rho0 2", "density cubic"), "density must be linear or log, not cubic"),
}
SCENE = """units si
atom_style sph
region b block 0 1 0 1 0 1
create_box 1 b
create_atoms 1 single 0.5 0.5 0.5
mass 1 1
pair_style hvi/sph cubic
pair_coeff 1 1 {} h 0.1
print "read it"
"""


def spoilt(text, change):
    assert not change or change[0] in text
    return (text.replace(*change) if change else text).encode("utf-8", "surrogateescape")


def judge(lmp, words, says, nranks=1):
    result = lmp(SCENE.format(words), nranks=nranks, expect_fail=bool(says), timeout=60)
    assert result.returncode < 128 and "Sanitizer" not in result.stderr, result
    if says:
        said = " ".join(result.error.split())
        assert says in said and "x." in said and "read it" not in result.log, f"{says!r} is not in {said[:500]!r}"


@pytest.mark.parametrize("name", MATERIALS)
def test_material(lmp, tmp_path, name):
    change, says = MATERIALS[name]
    (tmp_path / "x.hvi").write_bytes(spoilt(GOOD, change))
    judge(lmp, "file x.hvi", says)


@pytest.mark.parametrize("name", TABLES)
def test_table(lmp, tmp_path, name):
    change, says = TABLES[name]
    (tmp_path / "x.table").write_bytes(spoilt(TABLE, change))
    judge(lmp, "eos table x.table", says)


@pytest.mark.parametrize("words, of", [("file x.hvi", "material"), ("eos table x.hvi", "table")])
@pytest.mark.parametrize("nranks", [1, 2])
def test_no_file(lmp, tmp_path, words, of, nranks):
    """a folder, one that is not there, and one without end, which must not fill the memory"""
    judge(lmp, words, f"Cannot find {of} file x.hvi, neither here nor in LAMMPS_POTENTIALS", nranks)
    path = pathlib.Path("x.hvi")
    path.mkdir()
    judge(lmp, words, f"Cannot read {of} file x.hvi: is it a folder?", nranks)
    path.rmdir()
    path.symlink_to("/dev/zero")
    judge(lmp, words, f"The {of} file x.hvi is larger than {BIG} bytes: is it the right one?", nranks)
