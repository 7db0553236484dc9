# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A scene in 3D within a page: frames that a reader turns, cuts and goes through in time. view.js draws them."""

import base64
import dataclasses
import io
import json
import pathlib
import zlib
from typing import Optional

import matplotlib.image
import numpy as np
from matplotlib import colormaps

from .. import figures
from .. import units as unit_systems
from ..errors import HVIError
from ..io import mirror, packed
from ..material.library import stem
from . import page as pages
from . import pictures, render
from .page import Html, tag

SCRIPT = pathlib.Path(__file__).with_name("view.js")
VOLUME = (0.75 / np.pi) ** (1 / 3)  # radius of a sphere of the volume of a cube
RANGE = 0.1, 99.9  # percentiles of the values that have colors of their own, where a field has no least value
TRIED = 4  # times as many frames as a page surely holds are packed: deflate leaves a quarter at best
HIDES = ("none", "x >", "x <", "y >", "y <", "z >", "z <")  # of the cut


@dataclasses.dataclass(frozen=True)
class Field:
    """What colors may show; values(frame): (n,); needs: columns; factor: units of the dump in unit; root: colors by the root of the value
    least, most: its range; None: that of the data, without a thousandth at each end if there is no least value either"""

    name: str
    needs: tuple
    values: object
    unit: str = ""
    factor: float = 1.0
    root: bool = False
    least: Optional[float] = None
    most: Optional[float] = None
    colors: str = "viridis"


def fields_of(frame):
    """The Fields that the columns of a frame allow: speed, damage, temperature, pressure"""
    si = frame.units == "si"
    speed, unit = (1e3, "km/s") if si else (1.0, unit_systems.name("velocity", frame.units))
    found = (Field("speed", ("vx", "vy", "vz"), lambda f: np.linalg.norm(f.v, axis=1), unit, speed, root=True, least=0.0),
             Field("damage, 1: failed or spalled", ("damage",), lambda f: np.maximum(f.numbers("damage"), f.numbers("spalled") if "spalled" in f else 0.0), least=0.0, most=1.0, colors="magma"),
             Field("temperature", ("T",), lambda f: f.numbers("T"), "K" if si else "", colors="inferno"),
             Field("pressure", ("p",), lambda f: f.numbers("p"), "GPa" if si else "", 1e9 if si else 1.0, root=True, colors="coolwarm"))
    return [field for field in found if all(name in frame for name in field.needs)]


@dataclasses.dataclass(frozen=True)
class Look:
    """How a scene is first seen. eye, up: directions; frame: number in the dump, from 0; cut: of HIDES, at 0; color: the name of a field, or its first word"""

    eye: tuple = pictures.OBLIQUE[0]
    up: tuple = pictures.OBLIQUE[1]
    frame: int = -1
    cut: str = "none"
    color: str = "part"


class View:
    """Frames of a dump, as many as a page holds.

    dump: a Dump; part_of(frame): (n,) numbers of parts, from 0; parts(k): (name, (r, g, b), radius) of a part, radius in the units of the dump
    more: Fields beside those of fields_of(); factor, unit: of lengths; bar: of hvi.progress
    record: what view.js reads; note: of which frames and particles; last: (x, part) of the frame first shown, whole
    """

    def __init__(self, dump, part_of, parts, bar, look=Look(), more=(), factor=1.0, unit=""):
        most = max(header.n for header in dump.headers)
        if not most:
            raise HVIError(f"{dump.paths[0]}: no frame has a particle: there is nothing to draw")
        self.look, self.factor = look, factor
        first = dump.number(look.frame)
        fields = [*fields_of(dump[first]), *more]
        lacking = [name for field in more for name in field.needs if name not in dump[first]]
        names = ["part", *(field.name for field in fields)]
        color = next((k for k in reversed(range(len(names))) if look.color in (names[k], names[k].split()[0].rstrip(","))), None)  # a column that was asked for is the last
        if lacking or color is None:
            raise HVIError(f"{dump[first].where} has no column for the color {look.color}; it has: {' '.join(dump[first].columns)}")
        stride, numbers = packed.stride_of(most), _some(len(dump), TRIED * packed.frames_of(most, 1 + len(fields)), first)
        kept, self.mirror = [], dump[first].planes
        for number in numbers:
            frame = dump[number]
            bar.update()
            left = np.flatnonzero((frame.ids if "id" in frame else np.arange(len(frame))) % stride == 0)  # the same particles in all frames
            if len(left):
                kept.append((number, frame.x[left] / factor, part_of(frame)[left], [np.float32(field.values(frame)[left] / field.factor) for field in fields], when(frame)))
        if not kept:
            raise HVIError(f"{dump.paths[0]}: of {most} particles each {stride}. could be shown, and no ID is a multiple of {stride}: dump a group of at most {packed.PARTICLES} particles")
        numbers = [number for number, *_ in kept]
        shown = int(np.argmin(np.abs(np.subtract(numbers, first))))
        self.last = self._whole(*kept[shown][1:3])
        there = np.unique(np.concatenate([np.unique(part) for _, _, part, *_ in kept]))
        if there[-1] > 255:
            raise HVIError(f"{dump.paths[0]} has more than 256 types: a scene in 3D has colors for 256 (--figure NAME draws it from the side)")
        self.parts = {int(k): parts(int(k)) for k in there}
        self.colors, self.radii = np.zeros((256, 3)), np.zeros(256)
        for k, (_, rgb, radius) in self.parts.items():
            self.colors[k], self.radii[k] = rgb, radius / factor * stride ** (1 / 3)
        each = f"{most} particles" if stride == 1 else f"{most} particles, of which each {stride}. is shown, with the volume of {stride}"
        self.record = {"unit": unit, "color": color, "cut": look.cut, "cutAt": 0.0, "eye": list(look.eye), "up": list(look.up), "radius": self.radii.max(),
                       "mirror": [[plane.axis, plane.at / factor] for plane in self.mirror], **self._extent(kept), **self._colors(fields, kept)}
        self.record["frames"], self.record["first"] = fitting(self.record["frames"], shown)
        self.note = f"{len(self.record['frames'])} of {len(dump)} frames, of at most {each}."

    def _whole(self, x, part):
        """the same with mirror images"""
        at = np.zeros(3)
        for plane in self.mirror:
            at[plane.axis] = plane.at / self.factor
        signs = [sign for _, sign in mirror.images(self.mirror)]
        return np.concatenate([np.where(sign < 0, 2 * at - x, x) for sign in signs]), np.tile(part, len(signs))

    def _extent(self, kept):
        """the first view: all but a hundredth of the frame first shown, within its middle; how deep all frames are"""
        x, _ = self.last
        basis = render.basis(self.look.eye, self.look.up)
        low, high = np.percentile(x @ basis.T, (0.5, 99.5), axis=0)
        center, (right, up, _) = 0.5 * (low + high) @ basis, high - low
        least, most = np.percentile(x, (0.5, 99.5), axis=0)
        far = max(np.abs(self._whole(x, part)[0] - center).max() for _, x, part, *_ in kept)
        room = 0.1 * max(right, up) + 4 * self.radii.max()
        return {"center": center.tolist(), "least": least.tolist(), "most": most.tolist(), "wide": right + room, "high": up + room, "deep": 4 * (far + self.radii.max())}

    def _colors(self, fields, kept):
        """table of colors, fields with their legends, and frames with the bytes of both"""
        rows = np.zeros((1 + len(fields), 256, 4), dtype=np.uint8)
        rows[0] = np.rint(255 * np.column_stack([self.colors, self.radii / self.radii.max()]))
        legends, ranges = [{"name": "part", "parts": [[k, name] for k, (name, *_) in self.parts.items()]}], []
        for k, field in enumerate(fields):
            values = np.concatenate([values[k] for _, _, _, values, _ in kept])
            ends = RANGE if field.least is None else (0.0, 100.0)
            low, high = np.percentile(values[np.isfinite(values)], ends) if np.isfinite(values).any() else (0.0, 1.0)
            if field.root and field.least is None:  # on both sides of 0
                low, high = -max(abs(low), abs(high)), max(abs(low), abs(high))
            low, high = low if field.least is None else field.least, high if field.most is None else field.most
            high = high if high > low else low + 1.0
            ranges.append((low, high))
            rows[1 + k] = colormaps[field.colors](np.arange(256), bytes=True)
            middle = low + 0.5 * (high - low) if not field.root else 0.0 if field.least is None else low + 0.25 * (high - low)
            beyond = ("\u2264 " * bool((values < low).any()), "", "\u2265 " * bool((values > high).any()))
            legends.append({"name": unit_systems.label(field.name, field.unit), "ticks": [[f"{sign}{value:.3g}", at] for sign, value, at in zip(beyond, (low, middle, high), (0.0, 0.5, 1.0))]})
        frames = [{**packed.pack(x, [part, *(packed.levels(v, *limits, field.root) for v, limits, field in zip(values, ranges, fields))]), "when": text}
                  for _, x, part, values, text in kept]
        return {"table": base64.b64encode(zlib.compress(rows.tobytes(), 9)).decode(), "fields": legends, "frames": frames}

    def still(self, width=500):
        """a picture of the frame first shown, cut as the view is: (rows, columns, 4) of uint8"""
        x, part = self.last
        axis = "xyz".find(self.look.cut[0])
        keep = np.ones(len(x), dtype=bool) if axis < 0 else (x[:, axis] <= 0 if self.look.cut.endswith(">") else x[:, axis] >= 0)
        basis, center = render.basis(self.look.eye, self.look.up), np.array(self.record["center"])
        half = 0.5 * np.array([self.record["wide"], self.record["high"]])
        middle = (basis @ center)[:2]
        return render.picture(x[keep], self.radii[part[keep]], self.colors[part[keep]], basis, (middle[0] - half[0], middle[0] + half[0], middle[1] - half[1], middle[1] + half[1]), width)

    def html(self, still):
        """The element of the page; still: Html shown on paper and where the scene cannot be drawn"""
        return tag("div", tag("div", still, class_="still"), _controls(), tag("template", json.dumps(self.record, separators=(",", ":"), allow_nan=False)), class_="scene")


def fitting(frames, wanted):
    """(frames that a page holds, evenly of these, with the one that is wanted; its new number): how much deflate saves is known only then"""
    while len(frames) > 1 and (size := sum(len(frame["data"]) for frame in frames)) > packed.TEXT:
        numbers = _some(len(frames), max(1, min(len(frames) - 1, int(len(frames) * packed.TEXT / size))), wanted)
        frames, wanted = [frames[k] for k in numbers], numbers.index(wanted)
    return frames, wanted


def script():
    """text of view.js"""
    return SCRIPT.read_text(encoding="utf-8")


def when(frame):
    """of a frame: its time, or its step"""
    if frame.time is None:
        return f"step {frame.step}"
    factor, unit = (1e-6, "us") if frame.units == "si" else (1.0, unit_systems.name("time", frame.units))
    return f"{frame.time / factor:.2f} {unit}"


def _some(number, most, wanted):
    """numbers of at most so many frames, evenly from the first to the last, with the one that is wanted"""
    if number <= most:
        return list(range(number))
    found = np.unique(np.rint(np.linspace(0, number - 1, most)).astype(int)) if most > 1 else np.array([wanted])
    found[np.argmin(np.abs(found - wanted))] = wanted
    return found.tolist()


def _controls():
    def axis(name):
        return tag("path", d="M0 0", fill="none", stroke="#5a6670", stroke_width="1.5") + tag("text", name, data_axis=name, text_anchor="middle", dy="4", font_size="11", fill="#1c2329")

    canvas = tag("canvas", tabindex="0", role="img", aria_label="Particles in 3D: drag or arrow keys turn, wheel, + or - zoom, drag with the shift key moves")
    axes = tag("svg", Html("".join(axis(name) for name in "xyz")), viewBox="-32 -32 64 64", class_="axes", aria_hidden="true")
    ruler = tag("div", tag("span", data_is="length"), tag("i", data_is="ruler"), class_="ruler")
    time = tag("div", tag("button", "play", data_is="play", type="button"), tag("input", type="range", min="0", value="0", step="1", aria_label="time", data_is="time"), tag("output", data_is="when"), class_="bar")
    cuts = [tag("option", "none" if way == "none" else f"hide {way}", value=way) for way in HIDES]
    choices = tag("div", tag("label", "color ", tag("select", data_is="color")), tag("label", "cut ", tag("select", *cuts, data_is="cut")),
                  tag("input", type="range", min="0", max="1000", value="500", aria_label="place of the cut", data_is="place"), tag("output", data_is="where"),
                  tag("label", tag("input", type="checkbox", checked="", data_is="mirror"), " mirror images"), tag("button", "reset", data_is="home", type="button"), class_="bar")
    return tag("div", tag("div", canvas, axes, ruler, class_="stage"), time, choices, tag("ul", class_="key", data_is="legend"), class_="live")


# ---------------------------------------------------------------------- of what
def of_run(run, bar, look=Look(cut="y >"), dump=None, more=()):
    """The View of a Run of a shield, in mm; dump: of its frames, if it is not as the run says; more: Fields beside the usual ones; the fine middle of a wall and its outer part are two parts"""
    bodies, radii, outers = run.bodies(), run.radii(), run.outers()

    def part(kind):
        name = f"{pictures.body_name(bodies[kind])}, {stem(run.materials[bodies[kind]])}"
        return name + ", outer part" * (kind in outers), pictures.color(bodies[kind]), 1e-3 * radii[kind]

    return View(dump or run.frames(), lambda frame: frame.numbers("type").astype(int), part, bar, look, more, 1e-3, "mm")


def of_dump(dump, bar, look=Look(), diameter=None, more=()):
    """The View of a Dump: parts are types; diameter: of the particles, in the units of the dump, default that of spheres of the volume of a cube of their spacing"""
    first, frame, kinds = next((one for one in dump if len(one) > 1), dump[0]), dump[look.frame], {}
    factor, unit = unit_systems.scale("distance", np.ptp(frame.x, axis=0), frame.units) if len(frame) else (1.0, "")
    radius = 0.5 * diameter if diameter else VOLUME * figures.spacing(first) or factor  # of a single particle nothing says how large it is

    def part_of(frame):
        if "type" not in frame:
            return np.full(len(frame), kinds.setdefault("particles", 0))
        names, place = np.unique(frame["type"], return_inverse=True)
        return np.array([kinds.setdefault(f"type {name}", len(kinds)) for name in names], dtype=int)[place]

    return View(dump, part_of, lambda k: (list(kinds)[k], pictures.color(k), radius), bar, look, more, factor, unit)


def page(title, view):
    """The whole text of a page with nothing but a scene, and a still picture of it"""
    stream = io.BytesIO()
    matplotlib.image.imsave(stream, view.still(), format="png")
    still = pages.image(stream.getvalue(), f"Particles at {view.record['frames'][view.record['first']]['when']}")
    head = [tag("div", tag("h1", title), tag("p", view.note), class_="words")]
    return pages.page(title, "scene-page", head, [tag("section", view.html(still))], script())
