#!/bin/bash
# pugixml gives the text of an element only up to a comment in it, although it drops the comment.
#
# Package    libpugixml-dev, libpugixml1v5 1.13-0.2 (Debian 12)
# One would guess  that <Flux>4<!-- four hundred -->00</Flux> has the text 400, as other parsers say
#                  that drop comments (Python's ElementTree)
# It is            4: child_value(), text() and so as_double() take the first of two pieces of text
# Needs      apt-get, g++, python3 and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq libpugixml-dev=1.13-0.2 libpugixml1v5=1.13-0.2 > /dev/null
for package in *.deb; do dpkg-deb -x "$package" .; done
cat > read.cpp << 'EOF'
#include <cstdio>
#include <pugixml.hpp>
int main() {
  pugi::xml_document document;
  if (!document.load_string("<Flux>4<!-- four hundred -->00</Flux>")) return 2;
  std::printf("%s %g\n", document.child_value("Flux"), document.child("Flux").text().as_double());
}
EOF
lib=usr/lib/$(dpkg-architecture -q DEB_HOST_MULTIARCH 2> /dev/null || gcc -print-multiarch)
g++ -Iusr/include read.cpp "$lib/libpugixml.so.1" -o read
got=$(LD_LIBRARY_PATH=$lib ./read)
other=$(python3 -c 'import xml.etree.ElementTree as e
print(e.fromstring("<Flux>4<!-- four hundred -->00</Flux>").text)')
echo "pugixml 1.13: child_value and as_double are \"$got\"; ElementTree says \"$other\""
[ "$got" = "4 4" ] && [ "$other" = "400" ]
