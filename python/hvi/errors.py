# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What goes wrong is said in one line: what, where, and what would help."""

import contextlib


class HVIError(Exception):
    """Something in the input cannot be used; the message is meant for the user."""


class HVIWarning(UserWarning):
    """Something is left out of the answer."""


@contextlib.contextmanager
def writing(path):
    """a file that cannot be written is an HVIError that names it"""
    try:
        yield
    except OSError as problem:
        raise HVIError(f"cannot write {path}: {problem.strerror or problem}") from None
