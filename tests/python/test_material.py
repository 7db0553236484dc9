"""python3 -m hvi material: its reader against the headers of the C++ and against LAMMPS, its curves against what LAMMPS computes, its words and figures.

Every file of potentials/ is read, checked, drawn, and must say what it has not and why.
"""

import csv
import functools
import os
import re

import numpy as np
import pytest
from conftest import ROOT
from dumps import frames
from reference import voids

from hvi import HVIError, cli
from hvi.figures.material import draw
from hvi.material import curves, library

FILES = sorted((ROOT / "potentials").glob("*.hvi"))
HEADERS = ROOT / "lib" / "hvi" / "material"
EOS = "eos gruneisen\n  rho0 2700 # [S]\n  C 5200 # assumed: of something else\n  S1 1.3\n  g0 2\n  cp 900\n"
HEAD = "# DATE: 2026-01-02 UNITS: si CITATION: Nobody 2026\n#\n# A metal\n"
JC = "strength johnson-cook\n  G 26e9\n  A 3e8\n  B 2e8\n  n 0.3\n  C 0.01\n  m 1.2\n  Tref 300\n  Tm 800\n"
EXTRA = {  # laws that no file of potentials/ has
    "cowper-symonds": "strength cowper-symonds\n  G 27e9\n  Y0 2e8\n  D 6500\n  p 4\n",
    "zerilli-armstrong": "strength zerilli-armstrong\n  G 80e9\n  C0 65e6\n  C1 1033e6\n  C3 0.00698\n  C4 0.000415\n  C5 266e6\n  n 0.289\n  Tm 1800\n",
}


@pytest.fixture
def written(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(text, name="x.hvi"):
        (tmp_path / name).write_text(text)
        return name

    return write


# ---------------------------------------------------------------------- the reader
def test_keys_are_those_of_the_headers():
    """names, dimensions, ranges and presets of all laws, as their tables in C++ have them"""
    text = "".join(p.read_text() for p in sorted(HEADERS.glob("hvi_*.h")) + [HEADERS / "hvi_laws.cpp"])
    ranges = {"POSITIVE": library.POSITIVE, "NOT_NEGATIVE": library.FROM_0, "ANY": library.ANY, "FRACTION": library.FRACTION, "PART": library.PART,
              "ABOVE_ONE": library.ABOVE_1}
    kinds = {"Eos": "eos", "Strength": "strength", "Damage": "damage", "Spall": "spall", "Thermal": "thermal"}
    found = {}
    structs = re.split(r"^ *struct (\w+) \{$", text, flags=re.M)
    for struct, body in zip(structs[1::2], structs[2::2]):
        law = re.search(r'\bname = "([\w-]+)"', body)
        if not law or not struct.startswith(tuple(kinds)):
            continue
        table = re.search(r"Parameter params\[\] = \{(.*?)\};\n", body, re.S)
        rows = re.findall(r'\{"(\w+)", (\w+|\{[^}]*\}), (\w+), ([\w.e+-]+)', table[1] if table else "")
        kind = next(value for key, value in kinds.items() if struct.startswith(key))
        found[kind, law[1]] = tuple((key, "impulse" if quantity.startswith("{") else quantity.lower(), ranges[bounds],
                                     None if preset == "REQUIRED" else float(preset)) for key, quantity, bounds, preset in rows)
    assert found == {section: keys for section, keys in library.LAWS.items() if section != ("eos", "table")}


@pytest.mark.parametrize("text, message", [
    ("eos linear\n", "x.hvi:1: no UNITS: in the comments"),
    ("# UNITS: imperial\n", "x.hvi:1: unknown UNITS: imperial; known are si, cgs, micro, lj"),
    (HEAD, "x.hvi: no section eos"),
    (HEAD + "rho0 3\n", "x.hvi:4: expected a section (eos, strength, damage, spall, thermal), found rho0"),
    (HEAD + "eos\n", "x.hvi:4: section eos names no law; known are linear, tait"),
    (HEAD + "eos soft\n", "x.hvi:4: unknown law eos soft; known are linear"),
    (HEAD + "eos linear really\n", "x.hvi:4: eos linear: unexpected text really"),
    (HEAD + "eos linear\nrho0 3\n", "x.hvi:4: eos linear: missing key K"),
    (HEAD + "eos linear\nrho0 3\nrho0 4\n", "x.hvi:6: eos linear: key rho0 given twice, first in line 5"),
    (HEAD + "eos linear\nrho 3\n", "x.hvi:5: eos linear: unknown key rho; known are rho0 K"),
    (HEAD + "eos linear\nrho0\n", "x.hvi:5: eos linear: key rho0 has no value"),
    (HEAD + "eos linear\nrho0 3 4\n", "x.hvi:5: eos linear: rho0: unexpected text 4 after the value"),
    (HEAD + "eos linear\nrho0 0x3\n", "x.hvi:5: eos linear: rho0: 0x3 is not a number"),
    (HEAD + "eos linear\nrho0 inf\n", "x.hvi:5: eos linear: rho0: inf is not a number"),
    (HEAD + "eos linear\nrho0 1e999\n", "x.hvi:5: eos linear: rho0 = 1e999 is not a finite number"),
    (HEAD + "eos linear\nrho0 -3\n", "x.hvi:5: eos linear: rho0 = -3 must be > 0"),
    (HEAD + EOS + "eos linear\n", "x.hvi:10: second section eos, the first is in line 4"),
    (HEAD + EOS + JC + "strength none\n", "x.hvi:19: strength none beside strength johnson-cook in line 10"),
    (HEAD + EOS + JC.replace("Tm 800", "Tm 200"), "x.hvi:10: strength johnson-cook: Tm must be above Tref"),
    (HEAD + EOS + "spall voids\n  sigma 1e9\n  rate 1e5\n  m 1.5\n", "x.hvi:13: spall voids: m = 1.5 must be in (0, 1]"),
    (HEAD + "# No spall: lazy\n" + EOS + "spall limit\n  sigma_p 1e9\n", "x.hvi: its head says 'No spall', but it has a section spall"),
    (HEAD + "eos table\n", "x.hvi:4: eos table: missing key file"),
    (HEAD + "eos table\n\nfile no.table\n", "x.hvi:6: eos table: cannot find table file no.table, neither here nor in LAMMPS_POTENTIALS"),
    (HEAD + "eos linear\nrho0\u00a03\n", "x.hvi:5: eos linear: unknown key rho0\u00a03; known are rho0 K"),
    ((HEAD + EOS).replace("\n", "\r"), "x.hvi: no section eos"),
])
def test_wrong_files(lmp, written, capsys, text, message):
    """one line that names file and line; LAMMPS refuses the file at the same line"""
    name = written(text)
    assert cli.main(["material", name]) == 1
    err = capsys.readouterr().err
    assert err.startswith(f"hvi: {message}") and err.count("\n") == 1
    if "its head says" in message or "Tm must" in message:  # which is the fix's matter
        return
    result = lmp("units si\natom_style sph\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\npair_style hvi/sph cubic\n"
                 f"pair_coeff 1 1 file {name} h 0.1\n", expect_fail=True)
    assert result.returncode != 0 and re.search(rf"Material file {re.escape(message.split(': ')[0])}\b", result.error), str(result)


def test_lines_and_blanks(lmp, written):
    """as LAMMPS has them: all that ends a line elsewhere is text or a blank"""
    name = written((HEAD + "# one\u2028line\x85 with\fall\v of it\n" + EOS.replace("rho0 2700", "rho0\f2700\v")).replace("\n", "\r\n"))
    assert library.read(name).sections["eos", "gruneisen"]["rho0"] == 2700
    lmp("units si\natom_style sph\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\npair_style hvi/sph cubic dissipation riemann\n"
        f"pair_coeff 1 1 file {name} h 0.1\n")


def test_what_a_file_says(written, capsys):
    name = written(HEAD + "# No spall: nobody\n#   measured it\n" + EOS + JC)
    assert cli.main(["material", name, "--out", "h.csv"]) == 0
    out = capsys.readouterr().out
    for line in ("x.hvi: A metal", "units si, of 2026-01-02", "  eos       gruneisen", "  strength  johnson-cook", "  damage    none; the file does not say why",
                 "  spall     none: nobody", "  assumed   eos gruneisen C 5200: assumed: of something else", "  yes shocks and flow without strength",
                 "  no  projectiles, debris, plate impact (spall voids): it has no spall voids", "  no  walls of shields (damage yes spall voids): it has no damage, no spall voids",
                 "  yes temperature", "  yes softening by heat, melting"):
        assert line + "\n" in out, line
    with open("h.csv") as stream:
        rows = list(csv.DictReader(stream))
    for row in rows:
        u, Us, p = (float(row[key]) for key in ("u_m_s", "Us_m_s", "p_GPa"))
        assert Us == pytest.approx(5200 + 1.3 * u, rel=1e-9) and p == pytest.approx(2700 * Us * u * 1e-9, rel=1e-9), row
    assert len(rows) == 8


@pytest.mark.parametrize("name, lines", [("PMMA", ["  yes temperature", "  no  softening by heat, melting: it has no strength that knows the temperature"]),
                                         ("Al-Tillotson", ["  yes temperature", "  no  softening by heat, melting: it has no strength that knows the temperature"]),
                                         ("Ta", ["  yes projectiles, debris, plate impact (spall voids strength steinberg-guinan)", "  yes softening by heat, melting"])])
def test_uses_of_laws(capsys, name, lines):
    """heat softens laws that know the temperature; words name the law that fix hvi/johnson-cook would not look for by itself"""
    assert cli.main(["material", f"{name}.hvi"]) == 0
    out = capsys.readouterr().out
    for line in lines:
        assert line + "\n" in out, line


@pytest.mark.parametrize("heat, said", [("", "  no  temperature: it has no temperature in its table"), ("temperature 2 2\ne 0 1\n1 300 301\n2 300 301\n", "  yes temperature")])
def test_temperature_of_a_table(written, tmp_path, capsys, heat, said):
    (tmp_path / "x.table").write_text("# UNITS: si\npressure 2 2\ne 0 1\n1 0 0\n2 1 1\n" + heat)
    name = written("# UNITS: si\n# A thing\neos table\nfile x.table\n")
    assert cli.main(["material", name]) == 0
    assert said + "\n" in capsys.readouterr().out
    assert cli.main(["material", name, "--out", "x.csv"]) == 1 and not os.path.exists("x.csv")
    assert "--out: there are no curves of eos table" in capsys.readouterr().err


def test_files_are_found_as_lammps_finds_them(written, capsys, monkeypatch):
    monkeypatch.setenv("LAMMPS_POTENTIALS", os.pathsep.join(["none", str(ROOT / "potentials")]))
    assert cli.main(["material", "Pb.hvi"]) == 0 and str(ROOT / "potentials" / "Pb.hvi") in capsys.readouterr().out
    assert cli.main(["material", "Unobtainium.hvi"]) == 1
    assert "cannot find material file Unobtainium.hvi, neither here nor in LAMMPS_POTENTIALS" in capsys.readouterr().err


@pytest.mark.parametrize("units, factor", [("cgs", (1e-3, 1e2, 10, 1e4)), ("micro", (1e-3, 1, 1e-3, 1))])
def test_units(written, units, factor):
    """the same metal in other units: density, speed, pressure, specific heat; the impulse of tuler-butcher; presets are in SI"""
    density, speed, pressure, heat = factor
    time = {"cgs": 1.0, "micro": 1e6}[units]
    text = (f"eos gruneisen\nrho0 {2700 * density}\nC {5200 * speed}\nS1 1.3\ng0 2\ncp {900 * heat}\n"
            f"spall tuler-butcher\nsigma_0 {4e8 * pressure}\nlambda 2\nK {2e16 * pressure**2 * time}\ndamage johnson-cook\nD1 1\nD2 0\nD3 0\nD4 0\nD5 0\n")
    one = library.read(written(f"# UNITS: {units}\n" + text))
    assert one.in_si(("eos", "gruneisen")) == pytest.approx({"rho0": 2700, "C": 5200, "S1": 1.3, "g0": 2, "a": 0, "cp": 900, "S2": 0, "S3": 0, "T0": 300})
    assert one.in_si(("spall", "tuler-butcher")) == pytest.approx({"sigma_0": 4e8, "lambda": 2, "K": 2e16})
    assert one.in_si(("damage", "johnson-cook"))["epsdot0"] == 1


METAL = ("# UNITS: {units}\neos gruneisen\nrho0 {rho0!r}\nC {C!r}\ncp {cp!r}\nS1 1.3\ng0 2\nT0 300\nstrength johnson-cook\nG {G!r}\nA {A!r}\nB {B!r}\nn 0.3\nC 0.01\nm 1.2\nepsdot0 1\n"
         "Tref {Tref!r}\nTm 800\nspall voids\nsigma {sigma!r}\nrate {rate!r}\nm 0.2\nphi_c 0.1\n")
IN_SI = {"rho0": 2700, "C": 5200, "cp": 900, "G": 26e9, "A": 3e8, "B": 2e8, "sigma": 1e9, "rate": 1e5, "Tref": 300}


@pytest.mark.parametrize("units, density, speed, heat, pressure, rate", [("si", 1, 1, 1, 1, 1), ("cgs", 1e-3, 1e2, 1e4, 10, 1), ("micro", 1e-3, 1, 1, 1e-3, 1e-6), ("lj", 1, 1, 1, 1, 1)])
@pytest.mark.parametrize("key, slip, low, high", [("rho0", 1e-3, 10, 25000), ("C", 1e-3, 100, 20000), ("Tref", 1 / 15, 100, 6000), ("rate", 1e6, 1, 1e9), ("cp", 1e-3, 27, 270000),
                                                  ("G", 1e-9, 7.3e7, 1.5e11), ("A", 1e-6, 730000, 1.5e10), ("B", 1e-6, 730000, 1.5e10), ("sigma", 1e-9, 7.3e6, 2.2e10)])
def test_values_in_wrong_units(written, units, density, speed, heat, pressure, rate, key, slip, low, high):
    """of a metal, in the units of its file: the value is named, and what is usual; in units lj there are ratios only"""
    factor = {"rho0": density, "C": speed, "cp": heat, "G": pressure, "A": pressure, "B": pressure, "sigma": pressure, "rate": rate, "Tref": 1}
    values = {name: value * factor[name] for name, value in IN_SI.items()}
    assert not library.doubts(library.read(written(METAL.format(units=units, **values))))
    if units == "lj" and key in ("rho0", "C", "Tref", "rate"):
        return
    wrong, to = slip * values[key], factor[key]
    (said,) = library.doubts(library.read(written(METAL.format(units=units, **{**values, key: wrong}))))
    assert f": {key} = {wrong:g} is far from what is usual" in said and said.endswith(f", {low * to:g} to {high * to:g} in units {units}"), said


@pytest.mark.parametrize("eos, said", [
    ("linear\nrho0 1000\nK 2.2e9\n", ""), ("linear\nrho0 1000\nK 2.2\n", "K = 2.2 is far from what is usual with its rho0, 1e+07 to 4e+11"),
    ("tait\nrho0 1000\nc0 1.48\n", "c0 = 1.48 is"), ("polynomial\nrho0 8900\nA1 1.4e11\nA2 290\n", "A2 = 290 is far from what is usual with its eos, 1.4e+08 to 1.4e+13"),
    ("tillotson\nrho0 2700\na 0.5\nb 1.63\nA 75.2e9\nB 65e9\nE0 5e10\nEiv 3e6\nEcv 13.9e6\n", "E0 = 5e+10 is"), ("idealgas\ngamma 1.4\n", "")])
def test_units_of_equations_of_state(written, capsys, eos, said):
    assert cli.main(["material", written("# UNITS: si\neos " + eos), "Pb.hvi"]) == 0  # of several there are no curves
    assert re.fullmatch(f"hvi: warning: x.hvi: eos .*{re.escape(said)}.*: is it in other units\\?\n" if said else "", capsys.readouterr().err)


# ---------------------------------------------------------------------- all files
@pytest.fixture
def rough(monkeypatch):
    """what voids bear in few steps: test_what_voids_bear has the numbers"""
    monkeypatch.setattr(curves, "borne", functools.partial(curves.borne, steps=10))


@pytest.mark.parametrize("path", FILES, ids=lambda p: p.stem)
def test_all_files_pass(path, capsys, rough):
    """each is read without a warning, has a title, a date, sources, and says of all it has not why"""
    assert cli.main(["material", str(path)]) == 0
    one, (out, err) = library.read(path), capsys.readouterr()
    assert not err  # no value is far from what is usual
    assert one.title and one.date and one.citation
    assert all(one.lacks().values()), "a line '# No KIND: why' in the head"
    assert "does not say why" not in out
    for section, keys in one.assumed().items():
        assert all(f"assumed   {' '.join(section)} {key} " in out for key in keys)


def laws_of(path):
    one = library.read(path)
    return tuple(tuple(one.laws(kind)) for kind in library.WANTED)


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem, marks=[pytest.mark.long] * any(laws_of(path) == laws_of(other) for other in FILES[:k])) for k, path in enumerate(FILES)])
def test_all_files_are_drawn(path, rough):
    one = library.read(path)
    panels = draw(one).axes
    lines = [len(ax.lines) for ax in panels]
    strong, spall = len(one.laws("strength")), len(one.laws("spall")) + ("voids" in one.laws("spall"))  # voids: and what is borne
    assert lines == [1, 1, 2, 2 if one.in_si(("eos", one.laws("eos")[0])).get("cp") else 0, strong, strong, strong, spall]
    assert all(np.isfinite(line.get_ydata()).all() for ax in panels for line in ax.lines)
    for ax in panels:  # what is not there says so
        assert ax.lines or re.match("no ", ax.texts[0].get_text())


def test_metals_of_the_shots_can_be_used():
    """what published shields are made of has strength and spall by voids; what is assumed of it is said"""
    for name in "Al1100-O Al2017-T4 Al2024-T3 Al2219-T87 Al5456-H116 Al6061-T6 Al7075-T6".split():
        one = library.read(ROOT / "potentials" / f"{name}.hvi")
        assert library.needs(one, dict((words, wanted) for _, words, wanted in library.USES)["damage yes spall voids"]) == (["damage"] if name == "Al2017-T4" else [])
    for name in "Al2219-T87 Al5456-H116 Al7075-T6".split():
        assert set(library.read(ROOT / "potentials" / f"{name}.hvi").assumed()["spall", "voids"]) == {"sigma", "rate", "m", "phi_c"}


def test_table(capsys, tmp_path):
    assert cli.main(["material", *map(str, FILES), "--out", str(tmp_path / "t.csv")]) == 0
    out = capsys.readouterr().out.splitlines()
    assert len(out) == len(FILES) + 1 and out[0].split() == ["file", "eos", "strength", "damage", "spall", "assumed"]
    with open(tmp_path / "t.csv") as stream:
        assert list(csv.DictReader(stream)) == library.everything(ROOT / "potentials")
    assert cli.main(["material", *map(str, FILES), "--figure", "x"]) == 1 and "--figure draws one file" in capsys.readouterr().err


def test_table_of_the_documentation():
    """made from the files, and named in the page"""
    import materials

    rows = materials.rows(ROOT / "potentials")
    assert [row["file"] for row in rows] == [p.stem for p in FILES]
    table = materials.lines(ROOT / "potentials")
    cells = [line for line in table if re.match("   (\\* -|  -) ", line)]
    assert len(cells) == (len(FILES) + 1) * len(materials.COLUMNS) and "     - \\-" in cells  # a dash is text, no list
    assert any("lacks damage" in cell and "Assumed" in cell for cell in cells)
    assert ".. materials::" in (ROOT / "doc" / "src" / "Howto_materials.rst").read_text()


def test_sets_of_a_law():
    """made from the files: numbers in SI, what is assumed without its unit"""
    import materials

    text = "\n".join(materials.sets(ROOT / "potentials", "spall", "voids"))
    assert "   * - Al5083\\-H116\n     - 8.4e8\n     - 19000\n     - 0.2\n     - 0.0596\n     - m: not from [W14]\n" in text
    assert text.count("   * - ") == 1 + sum(("spall", "voids") in library.read(path).sections for path in FILES)
    page = (ROOT / "doc" / "src" / "Howto_materials.rst").read_text()
    assert ".. sets:: spall voids" in page and ".. sets:: eos tillotson" in page


def test_tables_of_laws():
    """each law with keys has its table in the page, made of the code; keys that are not those of the law are found"""
    import materials

    text = (ROOT / "doc" / "src" / "Howto_laws.rst").read_text()
    blocks = {(kind, law): body.splitlines() for kind, law, body in re.findall(r"^\.\. parameters:: ([\w-]+) ([\w-]+)\n\n((?:   .*\n)+)", text, re.M)}
    assert set(blocks) == {section for section, keys in library.LAWS.items() if keys}
    for section, content in blocks.items():
        table = materials.parameters(*section, content)
        assert len(table) == 4 + 5 * (len(library.LAWS[section]) + 1), section
    table = materials.parameters("spall", "limit", blocks["spall", "limit"])
    assert table[-5:] == ["   * - *sigma_p*", "     - tension that the material bears", "     - Pa", "     - > 0", "     - required"]
    with pytest.raises(ValueError, match="spall limit has the keys sigma_p, not sigma"):
        materials.parameters("spall", "limit", ["sigma tension"])


# ---------------------------------------------------------------------- curves
POINT = """units {units}
atom_style sph
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 5 5 5
mass 1 {rho0:.17g}
pair_style hvi/sph cubic
pair_coeff 1 1 file {file} h 1.2
neighbor 0.3 bin
fix sph all hvi/sph
compute a all hvi/atom p T
compute p all reduce sum c_a[1]
compute T all reduce sum c_a[2]
thermo_style custom step c_p {T}
thermo_modify format float %.17g
"""


def states(lmp, file, units, rho0, points, heat):
    """(p, T) of LAMMPS in states (rho, e)"""
    text = POINT.format(units=units, rho0=rho0, file=file, T="c_T" if heat else "")
    if not heat:
        text = text.replace("hvi/atom p T", "hvi/atom p").replace("c_a[1]", "c_a").replace("compute T all reduce sum c_a[2]\n", "")
    for rho, e in points:
        text += f"set group all sph/rho {rho:.17g} sph/e {rho0 * e:.17g}\nrun 0\n"
    runs = lmp(text).runs
    return [run["c_p"][0] for run in runs], [run["c_T"][0] for run in runs] if heat else None


@pytest.mark.parametrize("metal, within", [pytest.param("Al6061-T6", 0.004, marks=pytest.mark.long), ("Al2024-T3", None)])
def test_what_voids_bear(capsys, metal, within):
    """stretched at a constant rate: against the equations of tests/reference by SciPy; and a sigma that bears the strength that was measured"""
    one = library.read(ROOT / "potentials" / f"{metal}.hvi")
    v = one.in_si(("spall", "voids"))
    rate = np.array([1e4, 1e5, 1e7])
    if within:
        assert curves.borne(one, rate) == pytest.approx([voids.law(v, q)[0] for q in rate], rel=within)
    sigma = curves.sigma_for(one, 1.1e9, 3e5)
    assert curves.borne(one, 3e5, sigma) == pytest.approx(1.1e9, rel=1e-4) and sigma != pytest.approx(1.1e9 * (v["rate"] / 3e5) ** v["m"], rel=0.02)
    cli.main(["material", str(one.path)])
    said = re.search(r"stretched at 100000 1/s: bears (\S+) Pa, (\S+) of sigma; .* takes a sigma of (\S+) Pa", capsys.readouterr().out)
    assert [float(x) for x in said.groups()] == pytest.approx([float(curves.borne(one, 1e5)), float(curves.borne(one, 1e5)) / v["sigma"], curves.sigma_for(one, v["sigma"], 1e5)], rel=1e-3)


OTHERS = {"tait": "eos tait\nrho0 1000\nc0 1500\n",
          "polynomial": "eos polynomial\nrho0 2700\nA1 76e9\nA2 1.1e11\nA3 4e10\nB0 2\nB1 1.5\nB2 -0.3\nT2 1e10\ncp 900\n"}


@pytest.mark.parametrize("path", [*FILES, *OTHERS], ids=lambda p: getattr(p, "stem", p))
def test_shocks_isentropes_and_temperatures(lmp, written, path):
    """pressure and temperature of LAMMPS in the states of the curves, and off them in expansion; the shock's own equation"""
    file = path if path in FILES else ROOT.joinpath(os.getcwd(), written("# UNITS: si\n" + OTHERS[path]))
    one = library.read(file)
    eos = curves.Eos(one)
    up = np.array([0.05, 0.3, 0.7, 1.2]) * eos.c0
    Us, p, rho, e = eos.hugoniot(up)
    ps, es, Ts = eos.isentrope(1 - eos.rho0 / rho)
    assert p == pytest.approx(eos.rho0 * Us * up) and np.all(np.diff(Us) > 0)
    thin = eos.rho0 * np.array([0.5, 0.97, 0.97]), eos.c0**2 * np.array([0.5, 0.01, 0.2])
    points = [*zip(rho, e), *zip(rho, es), *zip(*thin)]
    got_p, got_T = states(lmp, file, one.units, eos.rho0, points, eos.cp > 0)
    want = np.concatenate([p, ps, eos.pressure(*thin)])
    assert got_p == pytest.approx(want, rel=1e-8, abs=1e-9 * eos.rho0 * eos.c0**2)
    if eos.cp:
        assert got_T == pytest.approx(np.concatenate([eos.temperature(rho, e), Ts, 300 + (eos.T0 - 300) + thin[1] / eos.cp]), rel=1e-5)


BLOCK = """units si
boundary f f f
atom_style sph
lattice sc 1e-3
region box block -3 8 -3 8 -3 8
create_box 1 box
region cube block 0 5 0 5 0 5
create_atoms 1 region cube
mass 1 {m:.17g}
set group all sph/rho {rho0:.17g} sph/e {E:.17g}
pair_style hvi/sph cubic viscosity 0 0
pair_coeff 1 1 file {file} h 1.2e-3
neighbor 2e-4 bin
variable vx atom {rate}*(y+0.3*z)
velocity all set v_vx 0 0
fix sph all hvi/sph
fix jc all hvi/johnson-cook strength {law} damage no spall none
fix hold all setforce 0 0 0
compute S all hvi/atom p T eps epsdot vm
compute R all property/atom rho
dump d all custom 1 out id c_R c_S[*]
dump_modify d format float %.17g sort id
timestep 1e-6
run 1
"""


@pytest.mark.parametrize("path, law", [(p, law) for p in FILES for law in library.read(p).laws("strength")] + [(None, law) for law in EXTRA],
                         ids=lambda x: getattr(x, "stem", x or "-"))
def test_yield_stress(lmp, written, tmp_path, path, law):
    """von Mises's stress of what LAMMPS has sheared by 5 %, at the strain, rate, temperature and pressure it reports"""
    file = path or tmp_path / written("# UNITS: si\n" + EOS + EXTRA[law])
    one = library.read(file)
    eos = curves.Eos(one)
    m = eos.rho0 * 1e-9
    lmp(BLOCK.format(m=m, rho0=eos.rho0, E=m * eos.cp * 150, file=file, rate=5e4, law=law))
    first, last = (f.table for f in frames(tmp_path / "out"))
    k = np.arange(len(last)).reshape(6, 6, 6)[2:4, 2:4, 2:4].ravel()
    (p, T), (rho, eps, rate, vm) = first[k][:, [2, 3]].T, last[k][:, [1, 4, 5, 6]].T
    assert eps.min() > 0.005
    assert vm == pytest.approx(curves.yield_stress(law, one.in_si(("strength", law)), eps, rate, T, p, rho / eos.rho0), rel=1e-7)


def test_hugoniots_end():
    """lead's law ends where cold matter would pull, behind shocks of 5.5 km/s: beyond there is none"""
    eos = curves.Eos(library.read(ROOT / "potentials" / "Pb.hvi"))
    Us = eos.hugoniot([500.0, 2400.0, 5400.0, 5600.0])[0]
    eta = np.array([500.0, 2400.0, 5400.0]) / Us[:3]
    assert Us[:3] == pytest.approx(2006 / (1 - 1.429 * eta - 0.8506 * eta**2 + 1.64 * eta**3)) and np.all(np.diff(Us[:3]) > 0) and np.isnan(Us[3])


@pytest.mark.parametrize("eos", ["eos gruneisen\nrho0 2700\nC 5200\nS1 0\ng0 2\ncp 900\n", "eos gruneisen\nrho0 8930\nC 3940\nS1 1.0\ng0 2\ncp 385\nS2 -1.1\n"])
def test_curves_end_where_the_hugoniot_does(written, capsys, eos):
    """beyond there is nan, of the temperature too"""
    name = written("# UNITS: si\n" + eos)
    assert cli.main(["material", name, "--out", "h.csv", "--figure", "h.png"]) == 0
    with open("h.csv") as stream:
        rows = [[float(row[key]) for key in ("p_GPa", "T_K")] for row in csv.DictReader(stream)]
    known = np.isfinite(rows)
    assert np.all(known[:3]) and not np.any(known[-1]) and np.all(known[:, 0] == known[:, 1]) and rows[2][1] > rows[0][1] > 300


def test_nothing_bears_shear_above_melting():
    one = library.read(ROOT / "potentials" / "Al6061-T6.hvi")
    for law, melt in (("johnson-cook", 775), ("steinberg-guinan", 1220)):
        v = one.in_si(("strength", law))
        Y = curves.yield_stress(law, v, 0.1, 1e4, np.array([melt - 1, melt, melt + 100]))
        assert Y[0] > 0 and list(Y[1:]) == [0, 0], law


def test_spall_strength(written):
    """the four laws: a constant, the power law, what stress that grows steadily uses up, Grady's limit"""
    text = (HEAD + EOS + "strength perfect\n  G 27e9\n  Y 3e8\nspall limit\n  sigma_p 1.2e9\nspall voids\n  sigma 1.2e9\n  rate 1e5\n  m 0.2\n  phi_c 0.1\n"
            "spall tuler-butcher\n  sigma_0 4e8\n  lambda 2\n  K 2e13\nspall grady\n  eps_c 0.15\n")
    one = library.read(written(text))
    rate = np.array([1e4, 1e5, 1e6])
    assert list(curves.spall_strength(one, "limit", rate)) == [1.2e9] * 3
    assert curves.spall_strength(one, "voids", rate) == pytest.approx(1.2e9 * np.array([10**-0.2, 1, 10**0.2]))
    assert curves.spall_strength(one, "grady", rate) == pytest.approx(np.sqrt(2 * 2700 * 5200**2 * 3e8 * 0.15))
    for epsdot, strength in zip(rate, curves.spall_strength(one, "tuler-butcher", rate)):
        stress = 2700 * 5200**2 * epsdot * np.linspace(0, 1e-9 * 1e6 / epsdot * 1e3, 400001)
        used = np.cumsum(np.maximum(stress - 4e8, 0) ** 2) * (stress[1] / (2700 * 5200**2 * epsdot)) / 2e13
        assert stress[np.searchsorted(used, 1)] == pytest.approx(strength, rel=1e-3)
    no_strength = library.read(written(HEAD + EOS + "spall grady\n  eps_c 0.15\n"))
    with pytest.raises(HVIError, match="spall grady needs a section strength"):
        curves.spall_strength(no_strength, "grady", rate)


def test_laws_without_curves(written, tmp_path, capsys):
    """a gas and a table are read; what cannot be drawn is said"""
    (tmp_path / "none.table").write_text("nothing\n")
    for text, law in (("eos idealgas\ngamma 1.4\n", "idealgas"), ("eos table\nfile none.table\n", "table")):
        name = written("# UNITS: si\n# A thing\n" + text)
        assert cli.main(["material", name, "--figure", "t.png"]) == 0, law
        assert f"no curves of eos {law}" in capsys.readouterr().out and os.path.getsize("t.png") > 5000
        with pytest.raises(HVIError, match=f"no curves of eos {law}"):
            curves.Eos(library.read(name))
