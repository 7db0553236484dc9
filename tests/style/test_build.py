"""The two ways to use the package: built in, and as a plugin of a stock LAMMPS. Both know the same styles."""

import re

import pytest


@pytest.fixture(scope="module")
def styles(root):
    """(kind, name) of every style macro in our headers"""
    found = set()
    for header in (root / "src" / "USER-HVI").glob("*.h"):
        for kind, name in re.findall(r"^(Pair|Bond|Fix|Compute|Region|Command)Style\(([^,]+),", header.read_text(), re.M):
            found.add((kind.lower(), name))
    assert len(found) >= 5
    return found


def known(text):
    """styles that 'info styles' names, as (kind, name)"""
    found, kind = set(), None
    for line in text.splitlines():
        title = re.match(r"(\w+) styles\b.*:", line)
        if title:
            kind = title.group(1).lower()
        elif kind:
            found |= {(kind, word) for word in line.split() if word.startswith("hvi")}
    return found


def test_builtin_knows_all_styles_also_after_clear(lmp, styles):
    r = lmp("info styles all\nprint BETWEEN\nclear\ninfo styles all\n")
    before, after = r.stdout.split("BETWEEN", 1)
    assert known(before) == styles
    assert known(after) == styles


def test_builtin_names_the_package(lmp):
    assert "USER-HVI" in lmp("", extra=["-h"]).stdout


def test_stock_knows_none(lmp, lmp_stock):
    assert known(lmp("info styles all\n", exe=lmp_stock).stdout) == set()


def test_plugin_brings_all_styles(lmp, lmp_stock, plugin, styles):
    r = lmp(f"plugin load {plugin}\nplugin list\ninfo styles all\n", exe=lmp_stock)
    listed = set(re.findall(r"^ *\d+: (\w+) style plugin (\S+)", r.stdout, re.M))
    assert listed == styles
    assert known(r.stdout) == styles
    assert not r.warnings


def test_plugin_path(lmp, lmp_stock, plugin, styles):
    """LAMMPS loads *plugin.so by itself, again after clear"""
    r = lmp("clear\ninfo styles all\n", exe=lmp_stock, env={"LAMMPS_PLUGIN_PATH": str(plugin.parent)})
    assert known(r.stdout) == styles


def test_plugin_on_several_ranks(lmp, lmp_stock, plugin, styles):
    r = lmp(f"plugin load {plugin}\nplugin list\n", exe=lmp_stock, nranks=2)
    assert len(re.findall(r"style plugin hvi", r.stdout)) == len(styles)


@pytest.mark.parametrize("package", "SPH MACHDYN BPM PERI MOLECULE GRANULAR PLUGIN EXTRA-FIX".split())
def test_stock_packages(lmp, package):
    assert re.search(rf"\b{package}\b", lmp("", extra=["-h"]).stdout)


def test_picture(lmp):
    """dump image writes PNG without any other program"""
    r = lmp("region b block 0 1 0 1 0 1\ncreate_box 1 b\ncreate_atoms 1 single 0.5 0.5 0.5\nmass 1 1\n"
            "pair_style zero 0.3\npair_coeff * *\nwrite_dump all image x.png type type\n")
    assert (r.cwd / "x.png").read_bytes()[1:4] == b"PNG"


def test_citations(lmp, tmp_path, root):
    """what -cite lists: the package once, and the paper of each method that the input asks for"""
    sph = "units si\natom_style sph\nregion box block 0 1 0 1 0 1\ncreate_box 1 box\npair_style hvi/sph cubic{}\n"
    solid = sph.format(" dissipation riemann") + f"pair_coeff 1 1 file {root}/potentials/Al6061-T6.hvi spacing 0.1\nfix 1 all hvi/sph\n"
    dem = "units si\natom_style bond\nregion box block 0 1 0 1 0 1\ncreate_box 1 box bond/types 1\npair_style hvi/contact\nbond_style hvi/spring\n"
    again = sph.format(" interface 0.3") + "mass 1 1\npair_coeff 1 1 eos tait 1000 1480 7 h 0.1\ncreate_atoms 1 single 0.5 0.5 0.5\nwrite_restart half\n"
    lmp(again)
    for text, papers in (("read_restart half\n", ["Zisis2013"]), (sph.format(""), []), (sph.format(" interface 0.3"), ["Zisis2013"]),
                         (solid, []), (solid + "fix 2 all hvi/johnson-cook damage yes\n", ["JohnsonCook1985"]), (dem, ["Watson2017"]), (dem + "clear\n" + sph.format(""), ["Watson2017"])):
        lmp(text, extra=["-cite", "cite.bib"])
        keys = re.findall(r"^@\w+\{(.*?),$", (tmp_path / "cite.bib").read_text(), re.M)
        assert sorted(key for key in keys if key in ("lammps-hvi", "Watson2017", "Zisis2013", "JohnsonCook1985")) == sorted(["lammps-hvi", *papers]), text
