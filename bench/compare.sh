#!/usr/bin/env bash
# Rates of this tree against those of another commit, on the same machine: builds the benchmark of both, runs them in
# turn, so that a machine that grows slower slows both, and compares the medians. What has fallen by more than the limit
# and by more than both scatter is run again, three times as often; ends with 1 when it is so again. Many short rounds (a
# minute each) rather than few long ones: what disturbs a machine lasts for seconds, and a process that got its memory
# badly is slow to its end.
#
#   usage: bench/compare.sh BASE [ROUNDS] [FILTER]     (rounds: 3; filter: a regular expression of benchmark names)
#   LIMIT in the environment: percent (5)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
base=${1:?usage: bench/compare.sh BASE [ROUNDS] [FILTER]}
rounds=${2:-3}
filter=${3:-.}
limit=${LIMIT:-5}  # percent

folder="$root/results/bench"
commit=$(git -C "$root" rev-parse --verify --quiet "$base^{commit}") || { echo "error: no commit '$base'" >&2; exit 2; }
tree="$folder/$commit"
rm -f "$folder"/*.csv
mkdir -p "$folder"
[[ -d $tree ]] || git -C "$root" worktree add --quiet --detach "$tree" "$commit"
trap 'git -C "$root" worktree prune' EXIT

cmake -S "$tree" -B "$tree/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DWEAVEFORM_TESTS=OFF --log-level=WARNING >&2
cmake --build "$tree/build" --parallel "$(nproc)" --target weaveform_bench weaveform -- --quiet >&2

# times FILTER ROUNDS FILE: a line of name, side and processor time for each. As JSON: its CSV has no place for counters
# that some benchmarks have and others have not.
times() {
  local round side build
  rm -f "$3"
  for ((round = 1; round <= $2; ++round)); do
    for side in base head; do
      build="$root/build"
      [[ $side == head ]] || build="$tree/build"
      "$build/bin/weaveform_bench" --benchmark_filter="$1" --benchmark_min_time=0.1 --benchmark_format=json 2>/dev/null |
        awk -F'"' -v side=$side '$2 == "name" { name = $4 }
          $2 == "cpu_time" { gsub(/[:, ]/, "", $3); print name "," side "," $3 }' >>"$3"
    done
  done
}

# compared FILE SLOWER: the table of medians, with half the spread of each side for what counts; names of what is slower
# into SLOWER.
compared() {
  : >"$2"
  sort -t, -k1,1 -k2,2 -k3,3g "$1" | awk -F, -v limit="$limit" -v slower_names="$2" '
    function close_group() { if (n) { median[key] = value[int((n + 1) / 2)]; spread[key] = (value[n] - value[1]) / 2 } }
    { now = $1 "," $2; if (now != key) { close_group(); key = now; n = 0; if (!($1 in seen)) { seen[$1]; name[++names] = $1 } }
      value[++n] = $3 }
    END {
      close_group()
      printf "%-60s %12s %12s %9s\n", "processor time, median", "base", "head", "change"
      for (i = 1; i <= names; ++i) {
        base = median[name[i] ",base"]; head = median[name[i] ",head"]
        if (base == "" || head == "") continue
        change = 100 * (head / base - 1)
        noise = 100 * (spread[name[i] ",base"] + spread[name[i] ",head"]) / base
        slower = change > limit && change > noise
        if (slower) print name[i] >slower_names
        printf "%-60s %12.4g %12.4g %+8.1f %%%s\n", name[i], base, head, change, slower ? "  slower" : ""
      }
    }'
}

times "$filter" "$rounds" "$folder/times.csv"
compared "$folder/times.csv" "$folder/slower"
[[ -s $folder/slower ]] || exit 0
echo "again, $((3 * rounds)) rounds:"
times "^($(paste -sd'|' "$folder/slower"))\$" $((3 * rounds)) "$folder/times_again.csv"
compared "$folder/times_again.csv" "$folder/slower_again"
[[ ! -s $folder/slower_again ]]
