// Actions of single keys, as listed in the page's help. Keys that are held down to walk are in
// hands.js.
import { byId } from '../panel/dom.js';
import { eyeHeights } from './motion.js';

/** Actions by key code. */
export function keyActions(page) {
  const { walk, panels, selection } = page;
  const nearer = () => walk.zoom(0.9);
  const farther = () => walk.zoom(1.1);
  const actions = {
    '?': () => byId('help').showModal(),
    KeyG: () => walk.setMode('walk'),
    KeyO: () => walk.setMode('orbit'),
    KeyP: () => walk.setMode('plan'),
    KeyV: () => panels.rendition.next(),
    KeyM: () => panels.marks.click(),
    KeyR: () => page.render(),
    KeyK: () => panels.clock.toggle(),
    KeyN: () => selection.next(),
    KeyL: () => page.hands.lock(),
    Escape: () => selection.clear(),
    Equal: nearer,
    NumpadAdd: nearer,
    Minus: farther,
    NumpadSubtract: farther,
  };
  Object.values(eyeHeights).forEach((metres, i) => {
    actions[`Digit${i + 1}`] = () => walk.setHeight(metres);
  });
  return actions;
}
