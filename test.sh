#!/usr/bin/env bash
# Builds Luxodus and runs its tests; the last lines are CTest's own summary.
#   ./test.sh                 every test, optimised build
#   ./test.sh -R emergency    only tests whose name matches (any CTest option passes through)
#   ./test.sh --sanitize      every test under the address and undefined-behaviour sanitizers
set -euo pipefail
cd "$(dirname "$0")"

preset=release
if [ "${1:-}" = --sanitize ]; then
  preset=asan-ubsan
  shift
fi

./setup.sh --tests
./.ci/build "$preset"
exec ctest --preset "$preset" -j "$(nproc)" --output-on-failure --no-tests=error "$@"
