// Light kept by group: what is shown is the sum over groups of factor x light, on surfaces and in
// smoke alike. A changed factor adds (new - old) of that group alone; since rounding of what was
// bright stays behind when it is dimmed to nothing, the sum is made afresh once hands are still.
import { halfValues } from '../protocol/half.js';

/** `stride` numbers a cell in the sum for every `taken` numbers of a group's light. */
export class LightSum {
  constructor(cells, { taken, places, stride }) {
    Object.assign(this, { cells, taken, places, stride });
    this.sum = new Float32Array(cells * stride);
    this.groups = new Map();
    this.rounded = false;
  }

  /** The length that a group's light has to have. */
  get length() {
    return this.cells * this.taken;
  }

  set(group, halves, factor) {
    const old = this.groups.get(group);
    if (old) this.add(old.halves, -old.factor);
    this.groups.set(group, { halves, factor });
    this.add(halves, factor);
    this.rounded ||= old !== undefined;
  }

  /** True when the sum has changed. */
  dim(group, factor) {
    const entry = this.groups.get(group);
    if (!entry || entry.factor === factor) return false;
    this.add(entry.halves, factor - entry.factor);
    entry.factor = factor;
    this.rounded = true;
    return true;
  }

  /** The sum without what rounding left in it; true when there was something to do. */
  settle() {
    if (!this.rounded) return false;
    this.sum.fill(0);
    for (const { halves, factor } of this.groups.values()) this.add(halves, factor);
    this.rounded = false;
    return true;
  }

  add(halves, weight) {
    if (weight === 0) return;
    const { sum, places, taken, stride } = this;
    for (let k = 0; k < taken; ++k)
      for (let from = k, to = places[k]; from < halves.length; from += taken, to += stride)
        sum[to] += weight * halfValues[halves[from]];
  }
}

/** A triangle: front r g b and a fourth, back r g b and a fourth: two texels of a texture. */
export const surfaceSum = (triangles) =>
  new LightSum(triangles, { taken: 6, places: [0, 1, 2, 4, 5, 6], stride: 8 });

/** A voxel: r g b and a fourth. */
export const smokeSum = (voxels) =>
  new LightSum(voxels, { taken: 3, places: [0, 1, 2], stride: 4 });
