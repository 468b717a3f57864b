#!/usr/bin/env bash
# Assimp drops a vertex of an OBJ one of whose numbers begins with a point. All faces that follow
# name the next vertices: the mesh is another one, and nothing is said.
#
# Package          assimp-utils and libassimp5 5.2.5~ds0-1+b1 (Debian 12)
# One would guess  that "v 1 .5 0" is the vertex (1, 0.5, 0), or an error
# It is            left out: 4 vertices of 5
# Needs            apt-get download, dpkg and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq assimp-utils=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1 libdraco7 libminizip1 \
  >download.log 2>&1
for package in ./*.deb; do dpkg -x "$package" root; done
export LD_LIBRARY_PATH=root/usr/lib/x86_64-linux-gnu
printf '%s\n' 'v 0 0 0' 'v 1 0 0' 'v 1 .5 0' 'v 0 1 0' 'v 0 0 1' 'f 1 2 3' 'f 1 3 4' >house.obj
root/usr/bin/assimp export house.obj again.obj >export.log 2>&1
got=$(grep '^v ' again.obj | tr -s ' ' | paste -sd, -)
echo "assimp 5.2.5 has the vertices $got; right is a third one, 1 0.5 0"
[ "$got" = "v 0 0 0,v 1 0 0,v 0 1 0,v 0 0 1" ]
