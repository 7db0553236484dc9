"""What the interface of elements and particles reflects, long form: python3 tests/verify/interface.py --lmp build/lmp [--out FOLDER] [--only WORD] writes
interface.md and interface.png (Howto_fem_interface); a part of `make verify`.

A pulse starts 100 spacings away (tests/lib/interface_scenes.py).  What comes back is what differs, when it is there again, from a run of the same
step in which all are elements (or all particles, if it started in these), over the peak of the pulse as it arrived.
"""

import argparse
import pathlib
import sys

import numpy as np
from scipy.spatial import cKDTree

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
from interface_scenes import bar, mistake, reflection, spun, squeezed  # noqa: E402
from lammps_runs import runner  # noqa: E402

RIEMANN = "dissipation riemann"
MONAGHAN = "dissipation monaghan"
CUBIC, WENDLAND = "cubic 1.2", "wendland2 1.6"
PULSES = ("smooth", "steep")

# title: words of bar(), of rows of the table
ROWS = {
    "particles along an edge": [dict(n=n, kernel=k) for k in (CUBIC, WENDLAND) for n in (1, 2, 3)],
    "kernels, forces": [dict(kernel="cubic 1.5"), dict(kernel="quartic 1.2"), dict(pair=MONAGHAN),
                        dict(kernel=WENDLAND, pair=MONAGHAN)],
    "from particles into elements": [dict(side=1, n=n) for n in (1, 2, 3)] + [dict(side=1, kernel=WENDLAND)],
    "ragged": [dict(ragged=True), dict(ragged=True, kernel=WENDLAND), dict(ragged=True, side=1)],
    "layers of elements that hold particles": [dict(n=n, hold=hold, kernel=k) for k, n, hold in
                                               ((CUBIC, 1, 1), (CUBIC, 1, 2), (CUBIC, 2, 1), (CUBIC, 3, 1), (WENDLAND, 1, 2), (WENDLAND, 2, 1))],
    "tied": [dict(fem="convert no")],
}
OBLIQUE = [(CUBIC, 0, False), (WENDLAND, 0, False), (CUBIC, 30, False), (CUBIC, 45, False), (WENDLAND, 45, False), (CUBIC, 45, True)]


class Study:
    def __init__(self, exe, folder, far=100, fem=""):
        self.folder, self.lmp, self.known, self.far, self.fem = folder, runner(exe, folder), {}, far, fem

    def run(self, free, **words):
        """of a bar without an interface once only"""
        words = dict(n=2, kernel=CUBIC, side=-1, pair=RIEMANN, hold=4 if words.get("n") == 1 else 2, far=self.far) | words
        words["fem"] = f"{words.get('fem', '')} {self.fem}"
        if free == "right":
            return bar(self.lmp, self.folder, free, **words)
        if free == "all" and words.get("n") == 1:  # the same particles
            words["n"] = 2
        key = free, *sorted((k, v) for k, v in words.items() if k in ("n", "pulse", "angle", "side", "far") or (free == "all" and k in ("kernel", "pair")))
        if key not in self.known:
            self.known[key] = bar(self.lmp, self.folder, free, **{k: v for k, v in words.items() if k not in ("hold", "ragged")} | dict(fem=self.fem))
        return self.known[key]

    def reflects(self, **words):
        one = self.run("right", **words)
        return one, reflection(one, self.run("none" if words.get("side", -1) < 0 else "all", **words))

    def pulses(self):
        drifts, momenta, across = {-1: [], 1: []}, [], {False: [], True: []}
        yield "| interface | n | kernel | pair style | layers | smooth | steep | energy | momentum | sideways |"
        yield "|---|---|---|---|---|---|---|---|---|---|"
        for title, rows in ROWS.items():
            for words in rows:
                found = [self.reflects(pulse=p, **words) for p in PULSES]
                drift, momentum, sideways = (max(one[k] for one, _ in found) for k in ("drift", "momentum", "sideways"))
                drifts[words.get("side", -1)].append(drift), momenta.append(momentum), across["ragged" in words].append(sideways)
                n = words.get("n", 2)
                yield (f"| {title} | {n} | {words.get('kernel', CUBIC)} | {words.get('pair', RIEMANN)} | {words.get('hold', 4 if n == 1 else 2)} | "
                       f"{' | '.join(f'{100 * r:.2f} %' for _, r in found)} | {drift:.0e} | {momentum:.0e} | {sideways:.0e} |")
        yield ""
        yield (f"Energy {min(drifts[-1]):.0e} to {max(drifts[-1]):.0e}, from particles {min(drifts[1]):.0e} to {max(drifts[1]):.0e}; momentum at most "
               f"{max(momenta):.0e}; sideways at most {max(across[False]):.0e}, ragged {max(across[True]):.0e}")

    def oblique(self):
        yield "| angle | kernel | interface | wave packet |"
        yield "|---|---|---|---|"
        for kernel, angle, ragged in OBLIQUE:
            r = self.reflects(kernel=kernel, pulse="packet", far=80, angle=np.radians(angle), ragged=ragged)[1]
            yield f"| {angle} | {kernel} | {'ragged' if ragged else 'flat'} | {100 * r:.2f} % |"

    def alone(self):
        yield "| bar of | kernel | pair style | smooth: peak | largest difference | steep: peak | largest difference |"
        yield "|---|---|---|---|---|---|---|"
        bars = [(f"elements of {n} spacings", "none", dict(n=n)) for n in (1, 2, 3)]
        if not self.fem:
            bars += [("particles", "all", dict(kernel=k, pair=p, side=1)) for k in (CUBIC, WENDLAND) for p in (RIEMANN, MONAGHAN)]
        for name, free, words in bars:
            found = [mistake(self.run(free, pulse=p, **words), p) for p in PULSES]
            yield (f"| {name} | {words.get('kernel', '')} | {words.get('pair', '')} | " +
                   " | ".join(f"{peak:.3f} | {100 * off:.1f} %" for peak, off in found) + " |")

    def at_rest(self):
        yield "| n | kernel | interface | nodes: largest force | free particles | speed later |"
        yield "|---|---|---|---|---|---|"
        for n, kernel, ragged in [(n, k, r) for k in (CUBIC, WENDLAND) for n in (1, 2) for r in (False, True)]:
            out = squeezed(self.lmp, self.folder, n, kernel, RIEMANN, ragged, fem=self.fem)
            yield f"| {n} | {kernel} | {'ragged' if ragged else 'flat'} | {out['nodes']:.1e} | {out['free']:.1e} | {out['speed']:.1e} |"

    def spin(self):
        yield "| block of | kernel | pair style | angular momentum | energy |"
        yield "|---|---|---|---|---|"
        for name, free in (("elements", "none"), ("both", "right"), ("particles", "all")):
            for kernel in (CUBIC, WENDLAND) if free != "none" else (CUBIC,):
                for pair in (RIEMANN, MONAGHAN) if free != "none" else (RIEMANN,):
                    turned, drift, _ = spun(self.lmp, self.folder, free, 2, kernel, pair)
                    yield f"| {name} | {kernel} | {pair} | {turned:.1e} | {drift:.1e} |"


def picture(study, path):
    """what comes back into elements"""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(9, 3), sharey=True, layout="constrained")
    for axis, pulse in zip(axes, PULSES):
        reference = study.run("none", pulse=pulse)
        peak = np.linalg.norm(reference["middle"], axis=1).max()
        for kernel, ragged in ((CUBIC, False), (WENDLAND, False), (CUBIC, True)):
            one = study.run("right", pulse=pulse, kernel=kernel, ragged=ragged)
            there = (one["x"][:, 0] < -5) & (np.abs(one["x"][:, 1:]).max(axis=1) < 0.1)
            x, i = one["x"][there, 0], cKDTree(reference["x"]).query(one["x"][there])[1]
            order = np.argsort(x)
            axis.plot(x[order], 100 * (one["end"][there] - reference["end"][i])[order, 0] / peak, lw=1, label=f"{kernel}{', ragged' * ragged}")
        axis.set(title=f"{pulse} pulse", xlabel="x, spacings; the interface is at 0", xlim=(-200, 0))
    axes[0].set_ylabel("velocity that came back, %\nof the pulse as it arrived")
    axes[0].legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", required=True, type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--only", help="one of pulses, oblique, alone, at_rest, spin, picture")
    parser.add_argument("--far", type=int, default=100, help="where pulses start, in spacings; not packets")
    parser.add_argument("--fem", default="", help="more words of fix hvi/fem, as in 'hourglass/viscous 0.1'; not of blocks that turn")
    args = parser.parse_args()
    folder = args.out / "interface"
    folder.mkdir(parents=True, exist_ok=True)
    study = Study(args.lmp.resolve(), folder, args.far, args.fem)
    with open(args.out / "interface.md", "w") as report:
        for name, title in (("pulses", "Pulses at normal incidence, reflected"), ("oblique", "Packets of waves 30 spacings long"), ("alone", "Without an interface"),
                            ("at_rest", "A body at rest under uniaxial strain"), ("spin", "A block of 6 x 6 x 12 spacings that turns by 0.8 rad")):
            if args.only and args.only != name:
                continue
            report.write(f"\n## {title}\n\n")
            for line in getattr(study, name)():
                report.write(line + "\n")
                print(line, flush=True)
    if args.only in (None, "picture"):
        picture(study, args.out / "interface.png")


if __name__ == "__main__":
    main()
