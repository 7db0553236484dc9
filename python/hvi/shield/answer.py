# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Answers: verdict, limits and curves of a case, read from its folder, for notebooks and for shields side by side."""

import dataclasses
import math
import pathlib
import warnings

from ..errors import HVIError, needed
from ..jobs import engine
from ..material import library
from . import case as cases
from . import decision, quantity
from .run import runs_of, texts

NOT_RUN = "not run"
MARGINS = ("hole_mm", "apart_mass_mg", "bulge_over_thickness", "deepest_failed_layer", "layers", "rear_plastic_strain")  # of a run; the largest is the worst, layers are the same in all of a spacing


@dataclasses.dataclass(frozen=True)
class Answer:
    """The answer on a case, as its folder has it.

    name: of the case; folder: pathlib.Path; case: hvi.shield.case.Case, its lengths in mm, its speed in km/s
    verdict: holds, fails, undecided, or "not run"; reasons, notes: tuples of texts
    runs: tuple of hvi.shield.run.Run, the finest first
    said: mapping of verdict.yaml, {} if there is none
    limits, curves: {folder: mapping of limit.yaml or curve.yaml} of those that were searched with the values of this case
    left_out: names of folders with limits and curves of other values, or of an older version
    """

    name: str
    folder: pathlib.Path
    case: cases.Case
    verdict: str
    reasons: tuple = ()
    notes: tuple = ()
    runs: tuple = ()
    said: dict = dataclasses.field(default_factory=dict)
    limits: dict = dataclasses.field(default_factory=dict)
    curves: dict = dataclasses.field(default_factory=dict)
    left_out: tuple = ()

    def __repr__(self):
        return "\n".join([f"{self.name}: {self.verdict}", *(f"  - {text}" for text in self.reasons), *(f"  note: {text}" for text in self.notes)])

    @property
    def areal_densities(self):
        """kg/m^2 of each wall, a list"""
        return [1e-3 * wall.thickness_mm * library.density_of(library.of_case(wall.material), si=True)[0] for wall in self.case.walls]

    @property
    def core_s(self):
        """core-seconds of the runs of the verdict; 0 without"""
        return sum(float(run.result.get("core_s", 0)) for run in self.runs)

    @property
    def search_core_s(self):
        """core-seconds of the searches of limits and curves; 0 without"""
        return sum(float(found.get("core_s", 0)) for found in (*self.limits.values(), *self.curves.values()))

    @property
    def margins(self):
        """{name: the worst of the finest runs, over shifts of the lattice}: hole_mm, apart_mass_mg, bulge_over_thickness, deepest_failed_layer of layers, rear_plastic_strain; NaN: a hole that is
        not known, {} without runs"""
        finest = [run.result.get("margins") or {} for run in self.runs if run.dx == self.runs[0].dx]
        values = {key: [float(margins[key]) for margins in finest if key in margins] for key in MARGINS}
        return {key: math.nan if any(map(math.isnan, found)) else max(found) for key, found in values.items() if found}

    def dataframe(self):
        """A pandas.DataFrame with a row per run, index its name, coarse first: spacing_mm, shift, and all numbers of result.yaml; units are in the names.

        HVIError if pandas is not there.
        """
        pandas = needed("pandas", "dataframe() needs")
        rows = {run.name: {"spacing_mm": run.dx, "shift": run.case.shifts[0], **{key: value for key, value in run.result.items() if not isinstance(value, (list, dict))}}
                for run in reversed(self.runs)}
        return pandas.DataFrame.from_dict(rows, orient="index").rename_axis("run")


def state_of(mapping):
    """a mapping of Case.mapping() without what changes no answer: frames, the order of shifts, and names of files of the projectile, whose checksums are compared"""
    body = {key: value for key, value in mapping.get("projectile", {}).items() if key != "file"}
    settings = {key: value for key, value in mapping.get("settings", {}).items() if key != "film"}
    return {**mapping, "projectile": body, "settings": settings, "shifts": sorted(mapping.get("shifts", []))}


def is_of(case, mapping, files):
    """is the case that of a Case.mapping(), and are all its files among those Case.checksums()? A run has one of the particle files of its case"""
    return state_of(case.mapping()) == state_of(mapping) and case.checksums().items() <= files.items()


def whole(runs, name):
    """the Case of all these runs"""
    of = {run.dx: run.case for run in sorted(runs, key=lambda run: -run.dx)}
    first = runs[0].case
    walls = tuple(dataclasses.replace(wall, spacings_mm=wall.spacings_mm and tuple(case.walls[k].spacings_mm[0] for case in of.values()))
                  for k, wall in enumerate(first.walls))
    return dataclasses.replace(first, name=name, walls=walls, spacings_mm=tuple(of), shifts=tuple(sorted({run.case.shifts[0] for run in runs})))


def are_all_of(runs, case):
    """are these the runs of a case, those of all its spacings and shifts and no others?"""
    members = {(case.spacings_mm[which], shift): case.one(which, shift).mapping() for which, shift in decision.members(case)}
    each, files = {(run.dx, run.case.shifts[0]): run.case for run in runs}, case.checksums()
    return members.keys() == each.keys() and all(is_of(of, members[key], files) for key, of in each.items())


def searched(folder, kind, case):
    """({folder: mapping} of kind.yaml in the folders kind-* that are of this case and its files, [names of those that are not, or of an older version that does not say])"""
    found, other = {}, []
    for path in sorted(folder.glob(f"{kind}-*/{kind}.yaml")):
        mapping = engine.read_yaml(path) or {}
        if all(isinstance(mapping.get(key), dict) for key in ("case", "files")) and is_of(case, mapping["case"], mapping["files"]):
            found[path.parent.name] = mapping
        else:
            other.append(path.parent.name)
    return found, other


def is_case(path):
    """is it a case of hvi shield, and no other YAML?"""
    path = pathlib.Path(path)
    return path.suffix in (".yaml", ".yml") and path.is_file() and isinstance((engine.read_yaml(path) or {}).get("walls"), list)


def is_folder(path):
    """is it a folder of a case, as hvi shield, limit and curve make it?"""
    path = pathlib.Path(path)
    return path.is_dir() and ((path / "verdict.yaml").is_file() or any(path.glob("limit-*/limit.yaml")) or any(path.glob("curve-*/curve.yaml")))


def read(path, runs="runs"):
    """The Answer of a folder runs/CASE, or of a case whose folder is in runs, if anything was run.

    path: the folder, or CASE.yaml. HVIError: neither, or the folder is of another state of the case.
    """
    path, case = pathlib.Path(path), None
    if not path.exists():
        raise HVIError(f"{path} does not exist")
    folder = path
    if not path.is_dir():
        with warnings.catch_warnings():  # what they say is said where it is run
            warnings.simplefilter("ignore")
            case = cases.read(path)
        folder = pathlib.Path(runs) / case.name
    elif not is_folder(path):
        raise HVIError(f"{path} is no folder of python3 -m hvi shield, limit or curve: it has no verdict.yaml, limit.yaml or curve.yaml")
    said, found = runs_of(folder) if (folder / "verdict.yaml").is_file() else ({}, [])
    if case is None:
        if not found:
            raise HVIError(f"{folder} has limits or curves only: give the case itself, CASE.yaml, and --runs {folder.parent}")
        case = whole(found, folder.resolve().name)
    elif found and not are_all_of(found, case):
        raise HVIError(f"{folder} is of another state of {path} (its runs are {', '.join(run.name for run in found)}), or of files that it names: "
                       f"call python3 -m hvi shield {path} again, or give the folder itself")
    limits, curves = (searched(folder, kind, case) for kind in ("limit", "curve"))
    return Answer(case.name, folder, case, str(said.get("verdict", NOT_RUN)), tuple(texts(said, "reasons")), tuple(texts(said, "notes")), tuple(found), said, limits[0], curves[0],
                  tuple(limits[1] + curves[1]))


# ---------------------------------------------------------------------- side by side
def roles(n, most):
    """of n walls among shields of at most so many: bumper, intermediate1, ..., rear; the last wall is the rear, the first of several the bumper"""
    if n == 1:
        return ["rear"]
    between = ["intermediate"] if most == 3 else [f"intermediate{k}" for k in range(1, n - 1)]
    return ["bumper", *between[:n - 2], "rear"]


def by_role(word, case, most):
    """a quantity by the role of its wall: thickness2 of two walls is the rear, gap2 the rear_gap; others as they are"""
    of = quantity.find(case, word, "limit")
    if of.wall is None:
        return word
    return roles(len(case.walls), most)[of.wall] + ("_gap" if of.key == "gap_mm" else "")


def over_limit(found):
    """how far the case is on the safe side, 1 or more where all runs hold: a wall over the least that holds in all of them, the largest diameter that does over the diameter; None without a limit"""
    if found.get("limit") is None or not found.get("own"):
        return None
    side, _, edge = found["holds"].rpartition(" ")
    return found["own"] / float(edge) if side == "from" else float(edge) / found["own"]


def row(answer, most):
    """{name with unit: value} of a shield, for a table of several with at most so many walls"""
    case = answer.case
    found = {"verdict": answer.verdict}
    if answer.runs:
        decides = str(answer.runs[0].result.get("decided_by", "")).removeprefix("wall")
        found["decided_by"] = roles(len(case.walls), most)[int(decides) - 1] if decides.isdigit() else "none"
    found.update(answer.margins)
    for limit in answer.limits.values():
        name = by_role(limit["varied"], case, most)
        unit = limit["unit"].replace("/", "_").replace("degrees", "deg")
        found.update({f"limit_{name}_{unit}": "not found" if limit["limit"] is None else limit["limit"], f"limit_{name}_holds": limit.get("holds"), f"limit_{name}_fails": limit.get("fails"),
                      f"limit_{name}_spacing_mm": min(limit["case"]["spacings_mm"]), f"over_limit_{name}": over_limit(limit)})
    if answer.runs:
        found["spacing_mm"] = answer.runs[0].dx
    found.update(areal_density_kg_m2=round(sum(answer.areal_densities), 3), runs=len(answer.runs), core_s=round(answer.core_s, 1), search_core_s=round(answer.search_core_s, 1),
                 projectile=str(case.projectile), projectile_material=library.stem(case.material), speed_km_s=case.speed_km_s, angle_deg=case.angle_deg)
    for role, wall, density in zip(roles(len(case.walls), most), case.walls, answer.areal_densities):
        found.update({f"{role}_gap_mm": wall.gap_mm, f"{role}_mm": wall.thickness_mm, f"{role}_material": library.stem(wall.material), f"{role}_kg_m2": round(density, 3)})
    return {name: value for name, value in found.items() if value is not None}


def side_by_side(answers):
    """(names, [row(), ...]) of several shields: every name that any of them has, walls in the order that they are struck"""
    most = max(len(answer.case.walls) for answer in answers)
    rows = [row(answer, most) for answer in answers]
    walls = [f"{role}_{what}" for role in roles(most, most) for what in ("gap_mm", "mm", "material", "kg_m2")]
    names = list(dict.fromkeys(name for found in rows for name in found if name not in walls))
    verdict = [name for name in names if name in ("verdict", "decided_by", *MARGINS)]
    limits = [name for name in names if name.startswith(("limit_", "over_limit_"))]
    rest = [name for name in names if name not in (*verdict, *limits)]
    return [*verdict, *limits, *rest, *(name for name in walls if any(name in found for found in rows))], rows


def bars_of(answers):
    """[(name, verdict, {role: kg/m^2}), ...]"""
    most = max(len(answer.case.walls) for answer in answers)
    rows = [(answer.name, answer.verdict, dict(zip(roles(len(answer.case.walls), most), answer.areal_densities))) for answer in answers]
    order = [role for role in roles(most, most) if any(role in walls for *_, walls in rows)]
    return [(name, verdict, {role: walls.get(role, 0.0) for role in order}) for name, verdict, walls in rows]


def curves_of(answers):
    """{(label of the axis, label of the limit): [(name of the shield, [(value, limit, low, high), ...]), ...]} of all curves, those alike together"""
    most, found = max(len(answer.case.walls) for answer in answers), {}
    for answer in answers:
        for curve in answer.curves.values():
            over = next(of for of in (quantity.find(answer.case, word, "curve") for word in quantity.words(answer.case)) if of.name == curve["over"])
            what = "critical diameter" if curve["on"] == "D" else f"limit on {by_role(curve['on'], answer.case, most).replace('_', ' ')}"
            points = [(point[over.name], point["limit"], point["low"], point["high"]) for point in curve["points"] if "limit" in point]
            if points:
                found.setdefault((f"{by_role(over.word, answer.case, most).replace('_', ' ')} ({over.unit})", f"{what} ({curve['unit']})"), []).append((answer.name, points))
    return found
