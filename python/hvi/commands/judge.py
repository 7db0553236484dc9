# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi judge: the verdict on a run that was made by hand in a folder of hvi shield --write."""

from ..shield import chain, decision

EXAMPLES = "  python3 -m hvi judge emi/dx-0.267_shift-0.0"


def add_arguments(parser):
    parser.add_argument("folder", metavar="DIR", help="with walls.dat, pieces.dat, history.dat and logs of the run")


def main(args):
    result = chain.judge(args.folder)
    print(f"verdict: {result['verdict']}")
    print("\n".join(decision.lines(result["reasons"], result.get("notes", ()))))
    return decision.STATUS[result["verdict"]]
