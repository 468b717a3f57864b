import assert from 'node:assert/strict';
import { test } from 'node:test';
import { allFinite, halfValues, toHalf } from '../../../actors/apps/view/page/src/protocol/half.js';

test('half floats have the values of IEEE 754', () => {
  const known = [[0x0000, 0], [0x3c00, 1], [0xc000, -2], [0x7bff, 65504], [0x0400, 2 ** -14],
    [0x0001, 2 ** -24], [0x3555, 0.333251953125]];
  for (const [bits, value] of known) assert.equal(halfValues[bits], value);
  assert.equal(halfValues[0x7c00], Infinity);
  assert.ok(Number.isNaN(halfValues[0x7e00]));
});

test('every finite half float is unchanged after writing and reading', () => {
  for (let bits = 0; bits < 0x10000; ++bits)
    if ((bits & 0x7c00) !== 0x7c00 && bits !== 0x8000)
      assert.equal(halfValues[toHalf(halfValues[bits])], halfValues[bits]);
});

test('a number becomes a half float at most half a step away', () => {
  for (let i = 0; i < 2000; ++i) {
    const x = 1e-4 * 1.012 ** i;
    if (x > 65000) break;
    assert.ok(Math.abs(halfValues[toHalf(x)] / x - 1) <= 2 ** -11);
  }
  assert.equal(halfValues[toHalf(1e9)], 65504);
});

test('numbers that are not finite are detected', () => {
  assert.ok(allFinite(Uint16Array.of(0, 0x7bff, 0xfbff)));
  assert.ok(!allFinite(Uint16Array.of(0, 0x7c00)));
  assert.ok(!allFinite(Uint16Array.of(0xfe01)));
});
