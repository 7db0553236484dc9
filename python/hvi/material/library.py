# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Material files (.hvi), read by the rules of doc/src/Howto_materials.rst: what they have, what they lack, what is assumed.

Needs neither NumPy nor LAMMPS, as the documentation's table is made with it. Curves are in curves.py.
"""

import dataclasses
import functools
import math
import os
import pathlib
import re
import warnings
from typing import Optional

from .. import texts
from ..errors import HVIError, HVIWarning, reading
from ..places import POTENTIALS

# keys of each law as its table in src/USER-HVI has them: (key, quantity, range, value if it is not given, None: it must be);
# tests/python/test_material.py holds them to the headers
POSITIVE, FROM_0, ANY, FRACTION, PART, ABOVE_1 = "> 0", ">= 0", "", "in [0, 1]", "in (0, 1]", "> 1"
HOLDS = {POSITIVE: lambda x: x > 0, FROM_0: lambda x: x >= 0, ANY: lambda x: True, FRACTION: lambda x: 0 <= x <= 1,
         PART: lambda x: 0 < x <= 1, ABOVE_1: lambda x: x > 1}
# exponents of mass, length, time, temperature
DIMENSIONS = {"number": (0, 0, 0, 0), "length": (0, 1, 0, 0), "density": (1, -3, 0, 0), "speed": (0, 1, -1, 0), "pressure": (1, -1, -2, 0),
              "per_pressure": (-1, 1, 2, 0), "specific_energy": (0, 2, -2, 0), "heat_capacity": (0, 2, -2, -1),
              "temperature": (0, 0, 0, 1), "per_temperature": (0, 0, 0, -1), "rate": (0, 0, -1, 0), "impulse": None}
DECADES = {"si": (0, 0, 0), "cgs": (-3, -2, 0), "micro": (-15, -6, -6)}  # units of mass, length and time in kg, m, s
UNITS = (*DECADES, "lj")


def _keys(text):
    """keys from 'name quantity range [value]; ...'"""
    found = []
    for item in text.split(";"):
        key, quantity, bounds, *value = item.split()
        bounds = {"+": POSITIVE, "0+": FROM_0, "any": ANY, "fraction": FRACTION, "part": PART, "1+": ABOVE_1}[bounds]
        found.append((key, quantity, bounds, float(value[0]) if value else None))
    return tuple(found)


HEAT = "cp heat_capacity 0+ 0"
T0 = "T0 temperature + 300"
LAWS = {
    ("eos", "linear"): _keys("rho0 density +; K pressure +"),
    ("eos", "tait"): _keys("rho0 density +; c0 speed +; gamma number + 7"),
    ("eos", "idealgas"): _keys("gamma number 1+; cv heat_capacity 0+ 0"),
    ("eos", "gruneisen"): _keys(f"rho0 density +; C speed +; S1 number 0+; g0 number 0+; a number any 0; {HEAT}; S2 number any 0; S3 number any 0; {T0}"),
    ("eos", "mie-gruneisen"): _keys(f"rho0 density +; C speed +; S1 number 0+; g0 number 0+; {HEAT}; {T0}"),
    ("eos", "polynomial"): _keys("rho0 density +; A1 pressure +; A2 pressure any 0; A3 pressure any 0; B0 number 0+ 0; B1 number any 0; B2 number any 0; "
                                 f"T1 pressure 0+ 0; T2 pressure any 0; {HEAT}; {T0}"),
    ("eos", "tillotson"): _keys("rho0 density +; a number 0+; b number 0+; A pressure +; B pressure 0+; E0 specific_energy +; Eiv specific_energy 0+; "
                                f"Ecv specific_energy +; alpha number + 5; beta number + 5; {HEAT}; {T0}"),
    ("eos", "table"): (),
    ("strength", "johnson-cook"): _keys("G pressure +; A pressure +; B pressure 0+; n number 0+; C number 0+; m number +; epsdot0 rate + 1; "
                                        "Tref temperature +; Tm temperature +; D rate 0+ 0; p number + 1"),
    ("strength", "steinberg-guinan"): _keys("G0 pressure +; Y0 pressure +; Ymax pressure +; beta number 0+; n number 0+; A per_pressure 0+; "
                                            "B per_temperature 0+; Tm0 temperature +; g0 number 0+; a number 0+"),
    ("strength", "cowper-symonds"): _keys("G pressure +; Y0 pressure +; D rate +; p number +"),
    ("strength", "zerilli-armstrong"): _keys("G pressure +; C0 pressure +; C1 pressure 0+ 0; C2 pressure 0+ 0; C3 per_temperature 0+; "
                                             "C4 per_temperature 0+; C5 pressure 0+ 0; n number 0+ 0; epsdot0 rate + 1; Tm temperature +"),
    ("strength", "perfect"): _keys("G pressure +; Y pressure +"),
    ("strength", "none"): (),
    ("damage", "johnson-cook"): _keys("D1 number any; D2 number any; D3 number any; D4 number any; D5 number any; epsdot0 rate + 1; eps_min number + 1e-6; "
                                      "sigma_spall pressure 0+ 0; u_f length 0+ 0"),
    ("spall", "limit"): _keys("sigma_p pressure +"),
    ("spall", "voids"): _keys("sigma pressure +; rate rate +; m number part; phi_c number part; delta_c length 0+ 0"),
    ("spall", "tuler-butcher"): _keys("sigma_0 pressure 0+; lambda number +; K impulse +"),
    ("spall", "grady"): _keys("eps_c number +"),
    ("thermal", "work"): _keys("chi number fraction"),
}
STIFF = {"linear": "K", "polynomial": "A1", "tillotson": "A"}  # what is rho0 c0^2
KINDS = tuple(dict.fromkeys(kind for kind, _ in LAWS))
WANTED = KINDS[:4]  # eos, strength, damage, spall


@dataclasses.dataclass
class Material:
    path: pathlib.Path
    title: str = ""
    units: str = ""
    date: str = ""
    citation: str = ""
    sections: dict = dataclasses.field(default_factory=dict)  # {(kind, law): {key: value}}, presets filled in, units of the file
    notes: dict = dataclasses.field(default_factory=dict)  # {(kind, law): {key: comment}}
    why: dict = dataclasses.field(default_factory=dict)  # {kind: why there is none}
    table: Optional[str] = None  # file of eos table

    @property
    def name(self):
        return stem(self.path)

    def laws(self, kind):
        return [law for k, law in self.sections if k == kind]

    def lacks(self):
        """{kind: why, or None where the file does not say} of strength, damage and spall that are not there"""
        return {kind: self.why.get(kind) for kind in WANTED if not self.laws(kind)}

    def assumed(self):
        """{(kind, law): {key: what is assumed}}"""
        found = {section: {key: note for key, note in notes.items() if re.search(r"\bassumed\b", note)} for section, notes in self.notes.items()}
        return {section: keys for section, keys in found.items() if keys}

    def in_si(self, section):
        """values of a section in SI; those of a file in units lj as they are"""
        values = self.sections[section]
        if self.units == "lj":
            return dict(values)
        unit = DECADES[self.units]

        def factor(dimension):
            return 10.0 ** sum(n * decade for n, decade in zip(dimension, unit))

        found = {}
        for key, quantity, _, _ in LAWS[section]:
            # the impulse K is a pressure to the power of lambda, times time
            scale = factor(DIMENSIONS["pressure"]) ** values["lambda"] * 10.0 ** unit[2] if quantity == "impulse" else factor(DIMENSIONS[quantity])
            # values that were not given are in SI
            found[key] = values[key] * (scale if key in self.notes[section] else 1.0)
        return found


def potentials():
    """folders in which material files are looked for: those that the environment names, and that of this package"""
    given = [pathlib.Path(p) for p in os.environ.get("LAMMPS_POTENTIALS", "").split(os.pathsep) if p]
    return given if POTENTIALS in given else [*given, POTENTIALS]


def path_of(name):
    """of a material file by its name or path, None if there is none"""
    return next((path for path in (pathlib.Path(name), *(folder / name for folder in potentials())) if os.path.isfile(path)), None)  # is_file() raises for a long name


def of_case(name):
    """The file of a material as a Case has its name: a whole path, or a file of the folders of materials, whatever is in the working directory"""
    return next((path for path in (folder / name for folder in potentials()) if os.path.isfile(path)), pathlib.Path(name))


def text_of(name):
    """of a material file, by its name in a Case"""
    path = of_case(name)
    with reading(path):
        return path.read_text(errors="replace")


def nowhere():
    """the folders that were looked in, for messages"""
    given = os.environ.get("LAMMPS_POTENTIALS")
    return f"LAMMPS_POTENTIALS ({given or 'not set'}) or {POTENTIALS}"


def find(name, what="material"):
    """the same, which must be there"""
    path = path_of(name)
    if path is None:
        raise HVIError(f"cannot find {what} file {name}, neither here nor in {nowhere()}")
    return path


def stem(name):
    """of a material file, without folder and ending"""
    return pathlib.Path(name).name.removesuffix(".hvi")


def _words(text):
    """as split() of hvi_text.h: other blanks, like those of web pages, belong to words"""
    return re.findall(r"[^ \t\r\f\v]+", text)


def _number(word):
    """as C's strtod on decimal digits: no inf, nan or hexadecimal numbers; None: it is none"""
    try:
        return float(word) if re.fullmatch(r"[0-9+\-.eE]+", word) else None
    except ValueError:
        return None


class _Reader:
    def __init__(self, path):
        self.material, self.line, self.now, self.given = Material(path), 0, None, {}

    def wrong(self, text, line=None):
        line = self.line if line is None else line
        raise HVIError(f"{self.material.path}:{line}: " + (f"{self.now[0]} {self.now[1]}: " if self.now else "") + text)

    def head(self, comment):
        """a comment before the first section"""
        material, words = self.material, _words(comment)
        for word, value in zip(words, words[1:]):
            if word == "DATE:":
                material.date = value
            elif word == "UNITS:":
                if material.units:
                    self.wrong("UNITS: given twice")
                if value not in UNITS:
                    self.wrong(f"unknown UNITS: {value}; known are {', '.join(UNITS)}")
                material.units = value
        cited = re.search(r"CITATION:\s*(.*)", comment)
        material.citation = cited[1].strip() if cited else material.citation
        absent = re.match(r"No ((?:(?:strength|damage|spall)(?:, )?)+): (.+)", comment.strip())
        if absent:
            material.why.update(dict.fromkeys(absent[1].split(", "), absent[2]))
        elif not material.title and comment.strip() and "UNITS:" not in comment:
            material.title = comment.strip()

    def section(self, words):
        self.now = None
        material, kind = self.material, words[0]
        known = ", ".join(law for k, law in LAWS if k == kind)
        if not material.units:
            self.wrong("no UNITS: in the comments before the first section")
        if len(words) < 2:
            self.wrong(f"section {kind} names no law; known are {known}")
        now = kind, words[1]
        if now not in LAWS:
            self.wrong(f"unknown law {kind} {words[1]}; known are {known}")
        if len(words) > 2:
            self.wrong(f"{kind} {words[1]}: unexpected text {words[2]}")
        for old in material.sections:
            if old == now or old[0] == kind == "eos":
                self.wrong(f"second section {' '.join(now) if old == now else 'eos'}, the first is in line {self.given[old]['']}")
            if old[0] == kind == "strength" and "none" in (old[1], now[1]):
                self.wrong(f"{' '.join(now)} beside {' '.join(old)} in line {self.given[old]['']}")
        self.now = now
        material.sections[now], material.notes[now], self.given[now] = {}, {}, {"": self.line}

    def value(self, words, comment):
        key, now = words[0], self.now
        if now is None:
            self.wrong(f"expected a section ({', '.join(KINDS)}), found {key}")
        keys = {k: bounds for k, _, bounds, _ in LAWS[now]}
        if now == ("eos", "table"):
            keys = {"file": ANY}
        if not keys:
            self.wrong(f"takes no keys, but got {key}")
        if key not in keys:
            self.wrong(f"unknown key {key}; known are {' '.join(keys)}")
        if key in self.given[now]:
            self.wrong(f"key {key} given twice, first in line {self.given[now][key]}")
        if len(words) < 2:
            self.wrong(f"key {key} has no value")
        if len(words) > 2:
            self.wrong(f"{key}: unexpected text {words[2]} after the value")
        self.given[now][key], self.material.notes[now][key] = self.line, comment
        if now == ("eos", "table"):
            self.material.table = words[1]
            return
        x = _number(words[1])
        if x is None:
            self.wrong(f"{key}: {words[1]} is not a number")
        if not math.isfinite(x):
            self.wrong(f"{key} = {words[1]} is not a finite number")
        if not HOLDS[keys[key]](x):
            self.wrong(f"{key} = {x:g} must be {keys[key]}")
        self.material.sections[now][key] = x

    def finish(self):
        """presets, and what values have against each other"""
        material = self.material
        for self.now, values in material.sections.items():
            self.line = self.given[self.now][""]
            for key, quantity, _, preset in LAWS[self.now]:
                if key not in values and preset is None:
                    self.wrong(f"missing key {key}")
                if key not in values and material.units == "lj" and preset and quantity != "number":
                    self.wrong(f"missing key {key}, which has no default in units lj")
                values.setdefault(key, preset)
            if self.now == ("eos", "table") and not material.table:
                self.wrong("missing key file")
            if material.table:
                try:
                    find(material.table, "table")
                except HVIError as problem:
                    self.wrong(str(problem), self.given[self.now]["file"])
            law = self.now[1]
            if law == "tillotson" and not values["Ecv"] > values["Eiv"]:
                self.wrong(f"Ecv = {values['Ecv']:g} must be > Eiv = {values['Eiv']:g}")
            if self.now == ("strength", "johnson-cook") and not values["Tm"] > values["Tref"]:
                self.wrong("Tm must be above Tref")
            if law == "steinberg-guinan" and values["Ymax"] < values["Y0"]:
                self.wrong("Ymax must not be below Y0")
            for key, of in (("Tm0", "steinberg-guinan"), ("Tm", "zerilli-armstrong")):
                if law == of and not values[key] > 300:
                    self.wrong(f"{key} must be above 300 K")
        self.now = None
        if not material.laws("eos"):
            raise HVIError(f"{material.path}: no section eos")
        for kind in material.why:
            if material.laws(kind):
                raise HVIError(f"{material.path}: its head says 'No {kind}', but it has a section {kind}")
        return material


def read(name):
    """The Material of a file, or an HVIError that names file and line."""
    path = find(name)
    text = texts.data_of(path).decode("utf-8-sig", errors="replace")
    reader = _Reader(path)
    for reader.line, line in enumerate(text.split("\n"), 1):
        body, _, comment = line.partition("#")
        words = _words(body)
        if reader.now is None and not words:
            reader.head(comment)
        elif words and words[0] in KINDS:
            reader.section(words)
        elif words:
            reader.value(words, comment.strip())
    return reader.finish()


# ---------------------------------------------------------------------- what a file is good for
SOFTENS = ("johnson-cook", "steinberg-guinan", "zerilli-armstrong")  # laws of strength that know the temperature
USES = (  # what, words of the input, what is needed
    ("shocks and flow without strength", "", ()),
    ("projectiles, debris, plate impact", "spall voids", (("strength", None), ("spall", "voids"))),
    ("walls of shields", "damage yes spall voids", (("strength", None), ("damage", None), ("spall", "voids"))),
    ("spall as other codes have it", "spall principal", (("strength", None), ("spall", "limit"))),
    ("temperature", "", (("cp", None),)),
    ("softening by heat, melting", "", (("cp", None), ("softens", None))),
)


def needs(material, wanted):
    """what of that the file does not have, as text"""
    eos = material.sections["eos", material.laws("eos")[0]]
    found = []
    for kind, law in wanted:
        if kind == "cp":
            if material.table and not re.search(r"^[ \t]*temperature[ \t]", texts.read(find(material.table, "table")), re.M):
                found.append("temperature in its table")
            elif not (eos.get("cp") or eos.get("cv") or material.table):
                found.append("cp of the eos")
        elif kind == "softens":
            if not set(SOFTENS) & set(material.laws("strength")):
                found.append("strength that knows the temperature")
        elif law and (kind, law) not in material.sections or not [x for x in material.laws(kind) if x != "none"]:
            found.append(f"{kind} {law}" if law else kind)
    return found


def uses(material):
    """[(use, words of the input, what is missing for it)]"""
    laws = [law for law in material.laws("strength") if law != "none"]
    own = f" strength {laws[0]}" if laws and "johnson-cook" not in laws else ""  # what fix hvi/johnson-cook takes if it is told nothing
    return [(use, words + own * bool(words), needs(material, wanted)) for use, words, wanted in USES]


# what is usual in SI of solids and liquids; and as parts of SCALES, in any units: wide, what is beyond has mostly wrong units
ABSOLUTE = {("eos", "density"): (10, 25e3), ("eos", "speed"): (100, 20e3), ("eos", "temperature"): (100, 1000), ("strength", "temperature"): (100, 6000),
            ("strength", "per_temperature"): (1e-6, 0.05), ("spall", "rate"): (1, 1e9)}
RELATIVE = {("eos", "pressure"): (1e-3, 100), ("eos", "specific_energy"): (0.01, 100), ("eos", "heat_capacity"): (3e-4, 3), ("strength", "modulus"): (1e-3, 2),
            ("strength", "pressure"): (1e-5, 0.2), ("strength", "per_pressure"): (0.05, 50), ("damage", "pressure"): (1e-4, 0.3), ("spall", "pressure"): (1e-4, 0.3)}


def doubts(material):
    """[text of each value that is far from what is usual: key, value, what is usual]; 0 is no value, and without a speed of sound only ABSOLUTE is known"""
    eos = "eos", material.laws("eos")[0]
    v, stiff, scales, found = material.in_si(eos), STIFF.get(eos[1]), {}, {}
    if "rho0" in v:
        M = v[stiff] if stiff else v["rho0"] * v.get("C", v.get("c0")) ** 2
        scales = {"pressure": M, "modulus": M, "per_pressure": 1 / M, "specific_energy": M / v["rho0"], "heat_capacity": M / v["rho0"] / 300}

    def look(section, key, usual, scale=1.0, given=""):
        value, si = material.sections[section][key], material.in_si(section)[key]
        if value and not usual[0] * scale <= abs(si) <= usual[1] * scale:
            low, high = (float(f"{x * scale * value / si:.2g}") for x in usual)
            found[section, key] = f"{' '.join(section)}: {key} = {value:g} is far from what is usual{given}, {low:g} to {high:g} in units {material.units}"

    keys = [(section, key, "modulus" if key in ("G", "G0") else quantity) for section in material.sections for key, quantity, _, _ in LAWS[section]
            if key in material.notes[section]]  # those that are given
    if material.units != "lj":
        for section, key, quantity in keys:
            if usual := ABSOLUTE.get((section[0], quantity)):
                look(section, key, usual)
        if stiff and (eos, "rho0") not in found:
            look(eos, stiff, [speed**2 for speed in ABSOLUTE["eos", "speed"]], v["rho0"], " with its rho0")
    if not any((eos, key) in found for key in ("rho0", "C", "c0", stiff)):
        for section, key, quantity in keys:
            if quantity in scales and (usual := RELATIVE.get((section[0], quantity))):
                look(section, key, usual, scales[quantity], " with its eos")
    return list(found.values())


def warn(material):
    """of doubts()"""
    for text in doubts(material):
        warnings.warn(f"{material.path}: {text}: is it in other units?", HVIWarning, stacklevel=2)


def row(material):
    """{column: text} of the table of all materials"""
    eos = material.laws("eos")[0]
    values = material.sections["eos", eos]
    shown = {"rho0": "rho0", "C": "C", "S1": "S1"} if "C" in values else {"rho0": "rho0", "K": "K", "A": "A"}
    numbers = ", ".join(f"{text} {values[key]:g}" for key, text in shown.items() if key in values)
    why = {}
    for kind, text in material.lacks().items():
        why.setdefault(text or "no reason given", []).append(kind)
    return {"file": material.name, "what": material.title, "eos": f"{eos}: {numbers}" if numbers else eos,
            **{kind: ", ".join(material.laws(kind)) or "-" for kind in WANTED[1:]},
            "lacks": "; ".join(f"{', '.join(kinds)}: {text}" for text, kinds in why.items()) or "-",
            "assumed": "; ".join(f"{' '.join(section)}: {', '.join(keys)}" for section, keys in material.assumed().items()) or "-",
            "sources": material.citation or "-"}


def everything(folder):
    """rows of all files of a folder"""
    names = sorted(p for p in os.listdir(folder) if p.endswith(".hvi"))
    return [row(read(pathlib.Path(folder, name))) for name in names]


def density_of(name, si=False):
    """(rho0, units) of a material file, as it has them or in SI"""
    path = find(name)
    with reading(path):
        state = os.stat(path)
    return _density(path, (state.st_mtime_ns, state.st_size, state.st_ino), si)


@functools.lru_cache(maxsize=64)
def _density(path, state, si):
    """the same of one state of the file: equations ask for it hundreds of times"""
    one = read(path)
    section = "eos", one.laws("eos")[0]
    if "rho0" not in one.sections[section] or si and one.units == "lj":
        raise HVIError(f"{one.path}: no rho0 in the section {' '.join(section)}" + (" in units that SI knows" if si else ""))
    return (one.in_si(section)["rho0"], "si") if si else (one.sections[section]["rho0"], one.units)
