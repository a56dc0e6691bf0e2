#!/usr/bin/env bash
# Proves that a bare Debian 12 is enough: bootstraps one into a folder, clones the last commit of this repository into it,
# and there does what the README tells a newcomer to do, printing how long each step took. Afterwards once more without
# network. Needs root, debootstrap, git, and some 5 GB; what is not committed is not tested.
#
#   usage: tests/clean_environment.sh [FOLDER]     (default: a new temporary folder, removed at the end)
#
# Not part of ./dev test: it downloads a Debian (./dev check debian).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/tests/support/bare_debian.sh"
prepare_folder "$@"

# With no network at all but what is installed by now.
inside_offline() {
  export -f inside
  folder="$folder" unshare --net bash -c "inside '$1' '$2'"
}

timed "bare Debian 12" bare_debian
git clone --quiet "$root" "$folder/weaveform"
timed "./dev run" inside /weaveform "./dev run"
timed "./dev test" inside /weaveform "./dev test --label-regex chain"
timed "./dev run, again, without network" inside_offline /weaveform "./dev run"
