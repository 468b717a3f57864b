import assert from 'node:assert/strict';
import { test } from 'node:test';
import { facesOf } from '../../../actors/apps/view/page/src/draw/lamp_faces.js';
import { isSameGloss, levelIn, levelsOf, mirrored, seenOf }
  from '../../../actors/apps/view/page/src/draw/levels.js';
import { Building } from '../../../actors/apps/view/page/src/walk/building.js';
import { cross, dot, length, subtract } from '../../../actors/apps/view/page/src/walk/vectors.js';

/** A square of two triangles, front up if `up`. */
function square(x, y, z, size, up = true) {
  const [a, b, c, d] = [[x, y, z], [x + size, y, z], [x + size, y + size, z], [x, y + size, z]];
  return up ? [a, b, c, a, c, d] : [a, c, b, a, d, c];
}
const building = (...parts) => {
  const corners = Float32Array.from(parts.flatMap(({ points }) => points.flat()));
  const surfaces = Uint32Array.from(parts.flatMap(({ points, surface }) =>
    Array(points.length / 3).fill(surface)));
  return [new Building({ triangles: surfaces.length, corners }), surfaces];
};
const gloss = (surface, back = false) =>
  ({ surface, back, mirrored: [0.1, 0.1, 0.1], spread: 0.5, roughness: 0.1 });

test('a glossy floor is a level, a glossy wall and a matt floor are not', () => {
  const wall = [[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 0], [0, 2, 2], [0, 0, 2]];
  const scene = building({ points: square(0, 0, 0.5, 4), surface: 0 },
    { points: square(9, 0, 0, 4), surface: 1 }, { points: wall, surface: 0 });
  const [level, ...others] = levelsOf(...scene, [gloss(0)]);
  assert.deepEqual(others, []);
  assert.equal(level.height, 0.5);
  assert.equal(level.patches.reduce((sum, { area }) => sum + area, 0), 16);
  assert.deepEqual([...level.parts.values()].map((corners) => corners.length), [18]);
});

test('gloss is unchanged only if the same sides have it', () => {
  const sides = () => [gloss(0), gloss(3, true)];
  assert.ok(isSameGloss(sides(), sides()));
  assert.ok(isSameGloss([], []));
  assert.ok(!isSameGloss([], undefined));
  assert.ok(!isSameGloss(sides(), sides().slice(1)));
  for (const change of [{ surface: 4 }, { back: false }, { spread: 0.4 }, { roughness: 0.2 },
    { mirrored: [0.1, 0.1, 0.2] }]) {
    const [first, second] = sides();
    assert.ok(!isSameGloss(sides(), [first, { ...second, ...change }]));
  }
});

test('only the side of a floor that faces up counts', () => {
  const scene = building({ points: square(0, 0, 0, 2, false), surface: 7 });
  assert.equal(levelsOf(...scene, [gloss(7)]).length, 0);
  assert.equal(levelsOf(...scene, [gloss(7, true)]).length, 1);
});

test('the inside of a body with glossy sides is not a floor', () => {
  const box = [...square(0, 0, 0, 2, false), ...square(0, 0, 1, 2)];
  const scene = building({ points: box, surface: 3 });
  assert.deepEqual(levelsOf(...scene, [gloss(3), gloss(3, true)]).map(({ height }) => height), [1]);
});

test('with floors of two heights, the one that fills more of the view is used', () => {
  const scene = building({ points: square(2, -1, 0, 2), surface: 0 },
    { points: square(-20, -4, 1, 8), surface: 0 });
  const levels = levelsOf(...scene, [gloss(0)]);
  assert.deepEqual(levels.map(({ height }) => height), [0, 1]);
  const view = (target) => ({ eye: [0, 0, 1.6], target, up: [0, 0, 1], fov: 60 });
  assert.equal(levelIn(levels, view([3, 0, 0]), 1.5).height, 0);
  assert.equal(levelIn(levels, view([-8, 0, 1]), 1.5).height, 1);
  assert.equal(levelIn(levels, view([0, 0, 9]), 1.5), null);
});

test('a level above the eye is not visible', () => {
  const [level] = levelsOf(...building({ points: square(0, 0, 1, 2), surface: 0 }), [gloss(0)]);
  const view = { eye: [1, 1, 0.9], target: [1, 2, 1], up: [0, 0, 1], fov: 60 };
  assert.equal(seenOf(level, view, 1), 0);
});

test('a distant patch fills the solid angle of its area and slant', () => {
  const scene = building({ points: square(9.95, -0.05, 0, 0.1), surface: 0 });
  const [level] = levelsOf(...scene, [gloss(0)]);
  const view = { eye: [0, 0, 2], target: [10, 0, 0], up: [0, 0, 1], fov: 60 };
  const expected = 0.01 * (2 / Math.hypot(10, 2)) / (100 + 4);
  assert.ok(Math.abs(seenOf(level, view, 1) / expected - 1) < 1e-3);
});

test('the mirrored eye sees a thing through the point where a floor reflects it', () => {
  const height = 0.3;
  const view = { eye: [1, 2, 1.7], target: [4, 3, 0.5], up: [0, 0, 1], fov: 50 };
  const behind = mirrored(view, height);
  const thing = [6, 5, 2.6];
  const share = (height - behind.eye[2]) / (thing[2] - behind.eye[2]);
  const mirror = behind.eye.map((x, k) => x + share * (thing[k] - x));
  const [down, up] = [subtract(mirror, view.eye), subtract(thing, mirror)];
  // The angles of incidence and reflection are equal, in one plane.
  assert.ok(Math.abs(down[2] / length(down) + up[2] / length(up)) < 1e-12);
  assert.ok(length(cross([down[0], down[1], 0], [up[0], up[1], 0])) < 1e-12);
  assert.deepEqual([behind.up, behind.fov], [[0, 0, -1], 50]);
});

const axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const lamp = (shape, size, more = {}) =>
  ({ shape, size, axes, position: [1, 2, 3], corners: [], ...more });
const area = { rectangle: 0.5 * 0.2, disc: (Math.PI * 0.25) / 4, sphere: Math.PI * 0.25,
  tube: Math.PI * 0.2 * 0.5, mesh: 0.5 };

for (const shape of Object.keys(area))
  test(`the face of a lamp that is a ${shape} has its area, and faces as its normals do`, () => {
    const size = ['disc', 'sphere'].includes(shape) ? [0.5, 0.5, 0.5] : [0.5, 0.2, 0.2];
    const corners = shape === 'mesh' ? [[0, 0, 0], [1, 0, 0], [0, 1, 0]] : [];
    const { positions, normals } = facesOf(lamp(shape, size, { corners }));
    assert.equal(positions.length, normals.length);
    let sum = 0;
    for (let k = 0; k < positions.length; k += 9) {
      const at = (c) => positions.slice(k + 3 * c, k + 3 * c + 3);
      const n = cross(subtract(at(1), at(0)), subtract(at(2), at(0)));
      sum += length(n) / 2;
      for (let c = 0; c < 3; ++c)
        assert.ok(dot(n, normals.slice(k + 3 * c, k + 3 * c + 3)) >= -1e-12);
      if (shape === 'rectangle' || shape === 'disc') assert.ok(n[2] < 0, 'it looks down');
    }
    assert.ok(sum <= area[shape] * (1 + 1e-9) && sum > 0.93 * area[shape], `${sum}`);
  });
