"""Builds with PORTABLE=yes run where there is no AVX (QEMU), with the pair sums for AVX2 where there is (hvi_sph_sweep.cpp has both)."""

import os
import re
import shutil
import signal
import subprocess

import pytest
from whole_runs import VARIABLES, WHOLE_RUNS, liquid

pytestmark = pytest.mark.long
WEAK = re.compile(r"^\S+ [WVu] (?!DW\.ref\.|typeinfo|vtable)(.*)$", re.M)


@pytest.mark.parametrize("scene", WHOLE_RUNS)
def test_runs_without_avx(lmp, lmp_portable, root, tmp_path, scene):
    qemu = shutil.which("qemu-x86_64")
    if not qemu:
        pytest.skip("no QEMU (Debian: apt-get install qemu-user)")
    if "HVI_LMP_PORTABLE" not in os.environ and subprocess.run([qemu, "-cpu", "Nehalem", lmp_portable, "-h"], capture_output=True).returncode == -signal.SIGILL:
        pytest.skip("lmp is of this machine only: make build PORTABLE=yes BUILD=build-portable, then HVI_LMP_PORTABLE=build-portable/lmp")
    script = tmp_path / "lmp"
    script.write_text(f'#!/bin/sh\nexec {qemu} -cpu Nehalem {lmp_portable} "$@"\n')
    script.chmod(0o755)
    without, with_it = (lmp(scene(root), vars=VARIABLES.get(scene), env={"LAMMPS_POTENTIALS": str(root / "potentials")}, exe=exe, timeout=1500).thermo for exe in (script, lmp_portable))
    assert list(without["Step"]) == list(with_it["Step"])
    compared = slice(None) if scene is liquid else slice(2)  # fracture is chaotic
    for name, want in with_it.items():
        assert without[name][compared] == pytest.approx(want[compared], rel=1e-6, abs=max(1e-6 * abs(want).max(), 1e-12), nan_ok=True), (scene, name)


def test_code_for_avx2_stays_in_its_file(root, tmp_path):
    """functions that two objects have are linked once: one with AVX2 would stop other machines"""
    rooms = [f"-I{p}" for p in (root / "lib/hvi").iterdir()]
    subprocess.run(["g++", "-std=c++17", "-O3", "-DNDEBUG", "-fPIC", "-mavx2", "-mfma", "-fno-math-errno", "-fno-trapping-math", "-Wno-psabi", "-DHVI_SWEEPS_AVX2", *rooms,
                    "-I/usr/include/eigen3", "-c", root / "lib/hvi/sph/hvi_sph_sweep.cpp", "-o", tmp_path / "sweeps.o"], check=True)
    names = subprocess.run(["nm", "-C", tmp_path / "sweeps.o"], check=True, capture_output=True, text=True).stdout
    assert "make_avx2_sph_sweeps" in names and WEAK.findall(names) == []
