#!/bin/sh
# Meshes of both walls, the run of README.md, its tables: sh run.sh [LAMMPS command, default: build/lmp]. Some minutes.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
export LAMMPS_POTENTIALS="$here/../../potentials" PYTHONPATH="$here/../../python"
python3=${HVI_PYTHON:-$("$here"/../../cmake/find-python.sh numpy scipy matplotlib yaml)} || exit 1
mesh() { # wall, core, hold, type, options
  wall=$1; core=$2; hold=$3; type=$4; shift 4
  $python3 -m hvi mesh "wall$wall.data" --side 300e-3 --thickness 0.8e-3 --element 0.8e-3 --core "$core" --hold "$hold" --growth 1.2 --largest 1.6e-3 \
    --quarter --type "$type" --node-type $((type + 1)) --material "$here"/../../potentials/Al2024-T3.hvi "$@" || exit 1
}
mesh 1 8e-3 14e-3 2
mesh 2 30e-3 50e-3 4 --bottom 60.8e-3
$lmp -in "$here"/in.waves || exit 1
for wall in 1 2; do $python3 "$here"/waves.py . --wall $wall --table waves$wall.csv --figure waves$wall.png --maps walls$wall.png || exit 1; done
