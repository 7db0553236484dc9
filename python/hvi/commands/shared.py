# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What several commands share: values of options, options, and what is printed."""

import argparse

from .. import tables


def number(kind, holds, what):
    """a type of options: a number of a kind for which something holds"""
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not holds(value):
            raise argparse.ArgumentTypeError(f"{text} is not {what}")
        return value
    return read


LARGEST, MANY = 1e60, 2**31 - 1  # the third powers of numbers can be taken, and arrays count so far
positive = number(float, lambda value: 1 / LARGEST < value < LARGEST, "a number > 0")
least0 = number(float, lambda value: value == 0 or 1 / LARGEST < value < LARGEST, "a number of at least 0")
real = number(float, lambda value: abs(value) < LARGEST, "a number")
count = number(int, lambda value: 1 <= value <= MANY, "a whole number from 1 on")
natural = number(int, lambda value: 0 <= value <= MANY, "a whole number from 0 on")
whole = number(int, lambda value: abs(value) <= MANY, "a whole number")


def add_output(parser, figure, required=False, out=True):
    if out:
        parser.add_argument("--out", metavar="FILE.csv", help="write the table with all digits")
    parser.add_argument("--figure", metavar="NAME", required=required, help=f"draw {figure}: NAME.png and NAME.pdf, or only the one that NAME ends in")


def draw(name, what, *given, **more):
    """a figure, by its function in hvi.figures; nothing without a name"""
    if name:
        from .. import figures

        save(getattr(figures, what)(*given, **more), name)


def save(figure, name):
    from ..figures import style

    for path in style.save(figure, name):
        print(f"figure: {path}")


def show(summary):
    for name, value in summary.items():
        print(f"{name}: {tables.number(value)}")
