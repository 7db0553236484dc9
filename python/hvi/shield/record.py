# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What the files of a run of in.shield say: walls.dat, pieces.dat, history.dat and the logs as the numbers of result.yaml.

Columns of walls.dat and pieces.dat are those of compute hvi/wall, a row for each wall. A run that was continued appends to
these files: rows after the restart file's step are there twice, and the later ones count.
"""

import math
import pathlib
import re
import time
import types

import numpy as np

from ..errors import HVIError, reading
from ..version import version
from . import script

WALL = """coming_mass coming_energy push momentum energy plastic_power passed_mass passed_momentum passed_energy tip failed_depth rear_strain missed_mass missed_reach
    far_free mass held_mass cloud_mass cloud_momentum cloud_energy front_velocity cloud_length cloud_diameter cloud_ratio fragments largest_mass largest_velocity pieces_apart
    largest_apart_mass apart_mass spall_mass apart_number bulge body_mass hole_found hole_diameter hole_min hole_max plane_found plane_diameter plane_x plane_y outer_strain""".split()
# units of these, in SI; all others are numbers
UNITS = {**dict.fromkeys("""coming_mass passed_mass missed_mass mass held_mass cloud_mass largest_mass largest_apart_mass apart_mass spall_mass body_mass""".split(), "kg"),
         **dict.fromkeys("momentum passed_momentum cloud_momentum".split(), "kg m/s"), **dict.fromkeys("coming_energy energy passed_energy cloud_energy".split(), "J"),
         **dict.fromkeys("front_velocity largest_velocity".split(), "m/s"), "push": "N", "plastic_power": "W",
         **dict.fromkeys("tip failed_depth missed_reach far_free cloud_length cloud_diameter bulge hole_diameter hole_min hole_max plane_diameter plane_x plane_y".split(), "m")}
OF_THE_MODEL = {"kg", "kg m/s", "J", "N", "W"}  # of a quarter model these are a quarter, except of a single piece
OF_A_PIECE = {"largest_mass", "largest_apart_mass"}
BOOK, FEM = 32, 12  # entries of compute hvi/energy, and of fix hvi/fem
ARRIVE = 6  # widest spacings before a wall, half of the gap at most: what comes so near has arrived
TOUCHED = 1e-6  # of the momentum of the projectile: what has not given a wall more has not reached it
NOTHING = 1e-99


def rows_of(path):
    """(steps (n,), values (n, columns)) of a file of fix ave/time; (n, rows, columns) of one with mode vector"""
    found, size = {}, None
    with reading(path):
        lines = [line.split() for line in pathlib.Path(path).read_text().splitlines() if line and not line.startswith("#")]
    at = 0
    while at < len(lines):
        words = lines[at]
        try:
            step = int(words[0])
            if len(words) == 2 and words[1].isdigit() and at + 1 < len(lines):  # step and number of rows
                count = int(words[1])
                block = [[float(word) for word in line[1:]] for line in lines[at + 1:at + 1 + count]]
                values = np.array(block) if len(block) == count and len({len(row) for row in block}) == 1 else None
                at += 1 + count
            else:
                values, at = np.array([float(word) for word in words[1:]]), at + 1
        except ValueError:
            values, at = None, at + 1
        if values is None or size not in (None, values.shape):
            continue  # cut off where a run was stopped
        size = values.shape
        for later in [known for known in found if known >= step]:
            del found[later]
        found[step] = values
    if not found:
        raise HVIError(f"{path} has no rows: has the run begun?")
    steps = sorted(found)
    bad = next((step for step in steps if np.isnan(found[step]).any()), None)
    if bad is not None:
        raise HVIError(f"{path}: a value at step {bad} is no number: the run has gone wrong there")
    return np.array(steps), np.array([found[step] for step in steps])


def named(table):
    """(n, walls, columns) as {name: (n, walls)}"""
    if table.ndim != 3 or table.shape[2] != len(WALL):
        raise HVIError(f"walls.dat must have {len(WALL)} columns for each wall, those of compute hvi/wall; it has {table.shape[-1]}")
    return types.SimpleNamespace(**{name: table[:, :, k] for k, name in enumerate(WALL)})


class Record:
    """The files of a run: steps and values of walls, pieces (both by name, (rows, walls)) and history (rows, columns)"""

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.steps, walls = rows_of(folder / "walls.dat")
        self.seldom, pieces = rows_of(folder / "pieces.dat")
        self.history_steps, self.history = rows_of(folder / "history.dat")
        self.walls, self.pieces = named(walls), named(pieces)
        self.us = np.interp(self.steps, self.history_steps, self.history[:, 0])
        self.seldom_us = np.interp(self.seldom, self.history_steps, self.history[:, 0])
        self.loops, self.ball, self.lammps = logs(folder)

    @property
    def time_us(self):
        return float(self.history[-1, 0])

    def book(self, k, row=-1):
        """entry k of compute hvi/energy, from 1 on"""
        return float(self.history[row, 1 + k])

    def fem(self, k, row=-1):
        """entry k of fix hvi/fem, 0: elements left; None without elements"""
        return float(self.history[row, 2 + BOOK + k]) if self.history.shape[1] > 2 + BOOK else None


def logs(folder):
    """([(seconds, ranks, particles, steps), ...] of the runs in the logs of a folder, particles of the projectile, LAMMPS's version as a number, 20250204)

    The projectile's are NaN if the log of the begin is gone.
    """
    found, ball, said = [], math.nan, ""
    for path in sorted(pathlib.Path(folder).glob("log*.lammps"), key=lambda path: float(re.sub(r"\D", "", path.name) or math.inf)):  # a part that was begun by hand is the last
        text = path.read_text(errors="replace")
        found += [(float(s), int(p), int(n), int(steps)) for s, p, steps, n in
                  re.findall(r"^Loop time of (\S+) on (\d+) procs for ([1-9]\d*) steps with (\d+) atoms", text, re.M)]
        ball = next(map(int, re.findall(r"^(\d+) atoms in group ball$", text, re.M)), ball)
        said = next(iter(re.findall(r"^LAMMPS \((\d+ \w+ \d+)", text, re.M)), said)
    return found, ball, int(time.strftime("%Y%m%d", time.strptime(said, "%d %b %Y"))) if said else 0


def measure(shield, folder):
    """The numbers of result.yaml, but for the verdict; shield: the script.Shield that was run in this folder"""
    record, g, case = Record(folder), shield.geometry, shield.case
    n, q, v0 = shield.n, shield.images, 1e3 * case.speed_km_s
    if record.walls.tip.shape[1] != n:
        raise HVIError(f"{folder}: walls.dat is of {record.walls.tip.shape[1]} walls, the case has {n}")
    columns = 2 + BOOK + (FEM if shield.elements else 0)
    if record.history.shape[1] != columns:
        raise HVIError(f"{folder}: history.dat must have {columns} columns after the step, as {script.BEGIN} of this case writes them; "
                       f"it has {record.history.shape[1]}: take a file of your own for other values")
    p, mp = record.pieces, shield.mass()
    E0, p0 = shield.energy, mp * v0
    close = [wall.front - min(ARRIVE * g.widest, 0.5 * (wall.front - before.rear)) for before, wall in zip(g.walls, g.walls[1:])]
    ends = [before_next(p, k, place, TOUCHED * p0 / q) for k, place in enumerate(close)]
    reached = next((k for k, row in enumerate(ends, 1) if row is None), n)
    beside = q * record.book(20) / mp if record.book(15) > 0 else 0.0  # left the box forward on the whole, through its sides
    found = {}
    for k in range(reached, n):
        found[f"wall{k + 1}_missed_fraction"] = max(q * float(p.missed_mass[-1, k]) / mp, beside)
        found[f"wall{k + 1}_missed_reach_mm"] = 1e3 * float(p.missed_reach[-1, k])
    for k, wall in enumerate(g.walls[:reached]):
        row = ends[k] if k < reached - 1 else -1
        at = {name: float(getattr(p, name)[row, k]) for name in WALL}
        rho, name, hold = shield.rho[k + 1], f"wall{k + 1}_", shield.hold(k + 1)
        missed = q * at["missed_mass"] / mp
        if k == n - 1:
            missed = max(missed, beside)
        found[name + "reached"] = True
        found.update({name + key: value for key, value in {
            "until_us": float(record.seldom_us[row]), "passed_mass_mg": 1e6 * q * at["cloud_mass"], "cloud_velocity_ratio": at["cloud_momentum"] / (at["cloud_mass"] + NOTHING) / v0,
            "cloud_front_velocity_ratio": at["front_velocity"] / v0, "cloud_momentum_ratio": q * at["cloud_momentum"] / p0, "cloud_energy_ratio": q * at["cloud_energy"] / E0,
            "fragments": int(at["fragments"]), "largest_fragment_mm": 1e3 * (6 * at["largest_mass"] / (math.pi * rho)) ** (1 / 3),
            "largest_fragment_mass_fraction": at["largest_mass"] / mp, "largest_fragment_velocity_m_s": at["largest_velocity"], "pieces_apart": int(at["pieces_apart"]),
            "largest_apart_mass_fraction": at["largest_apart_mass"] / mp, "momentum_N_s": q * at["momentum"], "momentum_ratio": q * at["momentum"] / p0,
            "energy_J": q * at["energy"], "energy_ratio": q * at["energy"] / E0, "spall_mass_mg": 1e6 * q * at["spall_mass"], "apart_mass_mg": 1e6 * q * at["apart_mass"],
            "apart_particles": round(at["apart_number"], 3), "layers": wall.layers, "bulge_over_thickness": at["bulge"] / wall.thickness,
            "deepest_failed_layer": math.ceil(at["failed_depth"] / wall.dz), "rear_plastic_strain": at["rear_strain"], "outer_plastic_strain": at["outer_strain"],
            "push_percent": 100 * push(record, k, g.enough_us) if k == reached - 1 else 0.0, "bulge_m_s": growth(record, k) if k == reached - 1 else 0.0,
            "plastic_percent_per_us": 100 * q * 1e-6 * at["plastic_power"] / E0,
            "converted_fraction": float((p.held_mass[0, k] - at["held_mass"]) / p.mass[0, k]), "still_to_come": q * at["coming_energy"] / E0, "missed_fraction": missed, "missed_reach_mm": 1e3 * at["missed_reach"],
            "torn": bool(hold and at["far_free"] > hold - 4 * wall.spacing)}.items()})
        found[name + "detached_spall"] = at["spall_mass"] > 0
    for k in range(1, n + 1):
        found.setdefault(f"wall{k}_reached", False)
        found.update(hole(record, k, k <= reached))
    first = {name: float(getattr(p, name)[ends[0] if reached > 1 else -1, 0]) for name in WALL}
    error = math.sqrt(sum((record.book(10 + d) + record.book(13 + d) - record.book(16 + d) - record.book(24 + d)) ** 2 for d in range(3)))
    start = math.sqrt(sum(record.book(24 + d) ** 2 for d in range(3)))
    runs_ = record.loops
    seconds, ranks = sum(s for s, *_ in runs_), max((r for _, r, *_ in runs_), default=1)
    core, logged = sum(s * r for s, r, *_ in runs_), sum(steps for *_, steps in runs_)
    elements = record.fem(0, 0)
    atoms, left = runs_[-1][2] if runs_ else 0, int(record.book(21))
    step = int(record.history_steps[-1])
    known = 1.0 if logged >= step else math.nan  # a call by hand writes over the log of the one before, unless its -log has another name
    found.update({
        "perforated": found[f"wall{n}_perforated"], "front_velocity_m_s": first["front_velocity"], "cloud_length_mm": 1e3 * first["cloud_length"],
        "cloud_diameter_mm": 1e3 * first["cloud_diameter"], "length_ratio": first["cloud_ratio"], "axial_velocity_ratio": first["front_velocity"] / v0,
        "walls": n, "walls_reached": reached, "quarter": "yes" if g.quarter else "no", "v0_m_s": v0, "dx_mm": 1e3 * g.a, "method": case.method() or "sph",
        "elements": int(elements or 0), "elements_left": int(record.fem(0) or 0), "elements_failed_without_particles": int(record.fem(9) or 0),
        "conversion_heat_ratio": q * (record.fem(7) or 0.0) / E0, "hourglass_energy_ratio": q * (record.fem(8) or 0.0) / E0,
        "projectile_particles": record.ball, "projectile_particles_planned": round(shield.in_projectile() / q),
        "particles": (matter(folder, atoms) if elements else atoms) + left, "particles_left_the_box": left, "steps": step, "time_us": record.time_us,
        "ended_by": "time" if record.time_us >= shield.latest_us else "event" if over(shield, record) else "until",
        "energy_ratio": record.book(9), "energy_missed_ratio": record.book(30) * record.book(9) / record.book(8), "energy_start_J": q * record.book(8) / record.book(9),
        "momentum_error": error / start, "momentum_left_ratio": q * record.book(15) / p0, "mass_error": (record.book(19) + record.book(20)) / record.book(27) - 1,
        "areal_density_kg_m2": round(sum(wall.thickness * rho for wall, rho in zip(g.walls, shield.rho[1:])), 3), "wall_s": round(known * seconds, 2), "ranks": ranks, "core_s": round(known * core, 1),
        "particle_steps_per_s": round(logged * (atoms + left) / max(seconds, 1e-9)),
        "lammps_version": record.lammps, "package_version": version()})
    return found


def before_next(p, k, close, least):
    """row of pieces before the cloud of wall k, from 0 on, comes close to the next wall, not that of the begin; None if nothing has reached that wall

    least: momentum of a wall that was reached
    """
    near = np.flatnonzero(p.tip[:, k] >= close)
    return max(near[0] - 1, 1) if len(near) and abs(p.momentum[near[0]:, k + 1]).max() >= least else None


def matter(folder, atoms):
    """of so many atoms those that are no nodes of elements, which are in no dump"""
    try:
        with open(pathlib.Path(folder) / "shield.dump", encoding="utf-8") as lines:
            return next(int(following) for line, following in zip(lines, lines) if line.startswith("ITEM: NUMBER OF ATOMS"))
    except (OSError, StopIteration, ValueError):
        return atoms


def over(shield, record):
    """is the event over, as v_over of the written input has it? Else the run was given an end of its own"""
    g, k, last = shield.geometry, shield.n - 1, record.pieces
    enough = record.time_us >= g.tstop_us * (1 - 1e-6)
    if last.apart_number[-1, k] >= (1 if last.hole_found[-1, k] > 0 else shield.few):
        return enough
    w, limit, rule = record.walls, shield.energy / shield.images, script.OVER
    return bool(record.time_us > g.arrival_us + g.passage_us + g.crossing_us and w.coming_energy[-1, k] < rule["share"] * w.energy[-1, k] + rule["coming"] * limit
                and push(record, k, g.enough_us) < script.STILL and abs(growth(record, k)) < script.BULGE
                and 1e-6 * w.plastic_power[-1].sum() < rule["plastic"] * limit
                and (enough or last.apart_number[-1, k] == 0 and last.hole_found[-1, k] <= 0))


def lately(record, values):
    """(change, us) of a column of one wall: the last row less the mean of a few, and the time between"""
    us, values = record.seldom_us[-script.LATELY:], values[-script.LATELY:]
    return values[-1] - values.mean(), max(us[-1] - us.mean(), NOTHING)


def push(record, k, enough_us):
    """change of the momentum of wall k (from 0 on) lately, of it, in a tenth of the time that is enough"""
    momentum = record.pieces.momentum[:, k]
    change, us = lately(record, momentum)
    return float(abs(change) / (abs(momentum[-1]) + NOTHING) * 0.1 * enough_us / us)


def growth(record, k):
    """m/s, of the bulge of wall k lately, less the velocity of all of the wall"""
    p = record.pieces
    change, us = lately(record, p.bulge[:, k])
    return float(1e6 * change / us - p.momentum[-1, k] / (p.mass[-1, k] + NOTHING))


def hole(record, k, reached):
    """of wall k, from 1 on, at the end"""
    at = {name: float(getattr(record.pieces, name)[-1, k - 1]) for name in WALL}
    known, found = at["hole_found"] >= 0 or not reached, {}
    for name, value in (("diameter", at["hole_diameter"]), ("min", at["hole_min"]), ("max", at["hole_max"])):
        found[f"hole{k}_{name}_mm"] = (1e3 * value if reached else 0.0) if known else math.nan
    found[f"hole{k}_plane_diameter_mm"] = math.nan if reached and at["plane_found"] < 0 else 1e3 * at["plane_diameter"] if reached else 0.0
    found[f"wall{k}_perforated"] = "unknown" if not known else bool(reached and at["hole_diameter"] > 0)
    return found


def rounded(found):
    """as result.yaml has it: more than nine digits are not known"""
    if isinstance(found, dict):
        return {key: rounded(value) for key, value in found.items()}
    return float(f"{value:.9g}") if isinstance(value := found, float) else value
