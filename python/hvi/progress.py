# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""A bar on the terminal while something takes long; nothing where nobody looks."""

import sys
import time

DELAY = 1.0  # seconds before a bar appears


class Bar:
    """Counts up to total; shows percent on a line of its own once DELAY has passed. A context manager."""

    def __init__(self, total, what, stream):
        self.total, self.what, self.stream = max(total, 1), what, stream
        self.done, self.start, self.shown = 0, time.monotonic(), None

    def update(self, n=1):
        self.done += n
        percent = min(100 * self.done // self.total, 100)
        if percent != self.shown and time.monotonic() - self.start > DELAY:
            self.shown = percent
            self.stream.write(f"\r{self.what}: {percent:3d} %")
            self.stream.flush()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.shown is not None:
            self.stream.write("\r\033[K")
            self.stream.flush()


class Silent:
    """The same without a word."""

    def update(self, n=1):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


def silent(total, what):
    return Silent()


def bar(total, what, stream=None):
    """A bar on a terminal (tqdm's where it is installed), Silent elsewhere."""
    stream = sys.stderr if stream is None else stream
    if not stream.isatty():
        return Silent()
    try:
        from tqdm import tqdm
    except ImportError:
        return Bar(total, what, stream)
    return tqdm(total=total, desc=what, file=stream, delay=DELAY, leave=False, unit_scale=True)
