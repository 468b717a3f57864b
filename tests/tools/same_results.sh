#!/usr/bin/env bash
# same_results.sh OLD NEW [NAME...]: runs two builds of luxodus on the same inputs and compares what
# they leave, byte for byte. For changes that must change no result:
#   git worktree add /tmp/before HEAD~1 && (cd /tmp/before && ./.ci/build release luxodus)
#   tests/tools/same_results.sh /tmp/before/build/release/luxodus build/release/luxodus
# With names, only these comparisons are made; `list` in place of OLD prints them. Results lie in
# build/same_results/old and new afterwards. What differs by nature is left out: seconds, rates, the
# version. Exits with 1 where anything differs, and names it.
set -euo pipefail
cd "$(dirname "$0")/../.."

library=scenes/library
data=../shared/data
work=build/same_results

# Each comparison is a function that runs $luxodus and writes its results into the folder $out.
run_flux() {
  for scene in empty_room integrating_sphere smoke_tank fire_in_a_box auditorium office_floor; do
    "$luxodus" run $library/$scene.toml --particles 100k --seed 3 --no-views --out "$out/$scene"
  done
  "$luxodus" run $library/office_floor.toml --scenario smoke_emergency --particles 100k --no-views \
    --cells 8 --nodes 3 --part-cache-mib 8 --fibers 4 --out "$out/nodes"
}
run_pictures() {
  "$luxodus" run $library/fire_in_a_box.toml --particles 100k --picture-paths 16 --out "$out/fire"
  "$luxodus" run $library/smoke_tank.toml --scenario smoke --particles 100k --picture-paths 16 \
    --out "$out/tank"
}
run_packs() {
  for scene in office_floor auditorium smoke_tank; do
    "$luxodus" pack $library/$scene.toml --out "$out/$scene.luxpack"
  done
}
run_journals() {
  # A killed coordinator leaves a journal: either program continues the old program's.
  printf '%s\n' '[run]' 'name = "journal"' "scene = \"$PWD/$library/auditorium.toml\"" \
    'particles = 4_000_000' "out = \"$PWD/$out/run\"" '[[host]]' 'name = "here"' \
    '[[node]]' 'name = "n"' 'count = 2' 'process = "one"' \
    '[[node]]' 'name = "controller"' 'role = "controller"' 'process = "one"' >"$out/cluster.toml"
  local nodes=(node --config "$out/cluster.toml" --name n0 --name n1 --name controller)
  "$old" "${nodes[@]}" &
  local first=$!
  until [ -n "$(find "$out" -name 'run.journal' -size +100k)" ]; do kill -0 $first; done
  kill -9 $first
  wait $first || true
  test ! -e "$out/run/flux.lux"
  "$luxodus" "${nodes[@]}"
}
run_check() {
  for scene in empty_room integrating_sphere smoke_tank fire_in_a_box auditorium office_floor; do
    "$luxodus" check $library/$scene.toml --json >"$out/$scene.json"
  done
}
run_assess() {
  for language in en de fr; do
    "$luxodus" assess $library/office_floor.toml --rules en1838-2024,nfpa101 --rounds 2 \
      --language $language --grid-values --out "$out/$language"
  done
  "$luxodus" assess $library/office_floor.toml --rules en1838-2013 --deviation de-asr-a3.4-3 \
    --codes-alone --language de --out "$out/codes"
}
run_over_time() {
  smoky_corridor >"$out/corridor.toml"
  for language in en de fr; do
    "$luxodus" assess "$out/corridor.toml" --rounds 2 --language $language --out "$out/$language"
  done
  "$luxodus" assess "$out/corridor.toml" --at 0s --smoke-scale 0.3,1,3 --rounds 2 \
    --out "$out/scaled"
  "$luxodus" compare "$out/en" "$out/scaled" >"$out/compare.txt" || true
}
run_design() {
  "$luxodus" design $library/office_floor.toml --rules en1838-2024 --gap 5% --out "$out/en"
  for language in de fr; do
    smoky_corridor | sed '/^\[time\]/,/^step/d; s/^z_low = .*/z_low = 2/' >"$out/corridor.toml"
    "$luxodus" design "$out/corridor.toml" --rules en1838-2024 --in-smoke failed \
      --language $language --out "$out/$language"
  done
}
run_graphs() {
  for nodes in 16 32 45; do
    "$luxodus" topology amp --nodes $nodes --links 4 -o "$out/$nodes.toml"
    "$luxodus" topology measure "$out/$nodes.toml" --json >"$out/$nodes.json"
    "$luxodus" topology draw "$out/$nodes.toml" -o "$out/$nodes.svg"
  done
  "$luxodus" topology compare --nodes 32 >"$out/compare.txt"
}
run_simulation() {
  "$luxodus" sim $library/empty_room.toml --seeds 0..12 --twice >"$out/seeds.txt"
  "$luxodus" sim $library/office_floor.toml --seed 7 --log >"$out/log.txt" 2>&1
}
run_imports() {
  for model in "$data"/ifc/*.ifc; do
    "$luxodus" import ifc "$model" --out "$out/$(basename "$model" .ifc)" ||
      echo "$model: $?" >>"$out/refused.txt"
  done
  for case in "$data"/fds/*.fds; do
    "$luxodus" import fds "$case" --out "$out/$(basename "$case" .fds)" ||
      echo "$case: $?" >>"$out/refused.txt"
  done
}
run_validation() {
  "$luxodus" validate --only cube --out "$out/cube"
  rm "$out/cube/validate.html"  # which draws errors over seconds
}
run_help() {
  "$luxodus" --help >"$out/help.txt"
  for command in $(sed -n 's/^  \([a-z]\+\)  .*/\1/p' "$out/help.txt"); do
    "$luxodus" "$command" --help >"$out/$command.txt"
  done
  for file in scene cluster study plan; do
    "$luxodus" keys $file >"$out/keys_$file.txt" || true
  done
}

smoky_corridor() {
  cat <<'EOF'
title = "Corridor"
[[object]]
name = "corridor"
shape = "room"
low = [0, -2, 0]
high = [12, 2, 3]
material = "grey50"
[[object]]
name = "desk"
shape = "box"
low = [5, -1.8, 0]
high = [6, -0.8, 0.8]
material = "grey50"
tags = ["furniture"]
[[emitter]]
name = "lamp"
shape = "point"
distribution = "isotropic"
position = [4, 0, 2.5]
flux_lm = 1000
emergency = "non-maintained"
emergency_flux = 500
maintenance_factor = 0.8
end_of_duration_factor = 0.75
[[emitter]]
name = "second"
shape = "point"
distribution = "isotropic"
position = [9, 0, 2.5]
flux_lm = 300
emergency = "non-maintained"
emergency_flux = 150
maintenance_factor = 0.8
end_of_duration_factor = 0.75
[[sign]]
name = "exit"
position = [11.95, 0, 2.2]
facing = [-1, 0, 0]
width = 0.4
height = 0.2
text = "EXIT"
letter_height = 0.15
mains_white = 500
mains_green = 50
emergency_white = 500
emergency_green = 50
lighting = "internal"
[[sign.leads_to]]
route = "way"
arrow = "ahead"
[[medium]]
name = "smoke"
kind = "layered"
[[medium.layer]]
z_low = [[0, 3], [100, 1]]
z_high = 3
albedo = 0.3
extinction = 2
[time]
to = 60
step = 30
[assessment]
irritant_smoke = false
spacing_m = 2
rules = ["en1838-2024"]
[[route]]
name = "way"
path = [[1, 0, 0], [11, 0, 0]]
width = 1.6
[[scenario]]
name = "failed"
operation = "emergency"
EOF
}

comparisons=$(declare -F | sed -n 's/^declare -f run_//p')
if [ "${1:-}" = list ]; then
  echo "$comparisons"
  exit
fi
if [ $# -lt 2 ]; then
  sed -n '2,10p' "$0" >&2
  exit 2
fi
old=$(realpath "$1") new=$(realpath "$2")
shift 2
if [ $# -gt 0 ]; then comparisons=$*; fi

# Removes from a folder's files what differs in every run.
without_times() {
  python3 - "$1" <<'EOF'
import json, pathlib, re, sys

timed = {"seconds", "particles_per_second", "rays_per_second", "figure_of_merit", "version",
         "commit", "slope_seconds", "timed_particles", "search_s", "traced_s", "took", "took_s",
         "time_s", "elapsed"}

seconds_and_rates = re.compile(
    r"[0-9.]+ (s|min|ms|[kM]? ?events/s|over seconds|virtual seconds)\b"
    r"|luxodus \d+\.\d+\.\d+\S*")

def timeless(value):
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if k not in timed}
    return [timeless(v) for v in value] if isinstance(value, list) else value

for path in pathlib.Path(sys.argv[1]).rglob("*"):
    if path.suffix == ".json":
        path.write_text(json.dumps(timeless(json.loads(path.read_text())), indent=1))
    elif path.suffix in (".txt", ".html", ".toml", ".log"):
        text = path.read_text(errors="replace")
        path.write_text(seconds_and_rates.sub("", text))
EOF
}

# Both write into the same folder, one after the other, so that paths in their results are equal.
results_of() {
  local which=$1 luxodus=$2 name=$3
  local out=$work/results said=$work/$which-$name.said
  rm -rf "$out" "$work/$which/$name"
  mkdir -p "$out" "$work/$which"
  local code=0
  set +e  # a subshell in a condition would go on after errors
  (
    set -e
    "run_$name"
  ) >"$said" 2>&1
  code=$?
  set -e
  if [ $code -ne 0 ]; then
    echo "$name: $luxodus failed:" >&2
    tail -n 5 "$said" >&2
    return 1
  fi
  without_times "$out"
  mv "$out" "$work/$which/$name"
}

rm -rf "$work"
mkdir -p "$work"
status=0
for name in $comparisons; do
  if ! declare -F "run_$name" >/dev/null; then
    echo "same_results.sh: no comparison is called $name: $0 list" >&2
    exit 2
  fi
  if ! results_of old "$old" "$name" || ! results_of new "$new" "$name"; then
    status=1
  elif diff -rq "$work/old/$name" "$work/new/$name" >"$work/$name.diff"; then
    echo "$name: equal ($(find "$work/new/$name" -type f | wc -l) files)"
  else
    echo "$name: different"
    sed 's/^/  /' "$work/$name.diff"
    status=1
  fi
done
exit $status
