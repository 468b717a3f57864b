import assert from 'node:assert/strict';
import { test } from 'node:test';
import { smokeSum, surfaceSum } from '../../../actors/apps/view/page/src/light/sum.js';
import { placesOf, smooth, weld } from '../../../actors/apps/view/page/src/light/weld.js';
import { erfc, normals } from '../../../actors/apps/view/page/src/draw/flame_shape.js';
import { atlasOf } from '../../../actors/apps/view/page/src/draw/flames.js';
import { toHalf } from '../../../actors/apps/view/page/src/protocol/half.js';

const halves = (...values) => Uint16Array.from(values, toHalf);

test('light is the sum over groups of factor times light', () => {
  const sum = surfaceSum(1);
  sum.set(0, halves(1, 2, 3, 40, 4, 5, 6, 60), 1);
  sum.set(1, halves(10, 10, 10, 100, 0, 0, 0, 0), 0.5);
  assert.deepEqual([...sum.sum], [6, 7, 8, 90, 4, 5, 6, 60]);
  sum.dim(0, 0);
  assert.deepEqual([...sum.sum], [5, 5, 5, 50, 0, 0, 0, 0]);
  sum.set(1, halves(2, 2, 2, 20, 0, 0, 0, 0), 0.5);
  assert.deepEqual([...sum.sum], [1, 1, 1, 10, 0, 0, 0, 0]);
});

test('newer light of a group replaces its older light', () => {
  const sum = smokeSum(1);
  sum.set(3, halves(1, 1, 1, 2, 2, 2), 2);
  sum.set(3, halves(4, 4, 4, 8, 8, 8), 2);
  assert.deepEqual([...sum.sum], [8, 8, 8, 0, 16, 16, 16, 0]);
});

test('recomputing the sum leaves no rounding errors of bright light', () => {
  const sum = smokeSum(1);
  sum.set(0, halves(60000, 60000, 60000), 1);
  sum.set(1, halves(1e-4, 1e-4, 1e-4), 1);
  for (let i = 0; i < 50; ++i) sum.dim(0, i * 0.137);
  sum.dim(0, 0);
  assert.equal(sum.settle(1), false);
  assert.equal(sum.settle(1), true);
  assert.ok(Math.abs(sum.sum[0] / 1e-4 - 1) < 1e-3);
  assert.equal(sum.rounded, false);
});

test('light that changes while the sum is recomputed is not lost', () => {
  const sum = smokeSum(1);
  sum.set(0, halves(1, 1, 1), 1);
  sum.set(1, halves(2, 2, 2), 1);
  sum.dim(0, 0.5);
  sum.settle(1);
  sum.dim(0, 0.25);
  sum.settle(1);
  sum.set(2, halves(8, 8, 8), 1);
  sum.settle();
  assert.deepEqual([...sum.sum], [10.25, 10.25, 10.25, 0, 0, 0, 0, 0]);
});

test('dimming a group without light, or to its present value, changes nothing', () => {
  const sum = smokeSum(1);
  sum.set(0, halves(1, 1, 1), 1);
  assert.equal(sum.dim(0, 1), false);
  assert.equal(sum.dim(9, 0.5), false);
});

test('dimming one of thirty-two groups of 120 000 triangles prints its time', () => {
  const sum = surfaceSum(120_000);
  const light = new Uint16Array(sum.length).fill(toHalf(1));
  for (let g = 0; g < 32; ++g) sum.set(g, light, 1);
  const start = performance.now();
  sum.dim(7, 0.25);
  console.log(`one group of 120 000 triangles: ${(performance.now() - start).toFixed(1)} ms`);
  assert.equal(sum.sum[0], 31.25);
});

test('flames share one texture, each with dark layers above and below', () => {
  const flames = [{ count: [2, 1, 2], size: [1, 0.5, 2], cells: Uint8Array.of(1, 2, 3, 0) },
    { count: [1, 2, 1], size: [1, 1, 1], cells: Uint8Array.of(5, 6) }];
  const { size, bytes, parts } = atlasOf(flames);
  assert.deepEqual(size, [2, 2, 7]);
  const at = (x, y, z) => bytes[2 * ((z * 2 + y) * 2 + x)];
  assert.deepEqual([at(0, 0, 1), at(1, 0, 1), at(0, 0, 2), at(1, 0, 2)], [1, 2, 3, 0]);
  assert.deepEqual([at(0, 0, 5), at(0, 1, 5)], [5, 6]);
  assert.equal(bytes.filter((_, i) => i % 2 === 0).reduce((sum, byte) => sum + byte), 17);
  assert.deepEqual(parts[1], { offset: [0, 0, 5 / 7], scale: [0.5, 1, 1 / 7] });
  assert.deepEqual(atlasOf([]).size, [1, 1, 1]);
  // Beside the glow stands the radius of a disc as large as what glows, over the wider side.
  const radius = (x, z) => bytes[2 * (z * 2 * 2 + x) + 1];
  assert.equal(radius(0, 1), Math.round(255 * Math.sqrt(0.5 / Math.PI)));
  assert.equal(radius(0, 2), Math.round(255 * Math.sqrt(0.25 / Math.PI)));
});

test('values of the lattice of flames are standard normal', () => {
  const values = normals();
  const mean = (of) => values.reduce((sum, v) => sum + of(v), 0) / values.length;
  assert.ok(Math.abs(mean((v) => v)) < 1e-6);
  assert.ok(Math.abs(mean((v) => v * v) - 1) < 1e-6);
  assert.ok(Math.abs(mean((v) => v ** 4) - 3) < 0.03);
  assert.ok(Math.abs(erfc(0.5) - 0.4795001) < 2e-7 && Math.abs(erfc(-1) - 1.8427008) < 2e-7);
});

const square = {
  triangles: 2,
  corners: Float32Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0),
  surfaces: Uint32Array.of(0, 0),
};

test('triangles of one flat surface share their points', () => {
  const { points, pointOf, area } = weld(square);
  assert.equal(points, 4);
  assert.equal(pointOf[0], pointOf[3]);
  assert.deepEqual([...area], [0.5, 0.5]);
});

test('points have the coordinates of their corners', () => {
  const welded = weld(square);
  const places = placesOf(welded, square.corners);
  assert.equal(places.length, 3 * 4);
  welded.pointOf.forEach((point, i) => assert.deepEqual(
    [...places.subarray(3 * point, 3 * point + 3)],
    [...square.corners.subarray(3 * i, 3 * i + 3)]));
});

test('another surface or another plane has its own points', () => {
  assert.equal(weld({ ...square, surfaces: Uint32Array.of(0, 1) }).points, 6);
  const corners = Float32Array.from(square.corners);
  corners[17] = 1;
  assert.equal(weld({ ...square, corners }).points, 6);
});

test('uniform light stays uniform when smoothed, and shared points take the mean by area', () => {
  const welded = weld(square);
  const out = new Float32Array(8 * welded.points);
  smooth(Float32Array.of(2, 2, 2, 20, 1, 1, 1, 0, 4, 4, 4, 40, 1, 1, 1, 0), welded, out);
  assert.equal(out[8 * welded.pointOf[0]], 3);
  assert.equal(out[8 * welded.pointOf[1]], 2);
  assert.equal(out[8 * welded.pointOf[5]], 4);
  assert.equal(out[8 * welded.pointOf[0] + 3], 30);
  for (let p = 0; p < welded.points; ++p) assert.equal(out[8 * p + 4], 1);
});
