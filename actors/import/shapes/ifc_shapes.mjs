// Computes the shapes of an IFC model as a binary glTF with @ifc-lite/wasm. `luxodus import ifc`
// (actors/import/ifc_shapes.cpp) calls it, limits its time and does not trust its answer.
//   node ifc_shapes.mjs MODEL.ifc OUT.glb
// Products are computed in batches, so that progress can be reported. Nodes are named by the
// GlobalId of their product, materials by opacity. The offset of the whole model is removed, since
// glTF has single precision, and printed as text with all digits.
// Lines on standard output:
//   done SHARE            of the products, from 0 to 1
//   offset X Y Z          of the model [m], axes of glTF (y up)
//   note TEXT             what could not be computed, for the user
// Exit codes: 0 done; 3 the package is not installed; 4 the model has no shapes; 1 anything else.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const glb_magic = 0x46546c67;
const json_chunk = 0x4e4f534a;
/** A job has the number of its product, and the begin and end of its statement [bytes]. */
const job_words = 3;
/** Class of a mesh: the shape of a type, which its products already have. */
const of_used_type = 2;
/** Limit on batches of a model. Products share work within a batch. */
const most_batches = 100;
/** Limit on products named for openings that were not cut; each batch names some. */
const most_hosts = 16;

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
  // The library's own messages, a few for each batch, are of no use here.
  console.info = console.warn = () => {};
  return new lite.IfcAPI();
}

/** Collects what could not be computed, over all batches. */
class Faults {
  constructor() {
    this.uncut = new Map();
    this.hosts = new Set();
    this.shapeless = new Map();
  }

  add(found) {
    const grow = (counts, what, by) => counts.set(what, (counts.get(what) ?? 0) + by);
    for (const { reason, count } of found?.failuresByReason ?? []) grow(this.uncut, reason, count);
    for (const host of found?.worstHosts ?? [])
      this.hosts.add(host.productId ?? host.expressId ?? '?');
    for (const item of found?.unsupportedItemsByType ?? [])
      grow(this.shapeless, item.reason ?? '?', item.count ?? 1);
  }

  tell() {
    for (const [type, count] of this.shapeless)
      console.log(`note ${count} items of ${type} have no shape`);
    for (const [reason, count] of this.uncut)
      console.log(`note ${count} openings were not cut: ${reason}`);
    for (const host of [...this.hosts].slice(0, most_hosts))
      console.log(`note #${host} has openings that were not cut`);
  }
}

/** The meshes of all products in the order of the model; prints how many products are done. */
function computed_meshes(api, bytes, plan, faults) {
  api.setSourceBytes(bytes);
  const meshes = [];
  const step = job_words * Math.ceil(plan.jobs.length / job_words / most_batches);
  for (let at = 0; at < plan.jobs.length; at += step) {
    const batch = api.processGeometryBatchFromSource(
      plan.jobs.slice(at, at + step), plan.unitScale, ...plan.rtcOffset, plan.needsShift,
      plan.voidKeys, plan.voidCounts, plan.voidValues, plan.styleIds, plan.styleColors,
      plan.planeAngleToRadians, plan.materialElementIds, plan.materialColorCounts,
      plan.materialColors);
    for (let i = 0; i < batch.length; ++i) {
      const mesh = batch.takeMesh(i);
      const { positions, normals, indices, color, origin, expressId } = mesh;
      if (indices.length > 0 && mesh.geometryClass !== of_used_type)
        meshes.push({ positions, normals, indices, color, origin, expressId });
      mesh.free();
    }
    faults.add(batch.diagnostics);
    batch.free();
    console.log(`done ${Math.min(1, (at + step) / plan.jobs.length)}`);
  }
  return meshes;
}

/** Concatenates the numbers that `of` returns for each mesh. */
function joined(Numbers, meshes, of) {
  const out = new Numbers(meshes.reduce((sum, mesh) => sum + of(mesh).length, 0));
  let at = 0;
  for (const mesh of meshes) {
    out.set(of(mesh), at);
    at += of(mesh).length;
  }
  return out;
}

function glb_of(api, meshes) {
  return api.exportGlbFromMeshes(
    joined(Float32Array, meshes, (mesh) => mesh.positions),
    joined(Float32Array, meshes, (mesh) => mesh.normals),
    joined(Uint32Array, meshes, (mesh) => mesh.indices),
    Uint32Array.from(meshes, (mesh) => mesh.positions.length / 3),
    Uint32Array.from(meshes, (mesh) => mesh.indices.length),
    joined(Float32Array, meshes, (mesh) => mesh.color),
    joined(Float64Array, meshes, (mesh) => mesh.origin),
    Uint32Array.from(meshes, (mesh) => mesh.expressId),
    true, true, false);
}

/** The JSON and the binary chunk of a binary glTF. */
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

/** Removes the translation of the single root; returns it plus that of the plan, which is z up. */
function take_offset(json, plan) {
  const [x, y, z] = plan.needsShift ? plan.rtcOffset : [0, 0, 0];
  const roots = json.scenes?.[json.scene ?? 0]?.nodes ?? [];
  const root = roots.length === 1 ? json.nodes[roots[0]] : undefined;
  if (!root?.translation || root.mesh !== undefined) return [x, z, -y];
  const [root_x, root_y, root_z] = root.translation;
  delete root.translation;
  return [x + root_x, z + root_y, root_z - y];
}

/** The GlobalId of each product: the first text of its statement. */
function global_ids(bytes, plan) {
  const ids = new Map();
  for (let at = 0; at < plan.jobs.length; at += job_words) {
    const [number, begin, end] = plan.jobs.subarray(at, at + job_words);
    const statement = Buffer.from(bytes.buffer, bytes.byteOffset + begin, end - begin)
      .toString('latin1').replace(/\/\*.*?\*\//gs, '');
    const id = /^[^']*\(\s*'([^']+)'/.exec(statement);
    if (id) ids.set(number, id[1]);
  }
  return ids;
}

function name_parts(json, ids) {
  for (const node of json.nodes) {
    const number = node.extras?.expressId;
    if (number !== undefined) node.name = ids.get(number) ?? `#${number}`;
  }
  for (const material of json.materials ?? [])
    material.name = `opacity ${material.pbrMetallicRoughness?.baseColorFactor?.[3] ?? 1}`;
}

const [model, out] = process.argv.slice(2);
const api = await load_api();
const bytes = new Uint8Array(readFileSync(model));
const plan = api.buildPrePassOnce(bytes);
const faults = new Faults();
const meshes = computed_meshes(api, bytes, plan, faults);
if (meshes.length === 0) {
  faults.tell();
  process.exit(4);
}
const { json, rest } = taken_apart(glb_of(api, meshes));
console.log(`offset ${take_offset(json, plan).join(' ')}`);
name_parts(json, global_ids(bytes, plan));
writeFileSync(out, put_together(json, rest));
faults.tell();
