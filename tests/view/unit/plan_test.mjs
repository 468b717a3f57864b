import assert from 'node:assert/strict';
import { test } from 'node:test';
import { emphasisBelow, escapeLines }
  from '../../../actors/apps/view/page/src/draw/escape_lines.js';
import { figuresOf } from '../../../actors/apps/view/page/src/panel/checks.js';
import { barOf } from '../../../actors/apps/view/page/src/panel/plan_key.js';

const scene = {
  routes: [{ name: 'way', width: 2, path: [[0, 0, 0], [4, 0, 0], [4, 3, 0]] },
    { name: 'above', width: 1, path: [[0, 0, 4], [4, 0, 4]] }],
  areas: [{ name: 'hall', z: 0, outline: [[0, 0], [2, 0], [2, 2]] }],
  emphasis: [{ name: 'exit', position: [4, 3, 0] }, { name: 'up', position: [0, 0, 4.2] }],
};

test('a plan has the routes, areas and points of the storey below its cut', () => {
  const ground = escapeLines(scene, 2.2);
  assert.equal(ground.lines.length, 6 * 4, 'two pieces, and two strokes of the arrow');
  assert.deepEqual(ground.lines.slice(0, 6), [0, 0, 0, 4, 0, 0]);
  assert.deepEqual(ground.edges.slice(0, 12), [0, 1, 0, 4, 1, 0, 0, -1, 0, 4, -1, 0]);
  assert.equal(ground.areas.length, 6 * 3);
  const upper = escapeLines(scene, 6.2);
  assert.deepEqual(upper.lines.slice(0, 6), [0, 0, 4, 4, 0, 4]);
  assert.equal(upper.areas.length, 0);
  assert.deepEqual(emphasisBelow(scene, 2.2).map(({ name }) => name), ['exit']);
});

test('the arrow of a route points in the direction of escape', () => {
  const { lines } = escapeLines({ routes: [scene.routes[1]], areas: [] }, 6);
  for (const from of [6, 12]) {
    assert.deepEqual(lines.slice(from, from + 2), [4, 0]);
    assert.ok(lines[from + 3] < 4);
  }
});

test('the scale bar has the longest round length that fits', () => {
  assert.deepEqual(barOf(0.02), { metres: 2, pixels: 100 });
  assert.equal(barOf(0.04).metres, 5);
  assert.equal(barOf(0.001).metres, 0.1);
  assert.ok(barOf(3.3).pixels <= 140);
});

test('a check says its value, its limit and the margin between them', () => {
  const check = { value: 0.84, limit: 1, atLeast: true, unit: 'lx', margin: -0.16 };
  assert.equal(figuresOf(check), '0.840 lx, at least 1.00 lx: −16 %');
  assert.equal(figuresOf({ ...check, limit: null }), '0.840 lx');
  assert.equal(figuresOf({ ...check, value: null }), '');
  assert.equal(figuresOf({ value: 20, limit: 40, atLeast: false, unit: '', margin: 0.5 }),
    '20.0, at most 40.0: +50 %');
});
