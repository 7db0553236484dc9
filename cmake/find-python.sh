#!/bin/bash
# Prints a Python interpreter that has all the named modules: find-python.sh numpy scipy ...
# Debian's packages belong to /usr/bin/python3, which need not be the first python3 on PATH.
for p in "${PYTHON:-}" python3 /usr/bin/python3; do
  [ -n "$p" ] || continue
  p=$(command -v "$p") || continue
  if MPLBACKEND=Agg PYTHONDONTWRITEBYTECODE=1 "$p" -W ignore -c 'import sys, importlib
for m in sys.argv[1:]: importlib.import_module(m)' "$@" >/dev/null 2>&1; then
    echo "$p"
    exit 0
  fi
done
echo "lammps-hvi: no Python with $*: install these modules or set PYTHON to an interpreter that has them" >&2
exit 1
