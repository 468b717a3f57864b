import assert from 'node:assert/strict';
import { test } from 'node:test';
import { decodeFrame, ProtocolError } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { decodeMessage } from '../../../actors/apps/view/page/src/protocol/decode_message.js';
import { intervalMs, Outbox } from '../../../actors/apps/view/page/src/protocol/outbox.js';
import { Live } from '../../../actors/apps/view/page/src/state.js';
import { geometryFrame, lightFrame, smokeFrame, sources, startState, trianglesOf }
  from '../mock_room.mjs';
import { MockServer } from '../mock_server.mjs';

/** A scene in which the light of some groups stays visible. */
const keeping = (scene, kept, how = 'kept') =>
  ({ ...scene, groups: scene.groups.map((g, i) => ({ ...g, light: kept(i) ? how : 'new' })) });

/** A page's state without a page, and a clock set by tests. */
function heard() {
  const events = [];
  const waiting = [];
  const live = new Live((name, detail) => events.push([name, detail]), (f) => waiting.push(f));
  const server = new MockServer();
  const scene = (generation) => {
    server.generation = generation;
    return decodeMessage(JSON.stringify(server.scene(null)));
  };
  const named = (name) => events.filter(([n]) => n === name).map(([, detail]) => detail);
  return { live, scene, events, named, ring: () => waiting.splice(0).forEach((f) => f()) };
}

const state = startState();
const light = (generation, group) => decodeFrame(lightFrame(generation, group, state));
const geometry = (generation) => decodeFrame(geometryFrame(generation));

function started() {
  const all = heard();
  all.live.hear(all.scene(1));
  all.live.hear(geometry(1));
  sources.forEach((_, group) => all.live.hear(light(1, group)));
  return all;
}

test('the first scene is shown at once', () => {
  const { live, named } = started();
  assert.equal(live.number, 1);
  assert.equal(live.shown.surfaces.groups.size, sources.length);
  assert.deepEqual(named('fading').filter(Boolean), []);
});

test('a new generation waits for its light, while the old one stays', () => {
  const { live, scene, named, ring } = started();
  live.hear(scene(2));
  assert.equal(live.number, 1);
  assert.equal(named('fading').at(-1), true);
  live.hear(light(2, 0));
  assert.equal(live.number, 1);
  ring();
  assert.equal(live.number, 2);
  assert.equal(named('fading').at(-1), false);
  assert.equal(live.shown.surfaces.groups.size, sources.length, 'other groups keep their light');
});

test('a new generation whose groups all have light waits no longer', () => {
  const { live, scene } = started();
  live.hear(scene(2));
  sources.forEach((_, group) => live.hear(light(2, group)));
  assert.equal(live.number, 2);
});

test('late frames of an older generation are dropped', () => {
  const { live, scene, ring } = started();
  live.hear(scene(3));
  const before = Float32Array.from(live.shown.surfaces.sum);
  live.hear(light(1, 0));
  ring();
  assert.equal(live.number, 1);
  assert.deepEqual(live.shown.surfaces.sum, before);
});

test('a newer scene replaces one that still waits', () => {
  const { live, scene, ring } = started();
  live.hear(scene(2));
  live.hear(light(2, 0));
  live.hear(scene(3));
  ring();
  assert.equal(live.number, 1);
  live.hear(light(3, 0));
  ring();
  assert.equal(live.number, 3);
});

test('a new connection begins anew, whatever the numbers of generations', () => {
  const { live, scene, ring } = started();
  live.hear(scene(5));
  live.forget();
  live.hear(scene(1));
  live.hear(geometry(1));
  live.hear(light(1, 0));
  ring();
  assert.equal(live.number, 1);
  assert.equal(live.next, null);
});

test('light of another size, of no group, or before its scene is refused', () => {
  const { live, scene } = started();
  assert.throws(() => live.hear({ ...light(1, 0), halves: new Uint16Array(6) }), ProtocolError);
  assert.throws(() => live.hear({ ...light(1, 0), group: 99 }), ProtocolError);
  assert.throws(() => live.hear(light(2, 0)), ProtocolError);
  live.hear({ ...scene(2), voxels: null });
  const smoke = decodeFrame(smokeFrame(2, state));
  assert.throws(() => live.hear(smoke), ProtocolError);
});

test('factors dim the picture, and groups not named stay', () => {
  const { live } = started();
  const before = Float32Array.from(live.shown.surfaces.sum);
  live.hear({ type: 'factors', factors: sources.map(({ name }) => ({ name, factor: 0.5 })) });
  live.settle();
  for (let i = 0; i < before.length; i += 97)
    assert.ok(Math.abs(live.shown.surfaces.sum[i] - before[i] / 2) <= 1e-6 * before[i] + 1e-9);
  live.hear({ type: 'factors', factors: [{ name: 'lamp west', factor: 0 }] });
  assert.equal(live.scene.groups[0].factor, 0);
  assert.equal(live.scene.groups[1].factor, 0.5);
});

test('an echo does not move a slider that is being dragged', () => {
  const { live, named } = started();
  live.held = (name) => name === 'lamp west';
  live.setFactor('lamp west', 0.2);
  const factors = ['lamp west', 'lamp east'].map((name) => ({ name, factor: 0.9 }));
  live.hear({ type: 'factors', factors });
  assert.equal(live.scene.groups[0].factor, 0.2);
  assert.deepEqual(named('factors').at(-1), [{ name: 'lamp east', factor: 0.9 }]);
});

test('a slider sends its last value, and no more messages than the program accepts', () => {
  const sent = [];
  const waiting = [];
  let interval = 0;
  const outbox = new Outbox((text) => sent.push(JSON.parse(text)), (f, ms) => {
    interval = ms;
    waiting.push(f);
  });
  for (let i = 1; i <= 100; ++i) outbox.put({ factor: i }, 'factor lamp');
  outbox.put({ other: true });
  while (waiting.length) waiting.shift()();
  assert.deepEqual(sent, [{ factor: 1 }, { factor: 100 }, { other: true }]);
  assert.equal(interval, intervalMs);
  assert.ok(1000 / intervalMs < 50);
});

test('white is the light of all groups but flames, as dimmed', () => {
  const { live } = started();
  const whites = sources.map((_, group) => live.shown.surfaces.groups.get(group).white);
  const sum = (weight) => [0, 1, 2].map((c) => whites.reduce((total, white, i) =>
    total + (live.scene.groups[i].kind === 'flame' ? 0 : weight(i) * white[c]), 0));
  assert.ok(whites.some((white, i) => white[1] > 0 && live.scene.groups[i].kind !== 'flame'));
  assert.deepEqual(live.white, sum(() => 1));
  live.setFactor(live.scene.groups[0].name, 0.25);
  assert.deepEqual(live.white, sum((i) => (i === 0 ? 0.25 : 1)));
});

test('a moved thing waits only for its own light, and nothing fades', () => {
  const { live, scene, named } = started();
  const others = live.shown.surfaces.groups.get(1).halves;
  live.hear(keeping(scene(2), (i) => i !== 0));
  assert.equal(live.number, 1);
  assert.deepEqual(named('fading').filter(Boolean), []);
  const moved = light(2, 0);
  live.hear(moved);
  assert.equal(live.number, 2);
  assert.equal(live.shown.surfaces.groups.get(0).halves, moved.halves);
  assert.equal(live.shown.surfaces.groups.get(1).halves, others, 'the others keep their light');
});

test('a generation that keeps all light is shown at once, and new geometry drops all of it', () => {
  const { live, scene, named } = started();
  live.hear(keeping(scene(2), () => true, 'before'));
  assert.equal(live.number, 2);
  live.hear(geometry(2));
  assert.equal(named('geometry').length, 2);
  assert.equal(live.shown.surfaces.groups.size, sources.length);
});

/** The room with another sign, its light and its triangles. */
const more = startState();
more.signs.push({ ...more.signs[0], name: 'new exit', position: [6.49, 2, 2.4], added: true });
const lightOfMore = (generation, group) => decodeFrame(lightFrame(generation, group, more));
const relaid = (scene, kept) => ({ ...keeping(scene, kept, 'before'), relaid: true });

test('other triangles wait for all the light sent with them', () => {
  const { live, scene, named } = started();
  live.hear(relaid(scene(2), () => true));
  assert.equal(live.number, 1, 'nothing of the old light fits');
  assert.deepEqual(named('fading').filter(Boolean), []);
  live.hear(decodeFrame(geometryFrame(2, more)));
  assert.throws(() => live.hear(light(2, 0)), ProtocolError);
  sources.forEach((_, group) => {
    assert.equal(live.number, 1);
    live.hear(lightOfMore(2, group));
  });
  assert.equal(live.number, 2);
  assert.equal(live.shown.surfaces.cells, trianglesOf(more));
  assert.equal(live.shown.surfaces.groups.size, sources.length);
});

test('a move after a change of triangles waits for their light as well', () => {
  const { live, scene } = started();
  live.hear(relaid(scene(2), () => true));
  live.hear(decodeFrame(geometryFrame(2, more)));
  live.hear(lightOfMore(2, 1));
  live.hear(keeping(scene(3), (i) => i !== 0));
  live.hear(lightOfMore(3, 0));
  assert.equal(live.number, 1);
  sources.forEach((_, group) => group > 1 && live.hear(lightOfMore(3, group)));
  assert.equal(live.number, 3);
  assert.equal(live.shown.surfaces.groups.size, sources.length);
});

test('triangles changed twice before any was shown are the last ones', () => {
  const { live, scene } = started();
  live.hear(relaid(scene(2), () => true));
  live.hear(decodeFrame(geometryFrame(2, more)));
  live.hear(lightOfMore(2, 0));
  live.hear(relaid(scene(3), () => true));
  live.hear(geometry(3));
  sources.forEach((_, group) => live.hear(light(3, group)));
  assert.equal(live.number, 3);
  assert.equal(live.shown.surfaces.cells, trianglesOf(state));
});

test('a requested copy is a message, not a frame', () => {
  const { live, named } = started();
  const said = { type: 'added', kind: 'sign', of: 'exit', name: 'exit copy' };
  live.hear(said);
  assert.deepEqual(named('added'), [said]);
});

test('frames of a generation that was replaced are not lost', () => {
  const { live, scene } = started();
  live.hear(scene(2));
  const other = geometry(2);
  live.hear(other);
  live.hear(light(2, 1));
  const early = live.next.frames.get('2 1').halves;
  live.hear(keeping(scene(3), (i) => i === 1));
  sources.forEach((_, group) => group === 1 || live.hear(light(3, group)));
  assert.equal(live.number, 3);
  assert.equal(live.shown.geometry, other);
  assert.equal(live.shown.surfaces.groups.get(1).halves, early);
});

test('time after a failure dims by shares, in addition to factors', () => {
  const { live, named } = started();
  const before = Float32Array.from(live.shown.surfaces.sum);
  const shares = sources.map(({ name }) => ({ name, share: 0.5 }));
  live.hear({ type: 'factors', factors: sources.map(({ name }) => ({ name, factor: 0.5 })) });
  live.hear({ type: 'time', seconds: 5, shares });
  live.settle();
  for (let i = 0; i < before.length; i += 97)
    assert.ok(Math.abs(live.shown.surfaces.sum[i] - before[i] / 4) <= 1e-6 * before[i] + 1e-9);
  assert.equal(live.scene.groups[0].factor, 0.5);
  assert.deepEqual(named('time'), [{ seconds: 5 }]);
  assert.equal(live.scene.seconds, 5);
  live.hear({ type: 'time', seconds: null, shares: [] });
  assert.equal(live.scene.groups[0].share, 1, 'who is not named gives all');
});
