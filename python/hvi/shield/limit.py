# lammps-hvi, Copyright (2026) the lammps-hvi developers. GNU General Public License, version 2: see the file LICENSE.
"""Up to where does the wall hold?  Bisection over one quantity of a case, with undecided answers.

Each spacing and shift of the lattice has a search of its own; that of a finer spacing begins about the answer of the
coarser one. What was run is not run again: call once more to go on.
"""

import math

from .. import tables
from ..errors import HVIError
from . import ble, chain, decision, quantity

MOST = 1000  # steps
ANGLES = 0.0, 75.0, 5.0  # degrees: default of a search, since an angle of 0 has no half and no double


def tries(n, window=False):
    """of a Search over places 0 ... n at most: its ends, and halves on the way to two borders; from a window the ends may be far"""
    halves = math.ceil(math.log2(n + 1))
    return max(2 + 2 * halves, 4 * halves - 4 if window else 0)


class Search:
    """Bisection over places 0 ... n, where one side holds and the other fails.

    said: {place: verdict} of what was tried. Between ends that differ, the middle is tried between the last place that
    holds and the first that does not, and between the last that does not fail and the first that does. Where verdicts are
    undecided, or go to and fro, these are two borders with an undecided region between them.
    window: the ends to begin with; they are moved outward until one holds and the other fails
    turned: True if the low side is the one that fails; None: the ends will say
    """

    def __init__(self, n, window=None, turned=None):
        self.n, self.known_turned = n, turned
        low, high = window or (0, n)
        self.ends, self.widen = [max(low, 0), min(high, n)], 2
        self.said, self.asked = {}, set()

    @property
    def turned(self):
        if self.known_turned is not None:
            return self.known_turned
        low, high = (self.said.get(end) for end in self.ends)
        return None if low == high else low == "fails" or high == "holds"

    def borders(self):
        """(last that holds, first that does not, last that does not fail, first that fails); None where there is none"""
        if self.turned is None:
            return (None,) * 4
        order = sorted(self.said, reverse=self.turned)
        said = [self.said[place] for place in order]
        good = next((k for k, verdict in enumerate(said) if verdict != "holds"), len(said))
        bad = len(said) - next((k for k, verdict in enumerate(reversed(said)) if verdict != "fails"), len(said))
        padded = [None, *order, None]
        return padded[good], padded[good + 1], padded[bad], padded[bad + 1]

    def _wanted(self):
        if any(end not in self.said for end in self.ends):
            return self.ends
        sides = {None: (None, None), False: ("holds", "fails"), True: ("fails", "holds")}[self.turned]
        low, high = (self.said[end] == side for end, side in zip(self.ends, sides))
        wider = [self.ends[0] if low else max(0, self.ends[0] - self.widen), self.ends[1] if high else min(self.n, self.ends[1] + self.widen)]
        if wider != self.ends:
            self.ends, self.widen = wider, 2 * self.widen
            return self.ends
        a, b, c, d = self.borders()
        return [(p + q) // 2 for p, q in ((a, b), (c, d)) if p is not None and q is not None and abs(p - q) > 1]

    def next(self):
        """places to try now: those that were not asked for before"""
        new = [place for place in dict.fromkeys(self._wanted()) if place not in self.asked]
        self.asked.update(new)
        return new

    @property
    def done(self):
        return self.asked == set(self.said)


class Limit:
    """The searches of all spacings and shifts, and the runs that they ask for."""

    def __init__(self, case, folder, on, low=None, high=None, step=None, name=""):
        self.case, self.folder, self.on, self.name = case, folder, on, name  # name: what names of runs begin with
        self.quantity = quantity.find(case, on, "--on")
        self.key, self.wall, self.unit = self.quantity.key, self.quantity.wall, self.quantity.unit
        self.own, self.files = self.quantity.of(case), case.checksums()
        usual = ANGLES if on == "angle" else (0.5 * self.own, 2 * self.own, 0.05 * self.own)
        low, high, step = (value if given is None else given for given, value in zip((low, high, step), usual))
        if low >= high or step > high - low:
            raise HVIError(f"--from {low:g} --to {high:g} --step {step:g}: there is nothing between")
        for option, value in (("--from", low), ("--to", high)):
            self.quantity.checked(case, float(f"{value:.6g}"), option)
        n = max(1, round(min((high - low) / step, 10 * MOST)))
        if n > MOST:
            raise HVIError(f"--step {step:g}: more than {MOST} values from {low:g} to {high:g}, steps of {(high - low) / MOST:.2g} are the least")
        self.values = [float(f"{low + (high - low) * k / n:.6g}") for k in range(n + 1)]
        if len(set(self.values)) <= n:
            raise HVIError(f"--from {low:.9g} --to {high:.9g} --step {step:g}: values have six digits, and some of these are the same")
        for value in self.values:  # elements do not fit any thickness
            self.at(value).check_elements(quantity.wrong(f"{on} {value:g} {self.unit}"))
        if whole := case.whole(len(case.walls)):
            raise HVIError(f"{case.name}: no limit: {whole[0][1]}, and a shield that holds is undecided -- {whole[0][3]}")
        self.searches, self.jobs = {}, {}

    def at(self, value):
        """the case with that value"""
        return self.quantity.at(self.case, value)

    def job(self, member, value):
        name = f"{self.name}{decision.member_name(self.case, member)}_{self.on}-{value:g}"
        return decision.job(self.at(value), member, self.folder / name, name, remove=["cloud*.dump", "film.*.dump"])

    def plans(self):
        """[[(value, plan of a run) at both ends of the range] of each spacing, ...]"""
        return [[(value, chain.plan_of(self.job((which, self.case.shifts[0]), value).shield)) for value in (self.values[0], self.values[-1])]
                for which in range(len(self.case.spacings_mm))]

    def most(self):
        """[(value, plan), ...] of all runs that can be asked for, each as at the end of the range where it takes more"""
        return [max(ends, key=lambda end: end[1]["core_s"]) for which, ends in enumerate(self.plans()) for _ in range(len(self.case.shifts) * tries(len(self.values) - 1, which > 0))]

    def _new(self, member):
        """jobs for what the search of a member asks for next; that of the next spacing, once this one is done"""
        found = []
        for place in self.searches[member].next():
            job = self.job(member, self.values[place])
            self.jobs[job.name] = member, place, job
            found.append(job)
        search, (which, shift) = self.searches[member], member
        if not found and search.done and which + 1 < len(self.case.spacings_mm):
            near = [place for place in search.borders() if place is not None]
            window = (min(near) - 1, max(near) + 1) if search.turned is not None else None
            self.searches[which + 1, shift] = Search(search.n, window, search.turned)
            found = self._new((which + 1, shift))
        return found

    def every(self):
        return [job for _, _, job in self.jobs.values()]

    def first(self):
        found = []
        for shift in self.case.shifts:
            self.searches[0, shift] = Search(len(self.values) - 1)
            found += self._new((0, shift))
        return found

    def more(self, job):
        member, place, _ = self.jobs[job.name]
        self.searches[member].said[place] = decision.verdict(job)[0]
        return self._new(member)

    def rows(self):
        """spacing, shift, value up to which it holds, undecided values, value from which it fails, runs"""
        def value(place):
            return "-" if place is None else self.values[place]
        found = []
        for (which, shift), search in sorted(self.searches.items()):
            a, b, c, d = search.borders()
            unsure = "-" if b == d else " to ".join(dict.fromkeys(tables.number(value(place)) for place in (b, c)))
            found.append((self.case.spacings_mm[which], shift, value(a), unsure, value(d), len(search.said)))
        return found

    def undecided(self):
        """{run: its reasons} of those that are undecided themselves"""
        found = {job.name: decision.verdict(job) for member, place, job in self.jobs.values() if place in self.searches[member].said}
        return {name: reasons for name, (verdict, reasons, _) in found.items() if verdict == "undecided"}

    def equations(self):
        """what ballistic-limit equations say of the same range, or why they say nothing"""
        return ble.beside(ble.limits, self.at, self.values[0], self.values[-1])

    def answer(self):
        """The mapping of limit.yaml; limit is None where it is not in the range, reasons say why."""
        borders = {member: (s.borders()[0], s.borders()[3]) for member, s in self.searches.items()}
        result = {"on": self.quantity.title, "unit": self.unit, "limit": None, "varied": self.on, "own": self.own, "case": self.case.mapping(), "files": self.files}
        outside = [f"{decision.member_name(self.case, member)}: " + ", ".join(f"{s.said[place]} at {self.values[place]:g} {self.unit}" for place in sorted(s.said))
                   for member, s in self.searches.items() if None in borders[member]]
        if outside:
            return {**result, "reasons": ["an end of the range neither holds nor fails as it should: choose --from and --to on both sides of the limit, and mend "
                                          "what makes runs undecided", *outside]}
        if len({s.turned for s in self.searches.values()}) > 1:
            return {**result, "reasons": ["what holds and what fails is not on the same side at all spacings and shifts"]}
        middle = {member: 0.5 * (self.values[a] + self.values[d]) for member, (a, d) in borders.items()}
        mean = [sum(middle[which, shift] for shift in self.case.shifts) / len(self.case.shifts) for which in range(len(self.case.spacings_mm))]
        turned = next(iter(self.searches.values())).turned
        worst, best = (max, min) if turned else (min, max)
        finest = [middle[len(mean) - 1, shift] for shift in self.case.shifts]
        holds, fails = self.values[worst(a for a, _ in borders.values())], self.values[best(d for _, d in borders.values())]
        return {**result, "limit": round(mean[-1], 6), "holds": f"{'from' if turned else 'up to'} {holds:g}",
                "fails": f"{'up to' if turned else 'from'} {fails:g}", "undecided": sorted([holds, fails]), "step": round(self.values[1] - self.values[0], 6),
                "limit_of_spacings": {f"{dx:g} mm": round(m, 6) for dx, m in zip(self.case.spacings_mm, mean)},
                "change_by_spacing": round(mean[-1] - mean[-2], 6) if len(mean) > 1 else None,
                "range_over_shifts": round(max(finest) - min(finest), 6) if len(finest) > 1 else None,
                "notes": decision.note_of_layers(self.case) + decision.note_of_versions(self.every())}
