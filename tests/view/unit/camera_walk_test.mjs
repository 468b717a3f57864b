import assert from 'node:assert/strict';
import { test } from 'node:test';
import { decodeFrame } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { Building } from '../../../actors/apps/view/page/src/walk/building.js';
import { CameraWalk } from '../../../actors/apps/view/page/src/walk/camera_walk.js';
import { geometryFrame } from '../mock_room.mjs';

const scene = {
  low: [0, 0, 0], high: [11, 6, 3], cameras: [],
  observers: [{ eye: [2, 3, 1.65], gaze: [1, 0, 0] }],
};

function walking() {
  const told = { moved: 0, stood: 0, looks: 0, walls: null };
  const picture = {
    width: 1600, height: 1000,
    marks: {
      setWalls: (walls) => (told.walls = walls),
      backdrops: { cutAt: (height) => (told.cut = height) },
    },
    look: () => (told.looks += 1),
  };
  const walk = new CameraWalk(picture, { moved: () => ++told.moved, stood: () => ++told.stood });
  walk.start(scene);
  walk.enter(new Building(decodeFrame(geometryFrame(1))));
  return { walk, told };
}

test('the first scene places the camera, later ones leave it there', () => {
  const { walk } = walking();
  assert.deepEqual(walk.motion.eye, [2, 3, 1.65]);
  walk.go([0.5, 0, 0]);
  walk.start(scene);
  assert.ok(Math.abs(walk.motion.eye[0] - 2.5) < 1e-6);
});

test('a wall stops the walk unless collisions are off', () => {
  const { walk } = walking();
  for (let i = 0; i < 100; ++i) walk.go([-0.1, 0, 0]);
  assert.ok(walk.motion.eye[0] > 0.1);
  walk.solid = false;
  for (let i = 0; i < 100; ++i) walk.go([-0.1, 0, 0]);
  assert.ok(walk.motion.eye[0] < -5);
});

test('a move counts until it is shown, however long pictures take', (context) => {
  let now = 1000;
  context.mock.method(performance, 'now', () => now);
  const { walk } = walking();
  walk.show();
  walk.look(0.1, 0);
  now += 5000;
  assert.ok(walk.moving);
  walk.show();
  assert.ok(!walk.moving);
});

test('the picture is drawn again once after each change, and not without one', () => {
  const { walk, told } = walking();
  walk.show();
  assert.equal(told.looks, 1);
  walk.show();
  assert.equal(told.looks, 1);
  walk.goOn({ forward: 0, side: 0, turn: 0, tilt: 0 }, 0.1);
  walk.show();
  assert.equal(told.looks, 1);
  walk.goOn({ forward: 1, side: 0, turn: 0, tilt: 0 }, 0.1);
  walk.show();
  assert.equal(told.looks, 2);
});

test('plan and orbit cut the building, and plan shifts where walking turns', () => {
  const { walk, told } = walking();
  assert.equal(walk.cut, null);
  walk.setMode('plan');
  walk.setCut(1);
  assert.equal(walk.cut, 1);
  assert.ok(told.walls.length > 0);
  let shifted = 0;
  walk.look(1, 0, () => ++shifted);
  assert.equal(shifted, 1);
  assert.equal(walk.motion.yaw, 0);
});

test('another eye height moves the eye and not the feet', () => {
  const { walk } = walking();
  walk.setHeight(0.6);
  const [x, y, z] = walk.motion.eye;
  assert.deepEqual([x, y], [2, 3]);
  assert.ok(Math.abs(z - 0.6) < 1e-6);
});
