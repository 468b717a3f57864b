#!/usr/bin/env bash
# Makes the Debian package, unpacks it elsewhere and runs a scene of it. Separate from ./test.sh,
# because it needs help2man and dpkg-dev (./setup.sh --package), and takes minutes if the program is
# not built yet.
#   tests/tools/package_test.sh             the package stays in build/release
set -euo pipefail
cd "$(dirname "$0")/../.."

fail() {
  echo "package_test.sh: $*" >&2
  exit 1
}
for tool in help2man dpkg-shlibdeps dpkg-deb; do
  command -v "$tool" >/dev/null || fail "$tool is missing: ./setup.sh --package"
done

targets=(luxodus package_files)
cmake --preset release >/dev/null
if ninja -C build/release -t query luxodus_python >/dev/null 2>&1; then
  targets+=(luxodus_python)
else
  echo "package_test.sh: without the Python module: pybind11 is missing (./setup.sh)"
fi
./.ci/build release "${targets[@]}"
(cd build/release && rm -f luxodus_*.deb && cpack -G DEB >package.log 2>&1) ||
  fail "cpack failed: build/release/package.log"
package=$(ls "$PWD"/build/release/luxodus_*.deb)

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
dpkg-deb -x "$package" "$place/unpacked"
usr=$place/unpacked/usr

echo "what it depends on"
depends=$(dpkg-deb -f "$package" Depends)
echo "  $depends"
for library in libc6 libembree3 libzmq5 libcapnp libpng16 libcairo2 librsvg2 fonts-dejavu-core; do
  [[ $depends == *"$library"* ]] || fail "the package does not depend on $library"
done

echo "what it holds"
for file in bin/luxodus share/luxodus/scenes/library/office_floor.toml \
  share/luxodus/examples/one_host.toml share/doc/luxodus/copyright share/doc/luxodus/README.md \
  share/man/man1/luxodus.1.gz share/man/man1/luxodus-run.1.gz \
  share/man/man1/luxodus-completion.1.gz \
  share/bash-completion/completions/luxodus share/zsh/vendor-completions/_luxodus; do
  [ -s "$usr/$file" ] || fail "the package lacks $file"
done
if command -v mkdocs >/dev/null; then
  page=$usr/share/doc/luxodus/html/reference/command-line.html
  grep -q "Seed of the random number generator" "$page" || fail "the site lacks the command line"
fi
zgrep -q "Seed of the random number" "$usr/share/man/man1/luxodus-run.1.gz" ||
  fail "the man page of run does not tell its options"
if grep -rl "$PWD" "$usr/share/luxodus" "$usr/share/bash-completion" "$usr/share/doc" ||
  zgrep -l "$PWD" "$usr"/share/man/man1/*.gz; then
  fail "these files name the folder that the package was built in"
fi

echo "what it does elsewhere"
mkdir "$place/elsewhere"
cd "$place/elsewhere"
program=$usr/bin/luxodus
env -i HOME="$place" PATH=/usr/bin:/bin "$program" --version
env -i HOME="$place" PATH=/usr/bin:/bin "$program" check office_floor >check.txt ||
  fail "luxodus check office_floor fails"
for scene in empty_room scenes/library/office_floor.toml; do
  env -i HOME="$place" PATH=/usr/bin:/bin "$program" run "$scene" --particles 100k --no-views \
    --out "result_of_$(basename "$scene" .toml)" || fail "luxodus run $scene fails"
  [ -s "result_of_$(basename "$scene" .toml)/flux.lux" ] || fail "no flux file of $scene"
done
# A cluster example finds its scene, too.
env -i HOME="$place" PATH=/usr/bin:/bin "$program" deploy \
  "$usr/share/luxodus/examples/one_host.toml" --for ssh --out deployed >/dev/null ||
  fail "the example of a cluster cannot be read"

if [[ " ${targets[*]} " == *" luxodus_python "* ]]; then
  echo "what Python imports"
  env -i HOME="$place" PATH=/usr/bin:/bin PYTHONPATH="$usr/lib/python3/dist-packages" \
    /usr/bin/python3 - "$usr/share/luxodus/scenes/library/office_floor.toml" <<'PYTHON' ||
import sys
import luxodus
run = luxodus.load(sys.argv[1]).run("clear_mains", particles=1e5)
assert run.planes["corridor floor"].illuminance_lx.mean() > 0
PYTHON
    fail "the Python module of the package traces nothing"
fi

echo "what completes"
bash -c '
  source "$1"
  COMP_WORDS=(luxodus run --se) COMP_CWORD=2
  _luxodus
  [ "${COMPREPLY[*]}" = --seed ]' _ "$usr/share/bash-completion/completions/luxodus" ||
  fail "bash does not complete --se to --seed"
echo "passed: $package, $(stat -c %s "$package") bytes"
