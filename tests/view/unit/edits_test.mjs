import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LightDisplay } from '../../../actors/apps/view/page/src/draw/light_display.js';
import { Edits } from '../../../actors/apps/view/page/src/edit/edits.js';

function display() {
  const told = { drawn: 0, settled: 0 };
  const picture = {
    surfaces: { shine: () => (told.drawn += 1) },
    people: { shine: () => {} },
    smoke: { shine: () => {}, flames: { shine: () => {} } },
    signs: { shine: () => {} },
    lamps: { shine: () => {} },
    setWhite: () => {},
    again: () => {},
  };
  const live = { scene: null, shown: null, settle: () => ++told.settled, setFactor: () => {} };
  return { light: new LightDisplay(picture, live), live, told };
}

test('refined light of one group waits for others, all other light does not', () => {
  const { light, told } = display();
  light.arrived(null);
  light.update(1000);
  assert.equal(told.drawn, 1);
  light.arrived(3);
  light.update(1100);
  assert.equal(told.drawn, 1);
  assert.ok(!light.settled);
  light.update(1300);
  assert.equal(told.drawn, 2);
  assert.ok(light.settled);
});

test('the sums are recomputed once after the last dimming', () => {
  const { light, told } = display();
  light.dimmed();
  light.update(performance.now());
  assert.equal(told.settled, 0);
  assert.ok(!light.settled);
  light.update(performance.now() + 1000);
  light.update(performance.now() + 2000);
  assert.equal(told.settled, 1);
});

test('a group being dimmed ignores its echo, and is sent to the program by name', () => {
  const { light, live } = display();
  const said = [];
  const edits = new Edits(live, light, (message, key) => said.push([message, key]));
  assert.ok(!live.held('lamp'));
  edits.dim('lamp', 0.5);
  assert.ok(live.held('lamp'));
  assert.ok(!live.held('other'));
  assert.deepEqual(said, [[{ type: 'factor', group: 'lamp', factor: 0.5 }, 'factor lamp']]);
});
