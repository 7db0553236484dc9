# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A shield and what strikes it, as a YAML file says: read and checked, with messages that name line and key.

KEYS, projectile.KEYS, WALL and SETTINGS are the tables of all keys: reader, messages, the documentation and --help take them from here.
"""

import dataclasses
import functools
import pathlib
import warnings
from typing import Any

import yaml

from .. import texts
from ..errors import HVIError, HVIWarning, reading
from ..jobs import engine
from ..material import laws, library
from . import elements, geometry, projectile
from .projectile import material
from .reader import REQUIRED, Key, Reader, choice, fields, lammps_words, number, several, word

SLOWEST, FASTEST = 0.1, 100  # km/s
RATIO = 1.2  # of spacings that may be said to differ,
ROUNDED = 0.999  # with the digits that messages give them
LAYERS = 3  # needed in the wall that decides
ACROSS = 4  # particles across a projectile
MOST = 1000  # walls
METHODS = "sph", "hybrid", "tied"
HOW = {"spall": "in tension", "damage": "by plastic strain"}  # what fails by a law of that kind


MODEL = ": what this package has no model for belongs into not_modelled"

WALL = {
    "thickness_mm": Key(number(above=0), REQUIRED, ""),
    "material": Key(material, REQUIRED, "a file of potentials by its name without .hvi, or one beside the case"),
    "gap_mm": Key(number(above=0), None, "in front of it, rear to front; wall 1 has none"),
    "radius_mm": Key(number(above=0), None, "default: what the cloud can strike"),
    "spacings_mm": Key(several(number(above=0)), None, "of its own, as many as the case has"),
    "method": Key(choice(*METHODS, hint=MODEL), None, "default: that of the case"),
    "core_mm": Key(number(least=0), None, "of elements: free particles instead up to there, default what the shot needs; of particles: half the side of the square that has spacings_mm, beyond they are twice as far apart, default: nowhere"),
    "hold_mm": Key(number(above=0), None, "and elements that hold particles up to there"),
    "yield_ksi": Key(number(above=0, sane=(1e-3, 1e4)), None, "for ballistic-limit equations only, of two walls; default: of a table (Howto_ble)"),
    "brinell": Key(number(above=0, sane=(1, 1e4)), None, "hardness, likewise, of a single wall"),
    "sound_km_s": Key(number(above=0, sane=(0.1, 30)), None, "speed of sound, likewise"),
}

SETTINGS = {
    "quarter": Key(choice("auto", "yes", "no"), "auto", "model x > 0, y > 0 only; auto: if nothing speaks against it"),
    "tstop": Key(number(least=0, sane=(0, 1e6)), 0, "us: the latest end, and when a wall that fails ends the run; 0: by geometry, see Howto_front"),
    "kernel": Key(lammps_words, "cubic", "of pair_style hvi/sph"),
    "eta": Key(number(above=0, sane=(0.1, 10)), 1.2, "smoothing length in spacings"),
    "pair": Key(lammps_words, "dissipation riemann", "further words of pair_style hvi/sph"),
    "solid": Key(lammps_words, laws.SOLID, "words of fix hvi/johnson-cook"),
    "debris": Key(choice("no", "yes"), "no", "yes: particles that fail into smaller fragments fly on as these (fix hvi/debris), but for those of the last wall"),
    "fem": Key(lammps_words, "strain 0.3", "words of fix hvi/fem"),
    "C": Key(number(above=0, sane=(1e-3, 10)), 0.6, "of fix hvi/dt"),
    "skin": Key(number(above=0, sane=(1e-6, 100)), None, "of the neighbor lists, in spacings; default 0.7, of pair_coeff spacing"),
    "back": Key(number(least=0, sane=(0, 1e7)), 0, "mm that are modeled in front of wall 1; 0: half of the way to the last wall, at least 20"),
    "edge": Key(choice("free", "clamp", "absorb"), "free", "outermost rim of the walls"),
    "rim": Key(number(above=0, sane=(1e-6, 1e7)), 5, "its width, mm"),
    "film": Key(number(sane=(1e-6, 1e6)), 0, "us between frames for pictures, the scene in 3D and movies; 0: 31 frames until tstop of plan.yaml, at most 500 MB; below 0: none"),
    "layers": Key(several(number(whole=True, sane=(1, 1e6))), None, "of particles through each wall, a value for each"),
}

KEYS = {
    "projectile": Key(lambda reader: functools.partial(projectile.read, reader), REQUIRED, "what strikes the walls"),
    "speed_km_s": Key(number(), REQUIRED, f"at least {SLOWEST:g}, below {FASTEST:g}"),
    "angle_deg": Key(number(least=0, below=90), 0.0, "from the normal of the walls; at 0 a quarter is modeled"),
    "walls": Key(lambda reader: functools.partial(read_walls, reader), REQUIRED, "a list, the first is struck first"),
    "spacings_mm": Key(several(number(above=0), distinct=True), REQUIRED, f"of particles: two or more for a verdict, the largest {RATIO:g} times the smallest at least"),
    "shifts": Key(several(number(least=0, below=1), distinct=True), (0.0, 0.25), "of the projectile's lattice along z, in spacings (of a glass: its number); differences are chance"),
    "method": Key(choice(*METHODS, hint=MODEL), "sph", "of walls: sph, particles; hybrid, elements that become particles where they fail; tied, elements that never do"),
    "not_modelled": Key(several(word), (), "what the shield has and the model has not, [MLI, stuffing, honeycomb]: the verdict is undecided"),
    "settings": Key(lambda reader: functools.partial(read_settings, reader), {}, "of the model"),
}


# its attributes are these keys; method is None only while it is read: that of the case
Wall = dataclasses.make_dataclass("Wall", [(name, Any, key.default) if key.default is not REQUIRED else (name, Any) for name, key in WALL.items()],  # type: ignore[misc]  # either form is one that it takes
                              frozen=True, namespace={"__module__": __name__})  # where pickle finds it


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    projectile: projectile.Projectile
    speed_km_s: float
    angle_deg: float
    walls: tuple
    spacings_mm: tuple
    shifts: tuple
    not_modelled: tuple = ()
    settings: dict = dataclasses.field(default_factory=dict)  # those that are given

    @property
    def diameter_mm(self):
        """of the projectile, or of a sphere of its mass"""
        return self.projectile.equivalent_mm

    @property
    def material(self):
        """of the projectile"""
        return self.projectile.material

    def setting(self, name):
        """its value, or the default"""
        return self.settings.get(name, SETTINGS[name].default)

    def variables(self, which, shift):
        """what distinguishes a run, as its job.yaml and tables have it: spacing number which, a shift of the lattice"""
        walls = self.walls
        found = {"dx": self.spacings_mm[which], "shift": shift, "D": round(self.projectile.size_mm, 6), "v0": round(1e3 * self.speed_km_s, 6),
                 "angle": self.angle_deg, "material_p": self.material, "walls": len(walls),
                 "thickness": [wall.thickness_mm for wall in walls], "gap": [wall.gap_mm or 0 for wall in walls],
                 "material": [wall.material for wall in walls]}
        if self.projectile.shape != "sphere":
            found["shape"] = self.projectile.shape
        if self.projectile.fill == "glass":
            found["fill"] = "glass"
        if self.projectile.files:
            found["file"] = self.file(which)
        if any(wall.spacings_mm for wall in walls):
            found["spacings"] = [(wall.spacings_mm or self.spacings_mm)[which] for wall in walls]
        if any(wall.core_mm for wall in walls):
            found["core"] = [wall.core_mm or 0 for wall in walls]
        if any(wall.radius_mm for wall in walls):
            found["radius"] = [wall.radius_mm or 0 for wall in walls]
        if method := self.method():
            found["method"] = method
        if self.not_modelled:
            found["outside"] = ", ".join(self.not_modelled)
        return {**found, **{name: list(value) if isinstance(value, tuple) else value for name, value in self.settings.items()}}

    def one(self, which, shift):
        """the Case of a single run: spacing number which, a shift of the lattice"""
        walls = tuple(dataclasses.replace(wall, spacings_mm=wall.spacings_mm and (wall.spacings_mm[which],)) for wall in self.walls)
        files = (self.file(which),) if self.projectile.files else ()
        body = dataclasses.replace(self.projectile, files=files, of_files=tuple(of for path, of in zip(self.projectile.files, self.projectile.of_files) if path in files))
        return dataclasses.replace(self, walls=walls, projectile=body, spacings_mm=(self.spacings_mm[which],), shifts=(shift,))

    def mapping(self):
        """what read() makes this Case of, beside the files that it names"""
        def wall(of):
            found = {name: list(value) if isinstance(value, tuple) else value for name, value in vars(of).items() if value is not None}
            return {**found, "material": pathlib.Path(of.material).name}

        found = {"projectile": self.projectile.mapping(), "speed_km_s": self.speed_km_s, "angle_deg": self.angle_deg, "walls": [wall(of) for of in self.walls],
                 "spacings_mm": list(self.spacings_mm), "shifts": list(self.shifts), "not_modelled": list(self.not_modelled),
                 "settings": {name: list(value) if isinstance(value, tuple) else value for name, value in self.settings.items()}}
        return {name: value for name, value in found.items() if value not in ([], {})}

    def checksums(self):
        """{name: checksum} of the files that mapping() names: materials, as texts, since runs have copies of these, and files of the projectile; HVIError if one is gone"""
        found = {pathlib.Path(name).name: library.text_of(name).encode() for name in (self.material, *(wall.material for wall in self.walls))}
        for path in self.projectile.files:
            with reading(path):
                found[pathlib.Path(path).name] = pathlib.Path(path).read_bytes()
        return {name: engine.digest(data) for name, data in found.items()}

    def file(self, which):
        """of the projectile at spacing number which"""
        files = self.projectile.files
        return files[which if len(files) > 1 else 0]

    def method(self):
        """hybrid or tied if any wall has elements, else None"""
        return next((wall.method for wall in self.walls if wall.method != "sph"), None)

    def whole(self, last):
        """[(k, sentence, {key: value}, remedy), ...] of walls up to the last one that lack a law of spall or damage, and so cannot be said to hold"""
        found = []
        for k, wall in enumerate(self.walls[:last], 1):
            name = f"wall {k} is of {wall.material}"
            for kind, why in laws.lacking(wall.material, self.setting("solid")).items():
                own = "give its file such a section, or " if why.startswith("whose") else ""
                found.append((k, lacks(name, kind, why), {"settings": {"solid": None}}, f"{own}take a law that it has, by settings: {{solid: ...}}"))
            for kind in HOW if wall.method != "sph" else ():
                if laws.last_word(self.setting("fem"), kind) in laws.NO:
                    found.append((k, lacks(name, kind, f"with settings: {{fem: {kind} no}} of its elements"), {"settings": {"fem": None}}, "take settings: {fem: ...} without that"))
        return found

    def faces(self):
        """(front, rear) of each wall in mm, the front of wall 1 at 0"""
        found, z = [], 0.0
        for wall in self.walls:
            z += wall.gap_mm or 0.0
            found.append((z, z + wall.thickness_mm))
            z += wall.thickness_mm
        return found

    def check_shot(self, wrong):
        """What a shot needs, whatever it is asked for; wrong(key, text) raises the error."""
        if not SLOWEST <= self.speed_km_s < FASTEST:
            wrong("speed_km_s", f"must be at least {SLOWEST:g} and below {FASTEST:g} km/s, not {self.speed_km_s:g}"
                  + (f"; is it in {'k' if self.speed_km_s < SLOWEST else ''}m/s?" if self.speed_km_s > 0 else ""))
        if len(self.walls) > MOST:
            wrong("walls", f"{len(self.walls)} walls, {MOST} at most are modeled")

    def check(self, wrong):
        """What values say of each other, for a run"""
        self.check_shot(wrong)
        if len(self.spacings_mm) > 1 and max(self.spacings_mm) < ROUNDED * RATIO * min(self.spacings_mm):
            wrong("spacings_mm", f"the largest must be {RATIO:g} times the smallest at least: almost the same twice says nothing of how much it matters")
        faces, size = self.faces(), 2 * self.projectile.radius_mm
        for k, wall in enumerate(self.walls, 1):
            for dx in wall.spacings_mm or self.spacings_mm:
                if dx > wall.thickness_mm:
                    wrong(f"wall {k}: spacings_mm" if wall.spacings_mm else "spacings_mm",
                          f"{dx:g} mm is more than wall {k} is thick, {wall.thickness_mm:g} mm: a wall needs a layer of particles at least")
            least = geometry.least_radius(self, faces[k - 1][1])
            if wall.radius_mm and wall.radius_mm < least:
                wrong(f"wall {k}: radius_mm", f"with {wall.radius_mm:g} mm a projectile of {size:g} mm at {self.angle_deg:g} degrees strikes its edge "
                      f"or beside it: at least {least:.4g} mm are needed; without the key it is what the cloud needs")
        least, tstop = geometry.least_time(self), self.setting("tstop")
        if 0 < tstop < least:
            wrong("settings: tstop", f"{tstop:g} us are over before anything can have struck wall {len(self.walls)} and crossed it: "
                  f"at least {least:.1f} are needed; 0 takes what is enough")
        if self.setting("quarter") == "yes" and not geometry.may_be_quarter(self):
            wrong("settings: quarter", f"yes needs angle_deg of 0, not {self.angle_deg:g}" if self.angle_deg else f"yes needs mirror planes, and a {self.projectile} has none")
        for k, (wall, reach) in enumerate(zip(self.walls, geometry.reaches(self)), 1):
            wide = wall.radius_mm or reach if wall.method == "sph" else elements.half_side(self, k)
            if self.setting("edge") != "free" and self.setting("rim") >= wide:
                wrong("settings: rim", f"{self.setting('rim'):g} mm is no narrower than wall {k}, "
                      f"whose {'radius' if wall.method == 'sph' else 'half side'} is {wide:.4g} mm")
        self.check_materials(wrong)
        self.check_refined(wrong)
        if "layers" in self.settings and len(self.settings["layers"]) != len(self.walls):
            wrong("settings: layers", f"must be {len(self.walls)} values, one for each wall")
        self.check_elements(wrong)
        self.check_projectile(wrong)

    def check_materials(self, wrong):
        """runs have copies of material files, by their names"""
        known = {}
        for key, name in (("projectile: material", self.material), *((f"wall {k}: material", wall.material) for k, wall in enumerate(self.walls, 1))):
            path = library.of_case(name).resolve()
            if known.setdefault(path.name, path) != path:
                wrong(key, f"{path} and {known[path.name]} have one name, and a run has a folder for all its files: rename one")

    def check_refined(self, wrong):
        """spacings of a wall go with those of the case, by as much as these must: any may decide"""
        for k, wall in enumerate(self.walls, 1):
            own = wall.spacings_mm or ()
            if any(fine > coarse for coarse, fine in zip(own, own[1:])):
                wrong(f"wall {k}: spacings_mm", f"{', '.join(f'{dx:g}' for dx in own)} mm grow where those of the case, {', '.join(f'{dx:g}' for dx in self.spacings_mm)} mm, become finer")
            if len(own) > 1 and own[0] < ROUNDED * RATIO * own[-1]:
                wrong(f"wall {k}: spacings_mm", f"the largest must be {RATIO:g} times the smallest at least, as of the case: else nothing says how much it matters")

    def check_projectile(self, wrong):
        body = self.projectile
        for dx in self.spacings_mm:
            if dx > body.least_mm / ACROSS:
                wrong("spacings_mm", f"{dx:g} mm leaves fewer than {ACROSS} particles across the projectile of {body.least_mm:.4g} mm")
            if body.shape == "hollow sphere" and dx > 0.5 * body.thickness_mm:
                wrong("spacings_mm", f"{dx:g} mm leaves fewer than 2 particles through the shell of {body.thickness_mm:g} mm")
        if body.files and not projectile.is_surface(body.files[0]):
            if len(body.files) != len(self.spacings_mm):
                wrong("projectile: file", f"{len(body.files)} particle file{'s' * (len(body.files) > 1)}, and there are {len(self.spacings_mm)} spacings_mm: one for each, "
                      "from coarse to fine")
            for which, dx in enumerate(self.spacings_mm):
                found = projectile.spacing_of(body.files[which], body.of_files[which][1])
                if not 0.9 * dx < found < 1.1 * dx:
                    wrong("spacings_mm", f"{dx:g} mm, and the particles of {body.files[which]} are {found:.3g} mm apart")
            if len(self.shifts) > 1:
                wrong("shifts", "particle files have no lattice that could be shifted: one value")
        elif len(body.files) > 1:
            wrong("projectile: file", "one STL file is enough for all spacings")

    def check_core(self, k, wall, wrong):
        """of a wall of particles: its outer part must have two layers"""
        least = 2 * self.projectile.radius_mm
        if wall.core_mm < least:
            wrong(f"wall {k}: core_mm", f"must be {least:g} mm at least, the diameter of the projectile, not {wall.core_mm:g}: it is half the side of the square that has particles of spacings_mm")
        for which in range(len(self.spacings_mm)):
            layers = geometry.layers_of(self, k, which)
            if layers < 4 or layers % 2:
                wrong(f"wall {k}: core_mm", f"{layers} layers of particles leave {layers / 2:g} in the outer part of the wall, twice as coarse, which needs two at least, and whole ones: "
                      "take smaller spacings_mm, or no core_mm")

    def check_elements(self, wrong):
        """that walls which shall have elements can have them"""
        method = self.method()
        if "convert" in self.setting("fem").split():
            wrong("settings: fem", "whether elements become particles is said by method, hybrid or tied, not by convert")
        for k, wall in enumerate(self.walls, 1):
            if wall.method == "sph":
                if wall.hold_mm is not None:
                    wrong(f"wall {k}: hold_mm", "is of elements: method hybrid or tied")
                if geometry.is_graded(wall):
                    self.check_core(k, wall, wrong)
                continue
            if wall.method != method:
                wrong(f"wall {k}: method", f"{wall.method}, but another wall is {method}: walls with elements have one method")
            for which in range(len(self.spacings_mm)):
                try:
                    elements.of_wall(self, k, which)
                except HVIError as problem:
                    wrong(f"wall {k}: method", f"{wall.method}: {problem}")


# ---------------------------------------------------------------------- reading
def read_walls(reader, node, key):
    if not isinstance(node, yaml.SequenceNode) or not node.value:
        reader.wrong(key, "must be a list of walls, '- {thickness_mm: 0.8, material: Al2024-T3}' for each", node)
    found, of = [], fields(reader, WALL)
    for k, item in enumerate(node.value, 1):
        reader.at[f"wall {k}"] = item
        wall = Wall(**reader.mapping(item, f"wall {k}", of))
        if k == 1 and wall.gap_mm:
            reader.wrong("wall 1: gap_mm", "is the gap in front of a wall; there is nothing in front of wall 1")
        if k > 1 and not wall.gap_mm:
            reader.wrong(f"wall {k}: gap_mm", "is missing", item)
        found.append(wall)
    return tuple(found)


def read_settings(reader, node, key):
    """{name: value} of those that are given"""
    given = reader.mapping(node, key, fields(reader, SETTINGS))
    return {name: value for name, value in given.items() if f"{key}: {name}" in reader.at}


def read(path, model=True):
    """The Case in a file; HVIError names line and key of what is wrong.

    model: False if nothing is to be run, only the shot and the walls are needed
    """
    reader = Reader(path)
    of = fields(reader, KEYS)
    if not model:
        of["spacings_mm"] = of["spacings_mm"][0], ()
    data = reader.mapping(reader.root, "", of)
    method = data.pop("method")
    order = sorted(range(len(data["spacings_mm"])), key=lambda k: -data["spacings_mm"][k])  # from coarse to fine
    walls = []
    for k, wall in enumerate(data["walls"], 1):
        reader.at.setdefault(f"wall {k}: method", reader.at.get("method"))
        if wall.spacings_mm and len(wall.spacings_mm) != len(order):
            reader.wrong(f"wall {k}: spacings_mm", f"must be {len(order)} values, one for each of spacings_mm of the case")
        walls.append(dataclasses.replace(wall, method=wall.method or method, spacings_mm=wall.spacings_mm and tuple(wall.spacings_mm[i] for i in order)))
    body = data["projectile"]
    if body.files and not projectile.is_surface(body.files[0]) and "shifts" not in reader.at:
        data["shifts"] = data["shifts"][:1]
    data.update(walls=tuple(walls), spacings_mm=tuple(data["spacings_mm"][i] for i in order))
    case = Case(name=texts.name_of(reader.path), **data)
    if not model:
        case.check_shot(reader.wrong)
        return case
    case.check(reader.wrong)
    laws.check(case, reader)
    warn(case, reader)
    return case


def lacks(name, kind, why):
    return f"{name}, {why}, so it does not fail {HOW[kind]}"


def warn(case, reader):
    """of what is no error"""
    for name in dict.fromkeys((case.material, *(wall.material for wall in case.walls))):
        library.warn(library.read(library.of_case(name)))
    if whole := case.whole(len(case.walls)):
        walls, texts_, _, remedies = zip(*whole)
        node = reader.at[f"wall {walls[0]}: material"]
        warnings.warn(f"{reader.path}, line {node.start_mark.line + 1}: {'; '.join(texts_)}: if the shield holds, the verdict will be undecided -- {'; '.join(dict.fromkeys(remedies))}",
                      HVIWarning, stacklevel=3)
    if "weibull" in case.setting("solid").split():
        node = reader.at["settings: solid"]
        warnings.warn(f"{reader.path}, line {node.start_mark.line + 1}: all runs have the same seed of weibull: what another would change is in no verdict", HVIWarning,
                      stacklevel=3)
    coarse = (case.walls[-1].spacings_mm or case.spacings_mm)[0]
    if geometry.layers_of(case, len(case.walls), 0) < LAYERS and "layers" not in case.settings:
        node = reader.at.get(f"wall {len(case.walls)}: spacings_mm") or reader.at["spacings_mm"]
        warnings.warn(f"{reader.path}, line {node.start_mark.line + 1}: {coarse:g} mm leaves fewer than {LAYERS} layers of particles in the last wall: if that "
                      "decides, the verdict will be undecided", HVIWarning, stacklevel=3)


def rows_of_keys():
    """[(key, default, what it is), ...] of all tables, for pages and --help"""
    found = []
    for table, inside in ((KEYS, ""), (projectile.KEYS, "projectile: "), (WALL, "walls: "), (SETTINGS, "settings: ")):
        for name, key in table.items():
            default = "needed" if key.default is REQUIRED else "" if key.default in (None, (), {}) else ", ".join(map("{:g}".format, key.default)) if isinstance(key.default, tuple) else str(key.default)
            found.append((inside + name, default, key.text))
    return found
