#!/usr/bin/env bash
# fault_table.sh BUILD: runs the tests of faults between real processes (some two minutes), and
# prints a table (Markdown) of when each fault was noticed, when who had it was given up, and when
# all was well again, as the controller's log has it. Fails where a test does.
set -euo pipefail

build=${1:-build/release}
said=$(mktemp)
trap 'rm -f "$said"' EXIT
status=0
"$build/tests/test_examples" "[faults]" >"$said" 2>&1 || status=$?
printf '| fault | noticed after | given up after | well after | ends in |\n|---|---|---|---|---|\n'
sed -n 's/^fault | \(.*\)$/| \1 |/p' "$said"
if [ "$status" -ne 0 ]; then
  grep -v '^fault |' "$said" >&2
fi
exit "$status"
