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
  sed "s|^create_atoms 2 region plate|read_data    $out/$name/plate.data add append offset 1 0 0 0 0|" in.plate >"$out/$name/in.plate"
  "$top/cmake/env.sh" mpirun -np 2 "${HVI_LMP:-$top/build/lmp}" -in "$out/$name/in.plate" -var dx 0.5 -var Rplate 75 -var tstop 12 \
    -var frame 1.5 -var out "$out/$name" -log "$out/$name/log.lammps" >"$out/$name/output.txt"
  echo "$name"
  $python front.py $(ls "$out/$name"/frame.*.dump | tail -2)    # 10.5 and 12 us
done | tee "$out/fronts.txt"
