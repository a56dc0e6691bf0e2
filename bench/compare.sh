#!/usr/bin/env bash
# Rates of this tree against those of another commit, on the same machine: builds the benchmark of both, runs them in
# turn, so that a machine that grows slower slows both, and compares the medians. Ends with 1 when a rate has fallen by
# more than the limit and by more than both scatter. Many short rounds (a minute each) rather than few long ones: what
# disturbs a machine lasts for seconds.
#
#   usage: bench/compare.sh BASE [ROUNDS] [FILTER]     (rounds: 5; filter: a regular expression of benchmark names)
#   LIMIT in the environment: percent (5)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
base=${1:?usage: bench/compare.sh BASE [ROUNDS] [FILTER]}
rounds=${2:-5}
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

for ((round = 1; round <= rounds; ++round)); do
  for side in base head; do
    build="$root/build"
    [[ $side == head ]] || build="$tree/build"
    # as JSON: its CSV has no place for counters that some benchmarks have and others have not
    "$build/bin/weaveform_bench" --benchmark_filter="$filter" --benchmark_min_time=0.1 --benchmark_format=json \
      2>/dev/null |
      awk -F'"' -v side=$side '$2 == "name" { name = $4 }
        $2 == "cpu_time" { gsub(/[:, ]/, "", $3); print name "," side "," $3 }' >>"$folder/times.csv"
  done
done

# medians of the processor times, and half the spread of each side
sort -t, -k1,1 -k2,2 -k3,3g "$folder/times.csv" | awk -F, -v limit=$limit '
  function close_group() { if (n) { median[key] = value[int((n + 1) / 2)]; spread[key] = (value[n] - value[1]) / 2 } }
  { now = $1 "," $2; if (now != key) { close_group(); key = now; n = 0; if (!($1 in seen)) { seen[$1]; name[++names] = $1 } }
    value[++n] = $3 }
  END {
    close_group()
    printf "%-44s %12s %12s %9s\n", "processor time, median", "base", "head", "change"
    for (i = 1; i <= names; ++i) {
      base = median[name[i] ",base"]; head = median[name[i] ",head"]
      if (base == "" || head == "") continue
      change = 100 * (head / base - 1)
      noise = 100 * (spread[name[i] ",base"] + spread[name[i] ",head"]) / base
      slower = change > limit && change > noise
      if (slower) failed = 1
      printf "%-44s %12.4g %12.4g %+8.1f %%%s\n", name[i], base, head, change, slower ? "  slower" : ""
    }
    exit failed
  }'
