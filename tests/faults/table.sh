#!/usr/bin/env bash
# The fault table: what is done to the program, how often, how it ends, what is lost. Run by `./dev faults [TRIES]`.
#   table.sh PROGRAM TRIES
# Prints one row a fault, as Markdown. Ends with 1 when a run ended in a way that the README does not promise (a signal,
# exit code 1, a time-out), or lost or changed what it must not.
set -u
program=$1
tries=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
RANDOM=1
broken=0

# ---- counting

declare -A ends
fault_name= fault_tries=0 fault_lost=

begin() {
  fault_name=$1 fault_tries=0 fault_lost=${2:-nothing}
  ends=()
}

count() {
  ends[$1]=$((${ends[$1]:-0} + 1))
  fault_tries=$((fault_tries + 1))
}

# Exit codes that are promised; all else is broken.
ended() {
  case $1 in
    0 | 2 | 3 | 4 | 130) count "exit $1" ;;
    124) count "NO END" && broken=1 ;;
    *) count "BROKEN ($1)" && broken=1 ;;
  esac
}

wrong() {
  count "WRONG: $1"
  broken=1
}

finish() {
  local text= end
  for end in $(printf '%s\n' "${!ends[@]}" | tr ' ' '~' | sort); do
    end=${end//\~/ }
    text+="${text:+, }${ends[$end]} × $end"
  done
  printf '| %s | %d | %s | %s |\n' "$fault_name" "$fault_tries" "$text" "$fault_lost"
}

# weave ARGUMENTS: the program with a limit of time, silent.
weave() { timeout -k 5 "${limit:-120}" "$program" "$@" >"$work/out" 2>"$work/err" </dev/null; }

# wreck FILE [TIMES]: bytes at random places become others.
wreck() {
  local size k
  size=$(stat -c %s "$1")
  for ((k = 0; k < ${2:-1}; k++)); do
    printf "\\x$(printf %02x $((RANDOM % 256)))" |
      dd of="$1" bs=1 seek=$(((RANDOM * 32768 + RANDOM) % size)) conv=notrunc status=none
  done
}

cut_short() { truncate -s $(((RANDOM * 32768 + RANDOM) % $(stat -c %s "$1"))) "$1"; }

# damage FILE: every third is cut, the others get one to four wrong bytes.
damage() { if ((RANDOM % 3 == 0)); then cut_short "$1"; else wreck "$1" $((RANDOM % 4 + 1)); fi; }

# same DIR DIR: history and last frame of two runs are the same bytes.
same() {
  local last
  last=$(cd "$1/frames" && ls | tail -n 1)
  cmp -s "$1/history.csv" "$2/history.csv" && cmp -s "$1/frames/$last" "$2/frames/$last"
}

seconds_since() { echo "$(date +%s.%N) - $1" | bc -l; }
greater() { (($(echo "$1 > $2" | bc -l))) && echo "$1" || echo "$2"; }
random_seconds() { echo "scale=3; 0.15 + $1 * $RANDOM / 32768" | bc -l; }

# ---- faults

# A run with contact, friction and a pushed binder, of a few seconds; checkpoints as often as their cost allows.
long_scene="$here/pressed.toml"

interrupted_by() {
  local signal=$1 k status pid begun killed last worst=0
  begin "$2" ""
  for ((k = 0; k < tries; k++)); do
    rm -rf "$work/r"
    "$program" run "$long_scene" -o "$work/r" -q >"$work/out" 2>"$work/err" </dev/null &
    pid=$!
    sleep "$(random_seconds "$whole_run")"
    kill -s "$signal" $pid 2>/dev/null
    killed=$(date +%s.%N)
    wait $pid 2>/dev/null
    if [[ -f $work/r/checkpoint.bin ]]; then
      last=$(stat -c %.9Y "$work/r/checkpoint.bin")
      worst=$(greater "$(echo "$killed - $last" | bc -l)" "$worst")
    fi
    # every second is killed once more on the way
    if ((k % 2)); then
      { timeout -s KILL "$(random_seconds 0.5)" "$program" run "$long_scene" -o "$work/r" -q --resume; } >/dev/null 2>&1
    fi
    weave run "$long_scene" -o "$work/r" -q --resume
    status=$?
    if ((status != 0)); then
      ended $status
    elif same "$work/reference" "$work/r"; then
      count "resumed, same bits"
    else
      wrong "resumed, other bits"
    fi
  done
  fault_lost=$(printf 'at most %.1f s of the run' "$worst")
  finish
}

# damaged_input NAME FILE COMMAND...: FILE, a copy of FILE.sound, is damaged before each COMMAND.
damaged_input() {
  local k file=$2
  begin "$1"
  shift 2
  for ((k = 0; k < tries * 5; k++)); do
    cp "$file.sound" "$file"
    damage "$file"
    limit=${slow:-60} weave "$@"
    ended $?
  done
  cp "$file.sound" "$file"
  finish
}

# damaged_result NAME FILE COMMAND...: the same for a file of the finished run in $work/tiny.
damaged_result() {
  cp "$work/tiny/$2" "$work/tiny/$2.sound"
  damaged_input "$1" "$work/tiny/$2" "${@:3}"
  rm "$work/tiny/$2.sound"
}

damaged_checkpoint() {
  local k
  begin "a damaged checkpoint.bin, then \`--resume\`" "the run"
  "$program" run "$long_scene" -o "$work/ck" -q >"$work/out" 2>"$work/err" </dev/null &
  sleep 1
  kill -s INT $!
  wait $!
  for ((k = 0; k < tries * 10; k++)); do
    rm -rf "$work/ck2" && cp -a "$work/ck" "$work/ck2"
    damage "$work/ck2/checkpoint.bin"
    weave solve "$work/ck2" --resume -q
    ended $?
  done
  finish
}

damaged_geometry() {
  local kind
  printf 'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 20, 20, 10}; Cylinder(2) = {10, 10, 10, 0, 0, 5, 4};
BooleanUnion { Volume{1}; Delete; } { Volume{2}; Delete; }\n' >"$work/part.geo"
  for kind in step brep stl; do
    weave tool "$work/part.geo" --chord-tolerance 1 -o "$work/t.$kind" || { echo "no $kind" >&2; continue; }
    cp "$work/t.$kind" "$work/t.$kind.sound"
    slow=400 damaged_input "a damaged ${kind^^} file" "$work/t.$kind" tool "$work/t.$kind" --chord-tolerance 1
  done
  cp "$work/part.geo" "$work/t.geo.sound"
  slow=400 damaged_input "a damaged .geo script" "$work/t.geo" tool "$work/t.geo" --chord-tolerance 1
}

damaged_meshes() {
  local kind
  for kind in abaqus:inp gmsh:msh; do
    weave export "$here/tiny.toml" --format "${kind%:*}" -o "$work/m.${kind#*:}.sound.${kind#*:}" || continue
    mv "$work/m.${kind#*:}.sound.${kind#*:}" "$work/m.${kind#*:}.sound"
    damaged_input "a damaged .${kind#*:} mesh" "$work/m.${kind#*:}" import "$work/m.${kind#*:}" -o "$work/imported"
  done
}

disk_full() {
  begin "a file may grow to N kB only (full disk)" "the results that do not fit"
  local k
  for ((k = 0; k < tries; k++)); do
    rm -rf "$work/f"
    (ulimit -f $((RANDOM % 20 + 1)) && weave run "$here/tiny.toml" -o "$work/f" -q)
    ended $?
    find "$work/f" -name '*.vtu' -size -1 | grep -q . && wrong "an empty result"
  done
  finish
}

no_memory() {
  begin "no more memory than N MB" "the run"
  local k
  for ((k = 0; k < tries; k++)); do
    (ulimit -v $((RANDOM * 8 + 150000)) && weave run "$here/tiny.toml" -o "$work/m$k" -q)
    # below what its libraries take, the system's loader ends a program (127)
    local status=$?
    if ((status == 127)); then count "does not start"; else ended $status; fi
  done
  finish
}

two_runs() {
  begin "two runs into one folder" "the second run"
  local k first second pid
  for ((k = 0; k < tries; k++)); do
    rm -rf "$work/two"
    "$program" run "$long_scene" -o "$work/two" -q >"$work/out1" 2>&1 &
    pid=$!
    sleep 0.5
    weave run "$long_scene" -o "$work/two" -q --set tools.punch.travel=5
    second=$?
    wait $pid
    first=$?
    if ((first == 0 && second != 0)) && same "$work/reference" "$work/two"; then
      count "first undisturbed, second exit $second"
    else
      wrong "first $first, second $second"
    fi
  done
  finish
}

closed_streams() {
  begin "streams closed, full or gone"
  local command
  for command in 'run "$1" -o "$2" >&-' 'run "$1" -o "$2" 2>&-' 'run "$1" -o "$2" >&- 2>&-' 'run "$1" -o "$2" <&- >&- 2>&-' \
    'run "$1" -o "$2" >/dev/full' 'run "$1" -o "$2" 2>/dev/full' 'check "$1" >/dev/full' 'keys >/dev/full' 'keys >&-' \
    'check "$1" >&- 2>&-'; do
    timeout 60 bash -c "\"\$0\" $command" "$program" "$here/tiny.toml" "$work/c" 2>"$work/err" >"$work/out" </dev/null
    ended $?
  done
  timeout 60 bash -c '"$0" run "$1" -o "$2" 2>&1 | head -n 1; exit ${PIPESTATUS[0]}' "$program" "$here/tiny.toml" "$work/c" >"$work/out"
  ended $?
  finish
}

links_and_strangers() {
  begin "links, and files of others in the folder" "nothing of theirs"
  local d="$work/links" before after k
  for ((k = 0; k < 5; k++)); do
    rm -rf "$d" && mkdir -p "$d/out" "$d/victim"
    echo precious >"$d/victim/precious.txt"
    echo mine >"$d/victim/frame_0000.vtu"
    case $k in
      0) ln -s ../victim "$d/out/frames" ;;
      1) ln -s ../victim/precious.txt "$d/out/history.csv" ;;
      2) cp "$d/victim/precious.txt" "$d/out/history.csv" ;;
      3) ln -s ../victim/precious.txt "$d/out/scene.toml" ;;
      4) ln -s ../victim/precious.txt "$d/out/scene.toml.partial" ;;
    esac
    before=$(find "$d" -type f -not -path '*/out/*' -exec md5sum {} + | sort)
    weave run "$here/tiny.toml" -o "$d/out" -q
    ended $?
    after=$(find "$d" -type f -not -path '*/out/*' -exec md5sum {} + | sort)
    [[ $before == "$after" ]] || wrong "somebody's file was changed"
    ((k != 2)) || [[ $(cat "$d/out/history.csv") == precious ]] || wrong "history.csv of others is gone"
  done
  finish
}

scripts_with_commands() {
  begin "a .geo that runs commands or writes files"
  local line k=0
  local d="$work/geo"
  mkdir -p "$d"
  printf '[blank]\nshape = "file"\noutline = "blank.geo"\n[[grip]]\nname = "top"\nbox = [-5, 5, 5, 10]\ntravel = 1\n' >"$d/s.toml"
  while read -r line; do
    { echo 'Point(1)={0,0,0};Point(2)={10,0,0};Point(3)={10,10,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};'
      echo "$line"; } >"$d/blank.geo"
    (cd "$d" && limit=400 weave check s.toml)
    ended $?
    [[ ! -e $d/PWNED ]] || { wrong "it was done: $line"; rm -f "$d/PWNED"; }
  done <"$here/commands.geo.txt"
  finish
}

# Keys of tables that the scene has, by their own names in it.
scene_keys() {
  "$program" keys | awk -F'`' '/^## /{ table = $2; gsub(/[][]/, "", table) }
    /^\| `/{ if (table == "measure") table = "measure.corner"; if (table == "tools.NAME") table = "tools.punch"
      if (table ~ /fabric|blank|model|punch|analysis|output|corner/) print table "." $2 }'
}

nonsense_scenes() {
  local keys values=(0 -1 1e-300 1e-9 1e9 1e300 nan inf 9223372036854775807 '""' '[]' '[nan,nan,nan]' true) k
  mapfile -t keys < <(scene_keys)
  begin "a value of nonsense in a scene (\`check\`, then \`run\`)"
  for ((k = 0; k < tries * 10; k++)); do
    local setting="${keys[RANDOM % ${#keys[@]}]}=${values[RANDOM % ${#values[@]}]}"
    weave check "$here/tiny.toml" --set "$setting"
    ended $?
    weave run "$here/tiny.toml" -o "$work/nonsense" -q --set "$setting"
    ended $?
  done
  finish
}

# ---- the table

printf '| fault | tries | how it ends | what is lost |\n|---|---|---|---|\n'
begun=$(date +%s.%N)
weave run "$long_scene" -o "$work/reference" -q || { echo "error: the reference run failed: $(cat "$work/err")" >&2; exit 1; }
whole_run=$(seconds_since "$begun")
weave run "$here/tiny.toml" -o "$work/tiny" -q || exit 1

interrupted_by KILL "kill -9 at any moment (also: no memory left, power cut), then \`--resume\`"
for signal in HUP INT TERM QUIT XCPU USR1; do
  interrupted_by "$signal" "SIG$signal at any moment, then \`--resume\`"
done
damaged_checkpoint
two_runs
links_and_strangers
disk_full
no_memory
closed_streams
scripts_with_commands
damaged_geometry
damaged_result "a damaged mesh.vtu, then \`solve\`" mesh.vtu solve "$work/tiny" -q
weave run "$here/tiny.toml" -o "$work/tiny" -q
damaged_result "a damaged frame" frames/frame_0002.vtu post "$work/tiny"
damaged_result "a damaged result.pvd" result.pvd post "$work/tiny"
damaged_result "a damaged history.csv" history.csv post "$work/tiny"
damaged_result "a damaged solve.json" solve.json post "$work/tiny"
cp "$work/tiny/mesh.vtu" "$work/onto.vtu.sound"
damaged_input "a damaged .vtu to map onto" "$work/onto.vtu" export "$work/tiny" --format csv -o "$work/x.csv" --force --onto "$work/onto.vtu"
damaged_meshes
cp "$here/tiny.toml" "$work/scene.toml.sound"
damaged_input "a damaged scene" "$work/scene.toml" check "$work/scene.toml"
nonsense_scenes
exit "$broken"
