#!/usr/bin/env bash
# Builds Luxodus and runs its tests; the last lines are CTest's summary, and what was left out.
#   ./test.sh                 every promise, optimised build
#   ./test.sh -R emergency    only tests whose name matches (any CTest option passes through)
#   ./test.sh --sanitize      every promise under the address and undefined-behaviour sanitizers
#   ./test.sh --long          only tests that take minutes, and the others' full numbers of
#                             particles and seeds: tests/tools/long_tests.sh
set -euo pipefail
cd "$(dirname "$0")"

preset=release
case ${1:-} in
  --sanitize)
    preset=asan-ubsan
    shift
    ;;
  --long)
    shift
    exec tests/tools/long_tests.sh "$@"
    ;;
esac

./setup.sh --tests
./.ci/build "$preset"
status=0
ctest --preset "$preset" -j "$(nproc)" --output-on-failure --no-tests=error -LE '^long$' "$@" ||
  status=$?
left=$(ctest --preset "$preset" -N -L '^long$' | sed -n 's/^Total Tests: //p')
echo "ran tests at their daily length; left to ./test.sh --long: $left tests, and the full" \
  "numbers of particles and seeds of others"
exit "$status"
