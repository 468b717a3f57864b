#!/usr/bin/env bash
# dxf-parser gives the extrusion of a block reference, and not that of an arc. Both are in
# coordinates of their own (OCS). CAD programs write an extrusion of (0, 0, -1) for what was
# mirrored, so the arc of a mirrored door leaf is on the wrong side of its wall.
#
# Package          dxf-parser 1.1.2 (npm)
# One would guess  that an entity with groups 210, 220, 230 has an extrusionDirection
# It is            so for INSERT; an ARC has none, and its centre is (-5, 4) instead of (5, 4)
# Needs            node, npm and the network; works in a folder of its own
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"name": "finding", "private": true, "type": "module"}' >package.json
npm install --silent --no-audit --no-fund --ignore-scripts dxf-parser@1.1.2 >/dev/null
printf '%s\n' 0 SECTION 2 ENTITIES \
  0 INSERT 8 DOORS 2 LEAF 10 -5 20 4 30 0 210 0 220 0 230 -1 \
  0 ARC 8 DOORS 10 -5 20 4 30 0 40 1 50 0 51 90 210 0 220 0 230 -1 \
  0 ENDSEC 0 EOF >plan.dxf
cat >read.js <<'JS'
import { readFileSync } from 'node:fs';
import Parser from 'dxf-parser';
const [insert, arc] = new (Parser.DxfParser ?? Parser)().parseSync(
  readFileSync('plan.dxf', 'utf8')).entities;
console.log(insert.extrusionDirection?.z, arc.extrusionDirection?.z, arc.center.x);
JS
got=$(node read.js)
echo "dxf-parser 1.1.2: extrusions of INSERT and ARC, centre of the arc: $got; both are -1"
[ "$got" = "-1 undefined -5" ]
