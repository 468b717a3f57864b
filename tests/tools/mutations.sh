#!/usr/bin/env bash
# mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry...]: harms COUNT files of each format that
# is imported, and reads them under the address and undefined-behaviour sanitizers. Says what each
# took in time and memory. LUXODUS_SEED draws other files. dxflib itself is a library without
# sanitizers, in a process of its own.
set -euo pipefail
cd "$(dirname "$0")/../.."

count=${1:?usage: mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry...]}
shift
rooms=("$@")
[ "${#rooms[@]}" -gt 0 ] || rooms=(fields fds_input ifc dxf photometry)

mkdir -p build
cmake --preset asan-ubsan >build/mutations.log
ninja -C build/asan-ubsan "${rooms[@]/#/test_scenes_}" >>build/mutations.log

failed=0
for room in "${rooms[@]}"; do
  begun=$SECONDS
  if LUXODUS_MUTATIONS=$count python3 - "build/asan-ubsan/tests/test_scenes_$room" <<'PYTHON'; then
import resource, subprocess, sys
code = subprocess.run([sys.argv[1], "harmed*"], stdout=subprocess.DEVNULL).returncode
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
print(f"  largest memory {peak:.0f} MiB, sanitizers included")
sys.exit(code != 0)
PYTHON
    echo "$room: $count files, $((SECONDS - begun)) s, no finding"
  else
    echo "$room: FAILED; build/asan-ubsan/tests/test_scenes_$room \"harmed*\" says why" >&2
    failed=1
  fi
done
exit "$failed"
