// What this viewer has changed: said to the program, and shown at once where the page can do so
// itself. What comes back of a slider under the viewer's own hand is an echo, and older.
import { toast } from '../panel/toasts.js';

/** While a hand is on a slider its own value counts, not the echo of it [ms]. */
const echo_ms = 1000;

export class Edits {
  /** `send(message, key)` says whether there is a connection. */
  constructor(live, light, send) {
    Object.assign(this, { live, light, send });
    this.heldUntil = new Map();
    live.held = (name) => this.heldUntil.get(name) > performance.now();
  }

  /** `key`: a later message of the same key takes the place of one that still waits. */
  say(message, key) {
    if (!this.send(message, key)) toast('Not connected: nothing was sent.');
  }

  dim(name, factor) {
    this.heldUntil.set(name, performance.now() + echo_ms);
    this.live.setFactor(name, factor);
    this.light.settleLater();
    this.say({ type: 'factor', group: name, factor }, `factor ${name}`);
  }
}
