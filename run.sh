#!/usr/bin/env bash
# Builds Luxodus and does its main job once: the office floor that ships with it, filled with smoke,
# after the mains have failed. Results lie in out/office_floor.
#   ./run.sh                          the smoke_emergency scenario
#   ./run.sh --seed 7                 options of `luxodus run` pass through
set -euo pipefail
cd "$(dirname "$0")"

scene=scenes/library/office_floor.toml
out=out/office_floor

./setup.sh --run
./.ci/build release luxodus

# The scenario is ours to choose only where the caller has not.
scenario=(--scenario smoke_emergency)
for argument in "$@"; do
  case $argument in
    --scenario | --scenario=*) scenario=() ;;
    --out | --out=*) out= ;;
  esac
done
where=()
if [ -n "$out" ]; then where=(--out "$out"); fi

build/release/luxodus run "$scene" "${scenario[@]}" "${where[@]}" "$@"

if [ -n "$out" ]; then
  echo
  echo "results of $scene in $out/:"
  find "$out" -maxdepth 2 -type f -printf '  %p  (%s bytes)\n' | sort
fi
