# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi material: what material files are good for."""

from .. import tables
from ..errors import HVIError
from ..material import curves, library
from .shared import add_output, save

EXAMPLES = """  python3 -m hvi material Al7075-T6.hvi --figure Al7075-T6
  python3 -m hvi material potentials/*.hvi"""


def add_arguments(parser):
    parser.add_argument("files", nargs="+", metavar="FILE.hvi", help="material file, here or in LAMMPS_POTENTIALS; of several a table")
    add_output(parser, "Hugoniot, isentrope, yield stress and spall strength of one file")


def main(args):
    found = [library.read(name) for name in args.files]
    for one in found:
        library.warn(one)
    if len(found) > 1:
        if args.figure:
            raise HVIError("--figure draws one file")
        rows = [library.row(one) for one in found]
        print(tables.text(("file", "eos", "strength", "damage", "spall", "assumed"),
                          [[row["file"], row["eos"].partition(":")[0], row["strength"], row["damage"], row["spall"], sum(len(keys) for keys in one.assumed().values())]
                           for one, row in zip(found, rows)]))
        if args.out:
            tables.write_csv(args.out, rows[0], [list(row.values()) for row in rows])
        return
    one = found[0]
    print(f"{one.path}: {one.title}\nunits {one.units}, {'of ' + one.date if one.date else 'no date'}\n")
    for kind in library.WANTED:
        why = one.lacks().get(kind)
        print(f"  {kind:9} {', '.join(one.laws(kind)) or 'none' + (f': {why}' if why else '; the file does not say why')}")
    for section, keys in one.assumed().items():
        for key, note in keys.items():
            print(f"  assumed   {' '.join(section)} {key} {one.sections[section][key]:g}: {note}")
    print("\nfor")
    for use, words, missing in library.uses(one):
        print(f"  {'no ' if missing else 'yes'} {use}" + (f" ({words})" if words else "") + (f": it has no {', no '.join(missing)}" if missing else ""))
    if one.laws("eos")[0] in ("table", "idealgas"):
        if args.out:
            raise HVIError(f"--out: there are no curves of eos {one.laws('eos')[0]}")
        print(f"\nno curves of eos {one.laws('eos')[0]}")
    else:
        if "voids" in one.laws("spall"):
            v, (pascal, hertz) = one.in_si(("spall", "voids")), ("", "") if one.units == "lj" else (" Pa", " 1/s")
            bears = curves.borne(one, v["rate"])
            print(f"\nspall voids, stretched at {v['rate']:g}{hertz}: bears {bears:.4g}{pascal}, {bears / v['sigma']:.3f} of sigma;"
                  f" to bear sigma itself takes a sigma of {curves.sigma_for(one, v['sigma'], v['rate']):.4g}{pascal}"
                  + (" (without delta_c, which lowers phi_c for large particles)" if v["delta_c"] else ""))
        names, rows = curves.shock_table(one)
        print("\nshocks into the reference state\n" + tables.text(names, rows))
        if args.out:
            tables.write_csv(args.out, names, rows)
    if args.figure:
        from ..figures.material import draw

        save(draw(one), args.figure)
