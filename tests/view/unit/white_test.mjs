import assert from 'node:assert/strict';
import { test } from 'node:test';
import { adaptedWhite } from '../../../actors/apps/view/page/src/draw/white.js';

const luminance = ([r, g, b]) => 0.2126729 * r + 0.7151522 * g + 0.072175 * b;

/** As the shader does it. */
function onMonitor(white, colour) {
  const m = adaptedWhite(white);
  const seen = [0, 1, 2].map((row) =>
    m[row] * colour[0] + m[3 + row] * colour[1] + m[6 + row] * colour[2]);
  return seen.map((v) => (v * luminance(colour)) / luminance(seen));
}

const spread = (rgb) => (Math.max(...rgb) - Math.min(...rgb)) / luminance(rgb);

test('the white is that of the program', () => {
  // The same numbers stand in tests/unit/scenes/light/vision/adapted_white_test.cpp.
  const shown = onMonitor([130, 98, 50], [130, 98, 50]);
  for (const [i, value] of [108.457, 101.088, 82.885].entries())
    assert.ok(Math.abs(shown[i] - value) < 0.05, `${shown}`);
});

test('light keeps the more of its colour, the dimmer and the warmer it is', () => {
  let before = 0;
  for (const cd_m2 of [1e6, 100, 1, 0.01]) {
    const left = spread(onMonitor([1.3 * cd_m2, 0.98 * cd_m2, 0.5 * cd_m2], [1.3, 0.98, 0.5]));
    assert.ok(left > before, `${left} at ${cd_m2} cd/m2`);
    before = left;
  }
  assert.ok(before < spread([1.3, 0.98, 0.5]));
});

test('without light, and in that of the monitor, colours stay', () => {
  for (const white of [[0, 0, 0], [200, 200, 200]])
    for (const [i, value] of onMonitor(white, [3, 2, 1]).entries())
      assert.ok(Math.abs(value - [3, 2, 1][i]) < 1e-3, `${white}`);
});
