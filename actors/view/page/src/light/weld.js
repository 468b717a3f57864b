// Which corners of triangles are one point of one flat piece of surface. Light is collected per
// triangle; drawn from point to point it shows no facets, and edges of the building stay sharp.

const perMetre = 1000;
const normalSteps = 16;

function normalOf(corners, at) {
  const ux = corners[at + 3] - corners[at];
  const uy = corners[at + 4] - corners[at + 1];
  const uz = corners[at + 5] - corners[at + 2];
  const vx = corners[at + 6] - corners[at];
  const vy = corners[at + 7] - corners[at + 1];
  const vz = corners[at + 8] - corners[at + 2];
  const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  return { n, double: Math.hypot(...n) };
}

/** A small number for the direction that a triangle faces. */
function directionKey({ n, double }) {
  if (double === 0) return 0;
  const step = (x) => Math.round((x / double) * normalSteps) + normalSteps;
  return (step(n[0]) * 64 + step(n[1])) * 64 + step(n[2]);
}

/** Points by number: an open table of five whole numbers a point, no garbage. */
class PointTable {
  constructor(most) {
    let size = 16;
    while (size < 2 * most) size *= 2;
    this.mask = size - 1;
    this.slots = new Int32Array(size).fill(-1);
    this.keys = new Int32Array(5 * most);
    this.count = 0;
  }

  find(x, y, z, direction, surface) {
    let slot = Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791);
    slot = (slot ^ Math.imul(direction, 2654435761 | 0) ^ Math.imul(surface, 40503)) & this.mask;
    for (; this.slots[slot] >= 0; slot = (slot + 1) & this.mask) {
      const k = 5 * this.slots[slot];
      const keys = this.keys;
      if (keys[k] === x && keys[k + 1] === y && keys[k + 2] === z &&
          keys[k + 3] === direction && keys[k + 4] === surface) return this.slots[slot];
    }
    this.slots[slot] = this.count;
    this.keys.set([x, y, z, direction, surface], 5 * this.count);
    return this.count++;
  }
}

/** `pointOf` each of the 3 n corners, the number of points, and each triangle's area. */
export function weld({ triangles, corners, surfaces }) {
  const table = new PointTable(3 * triangles);
  const pointOf = new Uint32Array(3 * triangles);
  const area = new Float32Array(triangles);
  for (let t = 0; t < triangles; ++t) {
    const normal = normalOf(corners, 9 * t);
    const direction = directionKey(normal);
    area[t] = normal.double / 2;
    for (let c = 0; c < 3; ++c) {
      const at = 9 * t + 3 * c;
      const [x, y, z] = [0, 1, 2].map((i) => Math.round(corners[at + i] * perMetre) | 0);
      pointOf[3 * t + c] = table.find(x, y, z, direction, surfaces[t] | 0);
    }
  }
  return { pointOf, area, points: table.count, weight: weights(pointOf, area, table.count) };
}

function weights(pointOf, area, points) {
  const weight = new Float32Array(points);
  for (let i = 0; i < pointOf.length; ++i) weight[pointOf[i]] += area[(i / 3) | 0];
  return weight;
}

/** Light of points from light of triangles, by area; both eight numbers each. */
export function smooth(sum, { pointOf, area, points, weight }, out) {
  out.fill(0, 0, 8 * points);
  for (let i = 0; i < pointOf.length; ++i) {
    const t = (i / 3) | 0;
    const point = pointOf[i];
    const share = weight[point] > 0 ? area[t] / weight[point] : 0;
    const from = 8 * t;
    const to = 8 * point;
    for (let k = 0; k < 7; ++k) out[to + k] += share * sum[from + k];
  }
}
