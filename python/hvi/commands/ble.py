# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi ble: critical diameter over speed by all equations, of a case; or what they say of published shots."""

from .. import tables
from ..errors import HVIError
from ..material.library import stem
from ..shield import ble
from ..shield import case as cases
from . import running
from .shared import add_output, draw

EXAMPLES = """  python3 -m hvi ble emi.yaml --figure limit
  python3 -m hvi ble emi.yaml --speeds 3:9:13 --equation JSC --equation Reimerdes --out limit.csv
  python3 -m hvi ble --shots examples/whipple-shield/shots/shots.csv"""

CURVE = 400  # speeds of a curve in the figure


def add_arguments(parser):
    parser.add_argument("case", metavar="CASE.yaml", nargs="?", help="as of hvi shield; spacings_mm are not needed")
    parser.add_argument("--shots", metavar="FILE.csv", help="instead of a case: a list of double-wall shots, as of hvi shots; how often each equation is right")
    running.add_speeds(parser, (1.0, 15.0, 15))
    parser.add_argument("--equation", action="append", metavar="NAME", help="only this equation; repeat (default: all)")
    add_output(parser, "critical diameter over speed, dashed where beyond ranges of validity, and the case")


def chosen(names, wanted):
    """those of the names that were asked for, or all"""
    for name in wanted or ():
        if name not in names:
            raise HVIError(f"no equation {name} for this; there are: {', '.join(names)}")
    return [name for name in names if name in wanted] if wanted else names


def where_beyond(speeds, points):
    """{what and limit: [(first speed, last speed), ...]} of a curve"""
    found, last = {}, {}
    for k, (_, beyond) in enumerate(points):
        for what, _, limit in beyond:
            stretches = found.setdefault((what, limit), [])
            if last.get((what, limit)) == k - 1:
                stretches[-1] = stretches[-1][0], speeds[k]
            else:
                stretches.append((speeds[k], speeds[k]))
            last[what, limit] = k
    return found


def of_case(args):
    case = cases.read(args.case, model=False)
    shield = ble.from_case(case)
    names = chosen(ble.equations(shield), args.equation)
    speeds = running.evenly(*args.speeds)
    points = {name: ble.curve(shield, name, speeds, case.angle_deg) for name in names}
    print(title(case, shield))
    print("critical diameter in mm; *: beyond a range of validity")
    rows = [(f"{speed:.4g}", *(f"{points[name][k][0]:.3f}" + ("*" if points[name][k][1] else " ") for name in names)) for k, speed in enumerate(speeds)]
    print(tables.text(("km/s", *names), rows))
    for name in names:
        for (what, limit), stretches in where_beyond(speeds, points[name]).items():
            at = ", ".join(f"{first:.4g} to {last:.4g}" if first < last else f"{first:.4g}" for first, last in stretches)
            print(f"  * {name}: {' '.join((what, limit)).strip()} at {at} km/s")
    print(f"\nthe case, {case.diameter_mm:g} mm at {case.speed_km_s:g} km/s:")
    found = ble.predictions(case)
    print("\n".join(ble.said({name: found[name] for name in names})))
    if shield.walls == 1:
        print(f"crater in a thick target: {10 * ble.crater_depth(shield, 0.1 * case.diameter_mm, case.speed_km_s, case.angle_deg):.2f} mm deep")
    if args.out:
        tables.write_csv(args.out, ("speed_km_s", *(f"{name}_{what}" for name in names for what in ("mm", "beyond"))),
                         [(speed, *(value for name in names for value in (points[name][k][0], "; ".join(" ".join((w, t)).strip() for w, _, t in points[name][k][1]))))
                          for k, speed in enumerate(speeds)])
    if args.figure:
        fine = running.evenly(args.speeds[0], args.speeds[1], CURVE)
        draw(args.figure, "ballistic_limit", fine, ble.curves(shield, names, fine, case.angle_deg), title(case, shield), (case.speed_km_s, case.diameter_mm))


def title(case, shield):
    """a case in a line"""
    walls = ", ".join((f"gap {wall.gap_mm:g} mm, " if wall.gap_mm else "") + f"{wall.thickness_mm:g} mm {stem(wall.material)}" for wall in case.walls)
    strength = f" ({shield.wall_yield_ksi:g} ksi)" if shield.walls == 2 else f" ({shield.wall_brinell:g} Brinell, {shield.wall_sound_km_s:g} km/s)"
    capped = f" (beyond {ble.CAP:g}: critical diameters are those of {ble.CAP:g})" if shield.walls == 2 and case.angle_deg > ble.CAP else ""
    return f"{case.name}: {stem(case.material)} on {walls}{strength}, {case.angle_deg:g} degrees{capped}"


# ---------------------------------------------------------------------- published shots
def shield_of(shot):
    """the Shield of a published shot, with nominal densities of its alloys"""
    def density(alloy):
        found = ble.properties(alloy.replace("AA", "Al", 1))[0]
        if found is None:
            raise HVIError(f"shot {shot.name}: no density of {alloy}; known: {', '.join(ble.PROPERTIES)}")
        return found
    projectile, bumper, wall = shot.alloys()
    return ble.Shield(wall_thickness_cm=0.1 * shot.wall_mm, wall_density=density(wall), wall_yield_ksi=shot.yield_ksi, projectile_density=density(projectile),
                      bumper_thickness_cm=0.1 * shot.bumper_mm, bumper_density=density(bumper), standoff_cm=0.1 * shot.gap_mm)


def of_shots(args):
    from ..shield import shots

    found = shots.read_list(args.shots)
    pairs = [(shot, shield_of(shot)) for shot in found]
    names = chosen([name for name, equation in ble.EQUATIONS.items() if equation.walls == 2], args.equation)
    said = {name: [ble.critical_diameter(name, shield, shot.speed_km_s, shot.angle_deg) for shot, shield in pairs] for name in names}
    print(f"{len(found)} shots, {sum(shot.observed == 'P' for shot in found)} perforated; predicted P if the diameter is above the critical one")
    print(tables.text(COUNTS, [(name, *counts(found, said[name])) for name in names]))
    if args.out:
        tables.write_csv(args.out, ("shot", "source", "observed", "diameter_mm", *(f"{name}_{what}" for name in names for what in ("mm", "beyond"))),
                         [(shot.name, shot.source, shot.observed, shot.diameter_mm, *(v for name in names for v in (10 * said[name][k][0], "; ".join(said[name][k][1]))))
                          for k, shot in enumerate(found)])


COUNTS = ("", "P as P", "P as NP", "NP as NP", "NP as P", "right", "within ranges", "right there")


def counts(shots, said):
    """COUNTS of an equation: observed as predicted"""
    table = {(seen, told): 0 for seen in ("P", "NP") for told in ("P", "NP")}
    within = right = 0
    for shot, (d, beyond) in zip(shots, said):
        told = "P" if 0.1 * shot.diameter_mm > d else "NP"
        table[shot.observed, told] += 1
        within += not beyond
        right += not beyond and told == shot.observed
    return (table["P", "P"], table["P", "NP"], table["NP", "NP"], table["NP", "P"],
            f"{100 * (table['P', 'P'] + table['NP', 'NP']) / len(shots):.0f} %", within, f"{100 * right / within:.0f} %" if within else "-")


def main(args):
    if (args.case is None) == (args.shots is None):
        raise HVIError("give a case, or --shots FILE")
    if args.shots and args.figure:
        raise HVIError("--figure is of a case, not of --shots")
    (of_shots if args.shots else of_case)(args)
