#!/usr/bin/env bash
# mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry|trajectories|geometry...]: mutates COUNT
# files of each imported format (geometry: meshes), and reads them under the address and
# undefined-behaviour sanitizers. Prints time and memory of each. LUXODUS_SEED selects other files.
# Most of these readers are our own; SQLite and HDF5 (trajectories) are libraries, which are not
# sanitized themselves.
set -euo pipefail
cd "$(dirname "$0")/../.."

count=${1:?usage: mutations.sh COUNT [fields|fds_input|ifc|dxf|photometry|trajectories|geometry...]}
shift
rooms=("$@")
[ "${#rooms[@]}" -gt 0 ] || rooms=(fields fds_input ifc dxf photometry trajectories geometry)
tests=("${rooms[@]/#/test_scenes_formats_}")
tests=("${tests[@]/formats_geometry/light_geometry}")

mkdir -p build
cmake --preset asan-ubsan >build/mutations.log
ninja -C build/asan-ubsan "${tests[@]}" >>build/mutations.log

failed=0
for test in "${tests[@]}"; do
  begun=$SECONDS
  if LUXODUS_MUTATIONS=$count python3 - "build/asan-ubsan/tests/$test" <<'PYTHON'; then
import resource, subprocess, sys
code = subprocess.run([sys.argv[1], "mutated*"], stdout=subprocess.DEVNULL).returncode
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
print(f"  largest memory {peak:.0f} MiB, sanitizers included")
sys.exit(code != 0)
PYTHON
    echo "$test: $count files, $((SECONDS - begun)) s, no finding"
  else
    echo "$test: FAILED; build/asan-ubsan/tests/$test \"mutated*\" says why" >&2
    failed=1
  fi
done
exit "$failed"
