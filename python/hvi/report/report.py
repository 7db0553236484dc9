# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""One HTML file, with all pictures in it, of what a shield did, why, and how far that is known."""

import dataclasses
import datetime
import pathlib
import platform
import re
import shlex

import matplotlib
import numpy as np

from .. import tables
from ..errors import HVIError
from ..jobs import engine
from ..material import library
from ..material.library import stem
from ..shield import ble, calibration, decision
from ..shield.run import runs_of, texts
from ..shield.script import BEGIN
from ..version import version
from . import page as pages
from . import pictures, view
from .page import Html, items, join, section, table, tag

MARKS = {"holds": "\u2713", "fails": "\u2715", "undecided": "?"}
MEANS = {"holds": "No hole in the wall that decides, nothing has come off its rear or through it, and nothing speaks against that.",
         "fails": "The wall that decides is perforated, or something has come off its rear or through it.",
         "undecided": "The model cannot tell: the reasons say why, and what would help."}
UNKNOWN = ("spall that is still on its way: failed material inside of a wall that is not apart at the end",
           "projectiles and debris of other shapes than spheres; seams, corners, supports; pressure or heat behind the wall",
           "clouds of liquid and vapor: materials are solids, with laws of spall that hold below some 5 km/s",
           "walls before the last with few layers of particles: only the wall that decides must have three, but the cloud is that of the others",
           "debris of earlier walls (not of the projectile) that passes beside a wall",
           "finer spacings than those that were run: runs that agree may all be too coarse")
MARGINS = {"hole_mm": "diameter of the hole, mm", "apart_mass_mg": "mass that has passed and is apart, mg", "bulge_over_thickness": "bulge over thickness of the wall",
           "deepest_failed_layer": "deepest layer with failed particles, from the front", "layers": "of so many layers", "rear_plastic_strain": "largest plastic strain of the rear layer",
           "push_percent": "change of the wall's momentum at the end, percent in a tenth of the time that is enough", "bulge_m_s": "growth of the bulge at the end, m/s", "still_to_come": "energy still on its way, of that of the shot",
           "missed_fraction": "mass that passed beside a wall, over that of the projectile"}
ELEMENTS = (("conversion_heat_ratio", "energy that has become heat when elements became particles, of that of the shot", "below 1e-3"),
            ("hourglass_energy_ratio", "energy in hourglass forces of elements, of that of the shot", "below 1e-3"))
WALL = {"layers": "layers of particles", "hole_mm": "hole, mm (of the same area; least to most)", "spall_mass_mg": "detached spall, mg", "apart_mass_mg": "all that passed and is apart, mg",
        "bulge_over_thickness": "bulge over thickness", "deepest_failed_layer": "deepest failed layer", "largest_fragment_mm": "largest sound fragment behind it, mm",
        "largest_fragment_velocity_m_s": "its velocity, m/s", "momentum_ratio": "momentum given to it, of that of the shot", "energy_ratio": "energy given to it, of that of the shot",
        "cloud_velocity_ratio": "mean velocity of what passed, of that of the shot", "cloud_energy_ratio": "kinetic energy of what passed, of that of the shot"}
LEDGER = (("energy_ratio", "energy at the end and what has left, over that at the start", "1"), ("energy_missed_ratio", "energy that the time integration missed, booked", "small"),
          ("momentum_error", "error of the momentum, of that at the start", "round-off"), ("mass_error", "error of the mass", "round-off"),
          ("particles_left_the_box", "particles that left the box", ""))


def word(verdict):
    """a verdict as a word on its color"""
    return tag("span", f"{MARKS.get(verdict, '?')} {verdict}", class_=f"word {verdict if verdict in MARKS else 'undecided'}")


class Report:
    """What is said of the folder; run: the finest."""

    def __init__(self, folder):
        self.said, self.runs = runs_of(folder)
        self.run = self.runs[0]
        self.name = pathlib.Path(folder).resolve().name
        self.case = self.run.case
        self.verdict, self.reasons, self.notes = self._verdict()

    def _verdict(self):
        found = self.said or self.run.result
        if found.get("verdict") not in MARKS:
            raise HVIError(f"{self.name}: the verdict must be {', '.join(MARKS)}, not {found.get('verdict')}")
        return found["verdict"], *(texts(found, key) for key in ("reasons", "notes"))

    # ------------------------------------------------------------------ words and numbers
    def shot(self):
        case = self.case
        walls = " + ".join(f"{wall.thickness_mm:g} mm {stem(wall.material)}" for wall in case.walls)
        return (f"{case.projectile}, {stem(case.material)}, at {case.speed_km_s:g} km/s, {case.angle_deg:g} degrees from the normal, "
                f"on {walls}")

    def shot_table(self):
        """the case, as a table"""
        case = self.case
        rows = [("projectile", f"{case.projectile}, {stem(case.material)}"), ("speed", f"{case.speed_km_s:g} km/s"), ("angle", f"{case.angle_deg:g} degrees from the normal")]
        for k, wall in enumerate(case.walls, 1):
            rows += [("gap", f"{wall.gap_mm:g} mm")] if wall.gap_mm else []
            rows.append((f"wall {k}", f"{wall.thickness_mm:g} mm {stem(wall.material)}, of radius {self.run.of_wall(k, 'radius_mm'):g} mm"))
        method, result = str(self.run.result.get("method", "sph")), self.run.result
        rows += [("method", f"{method}: {float(result['elements']):g} elements at the start, {float(result['elements_left']):g} at the end; those beyond what may fail "
                  "hold no particles, and are in no picture")] if method != "sph" else []
        rows += [("energy of the shot", f"{float(self.run.result['energy_start_J']):.4g} J")] if "energy_start_J" in self.run.result else []
        rows += [("not modelled", ", ".join(case.not_modelled))] if case.not_modelled else []
        return table(("what", "value"), [*rows, ("time that was run", f"{float(self.run.result.get('time_us', 0)):.1f} us")])

    def head(self):
        return [tag("div", f"{MARKS[self.verdict]} {self.verdict}", class_="said", role="status"),
                tag("div", tag("h1", f"Does the shield hold? {self.name}"), tag("p", self.shot()), class_="words")]

    def tiles(self):
        result, last = self.run.result, self.run.reached
        hole = result.get(f"hole{last}_diameter_mm")
        cost = sum(float(run.result["core_s"]) for run in self.runs)
        errors = {"energy missing in the ledger": abs(float(result["energy_ratio"]) - 1.0), "energy missed by the time integration": abs(float(result.get("energy_missed_ratio", 0.0)))}
        worst = max(errors, key=errors.get)
        found = [("unknown" if hole is None or not np.isfinite(hole) else f"{hole:.1f} mm" if hole else "none", f"hole in wall {last}"),
                 (f"{result.get(f'wall{last}_apart_mass_mg', 0):.4g} mg", f"apart behind wall {last}"),
                 (f"{result.get(f'wall{last}_bulge_over_thickness', 0):.2f}", f"bulge over thickness of wall {last}"),
                 (f"{result.get(f'wall{last}_layers', 0):g}", f"layers of particles in wall {last}"),
                 (f"{errors[worst]:.1e}", f"{worst}, of that of the start"),
                 ("unknown" if np.isnan(cost) else engine.duration(cost), f"core time of {len(self.runs)} run{'s' * (len(self.runs) > 1)}")]
        return tag("div", *(tag("div", tag("b", value), tag("span", text), class_="tile") for value, text in found), class_="tiles")

    def summary(self, hero):
        which = (f"Pictures and numbers below are of the finest run, {self.run.name} (spacing {self.run.dx} mm), unless they say otherwise."
                 if len(self.runs) > 1 else "One run: nothing says how far the answer hangs on the spacing and the shift of the lattice. python3 -m hvi shield runs several.")
        left = [tag("p", word(self.verdict), " ", MEANS[self.verdict]), tag("h3", "Reasons"), items(self.reasons)]
        left += [tag("h3", "Notes"), items(self.notes)] if self.notes else []
        further = (self.said or {}).get("next_finer")
        if further:
            case = dataclasses.replace(self.case, shifts=tuple({run.case.shifts[0] for run in self.runs}))
            left.append(tag("p", decision.said_of_finer(case, further)))
        outside = [f"this shield has {', '.join(self.case.not_modelled)}, which is not modelled"] if self.case.not_modelled else []
        left += [tag("h3", "What the verdict cannot know"), items([*outside, *UNKNOWN]), tag("p", which, class_="note")]
        return section("Verdict", tag("div", tag("div", *left), hero, class_="two"), self.tiles())

    def margins(self):
        margins = self.run.result.get("margins") or {}
        rows = [(text, margins[key]) for key, text in MARGINS.items() if key in margins]
        decides = str(self.run.result.get("decided_by", "")).replace("wall", "wall ")
        parts = [tag("p", f"Decided by: {decides}.")] if decides else []
        if sure := (self.said or {}).get("calibration"):
            parts.append(tag("p", "How sure: ", "; ".join(line.strip() for line in calibration.said_of_verdict(sure)).removeprefix("how sure: "), "."))
        names = ["", *(f"wall {k}" for k in range(1, self.run.walls + 1))]
        return section("How near it was", *parts, table(("margin", "value"), rows), tag("h3", "Walls"), table(names, self.wall_rows(), f"{self.run.name}. Fragments are what hangs "
                       "together by sound material; momentum and energy are of all material of the wall."))

    def wall_rows(self):
        result, rows = self.run.result, []
        for key, text in WALL.items():
            row = [text]
            for k in range(1, self.run.walls + 1):
                if key == "hole_mm":
                    of = [result.get(f"hole{k}_{what}") for what in ("diameter_mm", "min_mm", "max_mm")]
                    row.append("not reached" if k > self.run.reached else "none" if not of[0] else "unknown" if not np.isfinite(of[0]) else f"{of[0]:.4g} ({of[1]:.4g} to {of[2]:.4g})")
                else:
                    row.append(tables.number(result.get(f"wall{k}_{key}", "-")))
            rows.append(row)
        return rows

    def equations(self):
        """of verdict.yaml, or of the case of the run"""
        found = (self.said or {}).get("equations") or ble.beside(ble.predictions, self.case)
        titles = {name: f"{equation.title} [{equation.source}]" for name, equation in ble.EQUATIONS.items()}
        if isinstance(found, str):
            return section("Ballistic-limit equations", tag("p", found))
        rows = [(f"{name}: {titles[name]}" if name in titles else name, of["critical_diameter_mm"], of["d_over_critical"], word(of["predicted"]), "; ".join(of["outside"]) or "-")
                for name, of in found.items()]
        return section("Ballistic-limit equations", tag("p", f"What the equations of engineers say of a sphere of {self.case.diameter_mm:.4g} mm, beside the simulation: ", word(self.verdict)),
                        table(("equation", "critical diameter, mm", "projectile over it", "says", "outside of its range of validity"), rows), tag("p", "Sources in brackets: Howto_ble.", class_="note"))

    def all_runs(self):
        keys = ["verdict", *(f"hole{k}_diameter_mm" for k in range(1, self.run.walls + 1)), f"wall{self.run.walls}_spall_mass_mg", f"wall{self.run.walls}_apart_mass_mg", "particles", "steps",
                "time_us", "core_s"]
        rows = [(run.name, run.dx, run.case.shifts[0], word(run.result["verdict"]), *("unknown" if (value := run.result.get(key, "-")) != value else value for key in keys[1:])) for run in self.runs]
        return table(("run", "spacing mm", "shift", "verdict", *(key.replace("_diameter_mm", " mm").replace("_mass_mg", " mg").replace("_", " ") for key in keys[1:])), rows, class_="short")

    def numerics(self):
        run, plan = self.run, self.run.plan
        rows = [("projectile", stem(run.materials[0]), str(self.case.projectile), run.dx, f"{plan['projectile_across']:g} across", int(plan["projectile_particles"]))]
        rows += [(f"wall {k}", stem(run.materials[k]), f"{run.of_wall(k, 'thickness_mm'):g}", float(run.of_wall(k, "spacing_mm")), f"{run.of_wall(k, 'layers'):g} layers",
                  int(run.of_wall(k, "particles"))) for k in range(1, run.walls + 1)]
        model = "a quarter: mirror planes at x = 0 and y = 0; the pictures show the whole" if str(run.settings["quarter"]) == "yes" else "the whole"
        ledger = [(text, str(run.result[key]), should) for key, text, should in (*LEDGER, *(ELEMENTS if run.case.method() else ())) if key in run.result]
        several = [tag("h3", "All runs"), self.all_runs()] if len(self.runs) > 1 else []
        return section("Resolution and ledger", table(("body", "material", "thickness mm", "spacing mm", "particles through it", "particles"), rows, f"Modelled is {model}. "
                       "A wall that decides needs three layers."), tag("h3", "Ledger"), table(("what", "value", "should be"), ledger), *several)

    def materials(self):
        parts, rows = [], []
        for name in dict.fromkeys(self.run.materials):
            path = next((p for p in (library.of_case(name), self.run.folder / pathlib.Path(name).name) if p.is_file()), None)
            used = ", ".join(pictures.body_name(k) for k, material in enumerate(self.run.materials) if material == name)
            if path is None:
                rows.append((stem(name), used, "the file is not there any more"))
                continue
            text = path.read_text(errors="replace")
            was = self.run.job.get("files", {}).get(name)
            changed = was and was != engine.digest(path.read_bytes())
            laws = re.findall(r"^(eos|strength|damage|spall)\s+(\S+)", text, re.M)
            rows.append((stem(name), used, "; ".join(f"{kind}: {', '.join(law for k, law in laws if k == kind)}" for kind in dict.fromkeys(kind for kind, _ in laws))
                         + ("; HAS CHANGED since the run" if changed else "")))
            header = "\n".join(line.lstrip("#").removeprefix(" ") for line in re.match(r"(?:[ \t]*(?:#.*)?\n)*", text)[0].rstrip().split("\n"))
            parts += [tag("h3", stem(name)), tag("pre", header, class_="wrap")]
        return section("Materials and their sources", table(("material", "of", "laws in the file (which of them are used: settings, solid)"), rows), *parts)

    def settings(self):
        given = self.case.settings
        rows = [(name, Html(tag("span", engine.cell(value))), "given" if name in given else "default or derived") for name, value in sorted(self.run.settings.items())]
        return section("Settings", table(("setting", "value", ""), rows, f"All of {self.run.name}; what they mean: Howto_front."))

    def repeat(self):
        result = self.run.result
        single = shlex.join(["mpirun", "-np", str(result["ranks"]), "lmp", "-in", BEGIN]) + " && python3 -m hvi judge ."
        parts = []
        if self.said and self.said.get("command"):
            parts += [tag("p", "All of it, as it was typed:"), tag("pre", self.said["command"], class_="wrap")]
        case = self.run.folder.parent / "case.yaml"
        if self.said and case.is_file():
            parts += [tag("p", "The case:"), tag("pre", case.read_text(errors="replace"), class_="wrap")]
        parts += [tag("p", f"The run {self.run.name} alone, in its folder, which has all that it needs:"), tag("pre", single, class_="wrap")]
        rows = [("LAMMPS", result["lammps_version"]), ("USER-HVI that ran", result["package_version"]), ("lammps-hvi that made this report", version()),
                ("Python, NumPy, matplotlib", f"{platform.python_version()}, {np.__version__}, {matplotlib.__version__}")]
        rows = [(name, str(value)) for name, value in rows]
        return section("Repeat it", *parts, tag("h3", "Versions"), table(("what", "version"), rows))

    # ------------------------------------------------------------------ pictures
    def key(self, scene):
        return tag("ul", *(tag("li", tag("i", style="background:" + matplotlib.colors.to_hex(pictures.color(k))), f"{pictures.body_name(k)}, {stem(self.run.materials[k])}")
                           for k in range(int(scene.body.max()) + 1)), class_="key")

    def scale_note(self):
        walls = ", ".join(f"{float(self.run.of_wall(k, 'spacing_mm')):g} mm in wall {k}" for k in range(1, self.run.walls + 1))
        return f"Each particle is a sphere of its volume; spacing {self.run.dx:g} mm in the projectile, {walls}."

    def images(self, bar):
        """(hero, sections) with all pictures"""
        run, dpi = self.run, pictures.DPI

        def picture(figure, alt, caption="", **how):
            bar.update()
            return pages.picture(figure, alt, caption, dpi, **how)

        film = run.film()
        end, window = film[-1], pictures.side_window(run)
        hero = picture(pictures.oblique(run, end), f"The shield at {end.time:.1f} microseconds, cut open by a quarter", join([tag("b", f"{end.time:.1f} us."), " A quarter is cut out; the shot "
                       "came from the left."]), class_="tall")
        sketch = picture(pictures.sketch(run, self.case), "Sketch to scale: path of the projectile, walls, gaps, and what is struck", "What was run, to scale.", class_="tall")
        deep = max(float(run.of_wall(k, "radius_mm")) for k in range(1, run.walls + 1))
        note = f"All at one scale and in one frame; the half in front of the plane y = 0 is cut away, what is behind it is up to {deep:.0f} mm deep. What has flown out of the frame is not shown."
        side = [picture(pictures.side(run, scene, window), f"Side view at {scene.time:.1f} microseconds", join([tag("b", f"{scene.time:.1f} us")])) for scene in film]
        cloud = run.scene(f"cloud{run.reached - 1}.dump") if run.reached > 1 else None
        moments = [scene for scene in (cloud, end) if scene is not None]
        fast = [picture(pictures.velocities(run, scene, window, bar=True), f"Speeds at {scene.time:.1f} microseconds", join([tag("b", f"{scene.time:.1f} us"), ", colored by speed, one scale."]))
                for scene in moments]
        if cloud is not None:
            fast.append(picture(pictures.phase(cloud, run, run.reached - 1), "Mass over position and axial velocity of the cloud",
                                join([tag("b", f"{cloud.time:.1f} us"), f": mass over place and axial velocity of all behind wall {run.reached - 1}."]), class_="mid"))
        found = [section("What was run", tag("div", self.shot_table(), sketch, class_="two")), section("Side view in time", self.key(end), tag("div", *side, class_="row"), tag("p", f"{self.scale_note()} {note} Dashed: walls that nothing has reached yet.",
                 class_="note")), section("Speeds", tag("div", *fast[:len(moments)], class_="row pair"), tag("p", note, class_="note"), *fast[len(moments):])]
        walls = [self.key(end)]
        for k in range(1, run.reached + 1):
            near = f"Shown is what is no farther from it than its bulge is high, at {end.time:.1f} us; other walls are left out."
            walls += [tag("h3", f"Wall {k}"), tag("div", *(picture(pictures.face(run, end, k, rear), f"Wall {k} from {'behind' if rear else 'the front'}", join([
                tag("b", "rear" if rear else "front"), ". ", near])) for rear in (False, True)), class_="row pair")]
        walls += [tag("p", "Dashed circle: a hole of the same area and center as that of compute hvi/hole. Both faces of a wall have one scale.", class_="note"), tag("h3", f"Bulge of wall {run.reached}"),
                  picture(pictures.profile(run, end, run.reached), f"Slice through wall {run.reached}",
                          f"A slice of {pictures.slice_of(run, run.reached):.3g} mm about y = 0 at {end.time:.1f} us, struck from below. Dark: what has come off the wall. Dotted: its faces before.")]
        found.append(section("Walls", *walls))
        struck = []
        for k in range(2, run.reached + 1):
            scene = run.scene(f"cloud{k - 1}.dump")
            if scene is None:
                continue
            z, v = scene.whole["z"], scene.whole["vz"]
            if not ((z > 1e-3 * run.faces(k - 1)[1]) & (z < 1e-3 * run.faces(k)[0]) & (v > 0)).any():  # a coarse film
                struck.append(tag("p", f"Wall {k}: no picture. The last frame before it is struck is of {scene.time:.1f} us, when nothing was behind wall {k - 1}; "
                                       "take more frames, settings: {film: us between them}.", class_="note"))
            else:
                figure, summary = pictures.witness(run, scene, k)
                struck.append(picture(figure, f"Momentum and energy per area on the plane of wall {k}", join([tag("b", f"Plane of wall {k}."), f" What is on its way at {scene.time:.1f} us, flying on "
                              f"freely: {1e6 * summary['mass']:.4g} mg, {summary['momentum']:.4g} kg m/s, {summary['kinetic_energy']:.4g} J, half of the energy within "
                              f"{1e3 * summary['radius_of_half_the_energy']:.3g} mm of the axis."]), class_="mid"))
        return hero, [*found, *([section("Where the cloud strikes", *struck)] if struck else [])]

    def scene(self, bar):
        """all frames, to be turned"""
        found = view.of_run(self.run, bar)
        still = tag("p", "The picture beside the verdict is of this scene. Here it can be turned, cut and gone through in time, in a browser that runs scripts and has WebGL 2.", class_="note")
        note = f"{found.note} Drag to turn it, after a click the wheel zooms; drag with the shift key to move it. {self.scale_note()}"
        return section("Scene in 3D", found.html(still), tag("p", note, class_="note"))

    def html(self, bar):
        hero, drawn = self.images(bar)
        sections = [self.summary(hero), self.scene(bar), *drawn, self.margins(), self.equations(), self.numerics(), self.materials(), self.settings(), self.repeat(),
                    tag("footer", f"Made {datetime.date.today().isoformat()} by python3 -m hvi report, lammps-hvi {version()}. No part of this page is loaded from elsewhere.")]
        return pages.page(f"{self.name}: {self.verdict}", self.verdict, self.head(), sections, view.script())
