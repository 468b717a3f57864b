// The shapes of an IFC model as a binary glTF, computed by @ifc-lite/wasm: called by
// `luxodus import ifc` (actors/import/ifc_shapes.cpp), which bounds its time and reads its answer
// without trust.
//   node ifc_shapes.mjs MODEL.ifc OUT.glb
// Nodes are called by the GlobalId of their product, materials by opacity. The offset of the whole
// model is taken out, since numbers of glTF are single precision, and told as text with all digits.
// Lines on standard output:
//   offset X Y Z          of the model [m], axes of glTF (y up)
//   note TEXT             what could not be computed, for people
// Exit codes: 0 done; 3 the package is not installed; 4 the model has no shapes; 1 anything else.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const glb_magic = 0x46546c67;
const json_chunk = 0x4e4f534a;

/** The package, with its module of WebAssembly compiled from the disk. */
async function load_api() {
  let main;
  try {
    main = createRequire(import.meta.url).resolve('@ifc-lite/wasm');
  } catch {
    console.log('note the npm package @ifc-lite/wasm is not installed');
    process.exit(3);
  }
  const lite = await import(main);
  lite.initSync({ module: readFileSync(join(dirname(main), 'ifc-lite_bg.wasm')) });
  return new lite.IfcAPI();
}

/** JSON and what follows it of a binary glTF. */
function taken_apart(glb) {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  if (view.getUint32(0, true) !== glb_magic || view.getUint32(16, true) !== json_chunk)
    throw new Error('the package gave no binary glTF');
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(glb.subarray(20, 20 + length)));
  return { json, rest: glb.subarray(20 + length) };
}

function put_together(json, rest) {
  const text = Buffer.from(JSON.stringify(json));
  const padding = Buffer.alloc((4 - (text.length % 4)) % 4, 0x20);
  const head = Buffer.alloc(20);
  head.writeUInt32LE(glb_magic, 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + text.length + padding.length + rest.length, 8);
  head.writeUInt32LE(text.length + padding.length, 12);
  head.writeUInt32LE(json_chunk, 16);
  return Buffer.concat([head, text, padding, rest]);
}

/** Takes the translation of the one root out, and gives it. */
function offset_of(json) {
  const roots = json.scenes?.[json.scene ?? 0]?.nodes ?? [];
  const root = roots.length === 1 ? json.nodes[roots[0]] : undefined;
  if (!root?.translation || root.mesh !== undefined) return [0, 0, 0];
  const offset = root.translation;
  delete root.translation;
  return offset;
}

function name_parts(json) {
  for (const node of json.nodes) {
    const { GlobalId, expressId } = node.extras ?? {};
    if (GlobalId ?? expressId) node.name = GlobalId ? String(GlobalId) : `#${expressId}`;
  }
  for (const material of json.materials ?? [])
    material.name = `opacity ${material.pbrMetallicRoughness?.baseColorFactor?.[3] ?? 1}`;
}

function tell_faults(api, bytes) {
  const found = api.diagnoseGeometry(bytes);
  for (const { reason, count } of found?.failuresByReason ?? [])
    console.log(`note ${count} openings were not cut: ${reason}`);
  for (const host of found?.worstHosts ?? [])
    console.log(`note #${host.productId ?? host.expressId ?? '?'} has openings that were not cut`);
  for (const item of found?.unsupportedItemsByType ?? [])
    console.log(`note ${item.count ?? ''} items of ${item.type ?? item.ifcType ?? '?'} have no shape`);
}

const [model, out] = process.argv.slice(2);
const api = await load_api();
const bytes = new Uint8Array(readFileSync(model));
let glb;
try {
  glb = api.exportGlb(bytes, true, new Uint32Array(0), undefined, '', true, false);
} catch (error) {
  if (!String(error).includes('NO_RENDER_GEOMETRY')) throw error;
  console.log('note the model has no shapes');
  process.exit(4);
}
const { json, rest } = taken_apart(glb);
console.log(`offset ${offset_of(json).join(' ')}`);
name_parts(json);
writeFileSync(out, put_together(json, rest));
tell_faults(api, bytes);
