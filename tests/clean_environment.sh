#!/usr/bin/env bash
# Proves that a bare Debian 12 is enough: bootstraps one into a folder, clones the last commit of this repository into it,
# and there does what the README tells a newcomer to do, printing how long each step took. Afterwards once more without
# network. Needs root, debootstrap, git, and some 5 GB; what is not committed is not tested.
#
#   usage: tests/clean_environment.sh [FOLDER]     (default: a new temporary folder, removed at the end)
#
# Not part of ./dev test: it downloads a Debian.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:-}
keep=yes

fail() { echo "error: $1" >&2; exit 2; }
((EUID == 0)) || fail "needs root, for debootstrap and chroot"
command -v debootstrap >/dev/null || fail "debootstrap is missing; apt-get install debootstrap"

if [[ -z $folder ]]; then
  folder=$(mktemp -d)
  keep=no
fi

clean_up() {
  mountpoint -q "$folder/proc" && umount "$folder/proc"
  [[ $keep == yes ]] || rm -rf --one-file-system "$folder"
}
trap clean_up EXIT

# The Debian mirror of this machine: "URIs:" of the newer format, else the first "deb" line of the older, else Debian's own.
mirror() {
  local found
  found=$(sed -n 's/^URIs: *\([^ ]*\/debian\/\{0,1\}\)$/\1/p' /etc/apt/sources.list.d/*.sources 2>/dev/null | head -n 1)
  [[ -n $found ]] || found=$(sed -n 's/^deb *\(\[[^]]*\] *\)\{0,1\}\([^ ]*\/debian\/\{0,1\}\) .*/\2/p' /etc/apt/sources.list \
    /etc/apt/sources.list.d/*.list 2>/dev/null | head -n 1)
  echo "${found:-http://deb.debian.org/debian}"
}

# Proxy, clock and certificate settings of this machine, so that the new Debian reaches the mirror as this one does.
copy_network_settings() {
  local settings
  while read -r settings; do
    cp "$settings" "$folder/etc/apt/apt.conf.d/"
  done < <(grep -lE 'Proxy|Check-Valid-Until|Check-Date|CaInfo' /etc/apt/apt.conf /etc/apt/apt.conf.d/* 2>/dev/null)
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
  if [[ -d /etc/ssl/certs ]]; then
    mkdir -p "$folder/etc/ssl"
    cp -rL /etc/ssl/certs "$folder/etc/ssl/" 2>/dev/null || true
  fi
}

# timed NAME COMMAND...: runs it and says what came out and how long it took.
timed() {
  local name=$1 start=$SECONDS status=0
  shift
  echo "== $name"
  "$@" || status=$?
  echo "== $name: exit $status after $((SECONDS - start)) s"
  ((status == 0)) || exit "$status"
}

# A login's worth of environment and nothing of ours.
inside() {
  chroot "$folder" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
    ${https_proxy:+https_proxy="$https_proxy"} bash -c "cd /weaveform && $1"
}

# The same with no network at all but what is installed by now.
inside_offline() {
  export -f inside
  folder="$folder" unshare --net bash -c "inside '$1'"
}

bootstrap() { debootstrap --variant=minbase bookworm "$folder" "$(mirror)" >/dev/null; }

timed "bare Debian 12" bootstrap
copy_network_settings
mount -t proc proc "$folder/proc"
git clone --quiet "$root" "$folder/weaveform"

timed "./dev run" inside "./dev run"
timed "./dev test" inside "./dev test"
timed "./dev run, again, without network" inside_offline "./dev run"
