"""What a hard case is; tests/verify/hard.py runs them, hard_gas.py and hard_solids.py have their scenes."""

import dataclasses
import typing

import numpy as np

ENERGY, MOMENTUM = 1e-3, 1e-12  # of the initial total; of the sum of |p|: what every case asks for where the books are closed
BOOKS = {"energy": ENERGY, "momentum": MOMENTUM}


class Cannot(Exception):
    """the method has no such law, dimension or boundary; str: why"""


@dataclasses.dataclass
class Case:
    """a scene with what is asked of it

    name, title: a word and a line for the table.
    scene(lmp, folder, setting): runs it in a folder (`lmp`: see executor) and returns {measure: number};
      raises Stopped or Cannot.  Not finite measures stop it, too.
    methods: {name: setting}; names that begin with "stock" are other packages, which nothing is asked of.
    criteria: {measure: upper bound}, or (lower, upper).
    short: methods that run in make test (seconds each); all of them in make verify.
    known: {method: {measure or "run": cause}}: what it misses, one line each; one that clearly misses no more fails the test.
    since: "first" if the criteria were written down before the first run, "after" if numbers were known
    """

    name: str
    title: str
    scene: typing.Callable
    methods: dict
    criteria: dict
    short: tuple = ()
    known: dict = dataclasses.field(default_factory=dict)
    since: str = "first"

    def bounds(self, measure):
        b = self.criteria[measure]
        return b if isinstance(b, tuple) else (-np.inf, b)
