# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A bar on the terminal while something takes long (tqdm's); nothing where nobody looks."""

import sys

DELAY = 1.0  # seconds before a bar appears


class Silent:
    """What is used of tqdm's bars, without one."""

    n = total = 0

    def update(self, *_):
        pass

    set_postfix_str = __exit__ = update

    def write(self, text):
        print(text, flush=True)

    def __enter__(self):
        return self


def silent(total, what):
    return Silent()


def bar(total, what, stream=None, **words):
    """A bar of tqdm on a terminal, Silent elsewhere and without tqdm."""
    stream = sys.stderr if stream is None else stream
    if not stream.isatty():
        return Silent()
    try:
        from tqdm import tqdm
    except ImportError:
        return Silent()
    return tqdm(total=total, desc=what, file=stream, delay=DELAY, leave=False, **{"unit_scale": True, **words})
