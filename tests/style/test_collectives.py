"""Every rank makes the same collective calls in the same order, with the same roots, operations and sizes: tests/components/collectives.c
asks them all before each. A rank that leaves one out, or works on a loop that others do not have, ends the run instead of hanging it."""

import os
import pathlib
import shutil
import subprocess

import pytest
from whole_runs import VARIABLES, WHOLE_RUNS

OUT_OF_ORDER = r"""
#include <mpi.h>
int main(int argc, char **argv)
{
  int me, one = 1, all;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  if (me == 0 || argc != 2) MPI_Allreduce(&one, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Bcast(&one, 1, MPI_INT, argc > 2 ? me : 0, MPI_COMM_WORLD);
  MPI_Finalize();
}
"""


@pytest.fixture(scope="module")
def tools(root, tmp_path_factory):
    """folder with collectives.so and a program with a fault of each kind"""
    compiler = shutil.which(os.environ.get("MPICC", "mpicc"))
    if not compiler:
        pytest.fail("no mpicc: set MPICC", pytrace=False)
    folder = tmp_path_factory.mktemp("collectives")
    (folder / "wrong.c").write_text(OUT_OF_ORDER)
    source = root / "tests" / "components" / "collectives.c"
    subprocess.run([compiler, "-shared", "-fPIC", "-Wall", "-Wextra", "-Werror", source, "-o", folder / "collectives.so"], check=True)
    subprocess.run([compiler, folder / "wrong.c", "-o", folder / "wrong"], check=True)
    return folder


@pytest.mark.parametrize("nranks", [2, 3])
@pytest.mark.parametrize("scene", WHOLE_RUNS)
def test_ranks_agree_on_their_collective_calls(lmp, lmp_exe, root, tmp_path, tools, scene, nranks):
    script = tmp_path / "lmp"
    script.write_text(f'#!/bin/sh\nexport ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0"\nLD_PRELOAD={tools}/collectives.so exec {lmp_exe} "$@"\n')
    script.chmod(0o755)
    lmp(scene(root), nranks=nranks, exe=script, vars=VARIABLES.get(scene), env={"LAMMPS_POTENTIALS": str(root / "potentials")})
    assert int(pathlib.Path("collectives.agreed").read_text()) > 300


@pytest.mark.parametrize("words, says", [([], None), (["one left out"], "MPI_Allreduce, 4 bytes"), (["", "other roots"], "MPI_Bcast, 4 bytes, root 0")])
def test_what_differs_is_found(root, tools, words, says):
    """the library itself, on a program whose second rank leaves a call out"""
    result = subprocess.run([root / "cmake/env.sh", "mpirun", "-np", "2", "-x", f"LD_PRELOAD={tools}/collectives.so", tools / "wrong", *words],
                            capture_output=True, text=True, timeout=60)
    if says is None:
        assert result.returncode == 0, result.stderr
    else:
        assert result.returncode != 0 and "COLLECTIVES DIFFER: rank 0: " + says in result.stderr and "rank 1: MPI_Bcast" in result.stderr
