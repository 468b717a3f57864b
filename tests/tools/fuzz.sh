#!/usr/bin/env bash
# fuzz.sh SECONDS [fuzz_codec|fuzz_session|fuzz_flush]: builds the fuzzers with Clang, under the
# address and undefined-behaviour sanitizers, and runs each for this time. New inputs are in
# build/fuzz/corpus-NAME, where the next run begins; crashes in build/fuzz/crash-*.
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=${1:?usage: fuzz.sh SECONDS [NAME...]}
shift
names=("$@")
[ "${#names[@]}" -gt 0 ] || names=(fuzz_codec fuzz_session fuzz_flush)
if ! command -v clang++ >/dev/null; then
  echo "fuzz.sh: clang++ is missing (Debian: clang)" >&2
  exit 77
fi

cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" \
  -DLUX_SANITIZE=address,undefined >build/fuzz.log
ninja -C build/fuzz "${names[@]}" >>build/fuzz.log
for name in "${names[@]}"; do
  mkdir -p "build/fuzz/corpus-$name"
  "build/fuzz/tests/$name" -max_total_time="$seconds" -max_len=4096 -print_final_stats=1 \
    -artifact_prefix=build/fuzz/crash- "build/fuzz/corpus-$name"
done
