// Moves a sign or a luminaire: an outline follows the pointer; the program is told on release.
import { faceOf } from '../draw/signs.js';
import { axesOf, snapped } from './snap.js';
import { add, cross, dot, scale, subtract, unit } from '../walk/vectors.js';

/** Delay after the last press of a handle [ms]. */
const patience = 600;
const mark_m = 0.12;
/** Initial distance of a copy from the original; for wide signs, the gap between the two. */
const beside_m = 0.5;
const gap_m = 0.05;

export class Mover {
  /**
   * `say(message, key)` to the program; `outline(corners)`; `moved(position)` for the panel;
   * `yaw()` of the view, 90 degrees in plan; `others(kind, name)`: places of the other things.
   */
  constructor({ say, outline, moved, yaw, others }) {
    Object.assign(this, { say, outline, moved, yaw, others });
    this.snaps = true;
    this.release();
  }

  /** What waits to be sent of another thing is sent first, and a drag of it ends. */
  hold(kind, thing) {
    if (this.kind !== kind || this.thing?.name !== thing.name) this.release();
    clearTimeout(this.timer);
    this.pending = false;
    this.kind = kind;
    this.thing = { ...thing };
    this.from = thing.position;
    this.draw();
  }

  release() {
    if (this.pending) this.send();
    clearTimeout(this.timer);
    this.pending = false;
    this.thing = this.grip = null;
    this.outline([]);
  }

  /** Forgets a move that was not sent. */
  cancel() {
    clearTimeout(this.timer);
    if (!this.pending) return;
    this.pending = false;
    this.grip = null;
    this.thing.position = this.from;
    this.moved(this.from);
    this.draw();
  }

  /**
   * Right, up and out of the wall; for a luminaire the building's axes that are nearest to the
   * view's right and depth, and down.
   */
  get axes() {
    const { facing, up } = this.thing;
    if (!facing) {
      const { ahead, right } = axesOf(this.yaw());
      return { right, up: ahead, out: [0, 0, -1] };
    }
    const out = unit(facing);
    const right = unit(cross(up, out), [1, 0, 0]);
    return { right, up: cross(out, right), out };
  }

  nudge(way, metres) {
    if (!this.thing) return;
    const { right, up, out } = this.axes;
    const by = { left: scale(right, -1), right, up, down: scale(up, -1), ahead: out,
      back: scale(out, -1) }[way];
    this.to(add(this.thing.position, scale(by, metres)));
    this.sendSoon();
  }

  sendSoon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.send(), patience);
  }

  /** A coordinate that was typed; the others stay as they are. */
  place(axis, metres) {
    if (!this.thing || !Number.isFinite(metres)) return;
    this.to(this.thing.position.map((x, k) => (k === axis ? metres : x)));
    this.send();
  }

  /** Starts dragging along a ray; `plan`: in the horizontal plane instead of the wall's. */
  grab(origin, direction, plan) {
    this.normal = plan || !this.thing.facing ? [0, 0, 1] : this.axes.out;
    const point = this.onPlane(origin, direction);
    this.grip = point && subtract(this.thing.position, point);
    return Boolean(point);
  }

  onPlane(origin, direction) {
    const steep = dot(direction, this.normal);
    if (Math.abs(steep) < 1e-3) return null;
    const distance = dot(subtract(this.thing.position, origin), this.normal) / steep;
    return distance > 0 ? add(origin, scale(direction, distance)) : null;
  }

  drag(origin, direction) {
    const point = this.grip && this.onPlane(origin, direction);
    if (!point) return;
    const position = add(point, this.grip);
    this.to(this.snaps ? snapped(position, this.others(this.kind, this.thing.name), this.slides)
      : position);
  }

  /**
   * Coordinates that snap: of a drag in plan the horizontal ones, along a wall those in it. A thing
   * with a facing never snaps through its wall, so on an oblique one only its height does.
   */
  get slides() {
    const inPlan = this.normal[2] === 1;
    const { facing } = this.thing;
    return [0, 1, 2].map((k) => (k < 2 || !inPlan) && !(Math.abs(facing?.[k] ?? 0) > 1e-3));
  }

  /** Ends a drag. */
  drop() {
    this.grip = null;
    if (this.pending) this.send();
  }

  to(position) {
    this.pending = true;
    this.thing.position = position;
    this.moved(position);
    this.draw();
  }

  /** Requests a copy beside the held thing: for a sign, along its width. */
  copy() {
    if (this.pending) this.send();
    const { name, position, facing, width = 0 } = this.thing;
    const apart = Math.max(beside_m, width + gap_m);
    this.say({ type: 'add', kind: this.kind, of: name,
      position: add(position, scale(this.axes.right, apart)), ...(facing && { facing }) });
  }

  send() {
    clearTimeout(this.timer);
    this.pending = false;
    const { name, position, facing } = this.thing;
    this.from = position;
    this.say({ type: 'move', kind: this.kind, name, position, ...(facing && { facing }) }, 'move');
  }

  draw() {
    const { position, facing } = this.thing;
    if (facing) this.outline(faceOf(this.thing));
    else
      this.outline([[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) =>
        add(position, [x * mark_m, y * mark_m, 0])));
  }
}
