#!/usr/bin/env bash
# Checks whether float is precise enough. Builds the comparison in both precisions, traces scenes
# with the same random numbers, and fails if the difference is not far below the statistical error
# of 1e9 particles. PARTICLES and THREADS may be set.
#   tests/tools/precision.sh [FOLDER for the traced batches]
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:-out/precision}
threads=${THREADS:-$(nproc)}
mkdir -p "$out"
for preset in release double; do
  cmake --preset "$preset" > "$out/configure_$preset.log"
  ninja -C "build/$preset" -j "$threads" luxodus_precision
done

# name, scene, scenario, particles: the last has more than a thousand triangles, which Embree finds.
scenes=(
  "furnished tests/precision/furnished.toml - ${PARTICLES:-4e6}"
  "glass tests/precision/glass.toml - ${PARTICLES:-4e7}"
  "fire scenes/library/fire_in_a_box.toml flame ${PARTICLES:-4e6}"
  "office scenes/library/office_floor.toml smoke_emergency ${PARTICLES:-4e6}"
)
files=()
for line in "${scenes[@]}"; do
  read -r name scene scenario particles <<< "$line"
  [ "$scenario" = - ] && scenario=""
  for preset in release double; do
    file="$out/${name}_$preset.txt"
    echo "$name, $preset: $particles particles"
    "build/$preset/tests/luxodus_precision" trace \
      "$scene" "$scenario" "$particles" "$threads" "$file"
    files+=("$file")
  done
done
build/release/tests/luxodus_precision compare "${files[@]}"
