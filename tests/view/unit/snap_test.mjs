import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Mover } from '../../../actors/apps/view/page/src/edit/mover.js';
import { axesOf, snapped } from '../../../actors/apps/view/page/src/edit/snap.js';

const near = (a, b) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) < 1e-9, `${a}: ${b}`));

test('a drag comes to rest in line with others, else on the grid', () => {
  const others = [[2, 3, 2.9], [5, 1.07, 2.4]];
  near(snapped([2.09, 1.113, 2.9], others, [true, true, false]), [2, 1.07, 2.9]);
  near(snapped([3.512, 2.488, 2.9], others, [true, true, false]), [3.5, 2.5, 2.9]);
  near(snapped([6.49, 2.913, 2.433], others, [false, true, true]), [6.49, 3, 2.4]);
});

test('the axes of a view are those of the building that are nearest to it', () => {
  near(axesOf(0.3).ahead, [1, 0, 0]);
  near(axesOf(0.3).right, [0, -1, 0]);
  near(axesOf(Math.PI / 2).right, [1, 0, 0]);
  near(axesOf(-3).ahead, [-1, 0, 0]);
  near(axesOf(-1.5 * Math.PI).ahead, [0, 1, 0]);
});

function held(yaw) {
  const said = [];
  const mover = new Mover({ say: (message) => said.push(message), outline: () => {},
    moved: () => {}, yaw: () => yaw, others: () => [[4, 4, 2.9]] });
  mover.hold('luminaire', { name: 'lamp', position: [1, 1, 2.9] });
  return { mover, said };
}

test('a luminaire moves as the view looks', () => {
  const { mover } = held(Math.PI);
  mover.nudge('up', 1);
  near(mover.thing.position, [0, 1, 2.9]);
  mover.nudge('right', 1);
  near(mover.thing.position, [0, 2, 2.9]);
  mover.nudge('ahead', 0.5);
  near(mover.thing.position, [0, 2, 2.4]);
  mover.release();
});

test('a drag in plan snaps, and a typed place is taken as it is', () => {
  const { mover, said } = held(0);
  const down = [0, 0, -1];
  assert.ok(mover.grab([1, 1, 500], down, true));
  mover.drag([3.93, 2.013, 500], down);
  near(mover.thing.position, [4, 2, 2.9]);
  mover.snaps = false;
  mover.drag([3.93, 2.013, 500], down);
  near(mover.thing.position, [3.93, 2.013, 2.9]);
  mover.place(2, 2.5);
  near(said.at(-1).position, [3.93, 2.013, 2.5]);
  const count = said.length;
  mover.place(0, NaN);
  assert.equal(said.length, count);
  mover.release();
});

test('a sign never snaps through its wall', () => {
  const { mover } = held(0);
  const half = Math.SQRT1_2;
  mover.hold('sign', { name: 'oblique', position: [5, 5, 2.2], facing: [half, half, 0],
    up: [0, 0, 1], width: 0.3, height: 0.15 });
  mover.grab([9, 9, 2.2], [-half, -half, 0], false);
  mover.drag([9.43, 8.57, 2.28], [-half, -half, 0]);
  const [x, y, z] = mover.thing.position;
  assert.ok(Math.abs(x + y - 10) < 1e-9, 'it stays in the plane of its wall');
  assert.ok(Math.abs(z - 2.3) < 1e-9);
  mover.release();
  mover.hold('sign', { name: 'south', position: [5, 0.02, 2.2], facing: [0, 1, 0],
    up: [0, 0, 1], width: 0.3, height: 0.15 });
  mover.grab([5, 0.02, 500], [0, 0, -1], true);
  mover.drag([4.07, 0.02, 500], [0, 0, -1]);
  near(mover.thing.position, [4, 0.02, 2.2]);
  mover.release();
});

test('a nudge is sent when another thing is selected, and forgotten by an undo', () => {
  const { mover, said } = held(0);
  mover.nudge('up', 1);
  mover.hold('luminaire', { name: 'other', position: [9, 9, 2.9] });
  assert.deepEqual(said.map(({ name }) => name), ['lamp']);
  mover.nudge('up', 1);
  mover.cancel();
  near(mover.thing.position, [9, 9, 2.9]);
  mover.drop();
  assert.equal(said.length, 1);
  mover.release();
});
