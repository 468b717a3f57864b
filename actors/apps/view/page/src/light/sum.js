// Sums light by group: shown is the sum over groups of factor x light, on surfaces and in smoke. A
// changed factor adds (new - old) of that group only; since rounding errors of bright light remain
// when it is dimmed to nothing, the sum is recomputed once the sliders are still.
import { halfValues } from '../protocol/half.js';

/** Each cell has some texels of three or four numbers; the sum has four, as textures need. */
export class LightSum {
  constructor(cells, texels, numbers = 3) {
    Object.assign(this, { cells, numbers });
    /** The required length of a group's light. */
    this.length = numbers * texels * cells;
    this.sum = new Float32Array(4 * texels * cells);
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
    const { numbers } = this;
    for (let from = 0, to = 0; from < halves.length; from += numbers, to += 4) {
      sum[to] += weight * halfValues[halves[from]];
      sum[to + 1] += weight * halfValues[halves[from + 1]];
      sum[to + 2] += weight * halfValues[halves[from + 2]];
      if (numbers === 4) sum[to + 3] += weight * halfValues[halves[from + 3]];
    }
  }

  exchange({ halves: before, factor: weightBefore }, halves, weight) {
    const { sum, numbers } = this;
    const change = (from) =>
      weight * halfValues[halves[from]] - weightBefore * halfValues[before[from]];
    for (let from = 0, to = 0; from < halves.length; from += numbers, to += 4) {
      sum[to] += change(from);
      sum[to + 1] += change(from + 1);
      sum[to + 2] += change(from + 2);
      if (numbers === 4) sum[to + 3] += change(from + 3);
    }
    this.stained(true);
  }
}

/** A triangle: r g b and illuminance of the front, then of the back: two texels of a texture. */
export const surfaceSum = (triangles) => new LightSum(triangles, 2, 4);

/** A voxel: r g b and a fourth; then x y z, along the light that it scatters, and a fourth. */
export const smokeSum = (voxels) => new LightSum(voxels, 2);
