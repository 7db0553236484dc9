#!/bin/bash
# Stress fronts at 10.5 and 12 us in plates of 75 mm radius, for three lattices: front.sh [FOLDER] -> FOLDER/*/front.png, fronts.txt
set -euo pipefail
cd "$(dirname "$0")"
top=$PWD/../.. out=$(realpath -m "${1:-fronts}") python=$("$PWD/../../cmake/find-python.sh" numpy matplotlib MDAnalysis)
export LAMMPS_POTENTIALS=$top/potentials PYTHONPATH=$top/python
mkdir -p "$out"
for what in plain:0 rotated:45 layers:"0 45"; do
  name=${what%%:*} angles=${what#*:}
  mkdir -p "$out/$name"
  $python -m hvi plate "$out/$name/plate.data" --radius 75e-3 --thickness 2e-3 --spacing 0.5e-3 --layers 4 --angles $angles \
    --material "$top/potentials/Al6061-T6.hvi" --quarter >/dev/null
  "$top/cmake/env.sh" mpirun -np 2 "${HVI_LMP:-$top/build/lmp}" -in in.plate -var quarter yes -var dx 0.5 -var Rplate 75 -var tstop 12 \
    -var frame 10.5 12 -var plate "$out/$name/plate.data" -var out "$out/$name" -log "$out/$name/log.lammps" >"$out/$name/output.txt"
  echo "$name"
  $python front.py "$out/$name"/frame.10.5.dump "$out/$name"/frame.12.dump
done | tee "$out/fronts.txt"
