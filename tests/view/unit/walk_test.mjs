import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Building } from '../../../actors/apps/view/page/src/walk/building.js';
import { gazeOf, rayThrough, speeds, stand, startMotion, stride, turn, viewOf, zoom }
  from '../../../actors/apps/view/page/src/walk/motion.js';
import { geometryFrame } from '../mock_room.mjs';
import { decodeFrame } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';

const near = (a, b, most = 1e-6) =>
  a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) < most, `${a} is not ${b}`));
const keys = (changes) => ({ forward: 0, side: 0, turn: 0, fast: false, ...changes });
const start = () => startMotion([0, 0, 0], [10, 6, 3]);

test('forward is the direction of the gaze, right is to its right', () => {
  const motion = start();
  near(stride(motion, keys({ forward: 1 }), 1), [speeds.walk, 0, 0]);
  near(stride(motion, keys({ side: 1 }), 1), [0, -speeds.walk, 0]);
  turn(motion, Math.PI / 2, 0.5);
  near(stride(motion, keys({ forward: 1 }), 0.5), [0, speeds.walk / 2, 0]);
});

test('walking diagonally is no faster, looking up is no slower', () => {
  const motion = start();
  turn(motion, 0.3, 1);
  const step = stride(motion, keys({ forward: 1, side: -1 }), 1);
  assert.ok(Math.abs(Math.hypot(...step) - speeds.walk) < 1e-9);
  assert.equal(step[2], 0);
});

test('an eye placed somewhere looks at its target', () => {
  const motion = start();
  stand(motion, [1, 1, 2], [4, 5, 2], 50, 0);
  near(gazeOf(motion), [0.6, 0.8, 0]);
  assert.equal(motion.height, 2);
  assert.equal(viewOf(motion).fov, 50);
});

test('the view never turns upside down, and the angle of view is limited', () => {
  const motion = start();
  turn(motion, 0, 9);
  assert.ok(motion.pitch < Math.PI / 2);
  for (let i = 0; i < 99; ++i) zoom(motion, 0.8);
  assert.ok(motion.fov >= 15);
});

test('the ray through the centre is the gaze, in every mode', () => {
  for (const mode of ['walk', 'orbit', 'plan']) {
    const motion = start();
    motion.mode = mode;
    const view = viewOf(motion);
    const { direction } = rayThrough(view, 1.6, 0, 0);
    const gaze = view.target.map((x, i) => x - view.eye[i]);
    near(direction, gaze.map((x) => x / Math.hypot(...gaze)));
  }
});

test('in plan the ray through the right edge starts half a width to the right', () => {
  const motion = start();
  motion.mode = 'plan';
  const { origin } = rayThrough(viewOf(motion), 2, 1, 0);
  assert.ok(Math.abs(origin[0] - (motion.plan.centre[0] + motion.plan.span)) < 1e-9);
});

const building = () => new Building(decodeFrame(geometryFrame(1)));

test('a wall blocks, a doorway lets through, the floor supports', () => {
  const b = building();
  const through = (y) => {
    let eye = [5.5, y, 1.65];
    for (let i = 0; i < 40; ++i) eye = b.walk(eye, 1.65, [0.05, 0, 0]);
    return eye;
  };
  assert.ok(through(1)[0] < 6.3);
  near(through(2.9), [7.5, 2.9, 1.65], 1e-3);
});

test('a step against a wall slides along it', () => {
  const b = building();
  let eye = [6.1, 1, 1.65];
  for (let i = 0; i < 20; ++i) eye = b.walk(eye, 1.65, [0.03, 0.03, 0]);
  assert.ok(eye[0] < 6.3 && eye[1] > 1.4, String(eye));
});

test('the walker does not climb a table', () => {
  const b = building();
  let eye = [2.4, 3.6, 1.65];
  for (let i = 0; i < 40; ++i) eye = b.walk(eye, 1.65, [0, 0.05, 0]);
  assert.ok(Math.abs(eye[2] - 1.65) < 1e-3 && eye[1] < 4.3);
});

test('a click finds the nearest triangle and its side', () => {
  const hit = building().nearest([1, 1, 1], [0, 0, -1]);
  assert.ok(Math.abs(hit.distance - 1) < 1e-5 && hit.front);
  near(hit.point, [1, 1, 0], 1e-5);
  assert.equal(building().nearest([1, 1, -1], [0, 0, -1]), null);
});

test('a section at table height shows walls all around', () => {
  const lines = building().section(1.2);
  assert.equal(lines.length % 6, 0);
  const xs = lines.filter((_, i) => i % 3 === 0);
  near([Math.min(...xs), Math.max(...xs)], [0, 11], 1e-5);
});
