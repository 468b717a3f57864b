#!/usr/bin/env bash
# The tests that ./test.sh leaves out because they take minutes, and those of which it runs a
# smaller one, in full: more particles, seeds and cases. Any CTest option passes through.
set -euo pipefail
cd "$(dirname "$0")/../.."

# Where tests ask for their length (tests/kit/test_length.hpp).
in_full='^tests/(examples|optics|sim|validate):'

./setup.sh
./.ci/build release
export LUXODUS_LONG=1
run=(ctest --preset release -j "$(nproc)" --output-on-failure)
status=0
"${run[@]}" --no-tests=ignore -L '^long$' -E "$in_full" "$@" || status=$?
"${run[@]}" --no-tests=error -R "$in_full" "$@" || status=$?
echo "ran tests in full: those labelled long, and all whose names match $in_full"
exit "$status"
