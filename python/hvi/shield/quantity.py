# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Quantities of a case that searches vary and options set, by the words of the command line: D, speed, angle, thickness1, gap2."""

import dataclasses
import re
from typing import Optional

from ..errors import HVIError

OF_CASE = {"D": ("size_mm", "mm"), "speed": ("speed_km_s", "km/s"), "angle": ("angle_deg", "degrees")}
OF_WALL = {"thickness": "thickness_mm", "gap": "gap_mm"}
STEEPEST = 90  # degrees, of an angle: below that


@dataclasses.dataclass(frozen=True)
class Quantity:
    """word: as it is typed; key: of the case, its projectile or a wall; wall: its index or None; unit: mm, km/s or degrees"""

    word: str
    key: str
    wall: Optional[int]
    unit: str

    @property
    def name(self):
        """with its unit, as a column of a table: gap2_mm"""
        return self.key if self.word in ("speed", "angle") else f"{self.word}_mm"

    @property
    def title(self):
        """as limit.yaml has it"""
        key = "diameter_mm" if self.key == "size_mm" else self.key
        return key if self.wall is None else f"{key} of wall {self.wall + 1}"

    def of(self, case):
        """its value"""
        return getattr(case.projectile if self.key == "size_mm" else case if self.wall is None else case.walls[self.wall], self.key)

    def at(self, case, value):
        """the case with that value, of a diameter with all lengths of the projectile in proportion"""
        if self.key == "size_mm":
            return dataclasses.replace(case, projectile=case.projectile.scaled(value))
        if self.wall is None:
            return dataclasses.replace(case, **{self.key: value})
        walls = list(case.walls)
        walls[self.wall] = dataclasses.replace(walls[self.wall], **{self.key: value})
        return dataclasses.replace(case, walls=tuple(walls))

    def checked(self, case, value, option):
        """the same, which can be run; HVIError that begins with the option: it cannot"""
        where = f"{option} {value:g} {self.unit}"
        if self.word == "angle" and not 0 <= value < STEEPEST:
            raise HVIError(f"{where}: an angle must be at least 0 and below {STEEPEST} degrees")
        if self.word != "angle" and not value > 0:
            raise HVIError(f"{where}: must be above 0")
        found = self.at(case, value)
        found.check(wrong(where))
        return found


def wrong(where):
    """what Case.check() calls with a key and a text"""
    def raised(key, text):
        raise HVIError(f"{where}: {key}: {text}")
    return raised


def words(case):
    """of all quantities of a case"""
    n = len(case.walls)
    return [*OF_CASE, *(f"thickness{k}" for k in range(1, n + 1)), *(f"gap{k}" for k in range(2, n + 1))]


def find(case, word, option):
    """the Quantity with that word; HVIError that begins with the option: there is none"""
    known = words(case)
    if word not in known:
        raise HVIError(f"{option} must be {', '.join(known[:-1])} or {known[-1]}, not {word}")
    if word in OF_CASE:
        key, unit = OF_CASE[word]
        return Quantity(word, key, None, unit)
    kind, number = re.fullmatch(r"([a-z]+)(\d+)", word).groups()
    return Quantity(word, OF_WALL[kind], int(number) - 1, "mm")


def changed(case, given, *varied):
    """the case with values of options --at, [(word, value), ...], and what its folder is called after: _gap2-100; varied: words that can have no such value"""
    name = ""
    for k, (word, value) in enumerate(given):
        if word in varied:
            raise HVIError(f"--at {word}: {word} varies here: take it out")
        if word in dict(given[:k]):
            raise HVIError(f"--at {word}: it is given twice")
        case = find(case, word, "--at").checked(case, value, f"--at {word}")
        name += f"_{word}-{value:g}"
    return case, name
