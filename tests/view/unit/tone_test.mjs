import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Exposure } from '../../../actors/apps/view/page/src/draw/exposure.js';
import { cameraCurve, shownBy, signLevel } from '../../../actors/apps/view/page/src/draw/tone.js';

const signs = [0, 0.3, 0.9, 3, 70, 4000, 1e6];

test('the curve rises to white, and shows a sign at 0.8 or less', () => {
  for (const white of [1, 6, 50])
    for (const sign of signs) {
      const curve = cameraCurve(white, sign);
      let before = 0;
      for (let x = 1e-5; x < curve.white; x *= 1.05) {
        const now = shownBy(curve, x);
        assert.ok(now > before && now <= x + 1e-9, `${white}, ${sign}: ${now} at ${x}`);
        before = now;
      }
      assert.equal(shownBy(curve, curve.white), 1);
      assert.ok(shownBy(curve, sign) <= signLevel + 1e-9);
    }
});

test('a legend shows at least the 0.4th power of its ratio to its ground', () => {
  for (const sign of signs.slice(1))
    for (const ratio of [1.1, 3.5, 15, 1000]) {
      const curve = cameraCurve(6, sign);
      assert.ok(shownBy(curve, sign) / shownBy(curve, sign / ratio) >= ratio ** 0.4);
    }
});

test('the curve is that of the program', () => {
  // The same numbers stand in tests/unit/scenes/light/vision/tone_test.cpp.
  const curve = cameraCurve(20, 70);
  for (const [exposed, shown] of [[0.18, 0.0515029537], [35, 0.5855394439], [100, 0.9543412475]])
    assert.ok(Math.abs(shownBy(curve, exposed) - shown) < 1e-6, `${shownBy(curve, exposed)}`);
});

test('a sign that comes into view lowers the exposure, and it returns when the sign is gone', () => {
  const exposure = new Exposure();
  const room = Float32Array.of(0, 1, 1, 0);
  const roomWithSign = Float32Array.of(0, 1, 1, 500);
  exposure.meter(room);
  exposure.adapt(0.1, true);
  const alone = shownBy(exposure.curve, exposure.scale);
  exposure.meter(roomWithSign);
  assert.ok(exposure.adapt(0.1));
  exposure.adapt(1, true);
  const beside = shownBy(exposure.curve, exposure.scale);
  assert.ok(beside < 0.5 * alone);
  assert.ok(Math.abs(shownBy(exposure.curve, 500 * exposure.scale) - signLevel) < 1e-6);
  exposure.meter(room);
  exposure.adapt(1, true);
  assert.ok(Math.abs(shownBy(exposure.curve, exposure.scale) - alone) < 1e-6);
});

test('exposure begins with the first light, and not with the darkness before it', () => {
  const exposure = new Exposure();
  exposure.meter(new Float32Array(4 * 16));
  assert.equal(exposure.adapt(0.1), false);
  assert.equal(exposure.adapted, null);
  const lit = new Float32Array(4 * 16);
  for (let i = 0; i < lit.length; i += 4) lit.set([Math.log2(8), 1, 0.5, 0], i);
  exposure.meter(lit);
  assert.equal(exposure.adapt(0.1), true);
  assert.ok(Math.abs(exposure.adapted - 8) < 1e-6);
  // Later darkness counts: the lights have gone out.
  exposure.meter(new Float32Array(4 * 16));
  exposure.adapt(1000);
  assert.ok(exposure.adapted < 0.01);
});
