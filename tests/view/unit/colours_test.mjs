import assert from 'node:assert/strict';
import { test } from 'node:test';
import { count, scaleColour, scalePlace, scaleTexels, words, wordsWithError }
  from '../../../actors/apps/view/page/src/light/colours.js';
import { Exposure, eyeScale, readMeter } from '../../../actors/apps/view/page/src/draw/exposure.js';

const linear = (byte) => {
  const x = byte / 255;
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
};

test('the lightness of the scale rises throughout, so that it works in grey', () => {
  const lightness = Array.from({ length: 101 }, (_, i) => {
    const [r, g, b] = scaleColour(i / 100).map(linear);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  });
  for (let i = 1; i < lightness.length; ++i) assert.ok(lightness[i] > lightness[i - 1]);
});

test('a decade is a sixth of the scale', () => {
  assert.ok(Math.abs(scalePlace(1e-3)) < 1e-9);
  assert.ok(Math.abs(scalePlace(1) - 0.5) < 1e-9);
  assert.ok(Math.abs(scalePlace(1e3) - 1) < 1e-9);
  assert.equal(scaleTexels().length, 1024);
});

test('numbers have three digits, errors two, and values as many decimals as their error', () => {
  assert.equal(words(0.012345), '0.0123');
  assert.equal(words(12345.6), '12\u202f346');
  assert.equal(words(0), '0');
  assert.equal(words(null), '–');
  assert.equal(words(1e-9), '1.00e-9');
  assert.equal(wordsWithError(12.3456, 0.234), '12.35 ± 0.23');
  assert.equal(wordsWithError(4.08, 0.082), '4.080 ± 0.082');
  assert.equal(wordsWithError(12345, 67), '12\u202f345 ± 67');
  assert.equal(count(800000), '800\u202f000');
});

test('the meter gives the log-average of pixels with light', () => {
  const cells = Float32Array.of(10 * Math.log2(4), 10, 10, 0, 10 * Math.log2(16), 10, 4, 75,
    0, 0, 0, 3);
  const { level, shown, sign } = readMeter(cells);
  assert.ok(Math.abs(level - 8) < 1e-6);
  assert.ok(Math.abs(shown - 0.7) < 1e-6);
  assert.equal(sign, 75);
  assert.ok(readMeter(new Float32Array(8)).level > 0);
});

test('a dark-adapted eye needs less light for the same grey', () => {
  assert.ok(eyeScale(0.01) > eyeScale(1));
  assert.ok(eyeScale(1) > eyeScale(100));
  // A building as bright as half of the screen's white: a cd/m2 is shown as a cd/m2.
  assert.ok(Math.abs(eyeScale(125) - 1 / 250) < 1e-6);
});

test('exposure adapts towards the metered value and then rests', () => {
  const exposure = new Exposure();
  exposure.meter(Float32Array.of(Math.log2(1), 1, 1, 0));
  exposure.adapt(0.1);
  exposure.meter(Float32Array.of(Math.log2(64), 1, 1, 0));
  let before = exposure.level;
  for (let i = 0; i < 60 && exposure.adapt(0.1); ++i) {
    assert.ok(exposure.level > before);
    before = exposure.level;
  }
  assert.ok(Math.abs(exposure.level / 64 - 1) < 0.01);
  assert.equal(exposure.adapt(0.1), false);
});

test('slow adaptation takes seconds to more light, and minutes to less', () => {
  const exposure = new Exposure();
  exposure.slow = true;
  const after = (from, to, time) => {
    exposure.adapted = from;
    exposure.meter(Float32Array.of(Math.log2(to), 1, 1, 0));
    for (let t = 0; t < time; t += 0.1) exposure.adapt(0.1, true);
    return exposure.level;
  };
  assert.ok(Math.abs(after(1, 100, 5) / 100 - 1) < 0.05);
  assert.ok(after(100, 1, 5) > 80, 'in the dark little is seen at first');
  // After one time constant 1 / e of the way in logarithms is left.
  assert.ok(Math.abs(Math.log(after(100, 1, 120)) / Math.log(100) - 1 / Math.E) < 0.01);
});

test('with reduced motion the new exposure is applied and shown at once', () => {
  const exposure = new Exposure();
  for (const luminance of [1, 30]) {
    exposure.meter(Float32Array.of(Math.log2(luminance), 1, 1, 0));
    assert.equal(exposure.adapt(0.01, true), true);
    assert.ok(Math.abs(exposure.level / luminance - 1) < 1e-6);
    assert.equal(exposure.adapt(0.01, true), false);
  }
});
