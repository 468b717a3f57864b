#!/usr/bin/env bash
# Measures how long Luxodus takes to build, without a compiler cache, in a folder of its own;
# asserts nothing. Processor time (user and system) hardly depends on the machine's load.
#   tests/tools/build_times.sh                 the program: cold, unchanged, one source touched
#   tests/tools/build_times.sh --tests         then the test programs, cold
#   tests/tools/build_times.sh -DLUX_PCH=OFF   other options are passed to CMake
# Touched sources keep their dates.
set -euo pipefail
cd "$(dirname "$0")/../.."

folder=build/times
touched=(scenes/light/transport/particle.hpp scenes/light/world/description.hpp
  actors/apps/cli/run_command.cpp)
with_tests=
options=()
for argument in "$@"; do
  if [ "$argument" = --tests ]; then with_tests=yes; else options+=("$argument"); fi
done

# Runs a compiler and records seconds of user and system time, and the output file.
launcher=$PWD/$folder/timed
units=$PWD/$folder/units
rm -rf "$folder"
mkdir -p "$folder"
cat >"$launcher" <<EOF
#!/usr/bin/env bash
TIMEFORMAT='%U %S'
made= before=
for argument; do
  if [ "\$before" = -o ]; then made=\$argument; fi
  before=\$argument
done
exec 3>&2
taken=\$({ time "\$@" 2>&3 >&3; } 2>&1)
status=\$?
echo "\$taken \$made" >>"$units"
exit \$status
EOF
chmod +x "$launcher"

cmake --preset release -B "$folder" -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" "${options[@]}" \
  >"$folder/configure.log"

# measure WHAT TARGET...: builds, and prints processor time and elapsed time.
measure() {
  local what=$1
  shift
  : >"$units"
  TIMEFORMAT='%U %S %R'
  local times
  times=$({ time cmake --build "$folder" --parallel "$(nproc)" --target "$@" \
    >"$folder/build.log" 2>&1; } 2>&1) || {
    tail -n 40 "$folder/build.log" >&2
    exit 1
  }
  awk -v what="$what" -v units="$(wc -l <"$units")" \
    '{ printf "%-44s %7.1f s of processor time, %7.1f s passed, %4d compilations\n",
       what, $1 + $2, $3, units }' <<<"$times"
}

slowest() {
  echo "the 20 slowest compilations [s of processor time]:"
  awk '{ printf "%8.1f  %s\n", $1 + $2, $3 }' "$units" | sort -rn | head -n 20 |
    sed 's|CMakeFiles/[^/]*\.dir/||; s|\.o$||'
}

measure "the program, cold" luxodus
slowest
measure "the program, unchanged" luxodus
for source in "${touched[@]}"; do
  date=$(stat -c %y "$source")
  touch "$source"
  measure "$source touched" luxodus
  touch -d "$date" "$source"
done
if [ -n "$with_tests" ]; then
  measure "all the rest that ./test.sh builds, cold" all
  slowest
fi
