// Welds corners of triangles that are one point of one flat piece of surface. Light is stored per
// triangle; drawn from point to point it shows no facets, and edges of the building stay sharp.

const perMetre = 1000;
const normalSteps = 16;

/** A small number for the facing of a triangle; its area goes into `area`. */
function facing(corners, at, area, t) {
  const ux = corners[at + 3] - corners[at];
  const uy = corners[at + 4] - corners[at + 1];
  const uz = corners[at + 5] - corners[at + 2];
  const vx = corners[at + 6] - corners[at];
  const vy = corners[at + 7] - corners[at + 1];
  const vz = corners[at + 8] - corners[at + 2];
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  const double = Math.sqrt(nx * nx + ny * ny + nz * nz);
  area[t] = double / 2;
  if (double === 0) return 0;
  const step = normalSteps / double;
  const key = Math.round(nx * step) * 4096 + Math.round(ny * step) * 64 + Math.round(nz * step);
  return key | 0;
}

/** Points by number: an open-addressed table of five integers per point, without garbage. */
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
    const k = 5 * this.count;
    this.keys[k] = x;
    this.keys[k + 1] = y;
    this.keys[k + 2] = z;
    this.keys[k + 3] = direction;
    this.keys[k + 4] = surface;
    return this.count++;
  }
}

/** `pointOf` for each of the 3 n corners, the number of points, and each triangle's area. */
export function weld({ triangles, corners, surfaces }) {
  const table = new PointTable(3 * triangles);
  const pointOf = new Uint32Array(3 * triangles);
  const area = new Float32Array(triangles);
  const grid = (at) => Math.round(corners[at] * perMetre) | 0;
  for (let t = 0; t < triangles; ++t) {
    const direction = facing(corners, 9 * t, area, t);
    for (let i = 3 * t; i < 3 * t + 3; ++i)
      pointOf[i] =
        table.find(grid(3 * i), grid(3 * i + 1), grid(3 * i + 2), direction, surfaces[t] | 0);
  }
  return { pointOf, area, points: table.count, weight: weights(pointOf, area, table.count) };
}

/** One over the area that belongs to a point. */
function weights(pointOf, area, points) {
  const weight = new Float32Array(points);
  for (let i = 0; i < pointOf.length; ++i) weight[pointOf[i]] += area[(i / 3) | 0];
  return weight.map((sum) => (sum > 0 ? 1 / sum : 0));
}

/** Coordinates of points, three numbers each: those of the last corner there. */
export function placesOf({ pointOf, points }, corners) {
  const places = new Float32Array(3 * points);
  for (let i = 0; i < pointOf.length; ++i)
    for (let k = 0; k < 3; ++k) places[3 * pointOf[i] + k] = corners[3 * i + k];
  return places;
}

/** Light of points from light of triangles, weighted by area; both eight numbers each. */
export function smooth(sum, { pointOf, area, points, weight }, out) {
  out.fill(0, 0, 8 * points);
  for (let i = 0; i < pointOf.length; ++i) {
    const t = (i / 3) | 0;
    const share = area[t] * weight[pointOf[i]];
    const from = 8 * t;
    const to = 8 * pointOf[i];
    for (let k = 0; k < 8; ++k) out[to + k] += share * sum[from + k];
  }
}
