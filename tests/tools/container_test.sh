#!/usr/bin/env bash
# Builds the container of Containerfile and runs scenes in it. Separate from ./test.sh, because it
# needs Podman or Docker, fetches a base image, and compiles everything: some 20 minutes.
set -euo pipefail
cd "$(dirname "$0")/../.."

fail() {
  echo "container_test.sh: $*" >&2
  exit 1
}
builder=
for tool in podman docker; do
  if command -v "$tool" >/dev/null; then
    builder=$tool
    break
  fi
done
[ -n "$builder" ] || fail "neither Podman nor Docker is installed (Debian: apt install podman)"

image=luxodus-test
"$builder" build -t "$image" -f Containerfile .
place=$(mktemp -d)
trap 'rm -rf "$place"; "$builder" rm -f luxodus-test-view >/dev/null 2>&1 || true' EXIT
cp -r scenes/library "$place/library"

in_container() { "$builder" run --rm -v "$place:/work" "$image" "$@"; }
in_container --version
in_container run library/empty_room.toml --particles 100k --no-views --out room ||
  fail "luxodus run fails in the container"
[ -s "$place/room/flux.lux" ] || fail "the run left no flux file beside the scene"
in_container assess library/office_floor.toml --scenario smoke_emergency --codes-alone --pdf \
  --out report || fail "luxodus assess fails in the container"
head -c 5 "$place/report/report.pdf" | grep -q '%PDF-' || fail "the report is not printed"

"$builder" run -d --rm --name luxodus-test-view -p 18080:8080 -v "$place:/work" "$image" \
  view library/empty_room.toml --address 0.0.0.0 >/dev/null
address=
for _ in $(seq 60); do
  address=$("$builder" logs luxodus-test-view 2>&1 | grep -oE 'token=[0-9a-f]+' | head -n 1 || true)
  [ -n "$address" ] && break
  sleep 1
done
curl -sf "http://localhost:18080/?$address" | grep -q '<html' || fail "the live view is not served"
echo "container_test.sh: the container runs, assesses, prints and serves the live view"
