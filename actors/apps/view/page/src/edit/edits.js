// This viewer's changes: sent to the program, and shown at once if the page can compute them. A
// value that comes back while the viewer drags its slider is an older echo.
import { toast } from '../panel/toasts.js';

/** While a slider is dragged its own value counts, not the echo of it [ms]. */
const echo_ms = 1000;

export class Edits {
  /** `send(message, key)` returns whether there is a connection. */
  constructor(live, light, send) {
    Object.assign(this, { live, light, send });
    this.heldUntil = new Map();
    live.held = (name) => this.heldUntil.get(name) > performance.now();
  }

  /** `key`: a later message with the same key replaces one that still waits. */
  say(message, key) {
    if (!this.send(message, key)) toast('Not connected: nothing was sent.');
  }

  dim(name, factor) {
    this.heldUntil.set(name, performance.now() + echo_ms);
    this.live.setFactor(name, factor);
    this.light.settleLater();
    this.say({ type: 'factor', group: name, factor }, `factor ${name}`);
  }

  /** Undoes or redoes steps; factors that come back are no echoes. */
  goTo(done) {
    this.heldUntil.clear();
    this.say({ type: 'history', done }, 'history');
  }
}
