#!/usr/bin/env bash
# draw.sh PROGRAM [NAME...]: redraws the pictures of this folder with PROGRAM (a built weaveform), all of them or those named (hemisphere,
# tutorial/formed, ...). Each is one scene run in seconds, coarser than it stands where it would take longer, and one
# `weaveform render`; the tables below are the only list. Colours are reduced to 64 by pngquant where it is installed. Ends
# with 1 when a scene or picture failed, after the others; results are not kept.
set -euo pipefail

program=$(realpath "${1:?draw.sh PROGRAM [NAME...]}")
shift
wanted=("$@")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# name | scene in examples/ | options of run | options of render
pictures='
hemisphere          | hemisphere_pw_fast.toml       | --set blank.coarsening=1        | --size 1000 700 --no-tools
hemisphere_pw       | hemisphere_pw.toml            | --set blank.coarsening=4        | --size 800 600
hemisphere_pw_fast  | hemisphere_pw_fast.toml       |                                 | --size 800 600
hemisphere_two_plies | hemisphere_two_plies.toml   |                                 | --size 800 600
bias_extension_pw   | bias_extension_pw.toml        | --set blank.coarsening=3        | --size 800 600
bias_extension_tw   | bias_extension_tw.toml        | --set blank.coarsening=3        | --size 800 600
shear_frame_pw      | shear_frame_pw.toml           | --set blank.coarsening=4        | --size 800 600
shear_frame_tw      | shear_frame_tw.toml           | --set blank.coarsening=4        | --size 800 600
cantilever_pw       | cantilever_pw.toml            | --set blank.coarsening=2        | --view slant --field yarn_force_N --size 800 600
drape_hemisphere    | drape_hemisphere.toml         | --set blank.coarsening=2        | --frame 0 --size 800 600
cad_box             | cad_box.toml                  | --set blank.coarsening=2        | --size 800 600
own_outline         | recipes/own_outline.toml      |                                 | --size 800 600
clips               | recipes/clips.toml            |                                 | --size 800 600
clips_held          | recipes/clips_held.toml       |                                 | --size 800 600
tutorial/test       | tutorial/bias.toml            |                                 | --size 800 600
tutorial/formed     | tutorial/forming.toml         |                                 | --size 800 600
'

is_wanted() { ((${#wanted[@]} == 0)) || [[ " ${wanted[*]} " == *" $1 "* ]]; }

# Fewer colours, where the program for it is at hand: a quarter to a half of the bytes, and no difference to the eye.
put() {
  mkdir -p "$(dirname "$here/$2")"
  if command -v pngquant >/dev/null; then pngquant --force --speed 1 --output "$here/$2.png" 64 "$1"; else cp "$1" "$here/$2.png"; fi
  printf '%-22s %6d bytes\n' "$2.png" "$(stat -c %s "$here/$2.png")"
}

draw() {
  local name=$1 scene=$2 run_options=$3 render_options=$4
  local result
  result="$scratch/$(basename "$name")"
  # shellcheck disable=SC2086  # options are words
  "$program" run "$root/examples/$scene" --output "$result" --quiet --set output.frames=2 $run_options &&
    "$program" render "$result" --output "$scratch/drawn.png" --force --quiet $render_options &&
    put "$scratch/drawn.png" "$name"
}

draw_net() {
  "$program" drape "$root/examples/tutorial/drape.toml" --output "$scratch/net" --quiet &&
    "$program" render "$scratch/net" --output "$scratch/drawn.png" --force --quiet --size 800 600 &&
    put "$scratch/drawn.png" tutorial/net
}

# The first screens of a report, by Chromium; left as it is where that is not installed.
draw_report() {
  command -v chromium >/dev/null || return 0
  "$program" run "$root/examples/hemisphere_pw_fast.toml" --output "$scratch/report" --report --quiet &&
    HOME="$scratch" chromium --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars \
      --virtual-time-budget=9000 --window-size=1200,1750 --screenshot="$scratch/drawn.png" "file://$scratch/report/report.html" \
      >/dev/null 2>&1 &&
    put "$scratch/drawn.png" report
}

failed=()
while IFS='|' read -r name scene run_options render_options; do
  read -r name <<<"$name"
  read -r scene <<<"$scene"
  [[ -n $name ]] || continue
  is_wanted "$name" || continue
  draw "$name" "$scene" "$run_options" "$render_options" </dev/null || failed+=("$name")
done <<<"$pictures"
if is_wanted report; then draw_report || failed+=(report); fi
if is_wanted tutorial/net; then draw_net || failed+=(tutorial/net); fi
((${#failed[@]} == 0)) || { echo "not drawn: ${failed[*]}" >&2; exit 1; }
