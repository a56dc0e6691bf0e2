#!/bin/sh
# Measured curves -> shear laws -> predicted bias extensions -> comparison with the measured loads.
# Needs the program and awk. usage: run.sh [OUTPUT_FOLDER]; WEAVEFORM names the program (default build/bin/weaveform).
set -eu

here=$(cd "$(dirname "$0")" && pwd)
program=${WEAVEFORM:-$here/../../build/bin/weaveform}
output=${1:-results/benchmark}

# fit NAME: a card from NAME.toml
fit() {
  "$program" fit "$here/$1.toml" --output "$output/cards/$1" --quiet
}

# predict SCENE NAME CARD [OPTION...]: load of the scene's specimen with that card, as "travel load" lines
predict() {
  scene=$1 name=$2 card=$3
  shift 3
  "$program" run "$here/$scene.toml" --output "$output/runs/${scene}_$name" --quiet --set fabric.material="$card" "$@"
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
           { print $column["top.displacement_mm"], $column["top.force_N"] }' \
    "$output/runs/${scene}_$name/history.csv" >"$output/loads_${scene}_$name.txt"
}

# measured FILE NAME: the same lines from a data file
measured() {
  awk -F, '/^#/ || /^displacement/ { next } { print $1, $2 }' "$here/data/$1.csv" >"$output/measured_$2.txt"
}

# compare TITLE TRAVELS FILE...: loads of all files at the travels (mm), and their ratio to the mean of the
# measured files, which are those named measured_*; interpolated linearly.
compare() {
  title=$1 travels=$2
  shift 2
  echo "$title"
  awk -v travels="$travels" '
    function load_at(file, x,   i) {
      for (i = 2; i <= rows[file]; ++i)
        if (travel[file, i] >= x)
          return load[file, i - 1] + (load[file, i] - load[file, i - 1]) * (x - travel[file, i - 1]) / \
                 (travel[file, i] - travel[file, i - 1])
      return load[file, rows[file]]
    }
    FNR == 1 { ++files; label[files] = FILENAME; sub(/.*\//, "", label[files]); sub(/\.txt$/, "", label[files])
               is_measured[files] = label[files] ~ /^measured_/; sub(/^loads_bias_[a-z]*_/, "", label[files]) }
    { ++rows[files]; travel[files, rows[files]] = $1; load[files, rows[files]] = $2 }
    END {
      printf "| load (N) at travel (mm) |"
      n = split(travels, at, " ")
      for (k = 1; k <= n; ++k) printf " %s |", at[k]
      printf "\n|---|"
      for (k = 1; k <= n; ++k) printf "---|"
      printf "\n"
      for (f = 1; f <= files; ++f) {
        printf "| %s |", label[f]
        for (k = 1; k <= n; ++k) {
          value = load_at(f, at[k])
          if (is_measured[f]) { sum[k] += value; ++count[k]; least[k] = count[k] == 1 || value < least[k] ? value : least[k]
                                most[k] = value > most[k] ? value : most[k]; printf " %.2f |", value }
          else printf " %.2f (%.2f) |", value, value * count[k] / sum[k]
        }
        printf "\n"
      }
      if (count[1] > 1) {
        printf "| greatest/least measured |"
        for (k = 1; k <= n; ++k) printf " %.2f |", most[k] / least[k]
        printf "\n"
      }
      print "In brackets: over the mean of the measured loads.\n"
    }' "$@"
}

mkdir -p "$output"
output=$(cd "$output" && pwd)  # absolute: a card's path on the command line counts from its scene
for name in plain_frame_UML plain_frame_HKUST plain_frames plain_bias_INSA-NU plain_bias_NU-New twill_frame_UML twill_bias_INSA-NU \
  plain_bias_INSA-NU_simulated plain_bias_NU-New_simulated twill_bias_INSA-NU_simulated; do
  fit "$name"
done
for name in plain_frame_UML plain_frame_HKUST plain_frames plain_bias_INSA-NU plain_bias_NU-New plain_bias_INSA-NU_simulated \
  plain_bias_NU-New_simulated; do
  predict bias_plain "$name" "$output/cards/$name/card.toml"
done
# The law from a bias extension takes yarns as inextensible; a yarn that decrimps eases the model (README.md).
for name in plain_bias_INSA-NU plain_bias_NU-New; do
  predict bias_plain "${name}_linear" "$output/cards/$name/card.toml" --set model.yarn_law=linear
done
predict bias_plain paper twintex-pw
for name in twill_frame_UML twill_bias_INSA-NU twill_bias_INSA-NU_simulated; do
  predict bias_twill "$name" "$output/cards/$name/card.toml"
done
predict bias_twill twill_bias_INSA-NU_linear "$output/cards/twill_bias_INSA-NU/card.toml" --set model.yarn_law=linear
predict bias_twill paper twintex-tw
measured plain_bias_115x230_INSA-NU plain_INSA-NU
measured plain_bias_115x230_NU-New plain_NU-New
measured balanced-twill_bias_150x300_INSA-NU twill_INSA-NU

case $program in */*) program=$(cd "$(dirname "$program")" && pwd)/$(basename "$program") ;; esac
cd "$output"
plain_files="measured_plain_INSA-NU.txt measured_plain_NU-New.txt"
for name in bias_INSA-NU bias_INSA-NU_linear bias_INSA-NU_simulated bias_NU-New bias_NU-New_linear bias_NU-New_simulated frame_UML frame_HKUST frames; do
  plain_files="$plain_files loads_bias_plain_plain_$name.txt"
done
plain_files="$plain_files loads_bias_plain_paper.txt"
twill_files=measured_twill_INSA-NU.txt
for name in twill_bias_INSA-NU twill_bias_INSA-NU_linear twill_bias_INSA-NU_simulated twill_frame_UML paper; do
  twill_files="$twill_files loads_bias_twill_$name.txt"
done
# No name has a blank, so the lists may be split.
{
  compare "Plain weave, 115 mm x 230 mm" "5 10 15 20 25 30 35" $plain_files
  compare "Balanced twill, 150 mm x 300 mm" "5 10 15 20 25 30 35 40 45" $twill_files
} | tee comparison.md

# chart NAME TITLE MEASURED FILE...: the same as a chart, the first MEASURED files as points
chart() {
  name=$1 title=$2 measured=$3
  shift 3
  "$program" chart "$@" --output "$name.svg" --title "$title" --x-title "travel (mm)" --y-title "load (N)" \
    --points "$measured"
}
chart plain "Plain weave, 115 mm x 230 mm: measured and predicted loads" 2 $plain_files
chart twill "Balanced twill, 150 mm x 300 mm: measured and predicted loads" 1 $twill_files
