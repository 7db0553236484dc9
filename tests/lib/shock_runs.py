"""Runs a scene of shock_scenes.py in LAMMPS and measures what came out."""

import dataclasses
import os
import pathlib
import re
import subprocess

import numpy as np
from dumps import named, read_dump
from lammps_runs import alone
from shock_scenes import COURANT, ETA, KERNEL, METHODS, Blasts

STOCK_ROWS, STOCK_H, STOCK_ALPHA = 8, 4.0, 0.75  # its own example's: examples/PACKAGES/sph/shock_tube


def cannot(case, method):
    """why a method cannot do a case, '' if it can"""
    if method == "stock" and case.gamma != 1.4:
        return "the package SPH has a gas with gamma 1.4 only" if case.gamma else "the package SPH has neither law of these materials"
    return ""


def known(lmp, method, folder):
    """whether this LAMMPS knows the method's pair_style"""
    if METHODS[method] is None:
        return True
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    text = ("units lj\natom_style sph\nregion b block 0 1 0 1 0 1\ncreate_box 1 b\n"
            f"pair_style hvi/sph {KERNEL} {METHODS[method]}\n")
    (folder / "in.known").write_text(text)
    done = subprocess.run([str(lmp), "-in", "in.known", "-log", "none"], cwd=folder, capture_output=True, text=True)
    return done.returncode == 0


def columns(scene, rows, dx):
    """the row as a strip of `rows` rows, for stock SPH which has no row: particles with their mass per area"""
    k = len(scene.x)
    x = np.repeat(scene.x, rows, axis=0)
    x[:, 1] = np.tile((np.arange(rows) - 0.5 * (rows - 1)) * dx, k)
    rep = lambda a: np.repeat(a, rows, axis=0)  # noqa: E731
    box = np.array([scene.box[0], [-0.5 * rows * dx, 0.5 * rows * dx], [-0.5 * dx, 0.5 * dx]])
    return dataclasses.replace(scene, x=x, v=rep(scene.v), rho=rep(scene.rho), e=rep(scene.e), type=rep(scene.type),
                               mass=[m * dx for m in scene.mass], box=box, periodic="ppp")


def write_data(scene, path):
    n = len(scene.x)
    head = ["shock", "", f"{n} atoms", f"{len(scene.mass)} atom types", ""]
    head += [f"{lo:.17g} {hi:.17g} {'xyz'[a]}lo {'xyz'[a]}hi" for a, (lo, hi) in enumerate(scene.box)]
    head += ["", "Masses", ""] + [f"{t + 1} {m:.17g}" for t, m in enumerate(scene.mass)] + ["", "Atoms # sph", ""]
    energy = np.array(scene.mass)[scene.type - 1] * scene.e
    with open(path, "w") as f:
        f.write("\n".join(head) + "\n")
        for i in range(n):
            x = scene.x[i]
            f.write(f"{i + 1} {scene.type[i]} {scene.rho[i]:.17g} {energy[i]:.17g} 1 {x[0]:.17g} {x[1]:.17g} {x[2]:.17g}\n")
        f.write("\nVelocities\n\n")
        for i in range(n):
            f.write("%d %.17g %.17g %.17g\n" % (i + 1, *scene.v[i]))


def octant(scene):
    """the part of a scene about the origin where x, y, z > 0, between mirrors"""
    here = (scene.x > 0).all(axis=1)
    parts = {k: getattr(scene, k)[here] for k in ("x", "v", "rho", "e", "type")}
    box = scene.box.copy()
    box[:, 0] = 0.0
    return dataclasses.replace(scene, **parts, box=box, periodic=["f" + b for b in scene.periodic], mirror=[], measured=np.arange(here.sum()))


def script(case, scene, method, n, words=None, kernel=KERNEL, courant=COURANT, skin=0.3, variable=True, mirrors=False):
    """LAMMPS input: data file `data`, frames frame.0, frame.1, ...

    words: of the pair style, in place of the method's; skin in units of the least h; variable: h follows the density; mirrors: of an octant
    """
    flat = case.dim == 2 or method == "stock"
    lines = [f"units {scene.units}", f"dimension {2 if flat else 3}", f"boundary {' '.join(scene.periodic)}", "atom_style sph",
             "atom_modify map array"]
    if case.dim == 1 and method != "stock":
        lines.append("processors * 1 1")
    lines.append("read_data data")
    if method == "stock":
        reach = STOCK_H * scene.spacing
        lines += ["pair_style hybrid/overlay sph/rhosum 1 sph/idealgas", f"pair_coeff * * sph/rhosum {reach:.17g}",
                  f"pair_coeff * * sph/idealgas {STOCK_ALPHA} {reach:.17g}", "fix move all sph", "fix flat all setforce NULL 0.0 0.0"]
    else:
        lo, hi = case.hlimits()
        follow = f"variable {lo:.6g} {hi:.6g}" if variable else "constant"
        planes = " mirror x 0 lo mirror y 0 lo mirror z 0 lo" if mirrors else ""
        lines.append(f"pair_style hvi/sph {kernel} dim {case.dim} {words or METHODS[method]} h {follow}{planes}")
        lines += [f"pair_coeff {t + 1} {t + 1} eos {eos} h {h:.17g}" for t, (eos, h) in enumerate(zip(scene.eos, scene.h))]
        if scene.tension:
            k = len(scene.mass)
            lines += [f"pair_coeff {a} {b} tension yes" for a in range(1, k) for b in range(a + 1, k + 1)]
        lines.append("fix move all hvi/sph")
    lines += [f"neighbor {skin * min(scene.h):.17g} bin", "neigh_modify every 1 delay 0 check yes one 10000", "compute book all hvi/energy",
              "compute s all property/atom rho esph"]
    if method != "stock":
        lines.append("compute p all hvi/atom p")
    lines += ["thermo 10", "thermo_style custom step time dt c_book[1] c_book[2] c_book[8] c_book[9] c_book[10] c_book[11] c_book[12] c_book[28]",
              "thermo_modify format float %.16g"]
    frame = f"id x y z vx vy vz c_s[1] c_s[2]{'' if method == 'stock' else ' c_p'}"
    for k, t in enumerate(case.times):
        if method == "stock":
            steps = int(np.ceil(t / stock_step(case, n)))
            lines += [f"timestep {t / steps:.17g}", "run 0", f"run {steps}"]
        else:
            lines += [f"fix step all hvi/dt {courant}", f"variable left equal {t:.17g}-time-4*dt",
                      "fix halt all halt 1 v_left < 0.0 error continue message no", "run 100000000", "unfix halt", "unfix step",
                      f"variable rest equal ceil(({t:.17g}-time)/dt-1e-9)", "variable count equal ${rest}",
                      f"timestep $(({t:.17g}-time)/v_count)", "run ${count}"]
        lines.append(f"write_dump all custom frame.{k} {frame} modify sort id format float %.17g")
    return "\n".join(lines) + "\n"


def stock_step(case, n):
    """a fixed step, as stock has no other: that of fix hvi/dt for the fastest signal in the exact solution and in the start"""
    m, x, rho, u, p = case.profile(case.times[-1])
    scene = case.scene(n, "stock")
    c = max(np.sqrt(1.4 * p / rho).max(), np.sqrt(1.4 * 0.4 * scene.e).max())
    if isinstance(case, Blasts):
        c = max(c, np.sqrt(1.4 * 2000 / 6))  # where the blasts meet
    return COURANT * 0.5 * STOCK_H * scene.spacing / ((1 + 0.6 * STOCK_ALPHA) * c + np.ptp(u))


@dataclasses.dataclass
class Outcome:
    """of one run; l1, numbers: dicts; energy: largest |total/initial - 1|; momentum: largest |sum - initial| / largest sum of |p_i|;
    symmetry: largest difference of mirror images: positions in spacings, rho relative"""

    case: str
    method: str
    n: int
    particles: int = 0
    steps: int = 0
    seconds: float = 0.0
    l1: dict = dataclasses.field(default_factory=dict)
    numbers: dict = dataclasses.field(default_factory=dict)
    energy: float = np.nan
    momentum: float = np.nan
    symmetry: float = np.nan
    error: str = ""
    picture: tuple = ()


def read_frame(path, mass):
    f = named(read_dump(path), s="rho e")
    e = f["e"] / mass
    return dict(x=f["x"], v=f["v"], rho=f["rho"], e=e, p=f.get("c_p", 0.4 * f["rho"] * e))


def read_log(text):
    """thermo rows, seconds on a core (the machine may have other things to do: its share of the loops' time), steps"""
    rows, loops, last, steps, reading = [], 0.0, 0.0, 0, False
    for line in text.splitlines():
        w = line.split()
        if w[:2] == ["Step", "Time"]:
            reading = True
        elif line.startswith("Loop time"):
            last, steps, reading = float(w[3]), steps + int(w[8]), False
        elif "% CPU use with" in line:
            loops += last * float(w[0].rstrip("%")) / 100
        elif reading and len(w) == 11:
            try:
                rows.append([float(a) for a in w])
            except ValueError:
                pass
    return np.array(rows), loops, steps


def prepared(case, method, n, mirrors=False):
    """the row, lattice or strip that LAMMPS gets; the scene it stands for; the strip's number of rows, 1 for others"""
    scene = octant(case.scene(n, method)) if mirrors else case.scene(n, method)
    if method == "stock":
        return columns(scene, STOCK_ROWS, scene.spacing), scene, STOCK_ROWS
    return scene, scene, 1


def run(case, method, n, lmp, folder, ranks=1, timeout=1800, eta=ETA, mirrors=False, **how):
    """runs it in a folder; an Outcome. What stopped a run is in its error. eta: h in spacings; mirrors: an octant of a ball; how: see script()"""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = prepared(case, method, n, mirrors)[0]
    scene = dataclasses.replace(scene, h=[h * eta / ETA for h in scene.h])
    write_data(scene, folder / "data")
    (folder / "in.shock").write_text(script(case, scene, method, n, mirrors=mirrors, **how))
    for old in folder.glob("frame.*"):
        old.unlink()
    command = ([] if ranks == 1 else ["mpirun", "-np", str(ranks)]) + [str(lmp), "-in", "in.shock", "-log", "log", "-screen", "none"]
    env = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1", **(alone(folder / "mpi") if ranks == 1 else {})}
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env=env, timeout=timeout, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return Outcome(case.name, method, n, len(scene.x), error=f"no end after {timeout} s")
    return measure(case, method, n, folder, done.returncode, mirrors)


def measure(case, method, n, folder, returncode=0, mirrors=False):
    """the Outcome of what a run has left in a folder; mirrors take up momentum, so that of an octant is not measured"""
    scene, thin, rows = prepared(case, method, n, mirrors)
    out = Outcome(case.name, method, n, len(scene.x))
    log = (folder / "log").read_text() if (folder / "log").exists() else ""
    found = re.search(r"^ERROR[^:\n]*: *(.*)$", log, re.M)
    table, out.seconds, out.steps = read_log(log)
    ended = all((folder / f"frame.{k}").exists() for k in range(len(case.times)))
    if returncode or found or not ended:
        out.error = f"{found.group(1) if found else 'ended with ' + str(returncode)} (t = {table[-1, 1] if len(table) else 0:.4g})"
        return out
    mass = np.array(scene.mass)[scene.type - 1]
    frames = [read_frame(folder / f"frame.{k}", mass) for k in range(len(case.times))]
    last = frames[-1]
    scale = max((mass[:, None] * np.abs(v)).sum() for v in (scene.v, *(f["v"] for f in frames)))
    out.energy = np.abs(table[:, 6] - 1).max()
    out.momentum = np.nan if mirrors else np.abs(table[:, 7:10] - table[0, 7:10]).max() / scale
    if rows > 1:
        last = {k: a.reshape(-1, rows, *a.shape[1:]).mean(axis=1) for k, a in last.items()}
        frames = [last]
    out.symmetry = symmetry(thin, last)
    if not all(np.isfinite(last[k]).all() for k in last):
        out.error = "not finite"
        return out
    out.l1, *out.picture = case.errors(n, thin, last)
    if hasattr(case, "numbers"):
        out.numbers = case.numbers(n, thin, frames)
    return out


def symmetry(scene, frame):
    worst = np.nan
    for image, axis in scene.mirror:
        x = frame["x"].copy()
        length = scene.box[axis, 1] - scene.box[axis, 0]
        centre = 0.5 * (scene.box[axis, 0] + scene.box[axis, 1])
        d = x[:, axis] + x[image, axis] - 2 * centre
        if scene.periodic[axis] == "p":
            d -= length * np.round(d / length)
        others = [a for a in range(3) if a != axis]
        worst = np.nanmax([worst, np.abs(d).max() / scene.spacing, np.abs(x - x[image])[:, others].max() / scene.spacing,
                           np.abs(frame["rho"] / frame["rho"][image] - 1).max()])
    return worst
