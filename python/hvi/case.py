# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A shield and what strikes it, as a YAML file says: read and checked, with messages that name line and key."""

import dataclasses
import difflib
import math
import pathlib
import re
import warnings

import yaml

from . import runs, shield_mesh
from .errors import HVIError, HVIWarning

REQUIRED = object()
SLOWEST, FASTEST = 0.1, 100  # km/s
SOUND = 5  # km/s, as in.whipple has it
RATIO = 1.2  # of spacings that may be said to differ
SOLID = "damage no spall voids"  # words of fix hvi/johnson-cook, as in.whipple has them
LAYERS = 3  # that in.whipple needs in the wall that decides

# settings of in.whipple: what their values must be, beside numbers where its own are numbers
ABOVE_0, FROM_0, WHOLE = {"eta", "C", "skin", "rim", "probe_size"}, {"tstop", "back", "behind", "probe_at", "film"}, {"zones", "layers"}
METHODS = "sph", "hybrid", "tied"
CHOICES = {"quarter": ("auto", "yes", "no"), "edge": ("free", "clamp", "absorb"), "probes": ("yes", "no")}
SET_BY_CASE = {"t1", "t2", "spacing", "material_t", "radius1", "radius2", "radius", "spacings", "outside", "method", "dry", "resume", "out"}


@dataclasses.dataclass(frozen=True)
class Wall:
    thickness_mm: float
    material: str
    gap_mm: float = None  # in front of it; wall 1 has none
    spacings_mm: tuple = None  # of its own, as many as the case has
    radius_mm: float = None
    method: str = "sph"  # or hybrid, tied: elements; None while it is read: that of the case
    core_mm: float = None  # of elements: free particles instead up to there, None: what the shot needs
    hold_mm: float = None  # and elements with particles up to there
    yield_ksi: float = None  # for ballistic-limit equations only


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    diameter_mm: float
    material: str  # of the projectile
    speed_km_s: float
    angle_deg: float
    walls: tuple
    spacings_mm: tuple
    shifts: tuple
    not_modelled: tuple = ()
    settings: dict = dataclasses.field(default_factory=dict)

    def variables(self, which, shift):
        """those of in.whipple: spacing number which, a shift of the lattice"""
        walls = self.walls
        found = {"dx": self.spacings_mm[which], "shift": shift, "D": self.diameter_mm, "v0": round(1e3 * self.speed_km_s, 6),
                 "angle": self.angle_deg, "material_p": self.material, "walls": len(walls),
                 "thickness": [wall.thickness_mm for wall in walls], "gap": [wall.gap_mm or 0 for wall in walls],
                 "material": [wall.material for wall in walls]}
        if any(wall.spacings_mm for wall in walls):
            found["spacings"] = [(wall.spacings_mm or self.spacings_mm)[which] for wall in walls]
        if any(wall.radius_mm for wall in walls):
            found["radius"] = [wall.radius_mm or 0 for wall in walls]
        if method := self.method():
            found["method"] = method
            found["plate"] = ["plain" if wall.method == "sph" else shield_mesh.file_of(k) for k, wall in enumerate(walls, 1)]
        if self.not_modelled:
            found["outside"] = ", ".join(self.not_modelled)
        return {**found, **self.settings}

    def method(self):
        """hybrid or tied if any wall has elements, else None"""
        return next((wall.method for wall in self.walls if wall.method != "sph"), None)

    def faces(self):
        """(front, rear) of each wall in mm, the front of wall 1 at 0"""
        found, z = [], 0.0
        for wall in self.walls:
            z += wall.gap_mm or 0.0
            found.append((z, z + wall.thickness_mm))
            z += wall.thickness_mm
        return found

    def check(self, wrong):
        """What numbers say of each other; wrong(key, text) raises the error."""
        if not SLOWEST <= self.speed_km_s < FASTEST:
            wrong("speed_km_s", f"must be at least {SLOWEST:g} and below {FASTEST:g} km/s, not {self.speed_km_s:g}; "
                  f"is it in {'k' if self.speed_km_s < SLOWEST else ''}m/s?")
        if len(self.spacings_mm) > 1 and max(self.spacings_mm) < RATIO * min(self.spacings_mm):
            wrong("spacings_mm", f"the largest must be {RATIO:g} times the smallest at least: almost the same twice says nothing of how much it matters")
        angle, R = math.radians(self.angle_deg), 0.5 * self.diameter_mm
        for k, wall in enumerate(self.walls, 1):
            for dx in wall.spacings_mm or self.spacings_mm:
                if dx > wall.thickness_mm:
                    wrong(f"wall {k}: spacings_mm" if wall.spacings_mm else "spacings_mm",
                          f"{dx:g} mm is more than wall {k} is thick, {wall.thickness_mm:g} mm: a wall needs a layer of particles at least")
            least = 0.5 * self.faces()[k - 1][1] * math.tan(angle) + 1.5 * R / math.cos(angle)  # as in.whipple has it
            if wall.radius_mm and wall.radius_mm < least:
                wrong(f"wall {k}: radius_mm", f"with {wall.radius_mm:g} mm a projectile of {self.diameter_mm:g} mm at {self.angle_deg:g} degrees strikes its edge "
                      f"or beside it: at least {least:.4g} mm are needed; without the key it is what the cloud needs")
        front, rear = self.faces()[-1]
        least = (front + 3 * R) / (self.speed_km_s * math.cos(angle)) + (rear - front) / SOUND
        if 0 < float(self.settings.get("tstop", 0)) < least:
            wrong("settings: tstop", f"{self.settings['tstop']} us are over before anything can have struck wall {len(self.walls)} and crossed it: "
                  f"at least {least:.1f} are needed; 0 takes what is enough")
        if self.settings.get("quarter") == "yes" and self.angle_deg:
            wrong("settings: quarter", f"yes needs angle_deg of 0, not {self.angle_deg:g}")
        self.check_elements(wrong)
        for dx in self.spacings_mm:
            if dx > 0.25 * self.diameter_mm:
                wrong("spacings_mm", f"{dx:g} mm leaves fewer than 4 particles across the projectile of {self.diameter_mm:g} mm")


    def check_elements(self, wrong):
        """that walls which shall have elements can have them"""
        method = self.method()
        for k, wall in enumerate(self.walls, 1):
            if wall.method == "sph":
                for what in ("core_mm", "hold_mm"):
                    if getattr(wall, what) is not None:
                        wrong(f"wall {k}: {what}", "is of elements: method hybrid or tied")
                continue
            if wall.method != method:
                wrong(f"wall {k}: method", f"{wall.method}, but another wall is {method}: walls with elements have one method")
            for which in range(len(self.spacings_mm)):
                try:
                    shield_mesh.of_wall(self, k, which)
                except HVIError as problem:
                    wrong(f"wall {k}: method", f"{wall.method}: {problem}")
        for name, able in (("zones", "1"), ("probes", "no")) if method else ():
            if self.settings.get(name, able) != able:
                wrong(f"settings: {name}", f"must be {able} with method {method}, not {self.settings[name]}")


def has_strength(path):
    """True if a material file has a section strength"""
    try:
        return re.search(r"^[ \t]*strength\s", path.read_text(), re.M) is not None
    except (OSError, UnicodeDecodeError) as problem:
        raise HVIError(f"cannot read {path}: {problem}") from None


def laws_of(name):
    """laws of strength in a material file, by its name or path; None if there is no such file"""
    path = next((p for p in (pathlib.Path(name), *(folder / name for folder in runs.potentials())) if p.is_file()), None)
    return None if path is None else re.findall(r"^[ \t]*strength[ \t]+([\w-]+)", path.read_text(errors="replace"), re.M)


def check_laws(case, reader):
    """All materials must have the law of strength that the run takes: one without it would be a liquid, whatever else its file has"""
    words = str(case.settings.get("solid") or SOLID).split()
    law = next((new for old, new in zip(words, words[1:]) if old == "strength"), "johnson-cook")
    places = [("projectile: material", case.material), *((f"wall {k}: material", wall.material) for k, wall in enumerate(case.walls, 1))]
    known = [set(found) for _, name in places if (found := laws_of(name)) is not None]
    common = sorted(set.intersection(*known) - {"none"}) if known else []
    for key, name in places:
        found = laws_of(name)
        if found is None or law in found or law == "none":
            continue
        kept = " ".join(word for k, word in enumerate(words) if word != "strength" and (k == 0 or words[k - 1] != "strength"))
        remedy = (f"take settings: {{solid: {kept} strength {common[0]}}}, which all materials of this case have" if common else
                  f"all materials of a case must have one law in common, and these have none: give {pathlib.Path(name).stem} a section strength {law}")
        reader.wrong(key, f"{pathlib.Path(name).stem} has strength {' and '.join(found)}, and the run takes {law}: it would be a liquid; {remedy}")


def tears(name, solid):
    """True if there is something in a material file that lets it fail under tension, with these words of fix hvi/johnson-cook"""
    path = next((p for p in (pathlib.Path(name), *(folder / name for folder in runs.potentials())) if p.is_file()), None)
    if path is None:
        return True  # LAMMPS says so
    words, text = solid.split(), path.read_text(errors="replace")
    law, damage = (next((new for old, new in zip(words, words[1:]) if old == key), preset) for key, preset in (("spall", "principal"), ("damage", "yes")))
    section = law if law in ("voids", "tuler-butcher", "grady") else "limit"
    return (law != "none" and re.search(rf"^[ \t]*spall[ \t]+{section}\b", text, re.M) is not None
            or damage != "no" and re.search(r"^[ \t]*damage[ \t]", text, re.M) is not None)


def is_number(word):
    try:
        return math.isfinite(float(word))
    except ValueError:
        return False


class Reader:
    """The nodes of a YAML file, which know their lines."""

    def __init__(self, path):
        self.path, self.at = pathlib.Path(path), {}  # at: nodes of what was read, by key
        try:
            self.root = yaml.compose(self.path.read_text())
        except OSError as problem:
            raise HVIError(f"cannot read {path}: {problem.strerror}") from None
        except yaml.MarkedYAMLError as problem:
            mark = problem.problem_mark or problem.context_mark
            raise HVIError(f"{path}, line {mark.line + 1}: not YAML: {problem.problem or problem.context}") from None
        except (yaml.YAMLError, UnicodeDecodeError) as problem:
            raise HVIError(f"{path}: not YAML: {' '.join(str(problem).split())}") from None
        if self.root is None:
            raise HVIError(f"{path} is empty")

    def wrong(self, key, text, node=None):
        node = node or self.at.get(key) or self.root
        raise HVIError(f"{self.path}, line {node.start_mark.line + 1}: {key}: {text}")

    def mapping(self, node, key, fields):
        """{name: value} of fields {name: (function of node and key, default)}"""
        inside = f"{key}: " if key else ""
        if not isinstance(node, yaml.MappingNode):
            self.wrong(key or "the case", f"must be 'name: value' lines with {', '.join(fields)}", node)
        found = {}
        for name_node, value in node.value:
            name = str(name_node.value)
            if name not in fields:
                near = difflib.get_close_matches(name, fields, 1, 0.5)
                self.wrong(inside + name, "no such key" + (f"; did you mean {near[0]}?" if near else "") + f" (known: {', '.join(fields)})", name_node)
            if name in found:
                self.wrong(inside + name, "is there twice", name_node)
            self.at[inside + name] = value
            found[name] = fields[name][0](value, inside + name)
        for name, (_, default) in fields.items():
            if name not in found and default is REQUIRED:
                self.wrong(inside + name, "is missing", node)
            found.setdefault(name, default)
        return found

    def number(self, above=-math.inf, least=-math.inf, below=math.inf):
        def read(node, key):
            try:
                value = float(node.value)
            except (TypeError, ValueError):
                value = math.nan
            unit = next((word for end, word in (("_mm", " mm"), ("_km_s", " km/s"), ("_deg", " degrees"), ("_ksi", " ksi")) if key.endswith(end)), "")
            if not math.isfinite(value):
                said = f", not {node.value!r}" if isinstance(node, yaml.ScalarNode) else ""
                self.wrong(key, f"must be a number of{unit}, without the unit{said}" if unit else f"must be a number{said}", node)
            if not (value > above and value >= least and value < below):
                bounds = [f"{word} {bound:g}" for word, bound in (("above", above), ("at least", least), ("below", below)) if math.isfinite(bound)]
                self.wrong(key, f"must be {' and '.join(bounds)}{unit}, not {node.value}", node)
            return value
        return read

    def several(self, item, distinct=False):
        def read(node, key):
            if not isinstance(node, yaml.SequenceNode) or not node.value:
                self.wrong(key, "must be a list, like [0.4, 0.2]", node)
            values = tuple(item(n, key) for n in node.value)
            if distinct and len(set(values)) < len(values):
                self.wrong(key, "a value is there twice", node)
            return values
        return read

    def text(self, node, key):
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.wrong(key, "must be a word", node)
        return node.value

    def material(self, node, key):
        """a material file beside the case, or one of the package, by its name without .hvi; with a section strength: without, the wall is a liquid's"""
        name = self.text(node, key)
        known = {path.stem: path for folder in reversed(runs.potentials()) for path in sorted(folder.glob("*.hvi"))}
        solid = sorted(stem for stem, path in known.items() if has_strength(path))
        offered = f" (known: {', '.join(solid)})"
        own = next((path for path in (self.path.parent / name, self.path.parent / f"{name}.hvi") if path.is_file()), None)
        path = own or known.get(name.removesuffix(".hvi"))
        if path is None:
            near = difflib.get_close_matches(name, solid, 1, 0.4)
            self.wrong(key, f"no material {name}" + (f"; did you mean {near[0]}?" if near else "") + offered, node)
        if not has_strength(path):
            self.wrong(key, f"{path.stem} has no section strength, it would be a liquid{offered}", node)
        return str(own.resolve()) if own else path.name

    def method(self, node, key):
        if node.value not in METHODS:
            self.wrong(key, f"must be {METHODS[0]}, {METHODS[1]} or {METHODS[2]}, not {node.value}: what this package has no model for belongs into not_modelled", node)
        return node.value

    def walls(self, node, key):
        if not isinstance(node, yaml.SequenceNode) or not node.value:
            self.wrong(key, "must be a list of walls, '- {thickness_mm: 0.8, material: Al2024-T3}' for each", node)
        found = []
        for k, item in enumerate(node.value, 1):
            self.at[f"wall {k}"] = item
            wall = Wall(**self.mapping(item, f"wall {k}", {
                "thickness_mm": (self.number(above=0), REQUIRED), "material": (self.material, REQUIRED),
                "gap_mm": (self.number(above=0), REQUIRED if k > 1 else None),
                "spacings_mm": (self.several(self.number(above=0)), None),
                "radius_mm": (self.number(above=0), None), "core_mm": (self.number(least=0), None), "hold_mm": (self.number(above=0), None),
                "method": (self.method, None), "yield_ksi": (self.number(above=0), None)}))
            if k == 1 and wall.gap_mm:
                self.wrong("wall 1: gap_mm", "is the gap in front of a wall; there is nothing in front of wall 1")
            found.append(wall)
        return tuple(found)

    def settings(self, node, key):
        if not isinstance(node, yaml.MappingNode):
            self.wrong(key, "must be 'variable: value' lines, variables of in.whipple", node)
        found = {}
        for name, value in node.value:
            self.at[f"{key}: {name.value}"] = value
            values = [self.file(v, f"{key}: {name.value}") for v in (value.value if isinstance(value, yaml.SequenceNode) else [value])]
            found[name.value] = values if isinstance(value, yaml.SequenceNode) else values[0]
        return found

    def setting(self, name, source, walls):
        """a value, or several, of a variable of in.whipple"""
        key, default = f"settings: {name}", source.defaults.get(name)
        node = self.at[key]
        nodes = node.value if isinstance(node, yaml.SequenceNode) else [node]
        if default is None and len(nodes) != walls:
            self.wrong(key, f"must be {walls} values, one for each wall")
        number = self.number(above=0) if name in ABOVE_0 else self.number(least=0) if name in FROM_0 else self.number()
        for item in nodes:
            if name in WHOLE or default and all(map(is_number, default)):
                value = number(item, key)
                if name in WHOLE and (value < 1 or value != int(value)):
                    self.wrong(key, f"must be a whole number from 1 on, not {item.value}", item)
            elif name in CHOICES and item.value not in CHOICES[name]:
                *most, last = CHOICES[name]
                self.wrong(key, f"must be {', '.join(most)} or {last}, not {item.value}", item)
            elif name == "plate" and item.value != "plain" and not (self.path.parent / item.value).is_file():
                self.wrong(key, f"{item.value} is neither plain nor a file", item)

    def file(self, node, key):
        """a word; the whole path if it names a file beside the case, since runs have folders of their own"""
        text = self.text(node, key)
        path = self.path.parent / text
        return str(path.resolve()) if path.is_file() else text


def read(path, source):
    """The Case in a file; source: the runs.Input that it is for. HVIError names line and key of what is wrong."""
    reader = Reader(path)
    positive = reader.number(above=0)
    data = reader.mapping(reader.root, "", {
        "projectile": (lambda node, key: reader.mapping(node, key, {
            "diameter_mm": (positive, REQUIRED), "material": (reader.material, REQUIRED)}), REQUIRED),
        "speed_km_s": (reader.number(), REQUIRED),
        "angle_deg": (reader.number(least=0, below=90), 0.0),
        "walls": (reader.walls, REQUIRED),
        "spacings_mm": (reader.several(positive, distinct=True), REQUIRED),
        "shifts": (reader.several(reader.number(least=0, below=1), distinct=True), (0.0, 0.25)),
        "method": (reader.method, "sph"),
        "not_modelled": (reader.several(reader.text), ()),
        "settings": (reader.settings, {})})
    data.update(data.pop("projectile"))
    method = data.pop("method")
    data["walls"] = tuple(dataclasses.replace(wall, method=wall.method or method) for wall in data["walls"])
    case = Case(name=reader.path.stem, **data)
    order = sorted(range(len(case.spacings_mm)), key=lambda k: -case.spacings_mm[k])  # from coarse to fine
    for k, wall in enumerate(case.walls, 1):
        if wall.spacings_mm and len(wall.spacings_mm) != len(order):
            reader.wrong(f"wall {k}: spacings_mm", f"must be {len(order)} values, one for each of spacings_mm of the case")
    walls = tuple(dataclasses.replace(wall, spacings_mm=wall.spacings_mm and tuple(wall.spacings_mm[k] for k in order)) for wall in case.walls)
    case = dataclasses.replace(case, walls=walls, spacings_mm=tuple(case.spacings_mm[k] for k in order))
    reader.at.update({"diameter_mm": reader.at["projectile: diameter_mm"]})
    for k in range(1, len(walls) + 1):
        reader.at.setdefault(f"wall {k}: method", reader.at.get("method"))
    own = dataclasses.replace(case, settings={}).variables(0, 0.0)
    for name, value in case.settings.items():
        key = f"settings: {name}"
        if name in {*own, *SET_BY_CASE}:
            reader.wrong(key, "is set by the case itself")
        try:
            source.check({name: value}, reader.path)
        except HVIError as problem:
            reader.wrong(key, str(problem).partition(": ")[2])
        reader.setting(name, source, len(case.walls))
    case.check(reader.wrong)
    check_laws(case, reader)
    source.check(own, reader.path)
    if "weibull" in str(case.settings.get("solid")).split():
        node = reader.at["settings: solid"]
        warnings.warn(f"{path}, line {node.start_mark.line + 1}: all runs have the same seed of weibull: what another would change is in no verdict", HVIWarning,
                      stacklevel=2)
    last, coarse = case.walls[-1], (case.walls[-1].spacings_mm or case.spacings_mm)[0]
    if math.ceil(last.thickness_mm / coarse - 0.01) < LAYERS and "layers" not in case.settings:
        node = reader.at.get(f"wall {len(case.walls)}: spacings_mm") or reader.at["spacings_mm"]
        warnings.warn(f"{path}, line {node.start_mark.line + 1}: {coarse:g} mm leaves fewer than {LAYERS} layers of particles in the last wall: if that "
                      "decides, the verdict will be undecided", HVIWarning, stacklevel=2)
    return case
