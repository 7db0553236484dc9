#!/bin/bash
# Static checks of the sources; anything found fails. Needs a configured build folder (make check sees to that).
#   cmake/check.sh BUILD LAMMPS_TREE [compilers] [tidy] [cppcheck] [python] [lammps]      default: all
# Each part leaves its findings in BUILD/check/PART.txt. Compilers and clang-tidy skip files that passed since the last change.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
build=$(realpath "$1") lammps=$2
shift 2
parts=${*:-compilers tidy cppcheck python lammps}
out=$build/check
mkdir -p "$out/passed"
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-2}
headers=$(cat .clang-tidy cmake/check.sh lib/hvi/*/*.h src/USER-HVI/*.h tests/unit/*.h 2>/dev/null | sha256sum)

# "file<TAB>flags" of our C++ files, from what the build compiles them with
commands() {
  python3 - "$build/compile_commands.json" "$PWD" <<'P'
import json, shlex, sys
for c in json.load(open(sys.argv[1])):
    if c["file"].startswith(tuple(sys.argv[2] + "/" + d for d in ("src/", "lib/", "tests/unit/"))):
        words = shlex.split(c["command"])
        first = next(k for k, w in enumerate(words) if w.startswith("-"))
        print(c["file"], shlex.join(words[first:words.index("-o")]), sep="\t")
P
}

# GCC counts parameters of constructors that are named as the members they set, LAMMPS's own way (LAMMPS *lmp)
not_constructors() { awk '/: In /{c = /In constructor/; next} /(warning|error):/ && !(c && /shadows a member/)'; }

# one file by one tool; says nothing and notes the file where nothing is found
one() {
  local tool=$1 file=$2 flags=$3 note said code found
  note=$out/passed/$(sha256sum <<<"$tool $headers $flags $(sha256sum <"$file") $file" | cut -c1-40)
  [ -e "$note" ] && return
  case $tool in
    tidy)
      [[ $file == */tests/* ]] && return
      said=$(clang-tidy -p "$build" --quiet "$file" 2>/dev/null) ;;
    *) # interfaces have parameters that one implementation does not need
      said=$(eval "LC_ALL=C $tool -fsyntax-only -Wall -Wextra -Wshadow -Wno-unused-parameter -Wno-unknown-warning-option $flags '$file'" 2>&1) ;;
  esac
  code=$?
  found=$(grep -E '(: In |(warning|error):)' <<<"$said" | not_constructors | grep -F "$PWD/")
  [ $code = 0 ] || found=${found:-$file: $tool ended with status $code}
  if [ -z "$found" ]; then touch "$note"; else echo "$found"; fi
}
export -f one not_constructors
export out build headers

each() { commands | tr '\t' '\n' | xargs -d '\n' -P "$jobs" -n 2 bash -c 'one "$@"' _ "$1" | sort -u; }
compilers() { for c in g++ clang++; do each $c; done; }
tidy() { each tidy; }    # tests of the library have warnings of compilers alone: GoogleTest's macros are not ours
cppcheck_all() {
  local dirs
  dirs=$(printf -- '-I %s ' lib/hvi/*/)
  cppcheck --quiet -j "$jobs" --std=c++17 --language=c++ --enable=warning,performance,portability --inline-suppr \
    --suppress=missingIncludeSystem --suppressions-list=<(grep -v '^#' cmake/cppcheck.txt | grep .) --template='{file}:{line}: {severity}: {message} [{id}]' \
    $dirs -I src/USER-HVI lib/hvi src/USER-HVI 2>&1
}
python_all() {
  # faults, not layout; a fixture of pytest is imported and then a parameter
  flake8 --select=F,E9,W6 --per-file-ignores='tests/*/test_*.py:F811' python tests bench doc examples cmake
  mypy --ignore-missing-imports --disable-error-code import python/hvi | grep -v '^Success'    # stubs of yaml may be missing
}
# LAMMPS's own scripts, which look into src, lib, doc and python of a tree laid out as its own
lammps_all() {
  local s
  for s in "$lammps"/tools/coding_standard/*.py; do python3 "$s" . || echo "$s failed"; done
  LC_ALL=C grep -nP '[^\x00-\x7F]' doc/src/*.rst src/USER-HVI/* && echo "not ASCII"
}

status=0
for part in $parts; do
  case $part in compilers | tidy) run=$part ;; *) run=${part}_all ;; esac
  $run >"$out/$part.txt" 2>&1
  if [ -s "$out/$part.txt" ]; then
    echo "check $part: $(wc -l <"$out/$part.txt") lines"; head -n 40 "$out/$part.txt"; status=1
  else
    echo "check $part: nothing found"
  fi
done
exit $status
