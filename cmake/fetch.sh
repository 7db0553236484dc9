#!/bin/bash
# Puts a pinned LAMMPS source tree into the cache folder, once, and prints where it is.
#   cmake/fetch.sh 20250204|20260704
# HVI_CACHE   cache folder (default $XDG_CACHE_HOME/lammps-hvi or ~/.cache/lammps-hvi)
# HVI_RETRIES how often a failed download is tried again (default 3)
# HVI_MIRROR  Debian mirror to use instead of those in this machine's apt settings
set -uo pipefail

# read as a whole before it runs: the file may be changed meanwhile
{
say() { echo "lammps-hvi: $*" >&2; }
stop() { say "$*"; exit 1; }

case "${1:-}" in
  20250204)
    name='4 Feb 2025' tag=patch_4Feb2025 size='132 MB' suite=stable
    pool='lammps_20250204+dfsg.1.orig.tar.xz' file='lammps_20250204.orig.tar.xz'
    sum=3671165bd52fad36734e0a9136c5bc5ecb225e03988f8c89aa13366a8b53b1c7 ;;
  20260704)
    name='4 Jul 2026' tag=patch_4Jul2026 size='214 MB' suite=unstable
    pool='lammps_20260704+dfsg.orig.tar.gz' file='lammps_20260704.orig.tar.gz'
    sum=cddbc45a047416bd48a4a0b87f24a5b61b3446982b74d18cafe619c22b17eb62 ;;
  *) stop "unknown LAMMPS_VERSION '${1:-}': use 20250204 or 20260704, or give LAMMPS_SOURCE_DIR" ;;
esac
version=$1
cache=${HVI_CACHE:-${XDG_CACHE_HOME:-${HOME:-/tmp}/.cache}/lammps-hvi}
dest=$cache/lammps-$version
store=$cache/downloads

if [ -e "$dest/.complete" ]; then echo "$dest"; exit 0; fi
mkdir -p "$store" 2>/dev/null || stop "cannot write to $cache: set HVI_CACHE to a folder you can write to"
exec 9>"$cache/lock-source" || stop "cannot write to $cache: set HVI_CACHE to a folder you can write to"
flock 9
if [ -e "$dest/.complete" ]; then echo "$dest"; exit 0; fi # another run was faster

rm -rf "$cache"/unpack-"$version".* # left by an interrupted run
work=$cache/unpack-$version.$$
mkdir "$work" || stop "cannot write to $cache: set HVI_CACHE to a folder you can write to"
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP

checksum() { sha256sum "$1" | cut -d' ' -f1; }

# Debian mirrors of this machine, in apt's own order; apt knows deb822 and one-line settings
mirrors() {
  if [ -n "${HVI_MIRROR:-}" ]; then echo "${HVI_MIRROR%/}"; return; fi
  apt-get indextargets --format '$(ORIGIN)|$(REPO_URI)' 2>/dev/null | sed -n 's/^Debian|//p' | sed 's,/*$,,'
  # before the first "apt-get update" apt does not know the origin: take what the settings name
  cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null |
    sed -nE 's/^deb(-src)?[[:space:]]+(\[[^]]*\][[:space:]]+)?([^[:space:]]+).*/\3/p' | grep -i debian | sed 's,/*$,,'
  cat /etc/apt/sources.list.d/*.sources 2>/dev/null |
    sed -nE 's/^URIs:[[:space:]]*//p' | tr -s ' \t' '\n' | grep -i debian | sed 's,/*$,,'
}

# cloud images name a file with a list of mirrors
expand() {
  while read -r m; do
    case $m in
      mirror+file:*) sed -nE 's,^[[:space:]]*([a-z]+://[^[:space:]]+).*,\1,p' "/${m#mirror+file:}" 2>/dev/null | sed 's,/*$,,' ;;
      http* | file:* | ftp:* | tor+http*) echo "$m" ;;
    esac
  done | grep -v -- '-security$' | awk '!seen[$0]++'
}

# $1 = address; leaves the file in $store under its own name; the part that an interrupted run left is continued
download() {
  local part=$store/$file.part
  if [ -x /usr/lib/apt/apt-helper ]; then
    # APT::Sandbox::User: apt's unprivileged user cannot write to a home folder
    /usr/lib/apt/apt-helper -o APT::Sandbox::User="$(id -un)" -o Acquire::Retries="${HVI_RETRIES:-3}" -o Acquire::http::Timeout=60 \
      -o Acquire::https::Timeout=60 download-file "$1" "$part" >"$work/log" 2>&1 || return 1
  else
    curl -fsSL --retry "${HVI_RETRIES:-3}" -C - -o "$part" "$1" >"$work/log" 2>&1 || return 1
  fi
  mv "$part" "$store/$file"
}

unpack() {
  say "unpacking LAMMPS $name into $dest"
  mkdir "$work/tar"
  tar -xf "$store/$file" -C "$work/tar" --exclude=doc --exclude=examples --exclude=bench >"$work/log" 2>&1 ||
    stop "cannot unpack $store/$file ($(tail -n1 "$work/log")): check the free disk space and that xz-utils is installed"
  if [ -e "$work/tar/src" ]; then mv "$work/tar"/* "$work"/; else mv "$work/tar"/*/* "$work"/; fi # with or without a top folder
  rm -rf "$work/tar"
}

got=
if [ -e "$store/$file" ]; then
  if [ "$(checksum "$store/$file")" = $sum ]; then got=yes
  else say "$store/$file has a wrong checksum: fetching it again"; rm -f "$store/$file"; fi
fi
bad=
if [ -z "$got" ]; then
  tried=
  for m in $(mirrors | expand); do
    say "fetching LAMMPS $name ($size) from $m into $cache   (LAMMPS_SOURCE_DIR=DIR: nothing is fetched)"
    tried="$tried $m"
    download "$m/pool/main/l/lammps/$pool" || continue
    have=$(checksum "$store/$file")
    if [ "$have" = $sum ]; then got=yes; break; fi
    rm -f "$store/$file"
    bad="$m sent a file with SHA-256 $have"
    say "wrong checksum: $bad instead of $sum"
  done
fi

if [ -n "$got" ]; then
  unpack
else
  # not in the Debian archive any more, or no Debian mirror: the same release from its authors, by its tag and without a checksum
  url=${HVI_LAMMPS_GIT:-https://github.com/lammps/lammps.git}
  say "fetching LAMMPS $name (tag $tag) from $url into $cache, without a checksum   (LAMMPS_SOURCE_DIR=DIR: nothing is fetched)"
  rm -rf "$work/git"
  if command -v git >/dev/null &&
    GIT_TERMINAL_PROMPT=0 git -c advice.detachedHead=false clone -q --depth 1 --branch "$tag" "$url" "$work/git" >"$work/log" 2>&1; then
    rm -rf "$work"/git/{.git,doc,examples,bench}
    mv "$work/git"/* "$work"/
    rm -rf "$work/git"
  elif [ -n "$bad" ]; then
    stop "wrong checksum: $bad instead of $sum: set HVI_MIRROR to another Debian mirror, or put the right file at $store/$file"
  else
    gone=
    [ $suite = unstable ] && gone=" (Debian unstable may have moved on to a newer version)"
    stop "cannot fetch LAMMPS $name$gone, tried${tried:- no Debian mirror,} and github.com: check the network, or set LAMMPS_SOURCE_DIR to a copy of LAMMPS $name, or put $pool at $store/$file"
  fi
fi

rm -f "$work/log"
grep -q "\"$name\"" "$work/src/version.h" 2>/dev/null ||
  stop "what was fetched is not LAMMPS $name: remove $store/$file and try again, or set LAMMPS_SOURCE_DIR to a copy of LAMMPS $name"
touch "$work/.complete"
rm -rf "$dest"
mv "$work" "$dest" || stop "cannot write to $dest: set HVI_CACHE to a folder you can write to"
echo "$dest"
exit 0
}
