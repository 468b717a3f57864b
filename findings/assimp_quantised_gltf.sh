#!/usr/bin/env bash
# Assimp reads a glTF although it does not know an extension that the file requires. glTF 2.0 (3.12)
# wants such a file to be refused. With KHR_mesh_quantization, positions are integers: each vertex
# is read as a number near 0, and nothing is said.
#
# Package          assimp-utils and libassimp5 5.2.5~ds0-1+b1 (Debian 12)
# One would guess  that the triangle is 100 wide and 200 high, or that the file is refused
# It is            read, "OK", with a size of 0
# Needs            apt-get download, dpkg, python3 and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq assimp-utils=5.2.5~ds0-1+b1 libassimp5=5.2.5~ds0-1+b1 libdraco7 libminizip1 \
  >download.log 2>&1
for package in ./*.deb; do dpkg -x "$package" root; done
export LD_LIBRARY_PATH=root/usr/lib/x86_64-linux-gnu
python3 - <<'PYTHON'
import base64, json, struct
# Three positions of 16 bits, each padded to 8 bytes.
data = struct.pack("<12h", 0, 0, 0, 0, 100, 0, 0, 0, 0, 200, 0, 0)
json.dump({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5122, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [100, 200, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 8}],
    "buffers": [{"byteLength": 24, "uri": "data:application/octet-stream;base64,"
                 + base64.b64encode(data).decode()}]}, open("triangle.gltf", "w"))
PYTHON
said=$(root/usr/bin/assimp info triangle.gltf)
got=$(grep -E '^Maximum point' <<<"$said" | sed 's/.*(//; s/ *).*//')
echo "assimp 5.2.5 reads it, and the largest coordinates are $got; right are 100 200 0"
grep -q 'OK' <<<"$said" && [ "$got" = "0.000000 0.000000 0.000000" ]
