# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""What goes wrong is said in one line: what, where, and what would help."""

import contextlib
import errno
import importlib
import os
import sys


class HVIError(Exception):
    """Something in the input cannot be used; the message is meant for the user."""


class NotThere(HVIError, AttributeError):
    """An attribute that needs a library that is not there: help() goes on without it."""


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


def will_write(path):
    """raises at once what writing the file would in the end: there is no such folder, or it is not ours"""
    folder = os.path.dirname(path) or "."
    with writing(path):
        os.stat(folder + os.sep)
        if not (os.path.exists(path) or os.access(folder, os.W_OK)):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))


NAMES = {"PIL": ("Pillow", "pil"), "yaml": ("PyYAML", "yaml"), "MDAnalysis": ("MDAnalysis", "mdanalysis")}  # of libraries whose module has another name: (library, Debian's)


def remedy(module):
    """how to get the library of a module"""
    name, debian = NAMES.get(module, (module, module))
    return f"Debian's python3-{debian}, or pip install {name}"


def needed(module, what):
    """A module of a library that not everybody has; what needs it"""
    try:
        return importlib.import_module(module)
    except ImportError:
        top = module.partition(".")[0]
        raise HVIError(f"{what} {NAMES.get(top, (top,))[0]}: {remedy(top)}") from None


def missing(error):
    """what an ImportError of the command line says: this Python, and how to get the library"""
    module = (error.name or "").partition(".")[0]
    if isinstance(error, ModuleNotFoundError) and module:
        return f"{sys.executable} has no {NAMES.get(module, (module,))[0]}: {remedy(module)}; HVI_PYTHON names another Python for the launcher hvi; hvi doctor says what else is missing"
    return f"{sys.executable} cannot import {module or 'a module'}: {' '.join(str(error).split())}; hvi doctor says more"
