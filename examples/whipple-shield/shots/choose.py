# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 choose.py > chosen.yaml: which shots are run here, by cost and equations alone, from shots.csv and plans.csv.

plans.csv: hvi shots all.yaml --dry-run --ranks 1, before any of them was run.
"""

import bisect
import csv
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "python"))
from hvi.shield import shots  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
MOST, MOST_RARE = 120e6, 450e6  # particle-steps of the plan, 3 and 10 minutes of an idle core; the latter for oblique shots and thin bumpers
NUMBER, NEAR, OBLIQUE, THIN, FINER = 16, 8, 3, 1, 6
SPEEDS, BUMPERS = (2, 3.5, 5, 6.25, 7.5), (0.05, 0.15, 0.2, 0.3, 0.4)  # bands: km/s, bumper over diameter
FACTOR = 0.75


def costs(path):
    """{shot: particle-steps of a quarter}; a shot without a plan cannot be run"""
    with open(path, newline="") as rows:
        return {line["shot"]: float(line["particle_steps"]) for line in csv.DictReader(rows)}


def distance(ratios):
    """from the limit, of all equations: the mean of |ln(d/d_c)|"""
    return sum(abs(math.log(ratio)) for ratio, _ in ratios.values()) / len(ratios)


def bands(shot):
    """what a choice should not have too often: speed, bumper, what was seen"""
    return (bisect.bisect(SPEEDS, shot.speed_km_s), bisect.bisect(BUMPERS, thin(shot)), shot.observed)


def thin(shot):
    return shot.bumper_mm / shot.diameter_mm


def is_rare(shot):
    """few of the list are affordable"""
    return shot.angle_deg > 0 or thin(shot) < BUMPERS[1]


def eligible(found, cost):
    """those that the rules allow, and why others are left out"""
    kept, out = [], {}
    for shot in found:
        if not SPEEDS[0] <= shot.speed_km_s <= SPEEDS[-1]:
            out.setdefault("speed", []).append(shot.name)
        elif not BUMPERS[0] <= thin(shot) <= BUMPERS[-1]:
            out.setdefault("bumper over diameter", []).append(shot.name)
        elif shot.name not in cost:
            out.setdefault("no plan", []).append(shot.name)
        elif cost[shot.name] > (MOST_RARE if is_rare(shot) else MOST):
            out.setdefault("cost", []).append(shot.name)
        else:
            kept.append(shot)
    return kept, out


def choose(kept, far):
    """the shots: the nearest to the limit, then oblique ones and a thin bumper, then those of speeds, results and walls that are rare so far; far: {shot: distance}"""
    left = sorted(kept, key=lambda shot: far[shot.name])
    chosen = left[:NEAR]
    for number, kind in ((OBLIQUE, lambda shot: shot.angle_deg > 0), (THIN, lambda shot: thin(shot) < BUMPERS[1])):
        chosen += [shot for shot in left if kind(shot) and shot not in chosen][:max(0, number - sum(map(kind, chosen)))]
    while len(chosen) < NUMBER:
        def rare(shot):
            same = sum(mine == its for other in chosen for mine, its in zip(bands(shot), bands(other)))
            return same, sum(other.wall == shot.wall for other in chosen), far[shot.name]
        chosen.append(min((shot for shot in left if shot not in chosen and not is_rare(shot)), key=rare))
    return chosen


def finer(chosen, far, cost):
    return sorted((shot for shot in chosen if cost[shot.name] <= MOST), key=lambda shot: far[shot.name])[:FINER]


def main():
    study = shots.Study(HERE / "all.yaml")
    cost = costs(HERE / "plans.csv")
    ratios = {shot.name: shots.ratios_of(shots.Outcome(shot, study.case(shot), HERE)) for shot in study.shots}
    far = {name: distance(found) for name, found in ratios.items()}
    kept, out = eligible(study.shots, cost)
    chosen = choose(kept, far)
    for what, least, found in (("results", 2, {shot.observed for shot in chosen}), ("alloys of rear walls", 3, {shot.wall for shot in chosen}),
                               ("oblique shots", OBLIQUE, {shot.name for shot in chosen if shot.angle_deg})):
        if len(found) < least:
            raise SystemExit(f"too few {what}: {found}")
    fine = finer(chosen, far, cost)
    print("# Made by choose.py before the first run; the first eight are the nearest to the limit. Not chosen from, by rule:")
    for why, names in out.items():
        print(f"# {why} ({len(names)}): {', '.join(names)}")
    text = (HERE / "all.yaml").read_text().splitlines()
    print("\n".join(line for line in text[1:]))
    print("shots:")
    for shot in chosen:
        print(f"  - '{shot.name}'  # {shot.observed}, {shot.speed_km_s:g} km/s, {shot.angle_deg:g} degrees, {shot.wall}, t/D {thin(shot):.2f}, "
              f"mean |ln d/d_c| {far[shot.name]:.3f}, {cost[shot.name]:.3g} particle-steps")
    print(f"finer:\n  factor: {FACTOR}\n  shots: [{', '.join(repr(shot.name) for shot in fine)}]")


if __name__ == "__main__":
    main()
