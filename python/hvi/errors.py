# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What goes wrong is said in one line: what, where, and what would help."""

import contextlib
import importlib


class HVIError(Exception):
    """Something in the input cannot be used; the message is meant for the user."""


class HVIWarning(UserWarning):
    """Something is left out of the answer."""


@contextlib.contextmanager
def _said(what, problems):
    try:
        yield
    except problems as problem:
        raise HVIError(f"cannot {what}: {getattr(problem, 'strerror', None) or problem}") from None


def reading(path):
    """in its context what cannot be read is an HVIError that names the file"""
    return _said(f"read {path}", (OSError, EOFError, UnicodeDecodeError))


def writing(path):
    return _said(f"write {path}", OSError)


def needed(module, what):
    """A module of a library that not everybody has; what needs it"""
    try:
        return importlib.import_module(module)
    except ImportError:
        name, debian = {"PIL": ("Pillow", "pil")}.get(module.partition(".")[0], (module, module))
        raise HVIError(f"{what} {name}: Debian's python3-{debian}, or pip install {name.lower()}") from None
