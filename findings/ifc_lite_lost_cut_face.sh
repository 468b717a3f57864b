#!/usr/bin/env bash
# Package:   @ifc-lite/wasm (npm), version 9.3.0
# One would guess: a wall that a half space cuts (IfcBooleanClippingResult) comes back as a closed
#            solid, or the library reports a failure in the diagnostics of its batch.
# Behaviour: where the plane runs along an edge of the wall, as under a sloping roof, the cut face
#            is missing: the mesh is open. No failure is reported. With the plane a centimetre
#            higher the solid is closed. An intersection (IfcBooleanResult) with the same half space
#            gives no mesh at all, without a failure either.
# Output seen (9.3.0):
#            plane along the edge: 8 triangles, 6 open edges, reported failures 0
#            plane 10 mm higher: 20 triangles, 0 open edges, reported failures 0
#            intersection: 0 triangles, 0 open edges, reported failures 0
# This script installs the package in a temporary folder, computes the three walls, and fails if the
# behaviour has changed. It needs Node.js 18, npm and the registry of npm; it runs nothing of ours.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init -y >/dev/null
npm install --no-audit --no-fund --silent @ifc-lite/wasm@9.3.0

cat >wall.mjs <<'SCRIPT'
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

/** A wall of 4 m x 0.2 m x 3 m, and a half space above a plane that falls from one end. */
function model(height, operation) {
  return `ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#2=IFCUNITASSIGNMENT((#1));
#3=IFCCARTESIANPOINT((0.,0.,0.));
#4=IFCAXIS2PLACEMENT3D(#3,$,$);
#5=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#4,$);
#6=IFCPROJECT('0000000000000000000006',$,'P',$,$,$,$,(#5),#2);
#7=IFCLOCALPLACEMENT($,#4);
#8=IFCCARTESIANPOINT((2.,0.1));
#9=IFCAXIS2PLACEMENT2D(#8,$);
#10=IFCRECTANGLEPROFILEDEF(.AREA.,$,#9,4.,0.2);
#11=IFCDIRECTION((0.,0.,1.));
#12=IFCEXTRUDEDAREASOLID(#10,#4,#11,3.);
#13=IFCCARTESIANPOINT((0.,0.,${height}));
#14=IFCDIRECTION((1.,0.,1.));
#15=IFCAXIS2PLACEMENT3D(#13,#14,$);
#16=IFCPLANE(#15);
#17=IFCHALFSPACESOLID(#16,.F.);
#18=${operation},#12,#17);
#19=IFCSHAPEREPRESENTATION(#5,'Body','Clipping',(#18));
#20=IFCPRODUCTDEFINITIONSHAPE($,$,(#19));
#21=IFCWALL('0000000000000000000021',$,'W',$,$,#7,#20,$,$);
ENDSEC;
END-ISO-10303-21;
`;
}

const main = createRequire(import.meta.url).resolve('@ifc-lite/wasm');
const lite = await import(main);
lite.initSync({ module: readFileSync(join(dirname(main), 'ifc-lite_bg.wasm')) });
console.info = console.warn = () => {};

/** Triangles, edges of an odd number of triangles, and failures that the library reports. */
function computed(text) {
  const api = new lite.IfcAPI();
  const bytes = new TextEncoder().encode(text);
  const plan = api.buildPrePassOnce(bytes);
  const batch = api.processGeometryBatch(
    bytes, plan.jobs, plan.unitScale, ...plan.rtcOffset, plan.needsShift, plan.voidKeys,
    plan.voidCounts, plan.voidValues, plan.styleIds, plan.styleColors, plan.planeAngleToRadians,
    plan.materialElementIds, plan.materialColorCounts, plan.materialColors);
  const odd = new Set();
  let triangles = 0;
  for (let m = 0; m < batch.length; ++m) {
    const { positions, indices } = batch.takeMesh(m);
    const place = (i) => [0, 1, 2].map((k) => Math.round(1e3 * positions[3 * i + k])).join();
    for (let t = 0; t < indices.length; t += 3, ++triangles)
      for (let k = 0; k < 3; ++k) {
        const edge = [place(indices[t + k]), place(indices[t + (k + 1) % 3])].sort().join('|');
        if (!odd.delete(edge)) odd.add(edge);
      }
  }
  const { totalCsgFailures = 0, totalUnsupportedItems = 0 } = batch.diagnostics ?? {};
  return { triangles, open: odd.size, reported: totalCsgFailures + totalUnsupportedItems };
}

const difference = 'IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.';
const intersection = 'IFCBOOLEANRESULT(.INTERSECTION.';
const edge = computed(model('3.', difference));
const higher = computed(model('3.01', difference));
const common = computed(model('3.', intersection));
for (const [name, { triangles, open, reported }] of
     [['plane along the edge', edge], ['plane 10 mm higher', higher], ['intersection', common]])
  console.log(`${name}: ${triangles} triangles, ${open} open edges, reported failures ${reported}`);
const as_found = edge.open > 0 && edge.reported === 0 && higher.triangles > 0 &&
  higher.open === 0 && common.triangles === 0 && common.reported === 0;
if (!as_found) {
  console.log('the behaviour has changed: see the head of this script');
  process.exit(1);
}
SCRIPT
node wall.mjs
