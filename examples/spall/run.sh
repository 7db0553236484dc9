#!/bin/sh
# All runs of README.md, one folder each under runs/, and what they say: sh run.sh [LAMMPS command, default: build/lmp]. Some minutes.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
export LAMMPS_POTENTIALS="$here/../../potentials:$here"
run() { # name, variables
  name=$1; shift
  mkdir -p runs/"$name"
  $lmp -in "$here"/in.spall -var out runs/"$name" -log runs/"$name"/log.lammps "$@" >runs/"$name"/screen </dev/null || exit 1
}
for n in 64 128 256 512; do run n$n-clumps -var n $n -var eta 1.2; done
for s in voids principal; do
  for n in 8 16 32 64 128 256 512; do run n$n-$s -var n $n -var spall $s; done
  while read -r hf ht; do
    for n in 64 128; do run h$hf-$n-$s -var hf "$hf" -var ht "$ht" -var n $n -var spall $s; done
  done <<THICK
20 40
6.3 12.6
2 4
0.63 1.26
0.2 0.4
0.063 0.126
THICK
done
python3=${HVI_PYTHON:-$("$here"/../../cmake/find-python.sh numpy scipy matplotlib)} || exit 1
$python3 "$here"/plot.py --raised || exit 1
sed '/^#/d; /^name,/d' "$here"/shots.csv | while IFS=, read -r shot metal paper flyer target hf ht v0 rest; do
  todo="voids-64 voids-128 none-128"
  [ "$target" = Al6061-T6.hvi ] && todo="$todo principal-128"    # other files have no section spall limit
  raised=runs/raised/$target
  [ "$flyer" = "$target" ] && same=$raised || same=$flyer
  shot=shot-$(echo "$shot" | tr ' ' _)
  run "$shot"-raised-128 -var flyer "$same" -var target "$raised" -var hf "$hf" -var ht "$ht" -var v0 "$v0" -var n 128 || exit 1
  for s in $todo; do
    run "$shot-$s" -var flyer "$flyer" -var target "$target" -var hf "$hf" -var ht "$ht" -var v0 "$v0" -var spall "${s%-*}" -var n "${s#*-}"
  done || exit 1
done || exit 1
PYTHONPATH=$here/../../python $python3 -m hvi measure runs/*-* >runs/results
