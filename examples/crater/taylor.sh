#!/bin/sh
# Taylor's cylinders of tables.md, a line each: velocity, law, length left: sh taylor.sh [LAMMPS command, default: build/lmp]. Some minutes.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
export LAMMPS_POTENTIALS="$here/../../potentials:$here"
rod() { # velocity, name, file, words of fix hvi/johnson-cook
  mkdir -p runs/taylor-"$1-$2"
  $lmp -in "$here"/in.taylor -log runs/taylor-"$1-$2"/log.lammps -var v0 "$1" -var material "$3" -var solid "$4" >runs/taylor-"$1-$2"/screen || exit 1
  echo "$1 $2 $(sed -n 's:^Lf/L0 ::p' runs/taylor-"$1-$2"/screen)"
}
for v0 in 262 373 478; do
  rod $v0 perfect Al6061-perfect.hvi "strength perfect damage no spall none"
  rod $v0 steinberg-guinan Al6061-T6.hvi "strength steinberg-guinan damage no spall none"
  rod $v0 johnson-cook Al6061-T6.hvi "damage no spall none"
  rod $v0 voids Al6061-T6.hvi "damage no spall voids"
done
