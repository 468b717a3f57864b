import assert from 'node:assert/strict';
import { test } from 'node:test';
import { placeOf } from '../../../actors/apps/view/page/src/edit/placing.js';
import { figuresOf, polarPoints } from '../../../actors/apps/view/page/src/panel/library.js';
import { libraryOf } from '../../../actors/apps/view/page/src/protocol/connection.js';
import { ProtocolError } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { decodeLibrary } from '../../../actors/apps/view/page/src/protocol/decode_library.js';
import { Building } from '../../../actors/apps/view/page/src/walk/building.js';
import { decodeFrame } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { geometryFrame, library } from '../mock_room.mjs';

const near = (a, b) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) < 2e-3, `${a}: ${b}`));

test('the library is asked for with the token of the page, and decoded', async () => {
  let asked = null;
  const { kinds } = await libraryOf('http://host:8080/?token=abc#x', async (url) => {
    asked = url;
    return { ok: true, json: async () => library() };
  });
  assert.equal(asked, 'http://host:8080/library.json?token=abc');
  assert.deepEqual(kinds.map(({ kind, of, ofType }) => [kind, of, ofType]),
    [['luminaire', 'wide downlight', true], ['luminaire', 'lamp west', false],
      ['sign', 'exit sign', false]]);
  assert.equal(kinds[0].curves[1].length, 73);
  assert.equal(kinds[2].face.texels.length, 64 * 32);
});

test('a malformed library is refused', () => {
  const harmed = (harm) => () => {
    const value = library();
    harm(value);
    decodeLibrary(value);
  };
  for (const harm of [(l) => (l.step = 7), (l) => (l.luminaires = 3),
    (l) => (l.luminaires[0].curves[0].length = 5), (l) => (l.luminaires[0].curves.length = 1),
    (l) => (l.luminaires[0].mains = -1), (l) => (l.signs[0].face.texels = 'AAAA'),
    (l) => (l.signs[0].face.columns = 1e9), (l) => (l.signs[0].colours = [[1, 2, 300]]),
    (l) => (l.signs[0].of = null)])
    assert.throws(harmed(harm), ProtocolError);
});

test('a curve is drawn downwards, its peak at the rim', () => {
  const cosine = Array.from({ length: 73 }, (_, i) =>
    Math.max(0, Math.cos(((5 * i - 180) * Math.PI) / 180)));
  const points = polarPoints(cosine, 5, 1);
  near(points[36], [0, 1]);
  near(points[48], [0.5 * Math.sin(Math.PI / 3), 0.25]);
  near(polarPoints(cosine, 5, 0)[36], [0, 0]);
});

test('a kind says its flux in each operation, a sign its size', () => {
  assert.equal(figuresOf({ kind: 'luminaire', mains: 3100, emergency: 250, unit: 'lm' }),
    '3100 lm on mains, 250 lm in emergency');
  assert.equal(figuresOf({ kind: 'luminaire', mains: 0, emergency: 0, unit: 'lm' }), 'dark');
  assert.equal(figuresOf({ kind: 'sign', width: 0.6, height: 0.3 }), '0.60 × 0.30 m');
});

const building = new Building(decodeFrame(geometryFrame(1)));
const view = (eye, direction, more = {}) =>
  ({ eye, ray: { origin: eye, direction }, mode: 'walk', centre: [0, 0, 0], cut: Infinity,
    ...more });

test('luminaires are added under the ceiling ahead, before the next wall', () => {
  const eye = [2, 3, 1.65];
  near(placeOf('luminaire', building, view(eye, [1, 0, 0])).position, [4, 3, 2.97]);
  near(placeOf('luminaire', building, view(eye, [-1, 0, 0])).position, [0.3, 3, 2.97]);
  near(placeOf('luminaire', building, view(eye, [0, 0, 1],
    { mode: 'plan', centre: [8, 4, 2.2] })).position, [8, 4, 2.97]);
  near(placeOf('luminaire', building, view([30, 3, 9], [-1, 0, -0.2],
    { mode: 'orbit', centre: [5, 3, 1.5] })).position, [5, 3, 2.97]);
});

test('signs are added to the wall in view, and face the viewer', () => {
  const eye = [2, 5, 1.65];
  const onWall = placeOf('sign', building, view(eye, [-0.9, 0, 0.1]));
  near(onWall.position, [0.04, 5, 1.65 + 0.1 * (2 / 0.9)]);
  near(onWall.facing, [1, 0, 0]);
  const hung = placeOf('sign', building, view(eye, [0.1, 0, -1]));
  near(hung.position, [4, 5, 2.2]);
  near(hung.facing, [-1, 0, 0]);
});
