#!/usr/bin/env bash
# dxflib reports the vertices of an old POLYLINE without their flags (group 70). A polyline that was
# fitted to a spline holds two sets of vertices: those of the curve (8), and those of the frame that
# pulls it (16), which is not drawn. A program that joins what dxflib reports draws a zigzag.
#
# Package          libdxflib3 and libdxflib-dev 3.26.4-1+b1 (Debian 12)
# One would guess  that a vertex says what it is, or that the frame is left out
# It is            one like the others: DL_VertexData has x, y, z and bulge
# Needs            apt-get download, dpkg, g++ and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq libdxflib3=3.26.4-1+b1 libdxflib-dev=3.26.4-1+b1 >download.log 2>&1
for package in ./*.deb; do dpkg -x "$package" root; done
vertex() { printf '%s\n' 0 VERTEX 8 WALL 10 "$1" 20 "$2" 30 0 70 "$3"; }
{
  printf '%s\n' 0 SECTION 2 ENTITIES 0 POLYLINE 8 WALL 66 1 10 0 20 0 30 0 70 4
  vertex 0 0 16  # frame
  vertex 1 9 16
  vertex 2 0 16
  vertex 0 0 8  # curve
  vertex 2 0 8
  printf '%s\n' 0 SEQEND 8 WALL 0 ENDSEC 0 EOF
} >plan.dxf
cat >read.cpp <<'CPP'
#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>

#include <iostream>

struct Count : DL_CreationAdapter {
  int vertices = 0;
  double highest = 0;
  void addVertex(const DL_VertexData& v) override {
    ++vertices;
    highest = v.y > highest ? v.y : highest;
  }
};

int main() {
  Count count;
  DL_Dxf().in("plan.dxf", &count);
  std::cout << count.vertices << " vertices up to y = " << count.highest;
}
CPP
g++ -I root/usr/include -L root/usr/lib/x86_64-linux-gnu -o read read.cpp -ldxflib
got=$(LD_LIBRARY_PATH=root/usr/lib/x86_64-linux-gnu ./read)
echo "dxflib 3.26.4 reports $got; the curve has 2, at y = 0"
[ "$got" = "5 vertices up to y = 9" ]
