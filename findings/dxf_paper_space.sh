#!/usr/bin/env bash
# The npm package dxf draws the sheet of paper of a DXF among the building: entities of the paper
# space (group 67 = 1) lie beside those of the model space, in one coordinate system.
#
# Package          dxf 5.3.1 (npm)
# One would guess  that a drawing is its model space, and a line of 10 m is 10 m wide
# It is            500 wide: the frame of the sheet, in millimetres of paper, is a part of it
# Needs            node, npm and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"name": "finding", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund --ignore-scripts dxf@5.3.1 >/dev/null
# A wall of the model, then a line of the sheet.
printf '%s\n' 0 SECTION 2 ENTITIES \
  0 LINE 8 WALL 10 0 20 0 30 0 11 10 21 0 31 0 \
  0 LINE 67 1 8 FRAME 10 0 20 0 30 0 11 500 21 0 31 0 \
  0 ENDSEC 0 EOF >plan.dxf
cat >read.js <<'JS'
import { readFileSync } from 'node:fs';
import { Helper } from 'dxf';
const { bbox } = new Helper(readFileSync('plan.dxf', 'utf8')).toPolylines();
console.log(bbox.max.x - bbox.min.x);
JS
got=$(node read.js)
echo "dxf 5.3.1: the drawing is $got wide; right is 10"
[ "$got" = 500 ]
