import assert from 'node:assert/strict';
import { test } from 'node:test';
import { limits, decodeFrame, ProtocolError }
  from '../../../actors/apps/view/page/src/protocol/decode_frame.js';

function frame(kind, generation, a, bytes) {
  const buffer = new ArrayBuffer(16 + bytes);
  new Uint32Array(buffer, 0, 4).set([kind, generation, a, 0]);
  return buffer;
}

test('geometry has corners and surfaces of every triangle', () => {
  const buffer = frame(1, 5, 2, 80);
  new Float32Array(buffer, 16, 18).fill(1.5);
  new Uint32Array(buffer, 88).set([3, 4]);
  const { generation, triangles, corners, surfaces } = decodeFrame(buffer);
  assert.deepEqual([generation, triangles, corners.length, [...surfaces]], [5, 2, 18, [3, 4]]);
});

test('a length that contradicts the count is refused', () => {
  for (const bytes of [0, 40, 79, 81, 84]) assert.throws(() => decodeFrame(frame(1, 1, 2, bytes)),
    ProtocolError);
  assert.throws(() => decodeFrame(frame(1, 1, limits.triangles + 1, 80)), ProtocolError);
  assert.throws(() => decodeFrame(frame(2, 1, limits.groups, 12)), ProtocolError);
  assert.throws(() => decodeFrame(frame(2, 1, 0, 11)), ProtocolError);
  assert.throws(() => decodeFrame(new ArrayBuffer(15)), ProtocolError);
  assert.throws(() => decodeFrame(frame(9, 1, 0, 0)), ProtocolError);
});

test('numbers that are not finite are refused', () => {
  const corners = frame(1, 1, 1, 40);
  new Float32Array(corners, 16, 9)[7] = NaN;
  assert.throws(() => decodeFrame(corners), ProtocolError);
  const light = frame(2, 1, 0, 12);
  new Uint16Array(light, 16)[2] = 0x7c00;
  assert.throws(() => decodeFrame(light), ProtocolError);
});

test('mutated bytes are decoded or refused, and nothing else', () => {
  let state = 12345;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0);
  for (let i = 0; i < 5000; ++i) {
    const buffer = new ArrayBuffer(random() % 200);
    const bytes = new Uint8Array(buffer);
    for (let k = 0; k < bytes.length; ++k) bytes[k] = random() >>> 24;
    if (bytes.length > 8) bytes.set([random() % 6, 0, 0, 0]);
    try {
      decodeFrame(buffer);
    } catch (error) {
      assert.ok(error instanceof ProtocolError, String(error));
    }
  }
});
