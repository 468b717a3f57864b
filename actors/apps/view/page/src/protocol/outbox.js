// What the page wants to say, slowly enough: the program takes 50 messages a second of a viewer.
// A message with a key replaces the one of the same key that still waits, so that a slider pulled
// from end to end sends its last value and few between.

export const intervalMs = 40;

export class Outbox {
  /** `send(text)`; `later(f, ms)` calls f after a while (setTimeout, or a test's own clock). */
  constructor(send, later = (f, ms) => setTimeout(f, ms)) {
    this.send = send;
    this.later = later;
    this.waiting = new Map();
    this.resting = false;
    this.unkeyed = 0;
  }

  put(message, key = `#${++this.unkeyed}`) {
    this.waiting.set(key, message);
    if (!this.resting) this.flushOne();
  }

  clear() {
    this.waiting.clear();
  }

  flushOne() {
    const [first] = this.waiting;
    this.resting = first !== undefined;
    if (!first) return;
    this.waiting.delete(first[0]);
    this.send(JSON.stringify(first[1]));
    this.later(() => this.flushOne(), intervalMs);
  }
}
