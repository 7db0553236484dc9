"""Builds with PORTABLE=yes run where there is no AVX (QEMU), with the pair sums for AVX2 where there is (hvi_sph_sweep.cpp has both)."""

import os
import re
import shutil
import signal
import subprocess

import pytest
from whole_runs import VARIABLES, WHOLE_RUNS

pytestmark = pytest.mark.long
WEAK = re.compile(r"^\S+ [WVu] (?!DW\.ref\.|typeinfo|vtable)(.*)$", re.M)


@pytest.mark.parametrize("scene", WHOLE_RUNS)
def test_runs_without_avx(lmp, lmp_exe, root, tmp_path, scene):
    qemu = shutil.which("qemu-x86_64")
    if not qemu:
        pytest.skip("no QEMU (Debian: apt-get install qemu-user)")
    portable = os.environ.get("HVI_LMP_PORTABLE", str(lmp_exe))
    old = [qemu, "-cpu", "Nehalem", portable]
    if subprocess.run([*old, "-h"], capture_output=True).returncode == -signal.SIGILL:
        pytest.skip("lmp is of this machine only: make build PORTABLE=yes BUILD=build-portable, then HVI_LMP_PORTABLE=build-portable/lmp")
    script = tmp_path / "lmp"
    script.write_text(f'#!/bin/sh\nexec {" ".join(old)} "$@"\n')
    script.chmod(0o755)
    got, want = (lmp(scene(root), vars=VARIABLES.get(scene), env={"LAMMPS_POTENTIALS": str(root / "potentials")}, exe=exe, timeout=1500).thermo for exe in (script, portable))
    assert list(got["Step"]) == list(want["Step"])
    for name in want:  # fracture is chaotic: the last digits are others, later all of them
        assert got[name][0] == pytest.approx(want[name][0], rel=1e-9, abs=1e-9, nan_ok=True), (scene, name)


def test_code_for_avx2_stays_in_its_file(root, tmp_path):
    """functions that two objects have are linked once: one with AVX2 would stop other machines"""
    rooms = [f"-I{p}" for p in (root / "lib/hvi").iterdir()]
    subprocess.run(["g++", "-std=c++17", "-O3", "-DNDEBUG", "-fPIC", "-mavx2", "-mfma", "-fno-math-errno", "-fno-trapping-math", "-Wno-psabi", "-DHVI_SWEEPS_AVX2", *rooms,
                    "-I/usr/include/eigen3", "-c", root / "lib/hvi/sph/hvi_sph_sweep.cpp", "-o", tmp_path / "sweeps.o"], check=True)
    names = subprocess.run(["nm", "-C", tmp_path / "sweeps.o"], check=True, capture_output=True, text=True).stdout
    assert "make_avx2_sph_sweeps" in names and WEAK.findall(names) == []
