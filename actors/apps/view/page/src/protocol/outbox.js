// Limits the rate of outgoing messages: the program accepts 50 messages a second from a viewer. A
// message replaces a waiting one with the same key, so that a dragged slider sends its last value
// and few in between.

export const intervalMs = 40;

export class Outbox {
  /** `send(text)`; `later(f, ms)` calls f after a delay (setTimeout, or a test's own clock). */
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
