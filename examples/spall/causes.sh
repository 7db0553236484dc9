#!/bin/sh
# Causes of low spall strength, tables.md: more particles, another phi_c, a softer 6061, one shot each: sh causes.sh [LAMMPS command, default: build/lmp]. A minute or two.
here=$(cd "$(dirname "$0")" && pwd)
lmp=${*:-$here/../../build/lmp}
export LAMMPS_POTENTIALS="$here/../../potentials:$here" PYTHONPATH="$here/../../python"
python3=${HVI_PYTHON:-$("$here"/../../cmake/find-python.sh numpy scipy yaml)} || exit 1
run() { # name, file, flyer, target, velocity, n
  mkdir -p runs/"$1"
  $lmp -in "$here"/in.spall -var out runs/"$1" -log runs/"$1"/log.lammps -var flyer "$2" -var target "$2" -var hf "$3" -var ht "$4" -var v0 "$5" -var n "$6" \
    >runs/"$1"/screen </dev/null || exit 1
}
other() { # file, section before the key, key and value; the file mine.hvi of a folder is printed
  folder=runs/files/$1-$(echo "$*" | cksum | cut -d' ' -f1); mkdir -p "$folder"
  file=$1; shift
  cp "$here/../../potentials/$file.hvi" "$folder"/mine.hvi
  while [ $# -gt 0 ]; do
    sed -i "/^$1/,/^[a-z]/{/^[a-z]/!s/^  $2 .*/  $2 $3/}" "$folder"/mine.hvi
    grep -q "^  $2 $3\$" "$folder"/mine.hvi || exit 1
    shift 3
  done
  echo "$folder"/mine.hvi
}
for n in 64 128 256; do
  run cause-1100-$n Al1100-O.hvi 3.200 5.875 1007 $n
  run cause-304-$n steel-304.hvi 0.75 1.51 300 $n
done
for phi_c in 0.03 0.075; do
  file=$(other Al1100-O 'spall voids' phi_c $phi_c) || exit 1
  run cause-1100-phi_c-$phi_c "$file" 3.200 5.875 1007 128
done
file=$(other steel-304 'spall voids' phi_c 0.075) || exit 1
run cause-304-phi_c-0.075 "$file" 0.75 1.51 300 128
soft=$(other Al6061-T6 'strength johnson-cook' A 0.11e9 'spall voids' phi_c 0.0275) || exit 1
for file in Al6061-T6.hvi "$soft"; do
  [ "$file" = "$soft" ] && name=soft || name=file
  run cause-6061-14-$name "$file" 14 28 196 128
  run cause-6061-4.5-$name "$file" 4.5 9 288 128
done
$python3 -m hvi measure runs/cause-*
