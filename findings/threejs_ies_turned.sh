#!/bin/bash
# three.js turns an IES file of the planes 90 to 270 degrees by a quarter. LM-63 allows these for
# luminaires whose only plane of symmetry is that of 90 and 270 degrees.
#
# Package    three 0.187.0 (npm), examples/jsm/loaders/IESLoader.js
# One would guess  that the plane 180 of the file is that of the light, and 0 its mirror image
# It is            the plane 90 of the light: the listed angles are shifted to begin at 0
# Needs      node, npm and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"name": "finding", "private": true, "type": "module"}' > package.json
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 > /dev/null
# 100 cd in the planes 90 and 270, 50 cd in the plane 180, in all directions of each plane.
printf '%s\n' 'IESNA:LM-63-2002' '[TEST] none' 'TILT=NONE' '1 -1 1 2 3 1 2 0 0 0' '1 1 10' \
  '0 180' '90 180 270' '100 100' '50 50' '100 100' > lamp.ies
cat > read.js << 'EOF'
import { readFileSync } from 'node:fs';
import { FloatType } from 'three';
import { IESLoader } from 'three/examples/jsm/loaders/IESLoader.js';
const loader = new IESLoader();
loader.type = FloatType;
const { data } = loader.parse(readFileSync('lamp.ies', 'utf8')).image;
const rows = data.length / 360;
const at = (horizontal, vertical) => 100 * data[vertical + rows * horizontal]; // of the peak
console.log(at(180, 90), at(90, 90), at(0, 90));
EOF
got=$(node read.js)
echo "three 0.187.0: planes 180, 90 and 0 degrees have $got of 100 cd; right are 50 100 50"
[ "$got" = "100 50 100" ]
