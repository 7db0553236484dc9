# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""The projectile of a case: a sphere, cylinder, cube or hollow sphere, on a lattice or like glass, a closed surface (STL), or particles of a file."""

import dataclasses
import functools
import hashlib
import math
import pathlib
import re
from typing import Optional

import numpy as np
import yaml

from ..errors import HVIError
from ..io.data import DataFile
from ..material import library, laws
from ..model import bodies, stl
from .reader import REQUIRED, Key, choice, fields, number

# shape: keys that it needs, keys that it may have
SHAPES = {"sphere": (("diameter_mm",), ()), "cylinder": (("diameter_mm", "length_mm"), ("pitch_deg",)), "cube": (("side_mm",), ("pitch_deg",)),
          "hollow sphere": (("diameter_mm", "thickness_mm"), ()), "file": (("file",), ())}
FILLS = ("lattice", "glass")
OURS = r"(in|log)\..*|wall\d+\.data|.*\.(yaml|dat|hvi|dump|txt)"  # files that folders of runs have
LEAST = 8  # particles of a body of a file,
SAME = 0.01  # by how much their masses, and their density and that of the material, may differ
LENGTHS = ("diameter_mm", "length_mm", "side_mm", "thickness_mm")


def material(reader):
    return functools.partial(laws.find, reader)


def words(reader):
    """of one or several"""
    return lambda node, key: tuple(reader.text(item, key) for item in (node.value if isinstance(node, yaml.SequenceNode) else [node]))


def of(name, text=""):
    """which shapes have a key"""
    *most, last = (shape for shape, keys in SHAPES.items() if name in sum(keys, ()))
    return f"of a {', '.join(most)}{' or ' * bool(most)}{last}{text}"


KEYS = {
    "material": Key(material, REQUIRED, "as of walls"),
    "shape": Key(choice(*SHAPES), "sphere", ", ".join(SHAPES)),
    **{name: Key(number(above=0), None, of(name)) for name in LENGTHS},
    "pitch_deg": Key(number(above=-90, below=90), 0.0, of("pitch_deg", ": its axis is turned about y, from the normal of the walls towards x")),
    "fill": Key(choice(*FILLS), FILLS[0], "lattice, glass: particles on a cubic lattice, or even without rows (Howto_bodies); not of a file"),
    "file": Key(words, (), "an STL file in mm, or particle files of hvi body, one for each spacing"),
}


@dataclasses.dataclass(frozen=True)
class Projectile:
    """Lengths in mm, pitch in degrees: by how much its axis is turned about y from the direction normal to the walls

    files: absolute paths, one STL file, in mm, or particle files, one for each spacing; of_files: what they say,
    [(extent, volume, least), ...]: that of the sphere around it, mm, mm^3, and the least extent, mm
    """

    material: str
    shape: str = "sphere"
    diameter_mm: Optional[float] = None
    length_mm: Optional[float] = None
    side_mm: Optional[float] = None
    thickness_mm: Optional[float] = None
    pitch_deg: float = 0.0
    fill: str = FILLS[0]
    files: tuple = ()
    of_files: tuple = ()

    @property
    def radius_mm(self):
        """of the sphere around it, whose center is that of the body"""
        if self.shape == "file":
            return 0.5 * max(extent for extent, *_ in self.of_files)
        return {"sphere": lambda: 0.5 * self.diameter_mm, "hollow sphere": lambda: 0.5 * self.diameter_mm, "cube": lambda: 0.5 * math.sqrt(3) * self.side_mm,
                "cylinder": lambda: 0.5 * math.hypot(self.diameter_mm, self.length_mm)}[self.shape]()

    @property
    def volume_mm3(self):
        if self.shape == "file":
            return self.of_files[-1][1]
        return {"sphere": lambda: math.pi / 6 * self.diameter_mm**3, "cube": lambda: self.side_mm**3, "cylinder": lambda: math.pi / 4 * self.diameter_mm**2 * self.length_mm,
                "hollow sphere": lambda: math.pi / 6 * (self.diameter_mm**3 - (self.diameter_mm - 2 * self.thickness_mm) ** 3)}[self.shape]()

    @property
    def equivalent_mm(self):
        """diameter of a solid sphere of the same mass, for equations that know only spheres"""
        return self.diameter_mm if self.shape == "sphere" else (6 * self.volume_mm3 / math.pi) ** (1 / 3)

    @property
    def least_mm(self):
        """the least of its extents"""
        of_files = (self.equivalent_mm, *(least for *_, least in self.of_files)) if self.files else ()
        return min(value for value in (self.diameter_mm, self.length_mm, self.side_mm, *of_files) if value)

    @property
    def in_data(self):
        """True if its particles come with a data file, not from a lattice of the input"""
        return bool(self.files) or self.fill == "glass"

    @property
    def symmetric(self):
        """True if the planes x = 0 and y = 0 may be mirrors"""
        return self.shape != "file" and not self.pitch_deg

    def scaled(self, size_mm):
        """of another size: all lengths alike, so that size() is this"""
        if self.shape == "file":
            raise HVIError("a projectile of a file has the size that it has: its size cannot vary")
        by = size_mm / self.size_mm
        return dataclasses.replace(self, **{name: value * by for name in LENGTHS if (value := getattr(self, name)) is not None})

    @property
    def size_mm(self):
        """what --on D varies: the diameter, or the side"""
        return self.side_mm if self.shape == "cube" else self.diameter_mm if self.diameter_mm else self.equivalent_mm

    def __str__(self):
        pitch = f", pitched by {self.pitch_deg:g} degrees" if self.pitch_deg else ""
        return {"sphere": lambda: f"sphere of {self.diameter_mm:g} mm", "cube": lambda: f"cube of {self.side_mm:g} mm{pitch}",
                "cylinder": lambda: f"cylinder of {self.diameter_mm:g} mm, {self.length_mm:g} mm long{pitch}",
                "hollow sphere": lambda: f"hollow sphere of {self.diameter_mm:g} mm, {self.thickness_mm:g} mm thick",
                "file": lambda: f"body of {pathlib.Path(self.files[0]).name}, as much as a sphere of {self.equivalent_mm:.3g} mm"}[self.shape]()

    def mapping(self):
        """as in a case, beside its files"""
        found = {"material": pathlib.Path(self.material).name, **({"shape": self.shape} if self.shape != "sphere" else {}),
                 **({"fill": self.fill} if self.fill != FILLS[0] else {})}
        found.update({name: value for name in (*LENGTHS, "pitch_deg") if (value := getattr(self, name))})
        return {**found, **({"file": [pathlib.Path(path).name for path in self.files]} if self.files else {})}

    # ------------------------------------------------------------------ in the input
    def plain(self, file=None):
        """words of write() of what its particles follow from, as the record of a run keeps them; file: of particles or an STL file, which is copied beside them"""
        if file:
            return {"shape": self.shape, "file": pathlib.Path(file).name, "checksum": hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest()[:16]}
        return {name: value for name in ("shape", *LENGTHS, "pitch_deg") if (value := getattr(self, name))}

    def body(self, quarter):
        """bodies.Shape, in m, its axis along z"""
        size = {name: 1e-3 * value for name in LENGTHS if (value := getattr(self, name)) is not None}
        if self.shape == "cube":
            return bodies.box([size["side_mm"]] * 3, quarter)
        radius = 0.5 * size["diameter_mm"]
        if self.shape == "cylinder":
            return bodies.cylinder(radius, size["length_mm"], quarter=quarter)
        return bodies.sphere(radius, radius - size["thickness_mm"] if "thickness_mm" in size else 0.0, quarter)

    def regions(self, number):
        """lines of LAMMPS that define the region ball, its center R before wall 1; number: of a length or angle, as text"""
        R, z = 1e-3 * self.radius_mm, number(-1e-3 * self.radius_mm)
        if self.shape == "sphere":
            return [("region", f"ball sphere 0 0 {z} {number(R)} units box")]
        if self.shape == "hollow sphere":
            return [("region", f"outer sphere 0 0 {z} {number(R)} units box"), ("region", f"inner sphere 0 0 {z} {number(R - 1e-3 * self.thickness_mm)} side out units box"),
                    ("region", "ball intersect 2 outer inner")]
        half = 0.5e-3 * (self.length_mm or self.side_mm)
        high = f"{number(-R - half)} {number(-R + half)}"
        straight = f"block {number(-half)} {number(half)} {number(-half)} {number(half)} {high}"
        if self.shape == "cylinder":
            straight = f"cylinder z 0 0 {number(0.5e-3 * self.diameter_mm)} {high}"
        if not self.pitch_deg:
            return [("region", f"ball {straight} units box")]
        # create_atoms looks at the box that a region had before it was turned; one that is the outside of something has none
        return [("variable", f"pitch equal {number(math.radians(self.pitch_deg))}"),
                ("region", f"outside {straight} side out units box rotate v_pitch 0 0 {z} 0 1 0"),
                ("region", "turned union 2 outside outside side out"),
                ("region", f"around block {number(-R)} {number(R)} {number(-R)} {number(R)} {number(-2 * R)} 0 units box"),
                ("region", "ball intersect 2 turned around")]


def read(reader, node, key):
    """A Projectile"""
    found = reader.mapping(node, key, fields(reader, KEYS))
    shape, names = found["shape"], found.pop("file")
    needs, may = SHAPES[shape]
    for name in needs:
        if not (names if name == "file" else found[name]):
            reader.wrong(f"{key}: {name}", f"is missing: a {shape} has {' and '.join(needs)}", node)
    for name in (*LENGTHS, "pitch_deg", "file"):
        if name not in needs + may and (names if name == "file" else found[name]):
            reader.wrong(f"{key}: {name}", f"a {shape} has none: {', '.join(needs + may)}")
    if shape == "file" and found["fill"] != FILLS[0]:
        reader.wrong(f"{key}: fill", "a file has its own particles, or is filled by a lattice")
    if shape == "hollow sphere" and 2 * found["thickness_mm"] >= found["diameter_mm"]:
        reader.wrong(f"{key}: thickness_mm", f"must be below the radius, {0.5 * found['diameter_mm']:g} mm")
    for name in names:
        if re.fullmatch(OURS, pathlib.Path(name).name) or not re.fullmatch(r"[\w.+-]+", pathlib.Path(name).name, re.A):
            reader.wrong(f"{key}: file", f"{name!r} is copied into folders of runs, so its name has letters, digits and . _ + - only, and is none of theirs, such as *.dat and in.*: rename it")
    files = tuple(str((reader.path.parent / name).resolve()) for name in names)
    try:
        density = library.density_of(library.of_case(found["material"]), si=True)[0] if files else None
        return Projectile(**found, files=files, of_files=tuple(measured(path, density) for path in files))
    except HVIError as problem:
        reader.wrong(f"{key}: file", str(problem))


def measured(path, density):
    """(diameter of the sphere around its middle, volume, least extent) in mm, mm^3: of an STL file, in mm, or of a particle file, in m, of this density

    least: width over all directions, of a shell twice its wall: four particles are across the projectile, two across a shell. A particle is one spacing wide.
    """
    spacing = 0.0
    if is_surface(path):
        triangles = stl.read(path)
        x, volume = triangles.reshape(-1, 3), stl.volume(triangles)
        least = stl.least(triangles)
    else:
        x, mass, rho = particles(path)
        if abs(rho / density - 1) > SAME:
            raise HVIError(f"{path} has a density of {rho:g} kg/m^3, and the material of the projectile {density:g}: "
                           "python3 -m hvi body --material FILE.hvi makes one of it")
        x, volume = 1e3 * x, 1e9 * mass / density
        spacing = (volume / len(x)) ** (1 / 3)
        least = np.ptp(x, axis=0).min() + spacing
    return float(2 * np.linalg.norm(x - stl.middle(x), axis=1).max() + spacing), volume, float(least)


def spacing_of(path, volume_mm3):
    """of the particles of a file, mm, of this volume"""
    return (volume_mm3 / len(particles(path)[0])) ** (1 / 3)


def is_surface(path):
    return path.lower().endswith(".stl")


def particles(path):
    """(places (n, 3) in m, mass in kg, density in kg/m^3) of a particle file of atom_style sph, as hvi body writes it"""
    data = DataFile(path)
    frame = data.frame()
    if not frame.type_masses or data.mirror or data.rho is None:
        raise HVIError(f"{path} must be of atom_style sph, with a section Masses and no mirror plane: python3 -m hvi body makes such files")
    if np.ptp(frame.m) > SAME * frame.m.min() or np.ptp(data.rho) > SAME * data.rho.min():
        raise HVIError(f"{path} has particles of several masses or densities, and those of a projectile are all alike: python3 -m hvi body makes such files")
    return frame.x, float(frame.m.sum()), float(data.rho[0])


def write(path, spacing, shift, density, quarter, file=None, checksum=None, **of):
    """A data file, its middle at 0 0 0: particles of a file; of an STL file the sites of the lattice that are inside, which share its mass; of a shape particles
    like in a glass

    spacing: m; shift: of the lattice along z, in spacings, or another glass for each; density: kg/m^3; quarter: x > 0, y > 0 alone, of a glass; file, checksum, of: Projectile.plain()
    """
    body = Projectile("", **of)
    if file:
        x, mass = from_file(str(pathlib.Path(path).with_name(file)), spacing, shift, density)
        title, planes = file, ()
    else:
        made = bodies.make(body.body(quarter), spacing, "glass", 1 + round(1e4 * shift))
        c, s = math.cos(math.radians(body.pitch_deg)), math.sin(math.radians(body.pitch_deg))
        x, mass = made.x @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]), density * made.volume * len(made.x)
        title, planes = f"{body}, glass", (0, 1) if quarter else ()
    low = x.min(axis=0) - spacing
    low[list(planes)] = 0.0
    bodies.write_data(path, x, 1, [mass / len(x)], density, low, x.max(axis=0) + spacing, planes, title)


def from_file(source, spacing, shift, density):
    """(places (n, 3), their middle at 0; mass): m, kg"""
    if not is_surface(source):
        x, mass, _ = particles(source)
        x = x - stl.middle(x)
    else:
        triangles = 1e-3 * stl.read(source)
        mass = density * stl.volume(triangles)
        triangles = triangles - stl.middle(triangles.reshape(-1, 3))
        half = np.abs(triangles).max(axis=(0, 1))
        # a site on an edge of the surface would be a matter of rounding
        lines = [spacing * (np.arange(math.floor(-h / spacing), math.ceil(h / spacing) + 1) + 0.5 + 1e-7 + (shift if k == 2 else 0.0)) for k, h in enumerate(half)]
        bodies.refuse_many(math.prod(map(len, lines)), "sites of the lattice")
        sites = stl.inside(triangles, *lines)
        x = np.concatenate([np.column_stack([np.full(len(k), lines[0][i]), np.full(len(k), lines[1][j]), lines[2][k]]) for i, j, k in sites]) if sites else np.zeros((0, 3))
    if len(x) < LEAST:
        raise HVIError(f"{source} holds {len(x)} particles of a spacing of {1e3 * spacing:g} mm, {LEAST} at least are needed: is it in mm?")
    return x, mass
