#!/usr/bin/env bash
# Runs the tests that ./test.sh omits because they take minutes, and in full those of which it runs
# a smaller version: more particles, seeds and cases. CTest options are passed on.
set -euo pipefail
cd "$(dirname "$0")/../.."

# Folders of the tests that query their length (tests/kit/test_length.hpp).
folders=$(grep -rl 'in_full()' tests --include='*.cpp' --include='*.hpp' | xargs -n 1 dirname |
  sort -u | grep -v '^tests/kit$' | paste -sd '|')
in_full="^($folders):"

./setup.sh
./.ci/build release
export LUXODUS_LONG=1
run=(ctest --preset release -j "$(nproc)" --output-on-failure)
status=0
"${run[@]}" --no-tests=ignore -L '^long$' -E "$in_full" "$@" || status=$?
"${run[@]}" --no-tests=error -R "$in_full" "$@" || status=$?
echo "ran tests in full: those labelled long, and all whose names match $in_full"
exit "$status"
