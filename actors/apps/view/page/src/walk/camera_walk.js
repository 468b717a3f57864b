// Moves the camera: its position, how steps, turns and jumps change it, and the rays through its
// picture. Uses the building's walls and floors, but no light.
import { pan, rayThrough, speeds, stand, startMotion, stride, turn, viewOf, zoom }
  from './motion.js';
import { add, length } from './vectors.js';

/** Time after the last move until the picture is drawn finely [ms]. */
const still_ms = 160;

export class CameraWalk {
  /** `moved(motion)`: another point of view; `stood()`: another mode, or another standpoint. */
  constructor(picture, { moved, stood }) {
    Object.assign(this, { picture, moved, stood });
    this.motion = startMotion([0, 0, 0], [10, 10, 3]);
    /** Whether walls stop the walker. */
    this.solid = true;
    this.building = null;
    this.movedAt = 0;
    /** Whether the picture shows this point of view. */
    this.shown = true;
  }

  /** The first scene places the camera; later ones leave it where it is. */
  start({ low, high, cameras, observers }) {
    if (this.started) return;
    this.started = true;
    this.motion = startMotion(low, high, this.aspect);
    const [first] = observers.length ? observers : cameras;
    if (first) this.jump(first);
    this.change();
  }

  enter(building) {
    this.building = building;
    this.setCut(this.motion.plan.cut);
    const floor = building.floorUnder(this.motion.eye);
    if (floor !== null) this.motion.height = this.motion.eye[2] - floor;
  }

  change(how) {
    how?.();
    this.movedAt = performance.now();
    this.moved(this.motion);
    this.shown = false;
  }

  /** A move that is not shown yet counts, however long the previous picture took. */
  get moving() {
    return !this.shown || performance.now() - this.movedAt < still_ms;
  }

  /** Turns the view; in plan, where nothing can be turned, calls `shift` instead. */
  look(dx, dy, shift) {
    if (this.motion.mode === 'plan') shift?.();
    else this.change(() => turn(this.motion, this.motion.mode === 'orbit' ? -dx : dx, dy));
  }

  shift(right, up) {
    this.change(() => pan(this.motion, right, up));
  }

  zoom(factor) {
    this.change(() => zoom(this.motion, factor));
  }

  /** Walks some metres; in other modes, calls `shift` instead. */
  step(forward, side, shift) {
    if (this.motion.mode !== 'walk') return shift();
    const asked = Math.hypot(forward, side);
    const step = stride(this.motion, { forward, side }, 1);
    const size = length(step) || 1;
    return this.go(step.map((x) => (x * asked) / size));
  }

  go(step) {
    const { motion, building } = this;
    this.change(() => {
      motion.eye = building
        ? building.walk(motion.eye, motion.height, step, this.solid)
        : add(motion.eye, step);
    });
  }

  /** Moves by the held keys, for the duration of a picture. */
  goOn(held, seconds) {
    const { motion } = this;
    if (held.turn || held.tilt)
      this.change(() => turn(motion, held.turn * speeds.turn * seconds,
        held.tilt * speeds.turn * seconds * 0.6));
    if (!held.forward && !held.side) return;
    if (motion.mode === 'walk') this.go(stride(motion, held, seconds));
    else this.shift(held.side * 0.5 * seconds, held.forward * 0.5 * seconds);
  }

  setMode(mode) {
    this.change(() => (this.motion.mode = mode));
    this.stood();
  }

  setHeight(metres) {
    const { motion } = this;
    motion.eye[2] += metres - motion.height;
    motion.height = metres;
    this.go([0, 0, 0]);
  }

  /** Plan and orbit show nothing above this height. */
  setCut(height) {
    this.motion.plan.cut = height;
    if (this.building) this.picture.marks.setWalls(this.building.section(height));
    this.picture.marks.backdrops.cutAt(height);
    this.change();
    this.stood();
  }

  /** Brings a place into view: to the middle of plan and orbit; else the walker turns to it. */
  face(place) {
    const { motion } = this;
    this.change(() => {
      if (motion.mode === 'plan') motion.plan.centre = [place[0], place[1]];
      else if (motion.mode === 'orbit') motion.orbit.centre = [...place];
      else stand(motion, motion.eye, place, motion.fov);
    });
  }

  /** Jumps to an observer, who looks along `gaze`, or a camera, which looks at `target`. */
  jump({ eye, gaze, target, fov }) {
    const floor = this.building?.floorUnder(eye) ?? null;
    this.change(() => stand(this.motion, eye, target ?? add(eye, gaze), fov, floor));
    this.stood();
  }

  get aspect() {
    return this.picture.width / this.picture.height;
  }

  /** The ray through a position in the picture, each from -1 to 1, right and up. */
  ray(x, y) {
    return rayThrough(viewOf(this.motion), this.aspect, x, y);
  }

  get view() {
    return viewOf(this.motion);
  }

  /** The way the view looks, from +x towards +y. */
  get yaw() {
    const { eye, target } = this.view;
    return Math.atan2(target[1] - eye[1], target[0] - eye[0]);
  }

  get inPlan() {
    return this.motion.mode === 'plan';
  }

  get cut() {
    return this.motion.mode === 'walk' ? null : this.motion.plan.cut;
  }

  resize({ clientWidth, clientHeight }) {
    this.picture.resize(clientWidth, clientHeight);
    this.shown = false;
  }

  show() {
    if (!this.shown) this.picture.look(viewOf(this.motion), this.cut);
    this.shown = true;
  }
}
