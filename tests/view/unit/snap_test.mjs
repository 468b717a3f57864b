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
  mover.place([1.234, 2, 2.5]);
  near(said.at(-1).position, [1.234, 2, 2.5]);
  const count = said.length;
  mover.place([NaN, 2, 2.5]);
  assert.equal(said.length, count);
  mover.release();
});
