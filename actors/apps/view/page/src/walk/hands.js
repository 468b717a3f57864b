// Turns keyboard, mouse and touch input into actions.

const turnPerPixel = 0.0032;
const clickPixels = 5;
const walkPerPixel = 0.012;

const writable = 'input:not([type=range]):not([type=checkbox]), select';
const typing = (target) => target instanceof Element && target.closest(writable);
const control = (target) => target instanceof Element && target.matches('input, button, summary');

const walkKeys = new Set(['KeyW', 'KeyA', 'KeyS', 'KeyD', 'KeyQ', 'KeyE', 'ArrowUp', 'ArrowDown',
  'ArrowLeft', 'ArrowRight', 'PageUp', 'PageDown']);

export class Hands {
  /**
   * `wants`: look(dx, dy) in radians, shift(right, up) in shares of the height, zoom(factor),
   * click(x, y) and grab(x, y), drag(x, y), drop() in picture positions from -1 to 1, step(forward,
   * side) in metres, key(code), undo(), redo(). `grab` returns whether something is dragged.
   */
  constructor(canvas, wants) {
    Object.assign(this, { canvas, wants });
    this.keys = new Set();
    this.fingers = new Map();
    canvas.addEventListener('pointerdown', (e) => this.down(e));
    canvas.addEventListener('pointermove', (e) => this.move(e));
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, (e) => this.up(e));
    canvas.addEventListener('wheel', (e) => this.wheel(e), { passive: false });
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    addEventListener('keydown', (e) => this.keyDown(e));
    addEventListener('keyup', (e) => this.keys.delete(e.code));
    addEventListener('blur', () => this.keys.clear());
  }

  /** The directions of the held keys: each from -1 to 1. */
  get held() {
    const axis = (plus, minus) => Number(plus.some((k) => this.keys.has(k))) -
      Number(minus.some((k) => this.keys.has(k)));
    return {
      forward: axis(['KeyW', 'ArrowUp'], ['KeyS', 'ArrowDown']),
      side: axis(['KeyD'], ['KeyA']),
      turn: axis(['KeyQ', 'ArrowLeft'], ['KeyE', 'ArrowRight']),
      tilt: axis(['PageUp'], ['PageDown']),
      fast: this.keys.has('ShiftLeft') || this.keys.has('ShiftRight'),
    };
  }

  keyDown(event) {
    if (document.querySelector('dialog[open]')) return;
    if (typing(event.target) || event.altKey) return;
    if (event.ctrlKey || event.metaKey) return this.combined(event);
    if (control(event.target) && /^(Arrow|Page)/.test(event.code)) return;
    if (walkKeys.has(event.code)) event.preventDefault();
    this.keys.add(event.code);
    if (!event.repeat) this.wants.key(event.key === '?' ? '?' : event.code);
  }

  /** Keys together with Ctrl, or with Command on a Mac. Letters count, whatever the layout. */
  combined(event) {
    const letter = event.key.toLowerCase();
    const wanted = letter === 'y' || (letter === 'z' && event.shiftKey) ? 'redo'
      : letter === 'z' ? 'undo' : null;
    if (!wanted) return;
    event.preventDefault();
    this.wants[wanted]();
  }

  place({ clientX, clientY }) {
    const box = this.canvas.getBoundingClientRect();
    return [
      (2 * (clientX - box.left)) / box.width - 1,
      1 - (2 * (clientY - box.top)) / box.height,
    ];
  }

  down(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture?.(event.pointerId);
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.holding && this.travelled > clickPixels) this.wants.drop();
    this.travelled = this.fingers.size > 1 ? Infinity : 0;
    this.holding = this.fingers.size === 1 && this.wants.grab(...this.place(event));
  }

  move(event) {
    if (document.pointerLockElement === this.canvas) {
      this.wants.look(-event.movementX * turnPerPixel, -event.movementY * turnPerPixel);
      return;
    }
    const finger = this.fingers.get(event.pointerId);
    if (!finger) return;
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    this.travelled += Math.hypot(dx, dy);
    if (this.fingers.size === 2) this.two(event.pointerId, dx, dy);
    else if (this.holding) this.wants.drag(...this.place(event));
    else if (event.buttons === 2) this.shift(dx, dy);
    else this.one(dx, dy);
    Object.assign(finger, { x: event.clientX, y: event.clientY });
  }

  one(dx, dy) {
    this.wants.look(dx * turnPerPixel, dy * turnPerPixel, () => this.shift(dx, dy));
  }

  shift(dx, dy) {
    const height = this.canvas.clientHeight;
    this.wants.shift(-dx / height, dy / height);
  }

  /** Two fingers: moving together they walk, pinching they zoom. */
  two(id, dx, dy) {
    const ends = [...this.fingers.entries()];
    const moved = ends.find(([key]) => key === id)[1];
    const other = ends.find(([key]) => key !== id)[1];
    const before = Math.hypot(moved.x - other.x, moved.y - other.y);
    const after = Math.hypot(moved.x + dx - other.x, moved.y + dy - other.y);
    const metres = walkPerPixel / 2;
    this.wants.step(-dy * metres, dx * metres, () => this.shift(dx / 2, dy / 2));
    if (before > 10 && after > 10) this.wants.zoom(before / after);
  }

  up(event) {
    if (!this.fingers.delete(event.pointerId)) return;
    if (this.holding && this.travelled > clickPixels) this.wants.drop();
    else if (this.travelled <= clickPixels && event.type === 'pointerup')
      this.wants.click(...this.place(event));
    this.holding = false;
    this.travelled = Infinity;
  }

  wheel(event) {
    event.preventDefault();
    this.wants.zoom(Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.0015));
  }

  lock() {
    this.canvas.requestPointerLock?.();
  }
}
