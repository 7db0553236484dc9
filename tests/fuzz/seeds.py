"""Where the fuzzers begin: the files of the package, a small valid file of each kind, and the words of their languages."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

from hvi.material import library  # noqa: E402
from hvi.shield import calibration, case, projectile, shots  # noqa: E402

DUMP = """ITEM: UNITS
si
ITEM: TIME
1.5e-06
ITEM: TIMESTEP
10
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp ff ff
0 1
0 1
-1 1
ITEM: ATOMS id type x y z vx vy vz mass mirror_x_lo time_si c_p[1]
2 1 0.5 0.25 0 1 2 3 0.1 0 1.5e-06 7
1 2 0.125 0.5 0 1 2 3 0.1 0 1.5e-06 -7e9
3 1 0.75 0.5 0.5 1 2 3 0.1 0 1.5e-06 nan
ITEM: TIMESTEP
20
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS xy xz yz pp ff ff
0 1 0.1
0 1 0.2
-1 1 0
ITEM: ATOMS id type xs ys zs ix iy iz
1 2 0.125 0.5 0 0 1 -1
"""
GENERAL = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS abc origin pp pp pp
1 0 0 0
0.5 1 0 0
0 0 1 0
ITEM: ATOMS id type xu yu zu element
1 1 0 0 0 Al
2 1 0.5 0.5 0.5 Cu
"""
LOCAL = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ENTRIES
2
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ENTRIES index c_B[1] c_B[2]
1 1 2
2 2 3
"""
DATA = """LAMMPS data file: timestep = 7, units = si, mirror x 0 lo mirror y 0 lo

3 atoms
2 atom types
2 bonds
1 bond types

0 1 xlo xhi
0 1 ylo yhi
-1 1 zlo zhi
0.1 0 0 xy xz yz

Masses

1 0.25
2 0.5

Atoms # sph

1 1 2700 0 0 0.5 0.5 0.5 0 0 0
2 2 2700 0 0 0.25 0.5 0.5 0 0 0
3 1 2700 0 0 0.5 0.75 0.5 0 0 1

Velocities

1 0 0 0
2 0 0 0
3 0 0 0

Bonds

1 1 1 2
2 1 2 3
"""
BOND = DATA.replace("# sph", "# bond").replace(" 1 2700 0 0 ", " 1 1 ").replace(" 2 2700 0 0 ", " 1 2 ")
STL = """solid tetrahedron
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 1 0
vertex 1 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 1
vertex 0 1 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 0 0
vertex 0 1 0
vertex 0 0 1
endloop
endfacet
endsolid
"""
CASES = ["""projectile: {shape: cylinder, diameter_mm: 4, length_mm: 2, pitch_deg: 10, material: Al2017-T4}
speed_km_s: 6.7
angle_deg: 30
walls:
- {thickness_mm: 1, material: Al6061-T6, radius_mm: 30, spacings_mm: [0.4, 0.3]}
- {thickness_mm: 2, gap_mm: 30, material: Al2024-T3, method: hybrid, spacings_mm: [0.5, 0.3334], core_mm: 10, hold_mm: 12, yield_ksi: 47, brinell: 120, sound_km_s: 5.1}
spacings_mm: [0.4, 0.3]
shifts: [0, 0.5]
not_modelled: [MLI]
method: sph
settings: {quarter: 'no', tstop: 40, kernel: gauss, eta: 1.3, pair: dissipation riemann, solid: damage yes spall voids, fem: strain 0.3, C: 0.5, skin: 0.5, back: 30, edge: absorb, rim: 6, film: 1, layers: [3, 6]}
""", """projectile: &p {shape: hollow sphere, diameter_mm: 4, thickness_mm: 1, material: Al2017-T4}
speed_km_s: 6.7
walls: [&w {thickness_mm: 1, material: Al6061-T6}, {gap_mm: 30, thickness_mm: 1, material: Al6061-T6}]
spacings_mm: &s [0.4, 0.3]
""", """projectile: {shape: file, file: [body.stl], material: Al2017-T4}
speed_km_s: 6.7
walls: [{thickness_mm: 1, material: Al6061-T6}]
spacings_mm: [0.1, 0.08]
""", """projectile: {shape: cube, side_mm: 3, material: Al2017-T4}
speed_km_s: 2
walls: [{thickness_mm: 1, material: Al6061-T6}, {thickness_mm: 1, gap_mm: 10, material: Al6061-T6, method: tied}]
spacings_mm: [0.4, 0.3]
"""]
STUDY = """input: in.test
variables: {b: 1, d: [2, 3]}
ranks: 1
timeout: 60
grid:
  a: [1, 2.5, x]
  pair: [{b: 1, c: 2}, {b: 2, c: 3}]
remove: [frame.*.dump]
full:
  grid: {a: [1]}
"""
_CORNERS = [(x, y, z) for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)]
_HEXES = [(0, 4, 6, 2, 1, 5, 7, 3), (4, 8, 10, 6, 5, 9, 11, 7)]
ABAQUS = ("*NODE\n" + "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(_CORNERS))
          + "*ELEMENT, TYPE=C3D8\n" + "".join(f"{k + 1}, {', '.join(str(n + 1) for n in nodes)}\n" for k, nodes in enumerate(_HEXES)) + "*ELSET, ELSET=STRUCK\n1\n")
LEGACY_VTK = ("# vtk DataFile Version 4.2\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n" + "".join(f"{x} {y} {z}\n" for x, y, z in _CORNERS)
              + "\nCELLS 2 18\n" + "".join(f"8 {' '.join(map(str, nodes))}\n" for nodes in _HEXES) + "\nCELL_TYPES 2\n12\n12\n")
INPUT = "variable a index 1\nvariable b index 1\nvariable c index 1\nvariable d index 1 2\n"


def table(bicubic=True, log=True, T=True):
    """of p = 4 (rho - 1) + 0.3 rho e"""
    rho, e = [0.5, 0.75, 1.0, 1.25, 1.5], [-1, 0, 1, 2, 4]
    block = "".join(f"{r} " + " ".join(f"{4 * (r - 1) + 0.3 * r * x:.10g}" for x in e) + "\n" for r in rho)
    head = f"# DATE: 2026-01-01 UNITS: si\nrho0 1\ndensity {'log' if log else 'linear'}\ninterpolation {'bicubic' if bicubic else 'bilinear'}\n\n"
    text = f"{head}pressure 5 5\ne {' '.join(map(str, e))}\n{block}"
    return text + (f"temperature 5 5\ne {' '.join(map(str, e))}\n" + "".join(f"{r} 300 301 302 303 304\n" for r in rho) if T else "")


def of_laws():
    """a material of each law alone, all its keys with a number that it may have"""
    eos = "eos gruneisen\nrho0 2700\nC 5300\nS1 1.4\ng0 2\ncp 885\n"
    for (kind, law), keys in library.LAWS.items():
        own = {"Ecv": 8, "Tref": 300, "Tm": 900, "Tm0": 900}  # what must be above another
        values = "".join(f"{key} {own.get(key, 0.5 if 'in' in bounds else 2) if preset is None else preset}\n" for key, _, bounds, preset in keys)
        yield f"# UNITS: si\n{'' if kind == 'eos' else eos}{kind} {law}\n{values}{'file x.table' if law == 'table' else ''}\n"


def of(kind):
    """texts of a kind, bytes each"""
    if kind == "material":
        found = [path.read_text() for path in sorted((ROOT / "potentials").glob("*.hvi"))]
        found += [*of_laws(), "# UNITS: si\neos table\nfile x.table\n---\n" + table()]
    elif kind == "table":
        found = [table(a, b, c) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
    elif kind == "case":
        found = CASES + [path.read_text() for path in sorted((ROOT / "examples" / "whipple-shield" / "cases").glob("*.yaml"))]
    elif kind == "dump":
        found = [DUMP, GENERAL, LOCAL, DUMP + DUMP]
    elif kind == "data":
        found = [DATA, BOND, DATA.replace("# sph", "")]
    elif kind == "surface":
        found = [STL]
    elif kind == "abaqus":
        found = [ABAQUS]
    elif kind == "vtk":
        found = [LEGACY_VTK]
    elif kind == "shots":
        lists = sorted((ROOT / "examples" / "whipple-shield" / "shots").glob("shots.csv"))
        found = [",".join(shots.COLUMNS) + "\nA1,2017-T4,6061-T6,2024-T3,P,0.3,0.1,10,0.2,0,6.5,47\n"] + ["\n".join(path.read_text().splitlines()[:12]) + "\n" for path in lists]
    elif kind == "records":
        found = [calibration.FILE.read_text()]
    elif kind == "study":
        found = [STUDY] + [re.sub(r"(input|continue): .*", r"\1: in.test", path.read_text()) for path in sorted((ROOT / "examples").glob("*/studies/*.yaml"))]
    return [text.encode() for text in found]


KINDS = ("material", "table", "case", "dump", "data", "surface", "abaqus", "vtk", "shots", "records", "study")


def words(kind):
    """of the language of a kind, bytes each"""
    found = set()
    if kind in ("material", "table"):
        found |= {word for law, keys in library.LAWS.items() for word in (*law, *(key[0] for key in keys))} | {"file", "---", "# UNITS: ", "DATE:", "lj", "cgs", "micro"}
    if kind in ("case", "study"):
        found |= {"2001-13-01", "0o9", "1:99:99", "!!binary x", "!!set {a}", "*a", "&a ", "? [*a, *a] : ", "!!timestamp x", "<<: ", "~"}
    if kind == "case":
        found |= {f"{key}: " for keys in (case.KEYS, projectile.KEYS, case.WALL, case.SETTINGS) for key in keys}
        found |= {*projectile.SHAPES, *case.METHODS, "*w", "&w ", "<<: *w", "[", "]", "{", "}", "? ", "!!python/object:os.system ", "- ", "|\n", "null", ".nan"}
    for text in of(kind):
        found |= {word for word in re.findall(r"[^\s,:]+", text.decode()) if not re.fullmatch(r"[-+.\deE]+", word) and len(word) < 30}
    return [word.encode() for word in sorted(found)]


NUMBERS = [b"0", b"-0", b"-1", b"1", b"2", b"1e-320", b"1e-30", b"1e30", b"1e154", b"1e308", b"-1e308", b"1e309", b"nan", b"inf", b"-inf", b"2147483648", b"4294967297",
           b"9223372036854775808", b"1e6", b"0x10", b"1.5", b"1_000", b"0.1e", b"--1", b"1e-7", b"99999999999999999999999", b"\xd9\xa3"]


def dictionary(kind):
    """text of a dictionary of libFuzzer"""
    return "".join('"' + "".join(f"\\x{byte:02x}" for byte in word) + '"\n' for word in words(kind) + NUMBERS)
