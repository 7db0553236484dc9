# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A run of a shield as a chain of lmp calls, each from the restart file of the one before.

A restart file that was written is always read, by the next call of the chain: so a chain that was stopped has the bits of one
that was not. Where it stands is in chain.yaml, which names the last whole restart file and the one before, with their
checksums; two files are written in turn. One that is damaged is not gone on from: then the one before is.
"""

import contextlib
import math
import os
import pathlib
import warnings

import numpy as np

from ..errors import HVIError, HVIWarning
from ..io import packed
from ..jobs import engine
from . import record, script, verdict
from . import case as cases

CHAIN = "chain.yaml"
LEG = 4e8  # particle-steps between restart files: some minutes of a core
LEGS = 50  # at most
MOST = 2**31 - 1  # particles
FRAMES, BUDGET = 30, 5e8  # intervals between the frames of a film, and bytes that all frames of a run may have, where the case says nothing
ROW = 150  # bytes of a particle in a dump,
RECORD = 600  # in a restart file,
BYTES = 6100  # in memory: 8,218 MB were measured for 1.35e6 particles, of a single plate at 0.125 mm
HELD = 3000  # of a node, or a particle embedded in an element: 840 MB for 2.7e5 of these
OF_THE_CASE = 0.02  # of the energy of the projectile: a run that begins with another has another case
STEPS = 1.6  # of script.Shield.steps(), in runs of 600 to 4,000 steps
SPEED = 6e5  # particle-steps per second of a core, in the same runs


class Written:
    """The inputs of a run, as engine.Job takes an input"""

    name = script.BEGIN

    def __init__(self, shield):
        self.texts, self.copy_to = shield.texts(), shield.copy_to

    def checksum(self):
        return engine.digest("\0".join(self.texts.values()).encode())

    def reads(self, _):
        return []  # materials are among the texts, and of variables


def shield_of(case, which, shift):
    """the script.Shield of a run, with all its settings"""
    found = script.Shield(case, which, shift, {name: case.setting(name) for name in cases.SETTINGS})
    if found.particles() + found.nodes() > MOST:
        raise HVIError(f"{case.name}: spacings_mm: {case.spacings_mm[which]:g} mm makes some {found.particles():.3g} particles, more than LAMMPS can number: are lengths in mm?")
    if found.settings["film"] == 0:
        found.settings["film"] = film_of(found)
    found.settings["film"] = max(found.settings["film"], 0)
    return found


def film_of(shield):
    """us between frames where the case leaves it open: as many as the budget holds until the time that is enough, 0 if that is none; three digits, rounded up"""
    steps = min(FRAMES, int(BUDGET / (ROW * shield.particles())) - 2)  # and the frames of the begin and of the end
    if steps < 1:
        return 0
    digit = 10.0 ** math.floor(math.log10(shield.geometry.tstop_us / steps) - 2)
    return float(f"{math.ceil(shield.geometry.tstop_us / steps / digit) * digit:.3g}")


def legs(shield):
    """calls of the chain: the same for the same case, whatever the machine"""
    return max(1, min(LEGS, round((shield.particles() + shield.nodes()) * shield.steps() / LEG)))


class Job(engine.Job):
    """A run of a case in its own folder: legs from restart file to restart file, then its result"""

    def __init__(self, case, which, shift, name, folder, weight=1.0, remove=()):
        self.case, self.which, self.shift = case, which, shift
        self.shield = shield_of(case, which, shift)
        self.legs = legs(self.shield)
        self.known = {}  # (restart file, its time and size): checksum
        super().__init__(Written(self.shield), name, case.variables(which, shift), folder, remove=remove, weight=weight, made=(script.make, self.shield.files()))

    def chain(self):
        """{leg: calls that are done, file: restart file}, of the last one that is as it was written"""
        found = engine.read_yaml(self.folder / CHAIN) if self.begun() else None
        while found and not self.is_as_written(found):
            found = found.get("before")
        return found or {"leg": 0, "file": None}

    def is_as_written(self, state):
        """whether there is the restart file of a leg, and no byte of it has changed"""
        path = self.folder / str(state.get("file"))
        if not engine.inside(str(state.get("file"))) or not path.is_file():
            return False
        return state.get("checksum") in (None, self.checksum(path))

    def checksum(self, path):
        status = path.stat()
        key = path, status.st_mtime_ns, status.st_size
        if key not in self.known:
            self.known[key] = engine.checksum_of(path)
        return self.known[key]

    def restart_files(self):
        state = self.chain()
        return [self.folder / state["file"]] if state["file"] else []

    def until(self, leg):
        return self.shield.latest_us * (leg + 1) / self.legs

    def words(self):
        state = self.chain()
        leg = state["leg"]
        goes_on = ["-var", "from", state["file"]] if leg else []
        return ["-in", script.CONTINUE if leg else script.BEGIN, "-log", f"log.{leg + 1}.lammps", "-var", "until", f"{self.until(leg):.10g}", *goes_on,
                "-var", "to", f"shield.restart.{'ab'[leg % 2]}"]

    def launch(self, command, more=False):
        if not more:
            write_plan(self.shield, self.folder)
        state = self.chain()
        for path in engine.frames(self.folder, "film.*.dump"):  # of a call that was stopped; on other ranks these are not written again
            if state["leg"] and int(path.name.split(".")[1]) > state.get("step", math.inf):
                path.unlink()
        super().launch(command, more or state["leg"] > 0)

    def take(self):
        """as engine.Job; a call that went on when the front door was killed may have ended since"""
        taken = super().take()
        if not taken or not self.begun() or self.result() is not None:
            return taken
        state, written = self.chain(), engine.read_yaml(self.folder / CHAIN) or {}
        log = self.folder / f"log.{state['leg'] + 1}.lammps"
        if written.get("leg", 0) > state["leg"]:
            warnings.warn(f"{self.folder / str(written.get('file'))} is gone or damaged: the run goes on from {state['file'] or 'its beginning'}", HVIWarning, stacklevel=2)
            for path in (log, self.folder / str(written.get("file"))):  # the call that wrote it is made again
                path.unlink(missing_ok=True)
            if state["leg"]:
                engine.write_yaml(self.folder / CHAIN, state)
        elif log.is_file() and "Total wall time" in log.read_text(errors="replace")[-200:]:
            with contextlib.suppress(HVIError):  # what it has written is not there: it begins anew
                self.advance()
        return taken

    def goes_on_now(self, command):
        try:
            if not self.advance():
                self.launch(command, more=True)
                return True
        except HVIError as problem:
            print(problem)
        return False

    def advance(self):
        """after a call: True if the run is over, and its result written"""
        leg = self.chain()["leg"]
        steps, history = record.rows_of(self.folder / "history.dat")
        if history[-1, 0] >= self.until(leg) and leg + 1 < self.legs:
            file = f"shield.restart.{'ab'[leg % 2]}"
            if not engine.is_whole(self.folder / file):
                raise HVIError(f"{self.folder}: the run has written no whole {file}, from which it would go on")
            before = {key: value for key, value in self.chain().items() if key != "before"} if leg else None
            engine.write_yaml(self.folder / CHAIN, {"leg": leg + 1, "file": file, "step": int(steps[-1]), "time_us": float(history[-1, 0]),
                                                    "checksum": self.checksum(self.folder / file), "before": before})
            return False
        write_result(self.shield, self.folder)
        for path in (self.folder / CHAIN, *self.folder.glob("shield.restart.*"), *self.folder.glob("*.yaml.*.new")):  # .new: half a file of a call that was killed
            path.unlink(missing_ok=True)
        return True

    def stage(self):
        """(part of the time that is done, words on it)"""
        try:
            with open(self.folder / "output.txt", "rb") as out:
                out.seek(max(0, os.path.getsize(self.folder / "output.txt") - 20000))
                lines = [line.split() for line in out.read().decode(errors="replace").splitlines()]
            head = next(line for line in reversed(lines) if line[:2] == ["Step", "v_us"])
            us = next(float(line[1]) for line in reversed(lines) if len(line) == len(head) and line[0].isdigit())
        except (OSError, StopIteration, ValueError):
            return 0.0, ""
        return min(us / self.shield.geometry.tstop_us, 0.999), f" {us:.1f} us, enough are {self.shield.geometry.tstop_us:.1f}"


def write_plan(shield, folder):
    engine.write_yaml(pathlib.Path(folder) / "plan.yaml", plan_of(shield))


def size_of(shield):
    """about what a run takes: from geometry alone, before anything is made or read"""
    count, nodes, embedded, steps, film = shield.particles(), shield.nodes(), shield.embedded(), STEPS * shield.steps(), shield.settings["film"]
    atoms = count + nodes
    until = shield.latest_us if shield.case.setting("film") else shield.geometry.tstop_us  # those of a case go on to the end
    frames = (math.floor(until / film) + 1 if film else 0) + 1  # and shield.dump
    return {"particles": round(count), **({"nodes": round(nodes)} if nodes else {}), "steps": round(steps), "core_s": float(f"{atoms * steps / SPEED:.3g}"),
            "memory_MB": round(35 + (BYTES * (count - embedded) + HELD * (embedded + nodes)) / 1e6),
            "frames": frames, "frames_MB": round(frames * ROW * count / 1e6, 1), "frames_in_report": min(frames, packed.frames_of(count)),
            "disk_MB": round((frames * ROW * count + 4 * RECORD * atoms) / 1e6, 1)}


def plan_of(shield):
    """plan.yaml: what is run, as reports and pictures read it"""
    g, case = shield.geometry, shield.case
    found = {"dx_mm": case.spacings_mm[shield.which], "projectile_particles": round(shield.in_projectile() / shield.images), "projectile_across": round(1e-3 * case.projectile.least_mm / g.a, 1)}
    for k, (wall, of) in enumerate(zip(g.walls, case.walls), 1):
        found.update({f"wall{k}_{name}": value for name, value in {
            "particles": round(sum(shield.of_walls[k - 1][:2])), "elements": int(of.method != "sph"), "layers": wall.layers,
            "radius_mm": round(1e3 * wall.radius, 1), "middle_mm": round(1e3 * wall.middle, 1), "struck_at_mm": round(1e3 * wall.struck, 1),
            "front_mm": float(f"{1e3 * wall.front:.6g}"), "thickness_mm": float(f"{1e3 * wall.thickness:.6g}"), "spacing_mm": float(f"{1e3 * wall.spacing:.6g}"),
            **({"core_mm": float(f"{1e3 * wall.core:.6g}"), "outer_type": shield.outer_type(k)} if wall.core else {})}.items()})
    areal = [wall.thickness * rho for wall, rho in zip(g.walls, shield.rho[1:])]
    found.update({f"wall{k}_areal_density_kg_m2": round(value, 3) for k, value in enumerate(areal, 1)})
    found.update(areal_density_kg_m2=round(sum(areal), 3), **size_of(shield))
    of_run = {**shield.settings, "tstop": g.tstop_us, "quarter": "yes" if g.quarter else "no"}
    return {**found, "tstop_us": g.tstop_us, "projectile_at_the_last_wall_us": g.arrival_us, "materials": [case.material, *(wall.material for wall in case.walls)],
            "settings": {name: float(f"{value:.9g}") if isinstance(value, float) else list(value) if isinstance(value, tuple) else value for name, value in of_run.items() if value is not None}}


def write_result(shield, folder, by_hand=False):
    """result.yaml, verdict first; frames before the next wall is struck as cloudK.dump"""
    found = record.measure(shield, folder)
    if by_hand and abs(found["energy_start_J"] / shield.energy - 1) > OF_THE_CASE:
        raise HVIError(f"{folder}: the run began with {found['energy_start_J']:.4g} J, and the projectile of {script.CASE} has {shield.energy:.4g} J: it is of another case")
    said = verdict.of_run(shield, found)
    engine.write_yaml(pathlib.Path(folder) / "result.yaml", record.rounded({**said, **found}))
    clouds(found, pathlib.Path(folder))
    return found


def clouds(found, folder):
    """the last frame before the next wall is struck has the name cloudK.dump, too"""
    steps, history = record.rows_of(folder / "history.dat")
    frames = sorted((float(np.interp(int(path.name.split(".")[1]), steps, history[:, 0])), path) for path in engine.frames(folder, "film.*.dump"))
    for k in range(1, found["walls_reached"]):
        before = [path for us, path in frames if us <= found[f"wall{k}_until_us"] + 1e-6]
        if before:
            name = folder / f"cloud{k}.dump"
            name.unlink(missing_ok=True)
            os.link(before[-1], name)


def write_run(case, which, shift, folder):
    """a folder that LAMMPS alone can run: inputs, materials, meshes; the case of this run, for the verdict"""
    shield = shield_of(case, which, shift)
    check_free(shield, pathlib.Path(folder))
    shield.write(folder)
    write_plan(shield, folder)
    return shield


def check_free(shield, folder):
    """HVIError if the folder has a run, and not of this case: its numbers would be judged by the other"""
    if not any((folder / name).is_file() for name in ("walls.dat", "pieces.dat", "history.dat", "result.yaml")):
        return
    body = shield.case.projectile
    wanted = {**{name: text.encode() for name, text in shield.texts().items()}, **({pathlib.Path(path).name: pathlib.Path(path).read_bytes() for path in [shield.case.file(shield.which)]} if body.files else {})}
    for name, data in wanted.items():
        if not (folder / name).is_file() or (folder / name).read_bytes() != data:
            raise HVIError(f"{folder} has a run, and {name} there is not that of this case: remove the folder, or take another one")


def judge(folder):
    """The result of a folder of write_run(), run by hand; result.yaml is written"""
    folder = pathlib.Path(folder)
    if not (folder / script.CASE).is_file():
        raise HVIError(f"{folder} has no {script.CASE}: it is no folder of python3 -m hvi shield --write")
    case = cases.read(folder / script.CASE)
    shield = shield_of(case, 0, case.shifts[0])
    plan, now = engine.read_yaml(folder / "plan.yaml") or {}, plan_of(shield)
    for key in (key for key in now if key == "dx_mm" or key.endswith(("_front_mm", "_thickness_mm"))):
        if key in plan and abs(plan[key] - now[key]) > 1e-4 * (1 + abs(now[key])):
            raise HVIError(f"{folder}: {key} is {plan[key]:g} in plan.yaml, and {now[key]:g} by {script.CASE}: it is of another case")
    write_result(shield, folder, by_hand=True)
    return engine.read_yaml(folder / "result.yaml")
