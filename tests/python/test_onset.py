"""examples/single-plate: onset.py reads velocities off the sweeps' tables; studies/constants.py changes one constant of a material file."""

import csv
import os
import re
import subprocess
import sys

import pytest
from conftest import ROOT

from hvi.material import library

FOLDER = ROOT / "examples" / "single-plate"


def script(path, folder, *words):
    return subprocess.run([sys.executable, path, *words], cwd=folder, capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "Agg"})


def sweep(path, rows, metal="Al2017-T4.hvi"):
    """rows: t, dx, shift, v0, share of the sphere, of its rear, sound; None: a run that failed"""
    names = "t dx shift v0 material_p largest_apart_mass_fraction largest_rear_mass_fraction largest_fragment_mass_fraction core_s energy_ratio".split()
    with open(path, "w", newline="") as f:
        out = csv.writer(f)
        out.writerow(names)
        for t, dx, shift, v0, *shares in rows:
            out.writerow([t, dx, shift, v0, metal, *(shares if shares[0] is not None else ["", "", ""]), 12, 1 + 2e-8])


def test_onset(tmp_path):
    """on straight lines, passed first from below; below the least, beyond the largest; runs without a result are said"""
    sweep(tmp_path / "onset.csv", [
        (0.953, 0.4765, "", 3500, 0.2, 0.1, 0.2), (0.953, 0.4765, "", 2500, 1.0, 1.0, 0.95), (0.953, 0.4765, "", 3000, 0.6, 0.8, 0.6), (0.953, 0.4765, "", 4000, 0.95, 1, 0.3),
        (1.5248, 0.50826667, "", 3000, 0.4, 0.95, 0.3), (1.5248, 0.50826667, "", 2500, 0.85, 0.96, 0.8), (1.5248, 0.50826667, "", 3500, None)])
    sweep(tmp_path / "onset-variations.csv", [(0.953, 0.31766667, "", 3000, 0.92, 1, 0.9), (0.953, 0.31766667, "", 3500, 0.42, 0.5, 0.4), (0.953, 0.4765, 0.25, 3000, 0.7, 1, 0.7)])
    r = script(FOLDER / "onset.py", tmp_path, ".")
    assert r.returncode == 0, r.stderr
    assert "onset.csv: 1 runs without a result are left out" in r.stdout and (tmp_path / "onset.png").stat().st_size > 10000
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in r.stdout.splitlines() if line.startswith("|")]
    assert ["0.1", "2", "3.09", "2.75 (-11 %)", "2.62 (-15 %)", "3.12 (+1 %)", "3.12", "not run", "2.9, 7.7", "6.0, 7.8"] in rows
    assert ["0.16", "3", "2.60", "not reached", "below 2.5 (-4 %)", "2.89 (+11 %)", "2.80", "not run", "2.2-2.3, 5", "4.1, 7.2"] in rows
    assert ["0.1", "apart", "1.000", "0.600", "0.200", "0.950"] in rows and ["0.16", "apart", "0.850", "0.400", "-", "-"] in rows
    assert ["0.1", "30 across, 3 layers", "3: 0.920; 3.5: 0.420", "1.000, 0.500", "3.10 (+0 %)", "3.02 (-2 %)", "3.42 (+11 %)"] in rows
    assert ["0.1", "lattice shifted by 0.25 spacings", "3: 0.700", "1.000", "not reached", "below 3 (-3 %)", "not reached"] in rows
    assert re.search(r"^9 runs, 12 to 12 core-seconds, energy to 2e-08$", r.stdout, re.M)


def test_no_runs(tmp_path):
    r = script(FOLDER / "onset.py", tmp_path, ".")
    assert r.returncode == 1 and "no runs of studies/onset.yaml" in r.stderr


def test_constants(tmp_path):
    """files that differ from the package's in the one constant that their name says, by its factor"""
    assert script(FOLDER / "studies" / "constants.py", tmp_path, "made").returncode == 0
    made = sorted((tmp_path / "made").glob("*.hvi"))
    assert len(made) == 8
    for path in made:
        metal, key, factor = re.fullmatch(r"(.*-T\d)-(sigma|m|phi_c)-(.*)\.hvi", path.name).groups()
        one, other = library.read(ROOT / "potentials" / f"{metal}.hvi"), library.read(path)
        for section, values in one.sections.items():
            want = dict(values)
            if section == ("spall", "voids"):
                want[key] *= float(factor)
            assert other.sections[section] == pytest.approx(want, rel=1e-6)
        assert other.sections.keys() == one.sections.keys(), path
