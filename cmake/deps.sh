#!/bin/bash
# Makes sure that the Debian packages of the named groups are installed: deps.sh build [test] [check] [doc] [browser] [slurm] [machines] [fuzz]
# Installs only what is missing, and says the command before; changes nothing when all is there. DEPS=no skips it all.
set -uo pipefail
[ "${DEPS:-}" = no ] && exit 0
command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || exit 0 # not Debian: cmake names what is missing

build="g++ make cmake openmpi-bin libopenmpi-dev libeigen3-dev libpng-dev libjpeg-dev zlib1g-dev xz-utils ca-certificates"
python="python3 python3-numpy python3-scipy python3-matplotlib python3-mdanalysis python3-yaml python3-tqdm python3-meshio"
test="libgtest-dev python3-pytest python3-pandas python3-setuptools python3-wheel python3-venv python3-hypothesis $python"
demo="$python"
browser="chromium" # of make verify; large
slurm="slurm-wlm munge" # of make verify, which starts its own daemons
machines="valgrind qemu-user" # of make verify: memory, and machines without AVX
fuzz="clang libclang-rt-14-dev" # libFuzzer; in Debian 12 clang is 14
check="clang clang-tidy cppcheck flake8 mypy libyaml-dev libgmock-dev $test"
doc="python3-sphinx python3-sphinx-rtd-theme"

wanted=
for group in "$@"; do wanted="$wanted ${!group}"; done
missing() {
  local have
  have=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p')
  for p in $wanted; do grep -qx -- "$p" <<<"$have" || echo "$p"; done | sort -u | tr '\n' ' ' | sed 's/ $//'
}

need=$(missing)
[ -z "$need" ] && exit 0
hint="apt-get update && apt-get install --no-install-recommends -y $need"
if [ "$(id -u)" = 0 ]; then run=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then run=(sudo -n)
else
  echo "lammps-hvi: Debian packages are missing; as root run: $hint   (or DEPS=no if you have them from elsewhere)" >&2
  exit 1
fi
as=root
[ ${#run[@]} = 0 ] || as="root by sudo"
echo "lammps-hvi: as $as: $hint   (DEPS=no: nothing is installed)" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { "${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3 "$@" >>"$log" 2>&1 </dev/null; }
for try in 1 2 3; do
  apt update # one broken foreign source must not stop us: what counts is the installation
  apt install --no-install-recommends -y $need && break
  echo "lammps-hvi: as $as: dpkg --configure -a, and again" >&2
  "${run[@]}" dpkg --configure -a >>"$log" 2>&1 </dev/null # after an interrupted run
  [ $try = 3 ] || sleep $((5 * try))
done
need=$(missing)
[ -z "$need" ] && exit 0
echo "lammps-hvi: could not install $need ($(grep -m1 '^E:' "$log")): check the network, then run: $hint" >&2
exit 1
