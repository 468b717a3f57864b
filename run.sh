#!/usr/bin/env bash
# Builds Luxodus and does its main job once: the office floor that ships with it, filled with smoke,
# after the mains have failed. The verdict by the codes and a plan come first, within seconds; then
# light and pictures; then what people read of the signs in the smoke.
#   ./run.sh                          the smoke_emergency scenario, results in out/office_floor
#   ./run.sh --seed 7                 options of `luxodus run` pass through
set -euo pipefail
cd "$(dirname "$0")"

scene=scenes/library/office_floor.toml
scenario=smoke_emergency
out=out/office_floor

./setup.sh --run
./.ci/build release luxodus luxodus_python

# The scenario and the folder are ours to choose only where the caller has not.
others=()
while [ $# -gt 0 ]; do
  case $1 in
    --scenario=*) scenario=${1#*=} ;;
    --out=*) out=${1#*=} ;;
    --scenario | --out)
      [ $# -gt 1 ] || { echo "run.sh: $1 needs a value" >&2; exit 2; }
      if [ "$1" = --out ]; then out=$2; else scenario=$2; fi
      shift
      ;;
    *) others+=("$1") ;;
  esac
  shift
done
luxodus=build/release/luxodus
report=(assess "$scene" --scenario "$scenario" --out "$out/report")

printf '\n1 of 3: the codes, with plans\n\n'
"$luxodus" "${report[@]}" --codes-alone
printf '\n2 of 3: light and pictures\n\n'
"$luxodus" run "$scene" --scenario "$scenario" --out "$out" "${others[@]}"
printf '\n3 of 3: what people read of the signs in the smoke\n\n'
"$luxodus" "${report[@]}"

cat <<END

look    $out/report/report.html (verdict, plans, luminaires) and $out/views/ (pictures)
walk    $luxodus view $scene --scenario $scenario
Python  PYTHONPATH=build/release python3 -c 'import luxodus; help(luxodus)'
END
