#!/bin/bash
# pictures.sh PROGRAM: each scene of examples/ has its picture, small and shown in a document, and draw.sh draws what it is asked
# for. Exit code 77: skipped, VTK finds no screen and no program for a virtual one.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
program=$(realpath "$1")
largest=80000 # bytes
failed=0
complain() { echo "$*" >&2; failed=1; }

names=$(sed -n "/^pictures='/,/^'/s/^\([a-z_/]*\)  *|.*/\1/p" "$root/docs/pictures/draw.sh")
for name in $names tutorial/net; do
  picture="$root/docs/pictures/$name.png"
  [[ -f $picture ]] || { complain "draw.sh draws $name, and docs/pictures/$name.png is not there"; continue; }
  (($(stat -c %s "$picture") <= largest)) || complain "docs/pictures/$name.png is larger than $largest bytes"
  grep -q "pictures/$name\.png)" "$root/README.md" "$root"/docs/*.md || complain "no document shows docs/pictures/$name.png"
done
for scene in "$root"/examples/*.toml; do
  grep -qx "$(basename "$scene" .toml)" <<<"$names" || complain "draw.sh draws no picture of $(basename "$scene")"
done

[[ -n ${DISPLAY:-} ]] || command -v Xvfb >/dev/null || { echo "skipped: no screen and no Xvfb"; exit $((failed ? 1 : 77)); }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch/docs/pictures"
cp "$root/docs/pictures/draw.sh" "$scratch/docs/pictures"
ln -s "$root/examples" "$root/python" "$scratch"
"$scratch/docs/pictures/draw.sh" "$program" shear_frame_pw tutorial/test >/dev/null || complain "draw.sh failed"
drawn=$(cd "$scratch/docs/pictures" && find . -name '*.png' | sort | tr '\n' ' ')
[[ $drawn == "./shear_frame_pw.png ./tutorial/test.png " ]] || complain "draw.sh was asked for two pictures and drew: $drawn"
exit "$failed"
