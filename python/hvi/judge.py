# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""python3 -m hvi judge: the verdict on a run that was made by hand in a folder of hvi shield --write."""

from . import shield, shield_chain


def main(args):
    result = shield_chain.judge(args.folder)
    print(f"verdict: {result['verdict']}")
    print("\n".join([*(f"  - {text}" for text in result["reasons"]), *(["notes:"] if result.get("notes") else []), *(f"  - {text}" for text in result.get("notes", ()))]))
    return shield.STATUS[result["verdict"]]
