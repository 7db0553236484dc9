#!/bin/bash
# Builds the stock LAMMPS library with LAMMPS's own CMake; safe against two runs at once and against interruption.
#   stock.sh configure DEST SOURCE [cmake options]    -> DEST/styles, DEST/flags.cmake
#   stock.sh build DEST keep|drop                     -> DEST/liblammps.a; drop: remove the object files afterwards
set -uo pipefail
# read as a whole before it runs: the file may be changed meanwhile
{
stop() { echo "lammps-hvi: $*" >&2; exit 1; }

what=$1 dest=$2
mkdir -p "$dest" 2>/dev/null || stop "cannot write to $dest: set HVI_CACHE to a folder you can write to"
exec 9>"$dest/lock" || stop "cannot write to $dest: set HVI_CACHE to a folder you can write to"
flock 9

case $what in
  configure)
    src=$3
    shift 3
    [ -e "$dest/flags.cmake" ] && exit 0
    rm -rf "$dest/build" "$dest/styles"
    { cmake -S "$src/cmake" -B "$dest/build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" &&
      env -u MAKEFLAGS -u MAKELEVEL -u MFLAGS cmake --build "$dest/build" --target gitversion; } \
      >"$dest/configure.log" 2>&1 ||
      stop "LAMMPS's own cmake failed on $src ($(grep -A2 -m1 'CMake Error' "$dest/configure.log" | tail -n +2 | tr -s ' \n' ' ')): see $dest/configure.log"
    # the compiler's definitions and include folders are those of LAMMPS's own lammps.cpp
    line=$(grep '"command"' "$dest/build/compile_commands.json" | grep -m1 '/src/lammps\.cpp"')
    [ -n "$line" ] || stop "cannot read $dest/build/compile_commands.json: remove $dest and try again"
    mkdir "$dest/styles"
    cp "$dest"/build/styles/*.h "$dest/styles/"
    list() { grep -oE -- "$1" <<<"$line" | sed -E "s/$1/\\1/" | grep -vE "^($dest/build|NDEBUG$)" |
      sed "s,^$src\\b,\${LAMMPS_DIR}," | tr '\n' ';' | sed 's/;$//'; }
    {
      echo "set(STOCK_DEFINES \"$(list ' -D([^ ]+)')\")"
      echo "set(STOCK_INCLUDES \"$(list ' -I([^ ]+)')\")"
      echo "set(STOCK_SYSTEM_INCLUDES \"$(list ' -isystem ([^ ]+)')\")"
    } >"$dest/flags.cmake.part"
    mv "$dest/flags.cmake.part" "$dest/flags.cmake"
    ;;
  build)
    [ "$3" = drop ] && [ -e "$dest/liblammps.a" ] && exit 0
    [ -d "$dest/build" ] || { rm -f "$dest/flags.cmake"; stop "$dest is incomplete: run cmake again"; }
    jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc 2>/dev/null || echo 2)}
    # a compiler that was killed may have left half an object file
    if [ -e "$dest/running" ]; then
      find "$dest/build" -name '*.o' -printf '%T@ %p\n' | sort -rn | head -n 32 | cut -d' ' -f2- | xargs -r -d '\n' rm -f
    fi
    touch "$dest/running"
    [ -e "$dest/liblammps.a" ] || echo "lammps-hvi: compiling LAMMPS into $dest (once; minutes)" >&2
    # the variables of an outer make would make the inner one wait for the outer one's job slots
    env -u MAKEFLAGS -u MAKELEVEL -u MFLAGS cmake --build "$dest/build" --target lammps --parallel "$jobs" 2>&1 |
      tee "$dest/build.log" | awk '/^\[ *[0-9]*0%\]/ && !seen[$1 $2]++ { sub(/%.*/, "%]"); print "lammps-hvi: LAMMPS " $0; fflush() }'
    [ "${PIPESTATUS[0]}" = 0 ] ||
      stop "LAMMPS does not compile ($(grep -m1 -i 'error' "$dest/build.log")): see $dest/build.log"
    if ! cmp -s "$dest/build/liblammps.a" "$dest/liblammps.a"; then
      cp "$dest/build/liblammps.a" "$dest/liblammps.a.part"
      mv "$dest/liblammps.a.part" "$dest/liblammps.a"
    fi
    rm -f "$dest/running"
    if [ "$3" = drop ]; then rm -rf "$dest/build"; fi
    ;;
esac
exit 0
}
