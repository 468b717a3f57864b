import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ProtocolError } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { decodeMessage, limits }
  from '../../../actors/apps/view/page/src/protocol/decode_message.js';
import { sizeOf } from '../../../actors/apps/view/page/src/panel/traced.js';
import { liveAddress } from '../../../actors/apps/view/page/src/protocol/connection.js';
import { glossyFloor } from '../mock_room.mjs';
import { greyPng, MockServer } from '../mock_server.mjs';

const scene = () => new MockServer().scene(null);
const read = (message) => decodeMessage(JSON.stringify(message));

test('a scene is decoded field by field', () => {
  const { groups, signs, voxels, editor } = read({ ...scene(), surprise: 1 });
  assert.equal(groups.length, 6);
  assert.equal(signs[0].texels.length, 128 * 64);
  assert.equal(voxels.total, 22 * 12 * 6);
  assert.equal(read(scene()).flames[0].cells.length, 10 * 10 * 18);
  assert.equal(read(scene()).flames[0].shape.seed, 2018);
  assert.equal(read({ ...scene(), flames: [{ ...scene().flames[0], shape: null }] })
    .flames[0].shape, null);
  assert.equal(editor, false);
  assert.ok(!('surprise' in read({ ...scene(), surprise: 1 })));
});

test('lamps have tables of brightness, surfaces have gloss', () => {
  const { lamps, lampTables, gloss } = read({ ...scene(), gloss: glossyFloor(0.2) });
  assert.deepEqual(lamps.map(({ shape, table }) => [shape, table]), Array(3).fill(['disc', 0]));
  assert.deepEqual([...lampTables[0].values], [...Array(18).fill(65535), ...Array(18).fill(0)]);
  assert.deepEqual(gloss, [{ surface: 0, back: false, mirrored: [0.2, 0.2, 0.2],
    spread: 0.6, roughness: 0.2 }]);
});

test('a scene with a wrong field is refused, and the field named', () => {
  const harmed = (change) => {
    const s = structuredClone(scene());
    change(s);
    return () => read(s);
  };
  const named = (pattern) => (error) =>
    error instanceof ProtocolError && pattern.test(error.message);
  assert.throws(harmed((s) => (s.groups[2].factor = -1)), named(/groups\[2\]\.factor/));
  assert.throws(harmed((s) => (s.groups[0].kind = 'sun')), named(/groups\[0\]\.kind/));
  assert.throws(harmed((s) => (s.groups[1].light = 'old')), named(/groups\[1\]\.light/));
  assert.throws(harmed((s) => (s.signs[1].rows = 63)), named(/signs\[1\]\.texels/));
  assert.throws(harmed((s) => (s.signs[1].colours = Array(9).fill([1, 1, 1]))),
    named(/signs\[1\]\.colours/));
  assert.throws(harmed((s) => (s.signs[0].facing = [0, 1])), named(/facing/));
  assert.throws(harmed((s) => (s.flames[0].count = [10, 10, 17])), named(/flames\[0\]\.cells/));
  assert.throws(harmed((s) => (s.flames[0].count = [65, 1, 1])), named(/flames\[0\]\.count/));
  assert.throws(harmed((s) => (s.flames[0].size = [0, 1, 1])), named(/flames\[0\]\.size/));
  assert.throws(harmed((s) => (s.flames[0].shape.seed = 0.5)),
    named(/flames\[0\]\.shape\.seed/));
  assert.throws(harmed((s) => (s.flames = Array(9).fill(s.flames[0]))), named(/9 flames/));
  assert.throws(harmed((s) => (s.lamps[1].shape = 'cube')), named(/lamps\[1\]\.shape/));
  assert.throws(harmed((s) => (s.lamps[2].table = 1)), named(/lamps\[2\]\.table/));
  assert.throws(harmed((s) => (s.lamps[0].axes = [[1, 0, 0]])), named(/lamps\[0\]\.axes/));
  assert.throws(harmed((s) => (s.lamp_tables[0].polar = 35)), named(/lamp_tables\[0\]\.values/));
  const gloss = (change) => harmed((s) => (s.gloss = [{ ...glossyFloor(0.2)[0], ...change }]));
  assert.throws(gloss({ roughness: 1.5 }), named(/gloss\[0\]\.roughness/));
  assert.throws(gloss({ spread: 2 }), named(/gloss\[0\]\.spread/));
  assert.throws(harmed((s) => (s.voxels.count = [4000, 4000, 4000])), named(/voxels/));
  assert.throws(harmed((s) => delete s.low), named(/low/));
  assert.throws(harmed((s) => (s.luminaires[0] = null)), ProtocolError);
});

test('the states of a scene range from a time to a later one, or are absent', () => {
  const server = new MockServer();
  assert.equal(read(server.scene(null)).states, null);
  const states = { from: 0, to: 90, step: 30, at: 60 };
  const decoded = (more) => read({ ...server.scene(null), states: { ...states, ...more } }).states;
  assert.deepEqual(decoded({}), { ...states, mainsFailAt: null });
  assert.equal(decoded({ mains_fail_at: 40 }).mainsFailAt, 40);
  const refused = (change) =>
    assert.throws(() => read({ ...server.scene(null), states: { ...states, ...change } }),
      ProtocolError);
  refused({ to: -1 });
  refused({ step: 0 });
  refused({ at: 'now' });
});

test('time since a failure is a number or absent, and shares are numbers', () => {
  assert.deepEqual(read({ type: 'time', seconds: 5, shares: { lamp: 0.5 } }),
    { type: 'time', seconds: 5, shares: [{ name: 'lamp', share: 0.5 }] });
  assert.equal(read({ type: 'time', seconds: null, shares: {} }).seconds, null);
  assert.throws(() => read({ type: 'time', seconds: 5, shares: { lamp: -1 } }), ProtocolError);
  assert.throws(() => read({ type: 'time', seconds: 'now', shares: {} }), ProtocolError);
});

test('additions are marked, and the program sends their names', () => {
  const server = new MockServer();
  assert.equal(read(server.scene(null)).signs[0].added, false);
  assert.equal(read(server.scene(null)).relaid, false);
  server.do_add({ send: () => {} }, { kind: 'sign', of: 'exit sign', position: [6.49, 2, 2.4] });
  clearTimeout(server.tracing);
  const { signs } = read(server.scene(null));
  assert.deepEqual(signs.filter((s) => s.added).map((s) => s.name), ['exit sign copy']);
  const added = { type: 'added', kind: 'sign', of: 'exit sign', name: 'exit sign copy' };
  assert.deepEqual(read(added), added);
  assert.throws(() => read({ ...added, kind: 'wall' }), ProtocolError);
  assert.throws(() => read({ ...added, name: 7 }), ProtocolError);
});

test('a picture is a PNG file in base64, or still absent', () => {
  const png = greyPng(8, 4).toString('base64');
  const picture = { type: 'picture', id: 3, particles: 1e6, paths: 8, relative_error: null,
    seconds: 2, done: false, png };
  assert.deepEqual(read(picture), { type: 'picture', id: 3, particles: 1e6, paths: 8,
    relativeError: null, seconds: 2, done: false, png });
  assert.equal(read({ ...picture, png: null }).png, null);
  for (const wrong of ['', 'javascript:alert(1)', `${png}"><script>`, btoa('GIF89a and so on'), 7])
    assert.throws(() => read({ ...picture, png: wrong }), ProtocolError);
  assert.throws(() => read({ ...picture, paths: 0.5 }), ProtocolError);
  assert.throws(() => read({ ...picture, png: png + 'A'.repeat(limits.pngCharacters) }),
    ProtocolError);
});

test("a picture is requested as large as allowed, with the screen's aspect ratio", () => {
  assert.deepEqual(sizeOf(640, 360), [640, 360]);
  const [width, height] = sizeOf(2560, 1440);
  assert.ok(width * height <= 1 << 19 && width * height > 0.99 * (1 << 19));
  assert.ok(Math.abs(width / height - 16 / 9) < 0.005);
  assert.deepEqual(sizeOf(4000, 4), [4000, 16]);
});

test('text that is not a message is refused', () => {
  for (const text of ['', '{', '[]', '7', 'null', '{"type":"toString"}', '{"type":"sudo"}'])
    assert.throws(() => decodeMessage(text), ProtocolError);
});

test('an unknown error stays unknown', () => {
  const base = { generation: 1, particles: 5, seconds: 1 };
  assert.equal(read({ type: 'progress', ...base, relative_error: null }).relativeError, null);
  assert.equal(read({ type: 'progress', ...base, relative_error: 0.5 }).relativeError, 0.5);
});

test("only the token of the page's address is passed on", () => {
  assert.equal(liveAddress('http://a:8080/?token=x%26y&z=1#q'), 'ws://a:8080/live?token=x%26y');
  assert.equal(liveAddress('https://a/'), 'wss://a/live');
});

test('a suggestion is decoded field by field, and refused with a wrong field', () => {
  const suggestion = () => ({
    type: 'suggested',
    luminaires: [{ of: 'lamp', position: [1, 2, 3], facing: [0, 0, -1] }],
    instead_of: ['lamp copy'],
    least: 0.4,
    missing: 0.1,
    helpful: [{ position: [1, 2, 3], share: 0.5 }],
    words: '1 more would do, and no fewer',
  });
  const { luminaires, insteadOf, helpful } = read(suggestion());
  assert.deepEqual(luminaires[0], { of: 'lamp', position: [1, 2, 3], facing: [0, 0, -1] });
  assert.deepEqual(insteadOf, ['lamp copy']);
  assert.equal(helpful[0].share, 0.5);
  assert.throws(() => read({ ...suggestion(), missing: 2 }), /missing/);
  assert.throws(() => read({ ...suggestion(), helpful: [{ position: [1], share: 0 }] }), /position/);
  assert.throws(() => read({ ...suggestion(), luminaires: [{ of: 7 }] }), /luminaires\[0\]\.of/);
});

test('a refusal names its picture or suggestion, if it concerns one', () => {
  const read = (more) => decodeMessage(JSON.stringify({ type: 'refused', why: 'so', ...more }));
  assert.deepEqual(read({}), { type: 'refused', why: 'so', picture: null, suggestion: false,
    checks: false, sign: null });
  assert.equal(read({ picture: 7 }).picture, 7);
  assert.equal(read({ suggestion: true }).suggestion, true);
  assert.equal(read({ checks: true }).checks, true);
  assert.equal(read({ sign: 'exit' }).sign, 'exit');
  assert.throws(() => read({ picture: -1 }), ProtocolError);
});

test('steps of edits are decoded, and no more than there are hold', () => {
  const steps = [{ kind: 'factor', name: 'lamp', count: 1, value: 0.5 },
    { kind: 'smoke', name: null, count: 0, value: 2 }];
  const history = decodeMessage(JSON.stringify({ type: 'history', steps, done: 1 }));
  assert.deepEqual(history.steps[1], { kind: 'smoke', name: '', count: 0, value: 2 });
  assert.equal(history.done, 1);
  assert.deepEqual(read({ type: 'step', last: steps[0] }).last, steps[0]);
  assert.throws(() => read({ type: 'step' }), ProtocolError);
  const bad = (more) => () =>
    decodeMessage(JSON.stringify({ type: 'history', steps, done: 1, ...more }));
  assert.throws(bad({ done: 3 }), ProtocolError);
  assert.throws(bad({ steps: [{ kind: 'explode', count: 1 }] }), ProtocolError);
});

test('checks are decoded; values, limits and places may be unknown', () => {
  const row = { rule: 'E1', title: 'Illuminance', clause: 'EN 1838 4.2.1', subject: 'route "way"',
    conditions: '', verdict: 'fail', value: 0.8, limit: 1, at_least: true, unit: 'lx',
    margin: -0.2, place: [1, 2, 0.02], reasons: '' };
  const message = { type: 'checks', rows: [row, { rule: 'E9', title: 'Duration',
    verdict: 'not assessed' }], counts: { fail: 1, 'not assessed': 1 }, words: '1 check fails',
  seconds: 0.3 };
  const { rows, counts } = read(message);
  assert.deepEqual([rows[0].place, rows[0].atLeast, rows[0].margin], [[1, 2, 0.02], true, -0.2]);
  assert.deepEqual([rows[1].value, rows[1].place, rows[1].subject], [null, null, '']);
  assert.deepEqual(counts, { fail: 1, 'not assessed': 1 });
  assert.throws(() => read({ ...message, rows: [{ ...row, verdict: 'fine' }] }), ProtocolError);
  assert.throws(() => read({ ...message, rows: [{ ...row, place: [1, 2] }] }), ProtocolError);
});

test('routes have two places at least, and areas three corners', () => {
  const way = { name: 'way', width: 1.2, path: [[0, 0, 0], [5, 0, 0]] };
  const hall = { name: 'hall', z: 0, outline: [[0, 0], [4, 0], [4, 3]] };
  const more = (fields) => read({ ...scene(), ...fields });
  assert.deepEqual(more({ routes: [way], areas: [hall] }).areas, [hall]);
  assert.throws(() => more({ routes: [{ ...way, path: [[0, 0, 0]] }] }), ProtocolError);
  assert.throws(() => more({ areas: [{ ...hall, outline: [[0, 0], [4, 0]] }] }), ProtocolError);
  assert.throws(() => more({ areas: [{ ...hall, outline: [[0, 0], [4, 0], [4]] }] }),
    ProtocolError);
});
