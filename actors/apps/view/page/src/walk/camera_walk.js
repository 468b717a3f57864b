// The walk of the camera: where it stands, how steps, turns and jumps move it, and the rays through
// its picture. Knows the building's walls and floors, and no lights.
import { pan, rayThrough, speeds, stand, startMotion, stride, turn, viewOf, zoom }
  from './motion.js';
import { add, length } from './vectors.js';

/** So long after the last move the picture is drawn finely [ms]. */
const still_ms = 160;

export class CameraWalk {
  /** `moved(motion)`: another point of view; `stood()`: another mode, or another standpoint. */
  constructor(picture, { moved, stood }) {
    Object.assign(this, { picture, moved, stood });
    this.motion = startMotion([0, 0, 0], [10, 10, 3]);
    /** Whether walls stop the walk. */
    this.solid = true;
    this.building = null;
    this.movedAt = 0;
    /** Whether the picture shows this point of view. */
    this.shown = true;
  }

  /** The first scene says where to stand; later ones leave the camera where it is. */
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

  /** A move that is not shown yet counts, however long the picture before it took. */
  get moving() {
    return !this.shown || performance.now() - this.movedAt < still_ms;
  }

  /** `shift` in plan, where there is nothing to turn. */
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

  /** Some metres; `shift` where nobody walks. */
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

  /** What held keys ask for, as long as a picture took. */
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

  /** The height above which plan and orbit show nothing. */
  setCut(height) {
    this.motion.plan.cut = height;
    if (this.building) this.picture.marks.setWalls(this.building.section(height));
    this.picture.marks.backdrops.cutAt(height);
    this.change();
  }

  /** To an observer, who looks along `gaze`, or a camera, which looks at `target`. */
  jump({ eye, gaze, target, fov }) {
    const floor = this.building?.floorUnder(eye) ?? null;
    this.change(() => stand(this.motion, eye, target ?? add(eye, gaze), fov, floor));
    this.stood();
  }

  get aspect() {
    return this.picture.width / this.picture.height;
  }

  /** Through a place of the picture, each from -1 to 1, right and up. */
  ray(x, y) {
    return rayThrough(viewOf(this.motion), this.aspect, x, y);
  }

  get view() {
    return viewOf(this.motion);
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
