# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi judge: the verdict on a run that was made by hand in a folder of hvi shield --write."""

from ..shield import chain, decision


def main(args):
    result = chain.judge(args.folder)
    print(f"verdict: {result['verdict']}")
    print("\n".join([*(f"  - {text}" for text in result["reasons"]), *(["notes:"] if result.get("notes") else []), *(f"  - {text}" for text in result.get("notes", ()))]))
    return decision.STATUS[result["verdict"]]
