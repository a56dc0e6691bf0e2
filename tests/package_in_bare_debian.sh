#!/usr/bin/env bash
# Proves that the Debian package is enough where nothing else is: installs it in a bare Debian 12 by apt, which takes its
# dependencies from the mirror, and runs an example there. No compiler comes in on the way.
#
#   usage: tests/package_in_bare_debian.sh PACKAGE [FOLDER]     (default: a new temporary folder, removed at the end)
#
# PACKAGE is what ./dev package made. Not part of ./dev test: it downloads a Debian (./dev check debian).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/tests/support/bare_debian.sh"
[[ -f ${1:-} ]] || fail "usage: tests/package_in_bare_debian.sh PACKAGE [FOLDER]; ./dev package makes one"
package=$(realpath "$1")
prepare_folder "${2:-}"

no_compiler() { ! inside / "command -v g++ || command -v gcc || command -v clang || command -v cmake"; }
examples=/usr/share/doc/weaveform/examples

timed "bare Debian 12" bare_debian
cp "$package" "$folder/root/"
timed "apt install" inside /root "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
  ./$(basename "$package") >/dev/null"
timed "no compiler there" no_compiler
timed "weaveform --version" inside /root "weaveform --version"
timed "an example" inside /root "weaveform run $examples/bias_extension_pw.toml --set blank.coarsening=2 --output out"
timed "its results" inside /root "test -s out/summary.json -a -s out/result.pvd"
timed "a tool from CAD" inside /root "weaveform tool $examples/cad/box_punch.geo --output punch.stl"
timed "manual page and completion" inside /root "gzip -dc /usr/share/man/man1/weaveform.1.gz | grep -q '^.SS post compare' &&
  source /usr/share/bash-completion/completions/weaveform && complete -p weaveform"
