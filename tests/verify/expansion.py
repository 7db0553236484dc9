"""Fragments of bodies that expand, long form: python3 tests/verify/expansion.py --lmp build/lmp [--out FOLDER] writes expansion.md; a part of `make verify`.

Number of sound pieces over that of Grady's theory, length/s with s of compute hvi/atom fragsize: bars of 6061-T6 held sideways (tests/lib/expansion_scenes.py),
24 s long, over strain rate, particles in a length s, scatter of strength and over what length it is one; thin rings.
"""

import argparse
import pathlib
import sys

import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS), str(TESTS / "lib"), str(TESTS.parent / "python")]
from expansion_scenes import bar, count, grady, ring  # noqa: E402
from lammps_runs import runner  # noqa: E402

LENGTH = 24
# rate, particles in s, lengths of one strength in s (None: every particle its own), modulus of the scatter, h in spacings
BARS = [(1e4, 20, None, 20.0, 1.5), (1e6, 20, None, 20.0, 1.5), *((1e5, n, None, 20.0, 1.5) for n in (5, 10, 20, 40, 80, 160)),
        *((1e5, n, 20, 20.0, 1.5) for n in (40, 80, 160)), (1e5, 40, 20, 5.0, 1.5), (1e5, 40, 20, 80.0, 1.5), (1e5, 20, None, 0, 1.5),
        (1e5, 20, None, 20.0, 1.2), (1e5, 160, None, 20.0, 1.2)]
PLAIN = "cubic dim 2 dissipation riemann"
ART = f"{PLAIN} artstress 0.3 4"
VOIDS, COOK = "damage no spall voids", "damage johnson-cook spall voids weibull 20 7"
# rate, spacing mm, layers, laws, pair style
RINGS = [(5e4, 0.25, 4, VOIDS, PLAIN), (5e4, 0.25, 4, VOIDS, ART), (5e4, 0.125, 4, VOIDS, ART), (5e4, 0.125, 8, VOIDS, ART), (5e4, 0.25, 8, VOIDS, ART),
         (5e4, 0.25, 4, COOK, ART), (5e4, 0.125, 8, COOK, ART), (5e4, 0.25, 8, COOK, ART), (1e5, 0.25, 4, COOK, ART)]


def bars(lmp, root, folder):
    yield "| strain rate 1/s | s mm | particles in s | one strength over | Weibull modulus | h/dx | pieces/Grady's, two seeds | failed | fragsize/s |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for rate, across, grains, modulus, eta in BARS:
        found = []
        for seed in (1, 2) if across < 160 else (1,):
            r, f = bar(lmp, root, folder, rate, across, fragments=LENGTH, modulus=modulus, seed=seed, grains=grains, eta=eta)
            n, failed = count(r, f)
            found.append((n / LENGTH, failed.mean(), np.median(f["fragsize"][failed]) / grady(rate)))
        ratio, lost, size = np.array(found).T
        yield (f"| {rate:g} | {1e3 * grady(rate):.3g} | {across} | {'s/20' if grains else 'a particle'} | {modulus or 'no scatter'} | {eta} | "
               f"{', '.join(f'{a:.2f}' for a in ratio)} | {lost.mean():.3f} | {size.mean():.2f} |")


def rings(lmp, root, folder):
    yield "| strain rate 1/s | thick mm | dx mm | laws | pair style | whole up to a strain of | pieces | Grady's | over Grady's | failed | mean tension before, GPa |"
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for rate, dx, layers, words, style in RINGS:
        r, f = ring(lmp, root, folder, rate, dx=1e-3 * dx, layers=layers, words=words, style=style, strain=1.2, frames=48)
        whole = [g for g in r.frames if count(r, g)[0] == 1]
        n, failed = count(r, f)
        expected = 2 * np.pi * 20e-3 / grady(rate)
        yield (f"| {rate:g} | {dx * layers:g} | {dx} | {words} | {style} | {rate * whole[-1]['time']:.2f} | {n} | {expected:.0f} | {n / expected:.2f} | {failed.mean():.3f} | "
               f"{-1e-9 * np.median(whole[len(whole) // 2]['p']):.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lmp", required=True, type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--only", choices=("bars", "rings"))
    args = parser.parse_args()
    folder = args.out / "expansion"
    folder.mkdir(parents=True, exist_ok=True)
    with open(args.out / "expansion.md", "w") as report:
        for title, lines in (("Bars held sideways", bars), ("Rings of 20 mm radius, plane strain, h 1.5 spacings", rings)):
            if args.only not in (None, lines.__name__):
                continue
            report.write(f"\n## {title}\n\n")
            for line in lines(runner(args.lmp.resolve(), folder), TESTS.parent, folder):
                report.write(line + "\n")
                print(line, flush=True)


if __name__ == "__main__":
    main()
