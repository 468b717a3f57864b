// Computes the shapes of an IFC model as a binary glTF with @ifc-lite/wasm. `luxodus import ifc`
// (actors/import/ifc_shapes.cpp) calls it, limits its time and does not trust its answer.
//   node ifc_shapes.mjs MODEL.ifc OUT.glb [NUMBERS]
// Products are computed in batches, so that progress can be reported; with a file of numbers of
// instances, those alone. Nodes are named by the GlobalId of their product and their own number,
// materials by opacity. Where a node stands is printed as text with all digits, since glTF has
// single precision.
// Lines on standard output:
//   done SHARE            of the products, from 0 to 1
//   at NUMBER X Y Z       of a node [m], axes of glTF (y up)
//   uncut NUMBER COUNT    of a product, of whose openings COUNT were not cut
//   note TEXT             what could not be computed, for the user
// Exit codes: 0 done; 3 the package is not installed; 4 the model has no shapes; 1 anything else.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';

const glb_magic = 0x46546c67;
const json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
/** Component types of glTF. */
const floats = 5126, unsigned_ints = 5125;
/** A job has the number of its product, and the begin and end of its statement [bytes]. */
const job_words = 3;
/** Class of a mesh: the shape of a type, which its products already have. */
const of_used_type = 2;
/** Limit on batches of a model. Products share work within a batch. */
const most_batches = 100;

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
    this.reasons = new Map();
    this.hosts = new Map();
    this.shapeless = new Map();
  }

  add(found) {
    const grow = (counts, what, by) => counts.set(what, (counts.get(what) ?? 0) + by);
    for (const { reason, count } of found?.failuresByReason ?? [])
      grow(this.reasons, reason, count);
    for (const host of found?.worstHosts ?? [])
      if (host.csgFailures > 0) grow(this.hosts, host.productId, host.csgFailures);
    for (const item of found?.unsupportedItemsByType ?? [])
      grow(this.shapeless, item.reason ?? '?', item.count ?? 1);
  }

  tell() {
    for (const [type, count] of this.shapeless)
      console.log(`note ${count} items of ${type} have no shape`);
    for (const [host, count] of this.hosts) console.log(`uncut ${host} ${count}`);
    const sum = (counts) => [...counts.values()].reduce((all, count) => all + count, 0);
    const rest = sum(this.reasons) - sum(this.hosts);
    if (rest > 0)
      console.log(`note the library did not make ${rest} cuts of solids (` +
        `${[...this.reasons.keys()].join(', ')}); those that show are made anew, or listed`);
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
      const { positions, indices, color, origin, expressId } = mesh;
      if (indices.length > 0 && mesh.geometryClass !== of_used_type)
        meshes.push({ positions, indices, color, origin, expressId });
      mesh.free();
    }
    faults.add(batch.diagnostics);
    batch.free();
    console.log(`done ${Math.min(1, (at + step) / plan.jobs.length)}`);
  }
  return meshes;
}

/** The meshes as a binary glTF, each in a node without a translation. */
function glb_of(meshes, ids) {
  const accessors = [], bufferViews = [], materials = new Map(), parts = [], nodes = [];
  let byteOffset = 0;
  const add = (numbers, accessor) => {
    const bytes = Buffer.from(numbers.buffer, numbers.byteOffset, numbers.byteLength);
    bufferViews.push({ buffer: 0, byteOffset, byteLength: bytes.length });
    byteOffset += bytes.length;
    parts.push(bytes);
    accessors.push({ bufferView: bufferViews.length - 1, ...accessor });
    return accessors.length - 1;
  };
  const material_of = (color) => {
    const key = [...color].join(' ');
    if (!materials.has(key)) materials.set(key, materials.size);
    return materials.get(key);
  };
  const shapes = meshes.map((mesh, i) => {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    mesh.positions.forEach((x, k) => {
      low[k % 3] = Math.min(low[k % 3], x);
      high[k % 3] = Math.max(high[k % 3], x);
    });
    const count = mesh.positions.length / 3;
    nodes.push({ name: `${ids.get(mesh.expressId) ?? ''}#${i}`, mesh: i });
    const position = { componentType: floats, count, type: 'VEC3', min: low, max: high };
    const index = { componentType: unsigned_ints, count: mesh.indices.length, type: 'SCALAR' };
    return { primitives: [{ attributes: { POSITION: add(mesh.positions, position) },
                            indices: add(mesh.indices, index),
                            material: material_of(mesh.color) }] };
  });
  const bin = Buffer.concat(parts);
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: nodes.map((_, i) => i) }], nodes,
    meshes: shapes, accessors, bufferViews, buffers: [{ byteLength: bin.length }],
    materials: [...materials.keys()].map((key) => {
      const color = key.split(' ').map(Number);
      return { name: `opacity ${color[3] ?? 1}`,
               pbrMetallicRoughness: { baseColorFactor: color } };
    }) };
  return put_together(json, bin);
}

function put_together(json, bin) {
  const text = Buffer.from(JSON.stringify(json));
  const padding = Buffer.alloc((4 - (text.length % 4)) % 4, 0x20);
  const head = Buffer.alloc(20), middle = Buffer.alloc(8);
  head.writeUInt32LE(glb_magic, 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(28 + text.length + padding.length + bin.length, 8);
  head.writeUInt32LE(text.length + padding.length, 12);
  head.writeUInt32LE(json_chunk, 16);
  middle.writeUInt32LE(bin.length, 0);
  middle.writeUInt32LE(binary_chunk, 4);
  return Buffer.concat([head, text, padding, middle, bin]);
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

/** Prints where each mesh stands; the offset of the plan is z up. */
function tell_places(meshes, plan) {
  const [x, y, z] = plan.needsShift ? plan.rtcOffset : [0, 0, 0];
  meshes.forEach(({ origin }, i) =>
    console.log(`at ${i} ${origin[0] + x} ${origin[1] + z} ${origin[2] - y}`));
}

/** The jobs of the products whose numbers the file lists. */
function chosen_jobs(jobs, file) {
  const numbers = new Set(readFileSync(file, 'utf8').split(/\s+/).filter(Boolean).map(Number));
  return jobs.filter((_, i) => numbers.has(jobs[i - (i % job_words)]));
}

const [model, out, numbers] = process.argv.slice(2);
const api = await load_api();
const bytes = new Uint8Array(readFileSync(model));
const plan = api.buildPrePassOnce(bytes);
const ids = global_ids(bytes, plan);
if (numbers) plan.jobs = chosen_jobs(plan.jobs, numbers);
const faults = new Faults();
const meshes = computed_meshes(api, bytes, plan, faults);
if (meshes.length === 0) {
  faults.tell();
  process.exit(4);
}
tell_places(meshes, plan);
writeFileSync(out, glb_of(meshes, ids));
faults.tell();
