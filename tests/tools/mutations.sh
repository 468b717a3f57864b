#!/usr/bin/env bash
# mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry|vdb...]: mutates COUNT files of each
# imported format, and reads them under the address and undefined-behaviour sanitizers. Prints time
# and memory of each. LUXODUS_SEED selects other files. dxflib and OpenVDB themselves are libraries
# without sanitizers, in processes of their own; code in OpenVDB's headers is compiled with them.
# Outcomes of mutated OpenVDB files are counted; sanitizer reports about them are in
# build/vdb-reports.
set -euo pipefail
cd "$(dirname "$0")/../.."

count=${1:?usage: mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry|vdb...]}
shift
rooms=("$@")
[ "${#rooms[@]}" -gt 0 ] || rooms=(fields fds_input ifc dxf photometry)

mkdir -p build
cmake --preset asan-ubsan >build/mutations.log
ninja -C build/asan-ubsan "${rooms[@]/#/test_scenes_formats_}" >>build/mutations.log

# Errors of OpenVDB on a mutated file end a process of its own, and are reported. Errors in our code
# are findings.
reports=build/vdb-reports
rm -rf "$reports"
mkdir -p "$reports"
own_options=${ASAN_OPTIONS:-}
options="log_path=$reports/report:max_allocation_size_mb=256"

failed=0
for room in "${rooms[@]}"; do
  begun=$SECONDS
  words=/dev/stderr
  export ASAN_OPTIONS=$own_options
  if [ "$room" = vdb ]; then
    export ASAN_OPTIONS=$options
    words=$reports/words
  fi
  if LUXODUS_MUTATIONS=$count python3 - "build/asan-ubsan/tests/test_scenes_formats_$room" 2>"$words" <<'PYTHON'; then
import resource, subprocess, sys
code = subprocess.run([sys.argv[1], "mutated*"], stdout=subprocess.DEVNULL).returncode
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
print(f"  largest memory {peak:.0f} MiB, sanitizers included")
sys.exit(code != 0)
PYTHON
    echo "$room: $count files, $((SECONDS - begun)) s, no finding"
  else
    echo "$room: FAILED; build/asan-ubsan/tests/test_scenes_formats_$room \"mutated*\" says why" >&2
    failed=1
  fi
done
if [ -e "$reports/words" ]; then grep -E '^ +[0-9]+  ' "$reports/words" || true; fi
ours="(\.\./\.\.|$PWD)/(scenes|runtime)/"
if grep -lE "#[0-2] .* $ours|^$ours.*runtime error" "$reports"/* 2>/dev/null; then
  echo "vdb: these reports are of our code" >&2
  failed=1
fi
exit "$failed"
