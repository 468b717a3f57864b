// Sums light by group: shown is the sum over groups of factor x light, on surfaces and in smoke. A
// changed factor adds (new - old) of that group only; since rounding errors of bright light remain
// when it is dimmed to nothing, the sum is recomputed once the sliders are still.
import { halfValues } from '../protocol/half.js';

/** `triples` of numbers in each cell; the sum adds a fourth number each, for textures. */
export class LightSum {
  constructor(cells, triples) {
    this.cells = cells;
    /** The required length of a group's light. */
    this.length = 3 * triples * cells;
    this.sum = new Float32Array(4 * triples * cells);
    this.groups = new Map();
    this.stained(false);
  }

  /** `white`: a white surface in the group's light; null in smoke. */
  set(group, halves, factor, white = null) {
    const old = this.groups.get(group);
    this.groups.set(group, { halves, factor, white });
    if (old) this.exchange(old, halves, factor);
    else this.add(halves, factor);
    this.afresh = null;
  }

  /** Returns true if the sum has changed. */
  dim(group, factor) {
    const entry = this.groups.get(group);
    if (!entry || entry.factor === factor) return false;
    this.add(entry.halves, factor - entry.factor);
    entry.factor = factor;
    this.stained(true);
    return true;
  }

  /**
   * Continues to recompute the sum without rounding errors, by at most this many groups; true when
   * it is complete. Light that changes meanwhile restarts it.
   */
  settle(most = Infinity) {
    if (!this.rounded) return true;
    this.afresh ??= { sum: new Float32Array(this.sum.length), left: [...this.groups.values()] };
    const { sum, left } = this.afresh;
    for (const { halves, factor } of left.splice(0, most)) this.add(halves, factor, sum);
    if (left.length) return false;
    this.sum = sum;
    this.stained(false);
    return true;
  }

  stained(rounded) {
    this.rounded = rounded;
    this.afresh = null;
  }

  add(halves, weight, sum = this.sum) {
    if (weight === 0) return;
    for (let from = 0, to = 0; from < halves.length; from += 3, to += 4) {
      sum[to] += weight * halfValues[halves[from]];
      sum[to + 1] += weight * halfValues[halves[from + 1]];
      sum[to + 2] += weight * halfValues[halves[from + 2]];
    }
  }

  exchange({ halves: before, factor: weightBefore }, halves, weight) {
    const { sum } = this;
    const change = (from) =>
      weight * halfValues[halves[from]] - weightBefore * halfValues[before[from]];
    for (let from = 0, to = 0; from < halves.length; from += 3, to += 4) {
      sum[to] += change(from);
      sum[to + 1] += change(from + 1);
      sum[to + 2] += change(from + 2);
    }
    this.stained(true);
  }
}

/** A triangle: front r g b and a fourth, back r g b and a fourth: two texels of a texture. */
export const surfaceSum = (triangles) => new LightSum(triangles, 2);

/** A voxel: r g b and a fourth; then x y z, along the light that it scatters, and a fourth. */
export const smokeSum = (voxels) => new LightSum(voxels, 2);
