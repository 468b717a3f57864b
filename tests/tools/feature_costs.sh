#!/usr/bin/env bash
# Instructions that a particle takes, by feature and state: `luxodus_bench features` under
# callgrind. Needs valgrind. Times are printed by the same table without valgrind.
#   tests/tools/feature_costs.sh build/release [results.txt]
set -euo pipefail
build=${1:?"feature_costs.sh BUILD [RESULT]: BUILD is a folder with tests/luxodus_bench"}
result=${2:-/dev/stdout}
command -v valgrind >/dev/null || { echo "feature_costs.sh: install valgrind" >&2; exit 2; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
valgrind --tool=callgrind --callgrind-out-file="$work/out" "$build/tests/luxodus_bench" features \
  2>"$work/log" || { cat "$work/log" >&2; exit 1; }

# Each dump states its case ("Client Request: FEATURE|STATE|PARTICLES") and its counts.
python3 - "$work" >"$result" <<'PYTHON'
import pathlib
import re
import sys

rows = []
for path in pathlib.Path(sys.argv[1]).glob("out.*"):
    text = path.read_text(errors="replace")
    what = re.search(r"Client Request: (.*)\|(.*)\|(\d+)", text)
    total = re.search(r"^(?:summary|totals): (\d+)", text, re.M)
    part = re.search(r"^part: (\d+)", text, re.M)
    if what and total and part:
        rows.append((int(part[1]), what[1], what[2], int(total[1]) / int(what[3])))
if not rows:
    sys.exit("feature_costs.sh: callgrind wrote no counts")
print("| feature | state | instructions a particle | ratio |\n|---|---|---|---|")
first = None
for _, feature, state, count in sorted(rows):
    first = count if feature else first
    print(f"| {feature} | {state} | {count:.0f} | {count / first:.3f} |")
PYTHON
