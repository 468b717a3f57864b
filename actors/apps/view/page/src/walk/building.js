// Collisions with the building, and picking: rays against its triangles. Short rays of feet and
// shoulders use a grid seen from above; the rare long ray of a click tests every triangle.
import { add, cross, dot, length, scale, subtract, unit } from './vectors.js';

const cellsAcrossMost = 256;
const cellLeast_m = 0.5;
const bodyRadius_m = 0.25;
/** Heights above the floor at which a body collides; lower things are stepped over. */
const bodyHeights_m = [0.45, 0.95];
const stepMost_m = 0.45;

export class Building {
  constructor({ triangles, corners }) {
    this.triangles = triangles;
    this.corners = corners;
    this.layGrid();
  }

  /** Distance along the ray to a triangle's plane within its edges, or Infinity. */
  meet(t, o, d) {
    const c = this.corners;
    const k = 9 * t;
    const e1x = c[k + 3] - c[k], e1y = c[k + 4] - c[k + 1], e1z = c[k + 5] - c[k + 2];
    const e2x = c[k + 6] - c[k], e2y = c[k + 7] - c[k + 1], e2z = c[k + 8] - c[k + 2];
    const px = d[1] * e2z - d[2] * e2y;
    const py = d[2] * e2x - d[0] * e2z;
    const pz = d[0] * e2y - d[1] * e2x;
    const det = e1x * px + e1y * py + e1z * pz;
    if (det === 0) return Infinity;
    const sx = o[0] - c[k], sy = o[1] - c[k + 1], sz = o[2] - c[k + 2];
    const u = (sx * px + sy * py + sz * pz) / det;
    if (u < 0 || u > 1) return Infinity;
    const qx = sy * e1z - sz * e1y;
    const qy = sz * e1x - sx * e1z;
    const qz = sx * e1y - sy * e1x;
    const v = (d[0] * qx + d[1] * qy + d[2] * qz) / det;
    if (v < 0 || u + v > 1) return Infinity;
    const distance = (e2x * qx + e2y * qy + e2z * qz) / det;
    return distance > 1e-6 ? distance : Infinity;
  }

  /** The nearest triangle along a ray, ignoring what lies above `cut`; or null. */
  nearest(origin, direction, cut = Infinity) {
    let best = { distance: Infinity, triangle: -1 };
    for (let t = 0; t < this.triangles; ++t) {
      const distance = this.meet(t, origin, direction);
      if (distance < best.distance && origin[2] + distance * direction[2] <= cut)
        best = { distance, triangle: t };
    }
    if (best.triangle < 0) return null;
    const point = add(origin, scale(direction, best.distance));
    const normal = this.normal(best.triangle);
    return { ...best, point, normal, front: dot(normal, direction) < 0 };
  }

  normal(t) {
    const at = (c) => [...this.corners.subarray(9 * t + 3 * c, 9 * t + 3 * c + 3)];
    return unit(cross(subtract(at(1), at(0)), subtract(at(2), at(0))));
  }

  layGrid() {
    const c = this.corners;
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    for (let i = 0; i < c.length; i += 3)
      for (let a = 0; a < 2; ++a) {
        if (c[i + a] < low[a]) low[a] = c[i + a];
        if (c[i + a] > high[a]) high[a] = c[i + a];
      }
    const across = Math.max(high[0] - low[0], high[1] - low[1]);
    this.low = low;
    this.cell = Math.max(cellLeast_m, across / cellsAcrossMost);
    this.count = [0, 1].map((a) => Math.floor((high[a] - low[a]) / this.cell) + 1);
    this.start = new Uint32Array(this.count[0] * this.count[1] + 1);
    this.eachTriangle((cell) => ++this.start[cell + 1]);
    for (let i = 1; i < this.start.length; ++i) this.start[i] += this.start[i - 1];
    this.list = new Uint32Array(this.start.at(-1));
    const filled = this.start.slice();
    this.eachTriangle((cell, t) => (this.list[filled[cell]++] = t));
  }

  eachTriangle(visit) {
    const c = this.corners;
    for (let t = 0; t < this.triangles; ++t) {
      const k = 9 * t;
      this.eachCell(
        Math.min(c[k], c[k + 3], c[k + 6]), Math.min(c[k + 1], c[k + 4], c[k + 7]),
        Math.max(c[k], c[k + 3], c[k + 6]), Math.max(c[k + 1], c[k + 4], c[k + 7]), visit, t);
    }
  }

  column(x, axis) {
    const cell = Math.floor((x - this.low[axis]) / this.cell);
    return Math.min(this.count[axis] - 1, Math.max(0, cell));
  }

  /** Calls `visit(cell, t)` for the cells of a horizontal rectangle. */
  eachCell(lowX, lowY, highX, highY, visit, t) {
    const x0 = this.column(lowX, 0);
    const x1 = this.column(highX, 0);
    const y1 = this.column(highY, 1);
    for (let y = this.column(lowY, 1); y <= y1; ++y)
      for (let x = x0; x <= x1; ++x) visit(y * this.count[0] + x, t);
  }

  /** The first triangle within `reach` metres along a unit direction; for short rays. */
  ahead(origin, direction, reach) {
    const end = add(origin, scale(direction, reach));
    let best = { distance: reach, triangle: -1 };
    const visit = (cell) => {
      for (let i = this.start[cell]; i < this.start[cell + 1]; ++i) {
        const distance = this.meet(this.list[i], origin, direction);
        if (distance < best.distance) best = { distance, triangle: this.list[i] };
      }
    };
    this.eachCell(Math.min(origin[0], end[0]), Math.min(origin[1], end[1]),
      Math.max(origin[0], end[0]), Math.max(origin[1], end[1]), visit);
    return best.triangle < 0 ? null : best;
  }

  /** Height of the floor under a point, or null if there is none within ten metres. */
  floorUnder(point) {
    const hit = this.ahead(point, [0, 0, -1], 10);
    return hit && point[2] - hit.distance;
  }

  /** The eye's position after a step: it slides along walls and follows the floor. */
  walk(eye, height, step, solid = true) {
    const allowed = solid ? this.slide(eye, height, step) : step;
    const moved = add(eye, allowed);
    const floor = this.floorUnder(moved);
    if (floor === null) return moved;
    const rise = floor - (moved[2] - height);
    if (solid && rise > stepMost_m) return eye;
    return [moved[0], moved[1], floor + height];
  }

  slide(eye, height, step) {
    const feet = eye[2] - height;
    const levels = bodyHeights_m.map((h) => feet + h).filter((z) => z < eye[2]);
    let left = step;
    for (let tries = 0; tries < 3; ++tries) {
      const size = length(left);
      if (size < 1e-6) return [0, 0, 0];
      const wall = this.wallBefore(eye, [...levels, eye[2]], scale(left, 1 / size), size);
      if (!wall) return left;
      left = subtract(left, scale(wall, dot(left, wall)));
    }
    return [0, 0, 0];
  }

  /** The horizontal normal of what the body would touch, or null. */
  wallBefore(eye, levels, direction, size) {
    for (const z of levels) {
      const hit = this.ahead([eye[0], eye[1], z], direction, size + 3 * bodyRadius_m);
      if (!hit) continue;
      const [x, y] = this.normal(hit.triangle);
      if (Math.hypot(x, y) < 0.3) continue;
      const wall = unit([x, y, 0]);
      const straight = Math.abs(dot(direction, wall));
      if ((hit.distance - size) * straight < bodyRadius_m) return wall;
    }
    return null;
  }

  /** Line segments at which a height cuts the building: the walls of a plan. */
  section(height) {
    const lines = [];
    const c = this.corners;
    for (let k = 0; k < c.length; k += 9) {
      const above = (c[k + 2] >= height) + (c[k + 5] >= height) + (c[k + 8] >= height);
      if (above === 1 || above === 2) this.cutTriangle(k, height, lines);
    }
    return new Float32Array(lines);
  }

  cutTriangle(k, height, lines) {
    const c = this.corners;
    for (let e = 0; e < 3; ++e) {
      const a = k + 3 * e;
      const b = k + 3 * ((e + 1) % 3);
      if (c[a + 2] >= height === c[b + 2] >= height) continue;
      const s = (height - c[a + 2]) / (c[b + 2] - c[a + 2]);
      lines.push(c[a] + s * (c[b] - c[a]), c[a + 1] + s * (c[b + 1] - c[a + 1]), height);
    }
  }
}
