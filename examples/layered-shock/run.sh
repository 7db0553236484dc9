#!/bin/sh
# All runs of README.md, one folder each under runs/: sh run.sh [LAMMPS command, default: build/lmp]. About two minutes.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
auto="viscosity 1 2 interface auto"
riemann="dissipation riemann"
run() { # name, variables
  name=$1; shift
  mkdir -p runs/"$name"
  $lmp -in "$here"/in.layers -var out runs/"$name" -log runs/"$name"/log.lammps "$@" >runs/"$name"/screen || exit 1
}
for gap in 0 0.1; do
  run test-$gap-none -var gap $gap -var pair "viscosity 1 2 interface 0"
  run test-$gap-0.3 -var gap $gap
  run test-$gap-0.8 -var gap $gap -var pair "viscosity 1 2 interface 0.8"
  run test-$gap-auto -var gap $gap -var pair "$auto"
  run test-$gap-riemann -var gap $gap -var pair "$riemann"
done
for n in 100 200 800 1600; do
  run n$n-0.3 -var n $n
  run n$n-auto -var n $n -var pair "$auto"
  run n$n-riemann -var n $n -var pair "$riemann"
done
for kernel in quadratic cubic quartic quintic wendland2 wendland4; do run kernel-$kernel -var kernel $kernel; done
for eta in 1.0 1.5; do run eta-$eta -var eta $eta; done
run h-constant -var hvar constant
for case in al_glass_al al_carbon_al st_glass_st st_carbon_st; do
  words=$(python3 "$here"/laminates.py $case)
  run $case-0.3 $words
  run $case-auto $words -var pair "$auto"
  run $case-riemann $words -var pair "$riemann"
  run $case-gap $words -var gap 0.1 -var pair "$auto"
done
