// Luminous faces of lamps as triangles with outward normals. Pure.
import { add, cross, scale, subtract, unit } from '../walk/vectors.js';

const around = 24;
const alongSphere = 8;

class Faces {
  positions = [];
  normals = [];

  /** Corners counter-clockwise, seen from outside. */
  triangle(corners, normals) {
    this.positions.push(...corners.flat());
    this.normals.push(...normals.flat());
  }

  quad([a, b, c, d], [na, nb, nc, nd]) {
    this.triangle([a, b, c], [na, nb, nc]);
    this.triangle([a, c, d], [na, nc, nd]);
  }
}

const turn = (i) => (2 * Math.PI * i) / around;
const same = (normal, count) => Array(count).fill(normal);

/** A point given by its shares along the axes. */
const placed = ({ position, axes }, x, y, z) =>
  add(add(position, scale(axes[0], x)), add(scale(axes[1], y), scale(axes[2], z)));
const directed = ({ axes }, x, y, z) =>
  add(scale(axes[0], x), add(scale(axes[1], y), scale(axes[2], z)));

const shapes = {
  rectangle(lamp, faces) {
    const [x, y] = lamp.size.map((s) => s / 2);
    const down = scale(lamp.axes[2], -1);
    faces.quad([placed(lamp, -x, -y, 0), placed(lamp, -x, y, 0), placed(lamp, x, y, 0),
      placed(lamp, x, -y, 0)], same(down, 4));
  },
  disc(lamp, faces) {
    const r = lamp.size[0] / 2;
    const down = scale(lamp.axes[2], -1);
    const rim = (i) => placed(lamp, r * Math.cos(turn(i)), r * Math.sin(turn(i)), 0);
    for (let i = 0; i < around; ++i)
      faces.triangle([lamp.position, rim(i + 1), rim(i)], same(down, 3));
  },
  sphere(lamp, faces) {
    const r = lamp.size[0] / 2;
    const normal = (i, j) => {
      const polar = (Math.PI * j) / alongSphere;
      const across = Math.sin(polar);
      return directed(lamp, across * Math.cos(turn(i)), across * Math.sin(turn(i)),
        Math.cos(polar));
    };
    const at = (i, j) => add(lamp.position, scale(normal(i, j), r));
    for (let j = 0; j < alongSphere; ++j)
      for (let i = 0; i < around; ++i) {
        const corners = [[i, j], [i, j + 1], [i + 1, j + 1], [i + 1, j]];
        faces.quad(corners.map((c) => at(...c)), corners.map((c) => normal(...c)));
      }
  },
  tube(lamp, faces) {
    const x = lamp.size[0] / 2;
    const r = lamp.size[1] / 2;
    const at = (i, end) => placed(lamp, end, r * Math.cos(turn(i)), r * Math.sin(turn(i)));
    const normal = (i) => directed(lamp, 0, Math.cos(turn(i)), Math.sin(turn(i)));
    for (let i = 0; i < around; ++i)
      faces.quad([at(i, -x), at(i, x), at(i + 1, x), at(i + 1, -x)].reverse(),
        [normal(i), normal(i), normal(i + 1), normal(i + 1)].reverse());
  },
  mesh(lamp, faces) {
    for (let k = 0; k + 2 < lamp.corners.length; k += 3) {
      const [a, b, c] = lamp.corners.slice(k, k + 3);
      faces.triangle([a, b, c], same(unit(cross(subtract(b, a), subtract(c, a))), 3));
    }
  },
};

/** Flat faces may shine to both sides, as their table states. */
export const isFlat = ({ shape }) => shape === 'rectangle' || shape === 'disc';

/** `positions` and `normals`, nine numbers per triangle. */
export function facesOf(lamp) {
  const faces = new Faces();
  shapes[lamp.shape](lamp, faces);
  return faces;
}
