"""The documentation keeps up with the code: a page per style, inputs that run. Links: test_links.py; commands: test_page_commands.py, test_readmes.py."""

import re
import shlex

import pytest
from hvi import cli


@pytest.fixture(scope="module")
def markdown(root):
    return [p for p in sorted(root.glob("*.md")) + sorted(root.glob("examples/**/README.md"))]


def test_every_style_has_its_page(root):
    import stylepages

    assert list(stylepages.problems(root / "doc" / "src", root / "src" / "USER-HVI")) == []


def test_plain_ascii(root, markdown):
    for p in [*markdown, root / "CITATION.cff"]:
        assert p.read_bytes().isascii(), p


def test_index_of_a_letter_with_an_accent_is_beside_it(root):
    """in MathML as Docutils writes it; limits of sums stay where they are"""
    from accents import index_beside

    def formula(text):
        return f'<math xmlns="http://www.w3.org/1998/Math/MathML">{text}</math>'

    dot = '<mo stretchy="false">\u02d9</mo>'
    energy = f"<munderover><mi>e</mi><mi>i</mi>{dot}</munderover>"
    want = f"<msub><mover><mi>e</mi>{dot}</mover><mi>i</mi></msub>"
    assert index_beside(formula(f"<mi>m</mi>{energy}<mo>&lt;</mo>")) == formula(f"<mi>m</mi>{want}<mo>&lt;</mo>")
    assert index_beside(formula(f"<mfrac>{energy}<mrow>{energy}{energy}</mrow></mfrac>")) == formula(f"<mfrac>{want}<mrow>{want}{want}</mrow></mfrac>")
    sums = "<munderover><mo>\u2211</mo><mi>j</mi><mi>N</mi></munderover>"
    assert index_beside(formula(sums)) == formula(sums)
    assert index_beside(formula("<mi>ln</mi><mo>&ApplyFunction;</mo>")) == formula("<mi>ln</mi><mo>\u2061</mo>")


def inputs(path, start, end):
    """texts between two marks, taken back to the margin"""
    found = re.findall(start + r"(.*?)" + end, path.read_text(), re.S)
    return [re.sub(r"^   ", "", text, flags=re.M) for text in found]


def test_dem_input_runs(lmp, root):
    (text,) = inputs(root / "doc/src/Howto_dem.rst", r"(?=   # a ball)", r"\n(?=\S)")
    thermo = lmp(text).thermo
    assert thermo["Bonds"][-1] < 0.9 * thermo["Bonds"][0]  # it breaks
    assert abs(thermo["c_book[9]"] - 1).max() < 1e-4  # and the books are kept


def test_readme_input_runs(lmp, root):
    """until the sphere is through wall 1: its energy is on its way to wall 2, less what wall 1 has taken up"""
    (text,) = inputs(root / "README.md", r"```\n(?=units)", r"```")
    assert text.count("run             800") == 1
    r = lmp(text.replace("run             800", "thermo 20\nrun 160"), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    t = r.thermo
    assert all("Al2017-T4.hvi (type 1) has no section damage" in w for w in r.warnings) and len(r.warnings) == 1 and t["Time"][-1] > 2e-6
    energy = 0.5 * 9.34938e-5 / 4 * 6500**2  # of a quarter of the sphere
    assert t["c_walls[2][2]"][0] == pytest.approx(energy, rel=1e-5) and 0.6 * energy < t["c_walls[2][2]"][-1] < energy
    assert abs(t["c_book[9]"][-1] - 1) < 1e-6 and (t["c_walls[2][36]"] == 0).all()


def test_sph_input_runs(lmp, root):
    """two aluminum plates: u = V/2, Us = c0 + s u, p = rho0 Us u"""
    (text,) = inputs(root / "doc/src/Howto_sph.rst", r"(?=   # two aluminum plates)", r"\n(?=\S)")
    thermo = lmp(text).thermo
    assert thermo["c_mean"][-1] == pytest.approx(2703 * (5240 + 1.4 * 1000) * 1000, rel=0.02)
    assert abs(thermo["c_book[9]"] - 1).max() < 1e-4


def test_fem_input_runs(lmp, root):
    """its mesh by its command; what the page says of it"""
    (mesh,) = inputs(root / "doc/src/Howto_fem.rst", r"(?=   build/hvi mesh wall)", r"\n(?=\S)")
    (text,) = inputs(root / "doc/src/Howto_fem.rst", r"(?=   # a ball of 3 mm)", r"\n(?=\S)")
    words = shlex.split(mesh.replace("\\\n", ""))
    words[words.index("--material") + 1] = str(root / words[-1])
    assert cli.main(words[1:]) in (0, None)
    run = lmp(text, env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert run.warnings == []
    thermo = run.thermo
    assert thermo["f_wall"][0] == 1018 and 35 < thermo["f_wall[1]"][-1] < 55
    assert thermo["c_hole[1]"][-1] == pytest.approx(6.2e-3, abs=0.1e-3)
    assert thermo["f_wall[7]"][-1] < 2e-3 * thermo["c_book[1]"][0] and thermo["f_wall[9]"][-1] == 0
    assert abs(thermo["c_book[9]"][-1] - 1) < 1e-6


def test_version_is_the_same_everywhere(root):
    version = re.search(r'HVI_VERSION\[\] = "([^"]+)"', (root / "src" / "USER-HVI" / "hvi_version.h").read_text()).group(1)
    assert f"\nversion: {version}\n" in (root / "CITATION.cff").read_text()
    assert f"## [{version}]" in (root / "CHANGELOG.md").read_text()
    assert f"(version {version})" in (root / "README.md").read_text()
    written = [(p.name, v) for p in root.glob("examples/*/in.*") for v in re.findall(r"\bpackage_version: ([\d.]+)", p.read_text())]
    assert len(written) >= 5 and {v for _, v in written} == {version}, written
