#!/usr/bin/env bash
# Whether two builds of the program give the same bits: sixteen short runs over all elements, formulations, loads,
# contact, drape, symmetry and restart; histories, last frames and meshes are compared byte for byte, but for the lines
# that name the program.
#
#   usage: bench/same_bits.sh BASE HEAD [EXAMPLES]   (two binaries; scenes that both read: this tree's; two minutes)
#
# Ends with 1 when anything differs. A changed order of sums is a reason to differ: say so, and show it harmless.
set -euo pipefail

(($# == 2 || $# == 3)) || { sed -n '6s/^#//p' "$0" >&2; exit 2; }
base=$(realpath "$1") head=$(realpath "$2")
examples=$(realpath "${3:-$(dirname "$0")/../examples}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

reached=analysis.step_bound=reached
stiffest=analysis.step_bound=stiffest
# name, scene, overrides
scenes=(
  "truss bias_extension_pw blank.coarsening=4 $stiffest"
  "beam_contravariant bias_extension_tw blank.coarsening=4 model.yarn=beam model.formulation=contravariant $reached"
  "seatbelt_partner bias_extension_pw blank.coarsening=4 model.yarn=seatbelt model.partner=compression $reached"
  "perturbed bias_extension_pw blank.coarsening=4 analysis.perturbation=0.001 $reached"
  "frame_deformable shear_frame_pw blank.coarsening=4 $reached"
  "frame_rigid shear_frame_pw blank.coarsening=4 frame.rigid=true $reached"
  "incremental shear_frame_tw blank.coarsening=4 model.formulation=incremental $reached"
  "side_frame shear_frame_pw blank.coarsening=4 model.formulation=side-frame $reached"
  "weight cantilever_pw $reached"
  "quarter_contact hemisphere_pw_fast $reached"
  "whole_shell hemisphere_pw_fast blank.coarsening=4 model.cell=shell model.symmetry=none $stiffest"
  "rotation_free hemisphere_pw analysis.duration=0.1 blank.coarsening=4 $reached"
  "drape drape_hemisphere $reached"
  "cad cad_box $reached"
  "cad_two_threads cad_box $reached +threads"
)

# run BINARY DIR SCENE OVERRIDE...
run() {
  local binary=$1 output=$2 scene=$3 options=()
  shift 3
  for override in "$@"; do
    if [[ $override == +threads ]]; then options+=(--threads 2); else options+=(--set "$override"); fi
  done
  "$binary" run "$examples/$scene.toml" --output "$output" --quiet --yes "${options[@]}" >"$output.log" 2>&1
}

# A run of several seconds that is stopped each second and then goes on; how often is left in `stops`.
run_with_stops() {
  local binary=$1 output=$2 status=0
  stops=0
  timeout --signal=INT 1 "$binary" run "$examples/bias_extension_pw.toml" --output "$output" --quiet \
    --set $stiffest >"$output.log" 2>&1 || status=$?
  while ((status == 124)); do
    status=0
    stops=$((stops + 1))
    timeout --signal=INT 1 "$binary" run "$output/scene.toml" --output "$output" --resume --quiet \
      >>"$output.log" 2>&1 || status=$?
  done
  return "$status"
}

body() { grep -av -e '^#' -e 'Written by' "$1"; }

differences=0
# compare NAME FOLDER FOLDER
compare() {
  local name=$1 one=$2 other=$3 file found=()
  last=$(cd "$one/frames" && printf '%s\n' *.vtu | tail -n 1)
  for file in history.csv mesh.vtu "frames/$last"; do
    cmp -s <(body "$one/$file") <(body "$other/$file") || found+=("$file")
  done
  if ((${#found[@]})); then
    differences=1
    printf '%-20s DIFFERS: %s\n' "$name" "${found[*]}"
  else
    printf '%-20s same  history %s  frame %s\n' "$name" "$(body "$one/history.csv" | sha256sum | cut -c1-12)" \
      "$(body "$one/frames/$last" | sha256sum | cut -c1-12)"
  fi
}

for line in "${scenes[@]}"; do
  read -r name scene overrides <<<"$line"
  # shellcheck disable=SC2086
  run "$base" "$work/base_$name" "$scene" $overrides && run "$head" "$work/head_$name" "$scene" $overrides || {
    echo "$name: a run failed:" && cat "$work"/*_"$name".log && exit 1
  }
  compare "$name" "$work/base_$name" "$work/head_$name"
done
run "$base" "$work/base_stopped" bias_extension_pw $stiffest
run_with_stops "$head" "$work/head_stopped" || { cat "$work/head_stopped.log" && exit 1; }
((stops > 0)) || { echo "stopped: the run was over before it was stopped" && exit 1; }
compare "stopped $stops times" "$work/base_stopped" "$work/head_stopped"
exit "$differences"
