// The page of `luxodus view`: everything is made here and told of each other.
import './page.css';
import { Picture } from './draw/picture.js';
import { Labels } from './panel/labels.js';
import { byId, el } from './panel/dom.js';
import { Groups } from './panel/groups.js';
import { Inspect } from './panel/inspect.js';
import { Rendition } from './panel/rendition.js';
import { StatePanel } from './panel/state_panel.js';
import { toast } from './panel/toasts.js';
import { Top } from './panel/top.js';
import { Views } from './panel/views.js';
import { Mover } from './mover.js';
import { Connection, liveAddress } from './protocol/connection.js';
import { Live, weightOf } from './state.js';
import { Building } from './walk/building.js';
import { Hands } from './walk/hands.js';
import { eyeHeights, pan, rayThrough, speeds, stand, startMotion, stride, turn, viewOf, zoom }
  from './walk/motion.js';
import { add, cross, length, scale, unit } from './walk/vectors.js';

/** After the last dimming the sums are made afresh; after the last move the picture is fine. */
const settle_ms = 400;
const still_ms = 160;
/** While a hand is on a slider its own value counts, not the echo of it. */
const echo_ms = 1000;
const luminaireReach_px = 14;
/** Refined light comes group by group, many times: so often is it brought to the screen. */
const gather_ms = 250;
const probe_m = 0.05;

class Page {
  constructor() {
    this.picture = new Picture(byId('picture'));
    this.picture.hurried = matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.live = new Live((event, detail) => this[`on_${event}`]?.(detail));
    this.dirty = new Set();
    this.held = new Map();
    this.live.held = (name) => this.held.get(name) > performance.now();
    this.motion = startMotion([0, 0, 0], [10, 10, 3]);
    this.solid = true;
    this.movedAt = 0;
    this.settleAt = Infinity;
    this.probes = 0;
    this.makePanels();
    this.hands = new Hands(byId('picture'), this.wants());
    this.connection = new Connection(liveAddress(location.href), {
      heard: (heard) => this.live.hear(heard),
      state: (state, words) => this.on_link(state, words),
      fault: (words) => toast(words),
    });
    new ResizeObserver(() => this.resize()).observe(byId('picture'));
    this.last = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }

  makePanels() {
    const say = (message, key) => this.say(message, key);
    this.top = new Top({ edit: (wanted) => say({ type: 'edit', wanted }) });
    this.state = new StatePanel({ say });
    this.groups = new Groups({ dim: (name, factor) => this.dim(name, factor) });
    this.rendition = new Rendition(this.picture.exposure, () => (this.picture.untoned = true));
    this.rendition.check('collide with walls', true, (on) => (this.solid = on));
    this.rendition.check('smooth light', true, (on) => {
      this.picture.surfaces.setSmooth(on);
      this.dirty.add('light');
    });
    this.marksBox = this.rendition.check('marks', true, () => this.placeMarks());
    this.inspect = new Inspect({
      nudge: (way, metres) => this.mover.nudge(way, metres),
      copy: () => this.mover.copy(),
      remove: () => this.say({ type: 'remove', name: this.inspect.subject.name }),
      close: () => this.deselect(),
    });
    this.mover = new Mover({
      say,
      outline: (corners) => this.outline(corners),
      moved: (position) => this.inspect.moved(position),
    });
    this.views = new Views({
      mode: (mode) => this.setMode(mode),
      height: (metres) => this.setHeight(metres),
      jump: (place) => this.jump(place),
      cut: (height) => this.setCut(height),
      help: () => byId('help').showModal(),
    });
    this.labels = new Labels(byId('labels'));
    byId('panel').append(this.inspect.element, this.state.element, this.groups.element,
      this.rendition.element, this.state.saveElement);
    this.on_editor({ editor: false });
  }

  wants() {
    return {
      look: (dx, dy, shift) => this.look(dx, dy, shift),
      shift: (right, up) => this.moving(() => pan(this.motion, right, up)),
      zoom: (factor) => this.moving(() => zoom(this.motion, factor)),
      step: (forward, side, shift) => this.stepBy(forward, side, shift),
      click: (x, y) => this.click(x, y),
      grab: (x, y) => this.grab(x, y),
      drag: (x, y) => {
        const { origin, direction } = this.ray(x, y);
        this.mover.drag(origin, direction);
      },
      drop: () => this.mover.send(),
      key: (code) => this.key(code),
    };
  }

  // What the program tells.

  on_link(state, words) {
    if (state === 'open') this.live.forget();
    else this.on_editor({ editor: false });
    this.top.link(state, words);
  }

  on_scene(scene) {
    this.top.scene(scene);
    this.state.scene(scene);
    this.groups.scene(scene);
    this.views.scene(scene);
    this.labels.scene(scene);
    this.on_editor({ editor: scene.editor });
    if (!this.started) this.start(scene);
    this.picture.signs.build(scene.signs);
    this.keepSelection(scene);
    this.placeMarks();
    this.dirty.add('light');
  }

  start({ low, high, cameras, observers }) {
    this.started = true;
    this.motion = startMotion(low, high, this.picture.width / this.picture.height);
    const [first] = observers.length ? observers : cameras;
    if (first) this.jump(first);
    this.moving();
  }

  on_geometry(geometry) {
    this.building = new Building(geometry);
    this.picture.surfaces.build(geometry);
    this.dirty.add('light');
    this.setCut(this.motion.plan.cut);
    const floor = this.building.floorUnder(this.motion.eye);
    if (floor !== null) this.motion.height = this.motion.eye[2] - floor;
  }

  on_smoke({ scene, smoke }) {
    const held = this.picture.smoke.build(
      scene.voxels, smoke?.halves ?? null, this.picture.voxelsMost);
    if (!held) toast('This graphics card cannot hold so many voxels: the smoke is not drawn.');
    this.dirty.add('light');
  }

  /** New light of one group is one of many: it waits a little for the others. */
  on_light(group) {
    this.dirty.add(group === null ? 'light' : 'more light');
  }

  on_fading(now) {
    this.picture.fade.wanted = now ? 1 : 0;
    this.top.fading(now);
  }

  on_progress(progress) {
    this.top.progress(progress);
  }

  on_factors(changes) {
    this.groups.factors(changes);
    this.dirty.add('light');
    this.settleAt = performance.now() + settle_ms;
  }

  on_time({ seconds }) {
    this.state.time(seconds);
    this.dirty.add('light');
    this.settleAt = performance.now() + settle_ms;
  }

  on_probe(answer) {
    this.inspect.probe(answer);
  }

  on_sign(verdicts) {
    this.inspect.judged(verdicts);
  }

  /** A copy that was asked for here is selected when it is there. */
  on_added({ kind, name }) {
    this.copy = { kind, name };
  }

  on_saved({ file }) {
    toast(`Saved as ${file}`, 'good');
  }

  on_refused({ why }) {
    toast(`Refused: ${why}`);
    const { scene } = this.live;
    if (!scene) return;
    this.state.scene(scene);
    this.keepSelection(scene);
  }

  on_editor({ editor }) {
    this.editor = editor;
    for (const part of [this.top, this.state, this.groups, this.inspect]) part.edits(editor);
  }

  // What hands want.

  say(message, key) {
    if (!this.connection.say(message, key)) toast('Not connected: nothing was sent.');
  }

  dim(name, factor) {
    this.held.set(name, performance.now() + echo_ms);
    this.live.setFactor(name, factor);
    this.settleAt = performance.now() + settle_ms;
    this.say({ type: 'factor', group: name, factor }, `factor ${name}`);
  }

  /** Changes the point of view and says when. */
  moving(change) {
    change?.();
    this.movedAt = performance.now();
    this.views.show(this.motion);
    this.dirty.add('view');
  }

  look(dx, dy, shift) {
    if (this.motion.mode === 'plan') shift?.();
    else this.moving(() => turn(this.motion, this.motion.mode === 'orbit' ? -dx : dx, dy));
  }

  stepBy(forward, side, shift) {
    if (this.motion.mode !== 'walk') return shift();
    const asked = Math.hypot(forward, side);
    const step = stride(this.motion, { forward, side }, 1);
    const size = length(step) || 1;
    return this.go(step.map((x) => (x * asked) / size));
  }

  go(step) {
    const { motion, building } = this;
    this.moving(() => {
      motion.eye = building
        ? building.walk(motion.eye, motion.height, step, this.solid)
        : motion.eye.map((x, i) => x + step[i]);
    });
  }

  setMode(mode) {
    this.moving(() => (this.motion.mode = mode));
    this.placeMarks();
  }

  setHeight(metres) {
    const { motion } = this;
    motion.eye[2] += metres - motion.height;
    motion.height = metres;
    this.go([0, 0, 0]);
  }

  setCut(height) {
    this.motion.plan.cut = height;
    if (this.building) this.picture.marks.setWalls(this.building.section(height));
    this.moving();
  }

  /** To an observer, who looks along `gaze`, or a camera, which looks at `target`. */
  jump({ eye, gaze, target, fov }) {
    const floor = this.building?.floorUnder(eye) ?? null;
    this.moving(() => stand(this.motion, eye, target ?? add(eye, gaze), fov, floor));
    this.placeMarks();
  }

  key(code) {
    const modes = { KeyG: 'walk', KeyO: 'orbit', KeyP: 'plan' };
    const heights = Object.values(eyeHeights);
    if (code === '?') byId('help').showModal();
    else if (modes[code]) this.setMode(modes[code]);
    else if (/^Digit[123]$/.test(code)) this.setHeight(heights[Number(code.at(-1)) - 1]);
    else if (code === 'KeyV') this.rendition.next();
    else if (code === 'KeyM') this.marksBox.click();
    else if (code === 'KeyL') this.hands.lock();
    else if (code === 'Escape') this.deselect();
    else if (code === 'Equal' || code === 'NumpadAdd') this.moving(() => zoom(this.motion, 0.9));
    else if (code === 'Minus' || code === 'NumpadSubtract')
      this.moving(() => zoom(this.motion, 1.1));
  }

  walkOn(seconds) {
    const held = this.hands.held;
    const { motion } = this;
    if (held.turn || held.tilt)
      this.moving(() => turn(motion, held.turn * speeds.turn * seconds,
        held.tilt * speeds.turn * seconds * 0.6));
    if (!held.forward && !held.side) return;
    if (motion.mode === 'walk') this.go(stride(motion, held, seconds));
    else this.moving(() => pan(motion, held.side * 0.5 * seconds, held.forward * 0.5 * seconds));
  }

  // Pointing.

  ray(x, y) {
    return rayThrough(viewOf(this.motion), this.picture.width / this.picture.height, x, y);
  }

  get cut() {
    return this.motion.mode === 'walk' ? null : this.motion.plan.cut;
  }

  click(x, y) {
    if (!this.live.scene) return;
    const { origin, direction } = this.ray(x, y);
    const hit = this.building?.nearest(origin, direction, this.cut ?? Infinity) ?? null;
    const sign = this.signAt(x, y, hit);
    const luminaire = sign ? null : this.luminaireAt(x, y);
    if (sign) this.selectSign(sign);
    else if (luminaire) this.selectLuminaire(luminaire);
    else if (hit) this.probe(hit, this.picture.luminanceAt(x, y));
    else this.deselect();
  }

  signAt(x, y, hit) {
    if (this.motion.mode === 'plan') return this.markAt(x, y, this.live.scene.signs);
    const { origin, direction } = this.ray(x, y);
    return this.picture.signs.pointedAt(origin, direction, hit?.distance ?? 1e3);
  }

  luminaireAt(x, y) {
    return this.marksBox.checked ? this.markAt(x, y, this.live.scene.luminaires) : null;
  }

  /** The thing whose mark on the picture is nearest, if it is near. */
  markAt(x, y, things) {
    const box = byId('picture').getBoundingClientRect();
    let best = { apart: luminaireReach_px, thing: null };
    for (const thing of things) {
      const [px, py, ahead] = this.labels.project(thing.position, this.picture.camera);
      const apart = Math.hypot(((px - x) * box.width) / 2, ((py - y) * box.height) / 2);
      if (ahead && apart < best.apart) best = { apart, thing };
    }
    return best.thing;
  }

  selectSign(sign) {
    this.inspect.sign(sign);
    this.mover.hold('sign', sign);
    this.say({ type: 'judge', sign: sign.name });
    this.reveal();
  }

  selectLuminaire(luminaire) {
    this.inspect.luminaire(luminaire);
    this.mover.hold('luminaire', luminaire);
    this.reveal();
  }

  probe({ triangle, front, point, normal }, seen) {
    const id = ++this.probes;
    this.mover.release();
    this.outline(diamond(point, normal));
    this.inspect.surface({ id, point, seen });
    this.say({ type: 'probe', id, triangle, front, point }, 'probe');
    this.reveal();
  }

  reveal() {
    this.inspect.element.scrollIntoView({ block: 'nearest' });
  }

  deselect() {
    this.mover.release();
    this.inspect.clear();
  }

  /** A new generation may have moved what is selected, or judged it anew. */
  keepSelection(scene) {
    if (this.mover.pending) return;
    const lists = { sign: scene.signs, luminaire: scene.luminaires };
    const found = (wanted) => lists[wanted?.kind]?.find(({ name }) => name === wanted.name);
    const copy = found(this.copy);
    const { kind } = copy ? this.copy : this.inspect.subject ?? {};
    const thing = copy ?? found(this.inspect.subject);
    if (copy) this.copy = null;
    if (thing && kind === 'sign') this.selectSign(thing);
    else if (thing) this.selectLuminaire(thing);
    else if (lists[kind]) this.deselect();
  }

  grab(x, y) {
    const { thing, kind } = this.mover;
    if (!thing || !this.editor) return false;
    const { origin, direction } = this.ray(x, y);
    const plan = this.motion.mode === 'plan';
    const onIt = kind === 'sign' && !plan
      ? this.picture.signs.pointedAt(origin, direction, 1e3)?.name === thing.name
      : this.markAt(x, y, [thing]) !== null;
    return onIt && this.mover.grab(origin, direction, plan);
  }

  // The screen.

  outline(corners) {
    this.picture.marks.setOutline(corners);
    this.picture.untoned = true;
  }

  placeMarks() {
    if (!this.live.scene) return;
    this.picture.marks.wanted = this.marksBox.checked;
    const plan = this.motion.mode === 'plan';
    this.picture.marks.place(this.live.scene, plan, this.motion.eye);
    this.picture.untoned = true;
  }

  resize() {
    const canvas = byId('picture');
    this.picture.resize(canvas.clientWidth, canvas.clientHeight);
    this.dirty.add('view');
  }

  applyLight() {
    const { live, picture } = this;
    const groups = new Map((live.scene?.groups ?? []).map((g) => [g.name, weightOf(g)]));
    picture.surfaces.shine(live.shown?.surfaces ?? null);
    picture.smoke.shine(live.shown?.air ?? null);
    picture.signs.shine((name) => groups.get(name) ?? 1);
    picture.again();
  }

  update(now) {
    const more = this.dirty.has('more light') && now - (this.litAt ?? 0) > gather_ms;
    if (more || this.dirty.has('light')) {
      this.litAt = now;
      this.dirty.delete('more light');
      this.applyLight();
    }
    if (this.dirty.has('view')) this.picture.look(viewOf(this.motion), this.cut);
    this.dirty.delete('light');
    this.dirty.delete('view');
  }

  tick(now) {
    const elapsed = Math.min(0.5, (now - this.last) / 1000);
    this.last = now;
    this.walkOn(Math.min(0.1, elapsed));
    if (now > this.settleAt && this.live.settle(1)) this.settleAt = Infinity;
    this.update(now);
    const moving = performance.now() - this.movedAt < still_ms;
    if (this.picture.draw(elapsed, moving)) {
      this.rendition.show();
      this.labels.draw(this.picture.camera, this.motion.mode, this.motion.plan.cut);
    }
    requestAnimationFrame((then) => this.tick(then));
  }
}

/** A small mark that lies on a surface. */
function diamond(point, normal) {
  const side = unit(cross(normal, Math.abs(normal[2]) > 0.9 ? [1, 0, 0] : [0, 0, 1]));
  const other = cross(normal, side);
  return [side, other, scale(side, -1), scale(other, -1)].map((v) => add(point, scale(v, probe_m)));
}

function begin() {
  try {
    const page = new Page();
    // For tests and for the curious at the console.
    window.luxodus = {
      page,
      meanLuminance: () => page.picture.meanLuminance(),
      settled: async () => {
        const wait = () => new Promise((done) => requestAnimationFrame(done));
        do await wait();
        while (page.dirty.size || page.settleAt < Infinity || !page.picture.complete);
      },
    };
  } catch (error) {
    document.body.append(el('p', { className: 'failure', textContent:
      `The view needs WebGL 2 with floating-point targets. ${error.message}` }));
  }
}

begin();
