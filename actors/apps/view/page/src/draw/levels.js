// Finds level glossy floors, and the view from behind one of them. Pure.
import { add, dot, length, subtract, unit } from '../walk/vectors.js';

/** A floor is level if its normal deviates from the vertical by less than this. */
const levelMost = 1e-3;
const perMetre = 1000;
/** Nearer patches are treated as this far away. */
const nearest_m = 0.5;
/** Height range searched above a floor: from its own rounding up to the height of any room [m]. */
const leastOver_m = 1e-3;
const highest_m = 100;

/** Twice a triangle's area, along its normal. */
function doubleArea(c, k) {
  const [ux, uy, uz] = [c[k + 3] - c[k], c[k + 4] - c[k + 1], c[k + 5] - c[k + 2]];
  const [vx, vy, vz] = [c[k + 6] - c[k], c[k + 7] - c[k + 1], c[k + 8] - c[k + 2]];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}

/** Whether a floor's back, seen from above, is inside a body: then another back is above it. */
function isInside(middle, building) {
  const over = building.ahead(add(middle, [0, 0, leastOver_m]), [0, 0, 1], highest_m);
  return over !== null && building.normal(over.triangle)[2] > 0;
}

/** Whether two lists of glossy sides are equal. */
export function isSameGloss(one, other) {
  const sameSide = (a, b) => a.surface === b.surface && a.back === b.back &&
    a.spread === b.spread && a.roughness === b.roughness &&
    a.mirrored.every((share, k) => share === b.mirrored[k]);
  return other?.length === one.length && one.every((side, i) => sameSide(side, other[i]));
}

/**
 * The glossy floors of a building by height: `parts`, the corners of each kind of gloss; `patches`,
 * a centre and an area for each triangle.
 */
export function levelsOf(building, surfaces, gloss) {
  if (!gloss.length) return [];
  const { triangles, corners } = building;
  const kinds = new Map(gloss.map((one) => [`${one.surface} ${one.back}`, one]));
  const levels = new Map();
  for (let t = 0; t < triangles; ++t) {
    const k = 9 * t;
    const [x, y, z] = doubleArea(corners, k);
    const size = Math.hypot(x, y, z);
    if (!(size > 0) || Math.hypot(x, y) > levelMost * size) continue;
    const kind = kinds.get(`${surfaces[t]} ${z < 0}`);
    if (!kind) continue;
    const middle = [k, k + 1, k + 2].map((a) => (corners[a] + corners[a + 3] + corners[a + 6]) / 3);
    if (kind.back && isInside(middle, building)) continue;
    const key = Math.round(corners[k + 2] * perMetre);
    if (!levels.has(key))
      levels.set(key, { height: corners[k + 2], parts: new Map(), patches: [] });
    const level = levels.get(key);
    if (!level.parts.has(kind)) level.parts.set(kind, []);
    level.parts.get(kind).push(...corners.subarray(k, k + 9));
    level.patches.push({ middle, area: size / 2 });
  }
  return [...levels.values()];
}

/** Approximate solid angle of a level in a view, ignoring walls. */
export function seenOf({ height, patches }, { eye, target, fov }, aspect) {
  if (eye[2] <= height) return 0;
  const ahead = unit(subtract(target, eye));
  const up = Math.tan((fov * Math.PI) / 360);
  const least = 1 / Math.hypot(1, up, up * aspect);
  let sum = 0;
  for (const { middle, area } of patches) {
    const to = subtract(middle, eye);
    const far = length(to);
    // A patch may extend into the view even if its centre is outside.
    if (dot(to, ahead) < least * far - Math.sqrt(area)) continue;
    sum += (area * (eye[2] - height)) / Math.max(far, nearest_m) ** 3;
  }
  return sum;
}

/** The level that fills most of a view, or null. */
export function levelIn(levels, view, aspect) {
  let best = null;
  let most = 0;
  for (const level of levels) {
    const seen = seenOf(level, view, aspect);
    if (seen > most) [best, most] = [level, seen];
  }
  return best;
}

/** The view from behind a level mirror. Left and right are swapped in its picture. */
export function mirrored({ eye, target, up, fov }, height) {
  const below = ([x, y, z]) => [x, y, 2 * height - z];
  return { eye: below(eye), target: below(target), up: [up[0], up[1], -up[2]], fov };
}
