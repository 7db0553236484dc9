#!/bin/sh
# All runs of README.md, one folder each under runs/: sh run.sh [LAMMPS command, default: build/lmp]. About two minutes.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
export LAMMPS_POTENTIALS="$here/../../potentials"
run() { # name, input, variables
  name=$1; input=$2; shift 2
  mkdir -p runs/"$name"
  $lmp -in "$here"/in."$input" -var out runs/"$name" -log runs/"$name"/log.lammps "$@" >runs/"$name"/screen || exit 1
}
al_cu="-var file_f Al2024-T3.hvi -var rho_f 2785 -var c_f 5328 -var s_f 1.338 -var file_t Cu-OFHC.hvi -var rho_t 8930 -var c_t 3940 -var s_t 1.489"
words() { # of the pair style
  case $1 in
    monaghan) echo viscosity 1 2 ;;
    auto) echo viscosity 1 2 interface auto ;;
    riemann) echo dissipation riemann ;;
  esac
}
for d in monaghan auto riemann; do
  for n in 400 800 1600; do run sod-$d-$n sod -var pair "$(words $d)" -var n $n; done
  for n in 200 400 800; do run noh1-$d-$n noh -var pair "$(words $d)" -var n $n; done
  for n in 25 50; do run noh2-$d-$n noh -var pair "$(words $d)" -var dim 2 -var n $n; done
  for n in 100 200 400; do run flyer-$d-$n flyer -var pair "$(words $d)" -var n $n; done
  for v in 500 1000 2000 3000 7000 10000; do run flyer-$d-v$v flyer -var pair "$(words $d)" -var v0 $v; done
  run flyer-$d-cu flyer -var pair "$(words $d)" $al_cu -var v0 5750
  run noh3-$d-14 noh -var pair "$(words $d)" -var dim 3
done
for d in monaghan riemann; do
  run unequal-$d-800 sod -var pair "$(words $d)" -var n 800 -var masses unequal
  for n in 400 800; do run blast-$d-$n sod -var pair "$(words $d)" -var n $n -var p_l 1000 -var p_r 0.01 -var rho_r 1 -var tstop 0.012; done
done
