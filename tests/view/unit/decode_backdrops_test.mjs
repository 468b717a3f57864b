import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ProtocolError } from '../../../actors/apps/view/page/src/protocol/decode_frame.js';
import { backdropsOf } from '../../../actors/apps/view/page/src/protocol/connection.js';
import { decodeBackdrops, limits, under }
  from '../../../actors/apps/view/page/src/protocol/decode_backdrops.js';

const lines = () => ({ floors: [-1, 2], lines: [[0, 0, 5, 0], [5, 0, 5, 4]] });
const picture = () => ({ floors: [2, 5], png: 'iVBORw0KGgo=', corner: [0, 0], across: [5, 0], up: [0, 4] });

test('lines and pictures are decoded field by field', () => {
  const [first, second] = decodeBackdrops([{ ...lines(), surprise: 1 }, picture()]);
  assert.equal(first.lines.length, 2);
  assert.ok(!('surprise' in first));
  assert.deepEqual(second.picture.across, [5, 0]);
  assert.deepEqual(decodeBackdrops([]), []);
});

test('a wrong field is refused, and named', () => {
  const refused = (one, pattern) => assert.throws(
    () => decodeBackdrops([one]),
    (error) => error instanceof ProtocolError && pattern.test(error.message));
  refused({ ...lines(), floors: [0] }, /backdrops\[0\]\.floors/);
  refused({ ...lines(), lines: [[0, 0, 1]] }, /lines\[0\]/);
  refused({ ...lines(), lines: [[0, 0, 1, NaN]] }, /lines\[0\]/);
  refused({ ...lines(), lines: new Array(limits.lines + 1).fill([0, 0, 1, 1]) }, /no lines/);
  refused({ ...picture(), png: '"><script>' }, /png/);
  refused({ ...picture(), up: undefined }, /up/);
  refused(null, /no object/);
  assert.throws(() => decodeBackdrops({}), ProtocolError);
});

test('a plan shows the drawings of the storey that it cuts', () => {
  const all = decodeBackdrops([lines(), { ...lines(), floors: [2, 5] }, picture()]);
  assert.deepEqual(under(all, 1.2), [all[0]]);
  assert.deepEqual(under(all, 3.2), [all[1], all[2]]);
  assert.deepEqual(under(all, -3), []);
  assert.deepEqual(under(all, 9), []);
  assert.deepEqual(under([], 1), []);
  const everywhere = decodeBackdrops([{ ...lines(), floors: [-1e7, 1e7] }])[0];
  assert.deepEqual(under([...all, everywhere], 1.2), [all[0], everywhere]);
  assert.deepEqual(under([...all, everywhere], 9), [everywhere]);
});

test('backdrops are requested beside the page, with only its token', async () => {
  let asked;
  const ask = (answer) => async (address) => {
    asked = address;
    return answer;
  };
  const whole = { ok: true, json: async () => [lines()] };
  const page = 'http://host:1/?token=a%26b&other=1#x';
  assert.equal((await backdropsOf(page, ask(whole))).length, 1);
  assert.equal(asked, 'http://host:1/backdrops.json?token=a%26b');
  await assert.rejects(backdropsOf(page, ask({ ok: false, status: 404 })), /404/);
});
