#!/usr/bin/env python3
"""Flyers of elastic, perfectly plastic solids in three dimensions, measured against the exact states of reference/elastic_plastic.py.

    python3 tests/lib/state_scenes.py --lmp build/lmp --case al-al-5000 --kernel wendland2 --h 1.6 --words "viscosity 1 2"

prints errors in percent: of sigma_x = p - Sxx, rho and e on the plateau, of u in units of the jump, of the speeds of the fronts; on both
sides of the contact. Columns of m x m particles, periodic across: without jitter the numbers do not depend on m, so m is 1. The plates are
free behind and have a gap of one spacing at the start. With --fill glass layers are of one spacing before the impact.

Windows are the same for all cases: the plateau is 25 to 75 % of the layers that the plastic shock has passed, counted from the contact;
the contact is the 3 layers nearest to it, near the 16 after these. Fronts are fits of error functions to u at two times, the last and half of
it; a run ends when the faster of the two first waves is through 90 % of its plate. number is the density that the places of the particles
make, the mean over the plateau: where rho differs from it, the two drift apart.

Case piston: plates that hang together and have no gap, the hypoelastic piston of verify/test_solids.py (cm, g, us, Mbar).
"""

import argparse
import dataclasses
import pathlib
import sys
import tempfile

import numpy as np
from scipy.optimize import least_squares
from scipy.special import erf

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "python")]
from reference.elastic_plastic import METALS, Solid, impact  # noqa: E402
from hvi.model import bodies  # noqa: E402
from shock_runs import read_log  # noqa: E402
from solid_runs import STATE, material, read_frames  # noqa: E402
from lammps_runs import runner  # noqa: E402
from sph_scenes import Fluid  # noqa: E402

LAYERS, ACROSS, SPACING, COURANT = 256, 1, 1e-4, 0.2
CONTACT, NEAR = 3, 19  # layers
FIELDS = ("sigma", "rho", "u", "e")
PISTON = Solid(2.79, 0.533, 1.34, 2.0, G=0.286, Y=0.0026)
CASES = {f"{a}-{b}-{v}": (METALS[a], METALS[b], float(v)) for a, b, v in
         [("al", "al", v) for v in (500, 1000, 2000, 5000, 10000)] + [("cu", "cu", 2000), ("ta", "ta", 2000), ("pb", "pb", 1000), ("al", "cu", 5750)]}
CASES["piston"] = PISTON, PISTON, 0.02


def sections(s):
    """of a material file"""
    more = f" S2 {s.s2} S3 {s.s3}" if s.s2 or s.s3 else ""
    eos = f"eos gruneisen rho0 {s.rho0} C {s.c0} S1 {s.s1} g0 {s.g0} a {s.a} T0 300{more}"
    return (eos, f"strength perfect G {s.G:.17g} Y {s.Y:.17g}") if s.Y else (eos, "strength none")


def flyer(lmp, folder, flying, target, speed, n=LAYERS, across=ACROSS, dim=3, kernel="wendland2", h=1.6, words="viscosity 1 2", variable=False,
          gap=1.0, jitter=0.0, fill="lattice", courant=COURANT, skin=0.3):
    """runs it; lmp(text) runs LAMMPS in the folder. Returns what measure() does, with cost and books; lengths, skin too, in spacings"""
    joined = flying is PISTON
    units, dx, gap = ("lj", 2.5e-3, 0.0) if joined else ("si", SPACING, gap)
    solid = flying.Y > 0 or target.Y > 0
    exact = impact(flying, target, speed)
    end = 0.9 * n * dx / max(w[0].m / s.rho0 for w, s in zip(exact, (flying, target))) + gap * dx / speed
    m = across if dim == 3 else 1
    grid = np.stack(np.meshgrid(np.arange(2 * n), np.arange(m), np.arange(m), indexing="ij"), -1).reshape(-1, 3)
    if fill == "glass":
        plates = [bodies.make(bodies.box(dx * np.array([n, m, m]), periodic=(1, 2)), dx, seed=k).x for k in (1, 2)]
        grid = np.concatenate(plates) / dx + 0.5 * np.array([n, m, m])
        grid[n * m * m:, 0] += n
        x, left = dx * grid, grid[:, 0] < n
        grid = np.floor(grid).astype(int)
    else:
        x, left = dx * (grid + 0.5), grid[:, 0] < n
    x[:, 0] += np.where(left, 0.0, gap * dx) + 0.2 * n * dx
    k, wide = len(x), m * dx if dim == 3 else 20 * dx
    box = np.array([(2 * n + gap + 0.4 * n) * dx + 1.2 * speed * end, wide, wide])
    x += jitter * dx * np.random.default_rng(1).uniform(-1, 1, x.shape)
    if dim == 1:
        x[:, 1:] = 0.0
    mass = {1: flying.rho0 * dx**dim, 2: target.rho0 * dx**dim}
    s = Fluid(x, np.zeros((k, 3)), np.where(left, flying.rho0, target.rho0), np.zeros(k), np.where(left, 1, 2), mass, {1: h * dx, 2: h * dx},
              box, (False, True, True), dim)
    s.v[left, 0] = speed
    folder = pathlib.Path(folder)
    s.write(folder / "flyer.data")
    files = [material(folder / f"{name}.hvi", *sections(metal), units=units).name for name, metal in (("flyer", flying), ("target", target))]
    text = f"""units {units}
boundary f p p
atom_style sph
atom_modify map array
processors * 1 1
read_data flyer.data
pair_style hvi/sph {kernel} dim {dim} {words} h {'variable' if variable else 'constant'}
pair_coeff 1 1 file {files[0]} h {h * dx:.17g}
pair_coeff 2 2 file {files[1]} h {h * dx:.17g}
pair_coeff 1 2 tension {'yes' if joined else 'no'}
neighbor {skin * dx:.17g} bin
neigh_modify every 1 delay 0 check yes one 10000
{'fix jc all hvi/johnson-cook strength perfect damage no spall none' if solid else ''}
compute book all hvi/energy
fix move all hvi/sph
compute S all hvi/atom {' '.join(STATE) if solid else 'p e'}
compute R all property/atom rho
thermo 10
thermo_style custom step time dt c_book[1] c_book[2] c_book[8] c_book[9] c_book[10] c_book[11] c_book[12] c_book[28]
thermo_modify format float %.16g
fix step all hvi/dt {courant}
"""
    for part in (0.5, 1.0):
        text += f"""variable left equal {part * end:.17g}-time
fix halt all halt 1 v_left < 0.0 error continue message no
run 100000000
unfix halt
write_dump all custom f.{part} id type x y z vx vy vz c_R c_S[*] modify time yes sort id format float %.17g
"""
    r = lmp(text)
    frames = [read_frames(folder / f"f.{part}")[0] for part in (0.5, 1.0)]
    if dim == 1:
        grid[:, 1:] = 0
    out = measure(frames, grid[:, 0], n, dx, exact, speed, gap * dx / speed)
    table, out["seconds"], out["steps"] = read_log(r.log)
    out.update(particles=k, drift=np.abs(table[:, 6] - 1).max(), momentum=np.abs(table[:, 7:10] - table[0, 7:10]).max() / (s.m @ s.v[:, 0]))
    return out


def fronts(x, u, waves):
    """places of the shocks, by a fit of an error function for each; u from rest, in units of that of the contact"""
    levels = np.array([w.u for w in waves]) / waves[-1].u
    first = [x[np.flatnonzero(u > (levels[k] + (levels[k - 1] if k else 0)) / 2).max(initial=0)] for k in range(len(levels))]
    wide = np.ptp(x) / 20

    def model(q):
        jump = np.diff(levels, prepend=0.0)
        return sum(0.5 * j * (1 - erf((x - a) / w)) for j, a, w in zip(jump, q[::2], q[1::2]))

    start = np.array([[a, wide / 5] for a in first]).ravel()
    return least_squares(lambda q: model(q) - u, start, x_scale=wide / 5, xtol=1e-12, ftol=1e-12).x[::2]


def profile(waves, rest, n, spacing, time):
    """exact fields of n layers from the contact, means over their mass, so long after the impact"""
    passed = [np.clip(w.m * time / (rest * spacing) - np.arange(n), 0, 1) for w in waves]
    start = dict(sigma=0.0, rho=rest, u=0.0, e=0.0)
    states = [start] + [{f: getattr(w, f) for f in FIELDS} for w in waves]
    return {f: start[f] + sum(part * (b[f] - a[f]) for part, a, b in zip(passed, states, states[1:])) for f in FIELDS}


def distance(rows, waves, rest, spacing, time):
    """L1 of the layers over those that the fastest wave has passed, in units of the last jump, by field"""
    want = profile(waves, rest, len(rows["u"]), spacing, time)
    jump = {f: getattr(waves[-1], f) - (rest if f == "rho" else 0.0) for f in FIELDS}
    passed = waves[0].m * time / (rest * spacing)
    return {f: np.abs(rows[f] - want[f]).sum() / passed / jump[f] for f in FIELDS}


def measure(frames, column, n, spacing, exact, speed, start=0.0):
    """by side (flyer, target): relative errors on the plateau and at the contact, scatter on the plateau, errors of the speeds, L1

    start: time of the impact
    """
    out = {}
    for name, k, waves, sign, ours in (("flyer", 0, exact[0], -1, column < n), ("target", 1, exact[1], 1, column >= n)):
        layer = (n - 1 - column if k == 0 else column - n)[ours]  # from the contact
        want, rest = waves[-1], waves[0].m / waves[0].D
        wish = dict(sigma=want.sigma, rho=want.rho, u=want.u, e=want.e)

        def fields(f):  # in the frame of the material at rest, x and u towards it
            u = f["v"][ours, 0] if k else speed - f["v"][ours, 0]
            sigma = -f["sxx"] if "sxx" in f else f["p"]
            x = f["x"][ours, 0] - (0 if k else speed * f["time"])
            return dict(x=sign * x, u=u, sigma=sigma[ours], rho=f["rho"][ours], e=f["e"][ours])

        rows = [{f: np.bincount(layer, q) / np.bincount(layer) for f, q in fields(f).items()} for f in frames]
        on = slice(CONTACT, int(0.97 * n))  # not the contact, not the rear face
        place = [fronts(q["x"][on], q["u"][on] / want.u, waves) for q in rows]
        speeds = (place[1] - place[0]) / (frames[1]["time"] - frames[0]["time"])
        passed = np.interp(place[1][-1], rows[1]["x"], np.arange(n))
        a, b = np.ceil(0.25 * passed), np.floor(0.75 * passed)
        near, far = np.interp((a, b), np.arange(n), rows[1]["x"])
        number = (b - a) * spacing / (far - near) * rest / want.rho
        last = fields(frames[1])
        parts = dict(plateau=(layer >= a) & (layer <= b), near=(layer >= CONTACT) & (layer < NEAR), contact=layer < CONTACT)
        out[name] = {part: {f: last[f][k].mean() / wish[f] - 1 for f in FIELDS} for part, k in parts.items()}
        out[name].update(scatter={f: last[f][parts["plateau"]].std() / wish[f] for f in FIELDS}, Us=speeds[-1] / want.D - 1,
                         precursor=speeds[0] / waves[0].D - 1 if len(waves) > 1 else np.nan, number=number - 1, layers=rows[1], exact=waves,
                         l1=distance(rows[1], waves, rest, spacing, frames[1]["time"] - start))
    return out


def lines(out):
    """side, part, errors in percent"""
    text = f"{'side':8}{'part':8}" + "".join(f"{k:>10}" for k in ("sigma_x", *FIELDS[1:], "number", "Us", "precursor"))
    for side in ("flyer", "target"):
        for part in ("plateau", "scatter", "near", "contact"):
            speeds = [out[side][k] for k in ("number", "Us", "precursor")] if part == "plateau" else []
            text += f"\n{side:8}{part:8}" + "".join(f"{100 * v:10.3f}" for v in [*out[side][part].values(), *speeds] if np.isfinite(v))
    return text


def name(out):
    """of a run, with what it cost"""
    return (f"{out['particles']} particles, {out['steps']} steps, {out['seconds']:.1f} core-seconds, energy {out['drift']:.1e}, "
            f"momentum {out['momentum']:.1e}")


def run_case(exe, case, liquid=False, **how):
    """a case by its name, in a folder that goes again"""
    flying, target, speed = (dataclasses.replace(s, Y=0.0) if liquid and isinstance(s, Solid) else s for s in CASES[case])
    with tempfile.TemporaryDirectory() as folder:
        return flyer(runner(exe, pathlib.Path(folder)), folder, flying, target, speed, **how)


if __name__ == "__main__":
    a = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    a.add_argument("--lmp", default=TESTS.parent / "build" / "lmp", type=lambda p: pathlib.Path(p).resolve())
    a.add_argument("--case", default="al-al-5000", choices=CASES)
    a.add_argument("--kernel", default="wendland2")
    a.add_argument("--h", default=1.6, type=float, help="in spacings")
    a.add_argument("--variable", action="store_true", help="h variable")
    a.add_argument("--words", default="viscosity 1 2", help="of the pair style")
    a.add_argument("--layers", dest="n", default=LAYERS, type=int, help="of each plate")
    a.add_argument("--across", default=ACROSS, type=int, help="columns in each direction")
    a.add_argument("--dim", default=3, type=int, choices=(1, 3))
    a.add_argument("--gap", default=1.0, type=float, help="in spacings")
    a.add_argument("--jitter", default=0.0, type=float, help="largest shift of particles in each direction, in spacings")
    a.add_argument("--fill", default="lattice", choices=("lattice", "glass"), help="of the plates; glass with at least 3 columns in each direction")
    a.add_argument("--liquid", action="store_true", help="without strength")
    a.add_argument("--profile", action="store_true", help="prints the means of the layers, from the contact, in units of the exact state")
    o = vars(a.parse_args())
    exe, case, layers = (o.pop(k) for k in ("lmp", "case", "profile"))
    out = run_case(exe, case, **o)
    print(f"{case}, {o['kernel']} {o['h']}, h {'variable' if o['variable'] else 'constant'}, {o['words']}: {name(out)}; errors in %")
    print(lines(out))
    if layers:
        for side in ("flyer", "target"):
            rows, want = out[side]["layers"], out[side]["exact"][-1]
            print(side)
            for k in range(o["n"]):
                print(f"{k:4d}" + "".join(f"{rows[f][k] / getattr(want, f):10.5f}" for f in FIELDS))
