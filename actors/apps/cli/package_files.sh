#!/usr/bin/env bash
# package_files.sh PROGRAM FOLDER: writes the files of a package that the program generates:
# completion of bash and zsh, and man pages of the program and each command if help2man is
# installed.
set -euo pipefail
program=$1
out=$2

rm -rf "$out/man1"
mkdir -p "$out/man1"
"$program" completion bash >"$out/luxodus.bash"
"$program" completion zsh >"$out/_luxodus"

if ! command -v help2man >/dev/null; then
  echo "package_files.sh: no man pages: help2man is not installed" >&2
  exit 0
fi
version=$("$program" --version | cut -d ' ' -f 2)
# page NAME SUMMARY WORD...: the man page of `luxodus WORD...`, as man1/NAME.1.gz.
page() {
  local name=$1 summary=$2
  shift 2
  help2man --no-info --section 1 --name "$summary" --version-string "$version" \
    --source "Luxodus $version" --manual "Luxodus" "$program${*:+ $*}" |
    sed "s|$program|luxodus|g" | gzip -9n >"$out/man1/$name.1.gz"
}
page luxodus "light in smoke-filled buildings"
for command in $("$program" --help | sed -n 's/^  \([a-z]\+\)  \+[A-Z].*$/\1/p'); do
  page "luxodus-$command" "$("$program" "$command" --help | sed -n 1p)" "$command"
done
