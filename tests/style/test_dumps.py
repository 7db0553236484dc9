"""Dumps of the examples: columns with names, time, units, mass and mirror planes; MDAnalysis and OVITO read them as they are."""

import re

import hvi
import numpy as np
import plate_scenes
import pytest
import yaml
from hvi.io import mirror
from hvi.io.bonds import BondDump
from hvi.io.data import DataFile
from hvi.jobs import engine
from hvi.shield import chain
from shield_runs import read, wall

pytestmark = pytest.mark.filterwarnings("ignore::hvi.errors.HVIWarning")  # of few layers
ALWAYS = ["id", "type", "mass", "x", "y", "z", "vx", "vy", "vz", "time_si"]
STATE = ["p", "damage", "spalled", "vm", "fragsize"]
# input or its text, variables (seconds each), or a wall and words of a case of hvi shield; dumps, columns, model
CASES = {
    "plate": (plate_scenes.text(quarter=False), dict(dx=1.25, Rplate=15, frame=0.5, tstop=1), "*.dump", STATE, "whole"),
    "quarter plate": ("single-plate/in.plate", dict(dx=1.25, Rplate=15, frame=0.5, tstop=1), "*.dump", STATE, "quarter (mirror x 0 lo, mirror y 0 lo)"),
    "shield": (wall(0.8, radius=8), dict(tstop=1.5, film=0.5), "*.dump", [*STATE, "e", "eps"], "quarter (mirror x 0 lo, mirror y 0 lo)"),
    "oblique shield": (wall(0.8, radius=8), dict(tstop=2, film=0.5, angle=30), "*.dump", [*STATE, "e", "eps"], "whole"),
    "debris": ("debris-cloud/in.debris", dict(N=2000, tstop=1, frames=2, Rplate=10), "debris.dump", [], "whole"),
}


@pytest.fixture(scope="module")
def cache():
    return {}


@pytest.fixture(params=CASES)
def case(request, lmp, root, tmp_path_factory, cache):
    """(name, its dumps), each run once"""
    name = request.param
    if name not in cache:
        folder = tmp_path_factory.mktemp("case")
        script, variables, pattern, _, _ = CASES[name]
        if isinstance(script, dict):
            chain.write_run(read(folder / "case.yaml", script, **variables), 0, 0, folder)
            lmp(folder / "in.shield", cwd=folder, env={"LAMMPS_POTENTIALS": ""})
            chain.judge(folder)
        elif "\n" in script:
            lmp(script, cwd=folder, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
        else:
            source = engine.Input(root / "examples" / script)
            source.copy_to(folder)  # with what it includes
            lmp(folder / source.name, cwd=folder, env={"LAMMPS_POTENTIALS": str(root / "potentials")}, vars={"out": folder, **variables})
        cache[name] = sorted(folder.glob(pattern))
        assert cache[name]
    return name, cache[name]


def test_columns(case):
    """every number has a name, none that of a compute or variable; time and planes are said"""
    name, files = case
    times = []
    for path in files:
        dump = hvi.Dump(path)
        assert list(dump.columns[:len(ALWAYS)]) == ALWAYS and [c for c in CASES[name][3] if c not in dump.columns] == [], path
        assert [c for c in dump.columns if not re.fullmatch(r"[A-Za-z]\w*", c) or re.match(r"[cvf]_", c)] == [], path
        assert dump.units == "si" and mirror.text(dump.mirror(0)) == CASES[name][4], path
        for frame in dump:
            times.append(frame.time)
            assert frame.m.min() > 0 and (frame["time_si"] == frame.time).all()
            assert hvi.measure(frame, "z", -1.0)["mass"] == pytest.approx(frame.m.sum() * 2 ** len(frame.planes), rel=1e-12)
    end = 1e-6 * yaml.safe_load((files[0].parent / "result.yaml").read_text())["time_us"]
    assert max(times) == pytest.approx(end, rel=0.02 if name == "debris" else 1e-4)  # which goes on to the end of a look


def test_plain_mdanalysis(case):
    """MDAnalysis's own reader and topology parser, without a data file; it puts the lower corner of the box at 0"""
    MDAnalysis = pytest.importorskip("MDAnalysis")
    for path in case[1]:
        u = MDAnalysis.Universe(str(path), format="LAMMPSDUMP", topology_format="LAMMPSDUMP")
        dump = hvi.Dump(path)
        assert len(u.trajectory) == len(dump), path
        for ts, frame in zip(u.trajectory, dump):
            assert ts.data["step"] == frame.step and np.array_equal(u.atoms.ids, frame.ids)
            size = np.abs(frame.box.vectors).max()
            assert np.abs(u.atoms.positions + frame.box.origin - frame.x).max() < 1e-6 * size
            assert u.atoms.velocities == pytest.approx(frame.v, rel=1e-6, abs=1e-3)
            assert np.array_equal(u.atoms.types, frame["type"].astype(str))


def ovito(path):
    """[(attributes, names, rows)] of a dump, read as OVITO's manual describes it: docs.ovito.org, LAMMPS dump file reader.

    The file begins with ITEM: TIMESTEP, UNITS or TIME, and NUMBER OF ATOMS comes within 20 lines. Other items are skipped. A name of
    a column is that of a property: letters, digits and _, each once. A row has as many numbers as there are names.
    """
    lines = path.read_text().splitlines()
    assert re.match(r"ITEM: (TIMESTEP|UNITS|TIME)$", lines[0]) and any(x == "ITEM: NUMBER OF ATOMS" for x in lines[:20])
    frames, k, said = [], 0, {}
    while k < len(lines):
        item = lines[k]
        assert item.startswith("ITEM: "), item
        k += 1
        if item in ("ITEM: TIMESTEP", "ITEM: TIME", "ITEM: NUMBER OF ATOMS"):
            said[item[6:]] = float(lines[k])
        elif item.startswith("ITEM: BOX BOUNDS"):
            said["box"] = [[float(word) for word in line.split()] for line in lines[k:k + 3]]
            assert [len(row) for row in said["box"]] == [2, 2, 2] and all(re.fullmatch("pp|[fsm]{2}", word) for word in item.split()[3:6])
        elif item.startswith("ITEM: ATOMS"):
            names, n = item.split()[2:], int(said["NUMBER OF ATOMS"])
            assert len(set(names)) == len(names) and all(re.fullmatch(r"\w+", name) for name in names)
            rows = [[float(word) for word in line.split()] for line in lines[k:k + n]]
            assert len(rows) == n and {len(row) for row in rows} == {len(names)}
            frames.append((said, names, np.array(rows)))
            k, said = k + n, {}
        while k < len(lines) and not lines[k].startswith("ITEM:"):
            k += 1
    return frames


def test_ovito(case):
    for path in case[1]:
        dump = hvi.Dump(path)
        frames = ovito(path)
        assert len(frames) == len(dump), path
        for (said, names, rows), frame in zip(frames, dump):
            assert said["TIMESTEP"] == frame.step and {"id", "type", "x", "y", "z", "vx", "vy", "vz", "mass"} <= set(names)
            assert np.array_equal(rows[:, names.index("z")], frame["z"]) and (rows[:, names.index("time_si")] == frame.time).all()


def test_bonds(case):
    """dump local with the names of its columns, a list of bonds to OVITO; those of compute property/local"""
    if case[0] != "debris":
        return
    folder = case[1][0].parent
    text = (folder / "bonds.dump").read_text()
    assert "ITEM: NUMBER OF BONDS\n" in text and "ITEM: BONDS index btype batom1 batom2\n" in text
    bonds = BondDump(folder / "bonds.dump")
    dump = hvi.Dump(case[1][0])
    assert bonds.dump.units == "si" and [bonds.dump.time(k) for k in range(3)] == pytest.approx([dump.time(k) for k in range(3)], rel=1e-8)
    first, last = ({tuple(sorted(pair)) for pair in bonds.at(step).tolist()} for step in (dump.steps[0], dump.steps[-1]))
    assert {tuple(sorted(pair)) for pair in DataFile(folder / "debris.data").bonds.tolist()} < last < first
