"""examples/wall-waves, small and short: the longitudinal wave in a wall of elements is as fast as plate theory says, the books are closed."""

import os
import subprocess
import sys

import numpy as np
import pytest
import yaml
from conftest import ROOT

sys.path.insert(0, str(ROOT / "examples" / "wall-waves"))
import waves
from dumps import read_dump

AT = (25, 35, 45)
FAR = 98e-3  # m, front of wall 2: nothing comes there in 13 us


@pytest.fixture(scope="module")
def wall(tmp_path_factory, lmp_exe):
    """(folder, result) of wall 1, 120 mm wide, with cubes of its thickness of 0.8 mm and coarser ones beyond 14 mm; wall 2 is small, and out of reach"""
    folder = tmp_path_factory.mktemp("wall")
    env = {**os.environ, "LAMMPS_POTENTIALS": str(ROOT / "potentials"), "PYTHONPATH": str(ROOT / "python")}
    for name, words in (("wall1.data", "--side 120e-3 --core 8e-3 --hold 14e-3 --growth 1.2 --largest 1.6e-3 --type 2 --node-type 3"),
                        ("wall2.data", f"--side 8e-3 --bottom {FAR} --type 4 --node-type 5")):
        mesh = ["mesh", name, *words.split(), "--thickness", "0.8e-3", "--element", "0.8e-3", "--quarter", "--material", str(ROOT / "potentials/Al2024-T3.hvi")]
        subprocess.run([sys.executable, "-m", "hvi", *mesh], cwd=folder, env=env, check=True, stdout=subprocess.DEVNULL)
    probes = " ".join(f"probe {r}e-3 0 {z}" for r in AT for z in (0, 0.8e-3, FAR, FAR + 0.8e-3))
    r = subprocess.run([lmp_exe, "-in", ROOT / "examples/wall-waves/in.waves", "-var", "tstop", "13", "-var", "probes", probes], cwd=folder, env=env, text=True,
                       capture_output=True)
    assert r.returncode == 0, r.stdout[-3000:]
    return folder, yaml.safe_load((folder / "result.yaml").read_text())


def test_books(wall):
    r = wall[1]
    assert r["time_us"] >= 13 and r["elements"] > 2000 and r["plain_elements_failed"] == 0
    assert abs(r["energy_ratio"] - 1) < 1e-4
    assert 0 < r["hourglass_share"] < 1e-2 and r["conversion_heat_share"] < 1e-3


def test_longitudinal_wave(wall, monkeypatch):
    """from 25 to 35 to 45 mm; peaks fall, and the wave is in the plane: stress is the same at both faces, nothing across the wall yet"""
    monkeypatch.setenv("LAMMPS_POTENTIALS", str(ROOT / "potentials"))
    plate = waves.Plate("Al2024-T3.hvi", 0.8)
    assert plate.plate == pytest.approx(5.572, abs=1e-3)  # sqrt(E/(rho (1 - nu^2))), E 76.6 GPa and nu 0.339 of the material file
    records = {place: record for place, record in waves.read(wall[0] / "waves.dat", AT).items() if place[0] == 1}
    distance = np.array([r["r"] for r in records.values()])
    assert np.all(np.abs(distance - AT) < 0.85)  # centers of elements of up to 1.6 mm
    arrival, middle, peak, vm, radial, velocity = np.array([waves.membrane(r, 0.1, 13) for r in records.values()]).T
    assert (distance[-1] - distance[0]) / (middle[-1] - middle[0]) == pytest.approx(plate.plate, rel=0.03)
    assert np.all(np.diff(vm) < 0) and 100 < vm[-1] < vm[0] < 300 and np.all(radial < 0)
    # behind a plane front sigma = rho c v
    assert np.allclose(-1e6 * radial, plate.rho * 1e3 * plate.plate * velocity, rtol=0.15)
    for r in records.values():
        early = r["us"] < arrival[0]
        assert np.abs(r["vm_bend"]).max() < 1e-9 * vm[0] * 1e6 and np.abs(r["vz"][early]).max() < 1e-2 * velocity.max()


def test_every_row_is_of_its_step(wall):
    """probes are read when they are asked for, not at output steps only"""
    r = waves.read(wall[0] / "waves.dat", AT)[1, 25]
    later = r["us"] > 5
    assert np.count_nonzero(np.diff(r["vm"][later]) == 0) == 0 and np.all(np.diff(r["us"]) > 0)


def test_elements_without_particles_are_listed(wall):
    """dump local: every element, at its place; away from the hole none is plastic, with a stress of the size that probes saw"""
    dumps = sorted(wall[0].glob("elements.*.dump"), key=lambda path: int(path.name.split(".")[1]))
    assert len(dumps) == 2
    table = read_dump(dumps[-1]).table
    assert table.shape == (wall[1]["elements"], 17) and len(np.unique(table[:, 0])) == len(table)
    assert set(table[:, 1]) == {2, 4}
    table = table[table[:, 1] == 2]
    x, y, z, vm, eps = table[:, [2, 3, 4, 12, 13]].T
    assert np.allclose(z, 0.4e-3, atol=0.2e-3) and x.min() > 0 and x.max() < 60.1e-3
    assert np.count_nonzero(table[:, 16] == 2) == 159 and set(table[:, 16]) == {0, 2}  # those that hold particles
    far = np.hypot(x, y) > 40e-3
    assert np.all(eps[far] == 0) and 5e7 < vm[far].max() < 3e8
