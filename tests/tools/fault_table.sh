#!/usr/bin/env bash
# fault_table.sh BUILD: runs the tests of faults between real processes (about two minutes), and
# prints a table (Markdown) with the times of each fault's detection, of giving up the node, and of
# recovery, from the controller's log. Fails if a test does.
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
