// The page of `luxodus view`: makes its parts, connects them, and runs the frame loop.
import './page.css';
import { LightDisplay } from './draw/light_display.js';
import { Picture } from './draw/picture.js';
import { SceneBuilding } from './draw/scene_building.js';
import { Edits } from './edit/edits.js';
import { diamond, Selection } from './edit/selection.js';
import { byId, el } from './panel/dom.js';
import { Panels } from './panel/panels.js';
import { sizeOf } from './panel/traced.js';
import { toast } from './panel/toasts.js';
import { Connection, backdropsOf, libraryOf, liveAddress, peopleOf }
  from './protocol/connection.js';
import { Live } from './state.js';
import { CameraWalk } from './walk/camera_walk.js';
import { Hands } from './walk/hands.js';
import { keyActions } from './walk/keys.js';
import { presenceOf } from './walk/people_at.js';

class Page {
  constructor() {
    const canvas = byId('picture');
    this.picture = new Picture(canvas);
    this.picture.hurried = matchMedia('(prefers-reduced-motion: reduce)').matches;
    this.picture.liveFlames = !this.picture.hurried;
    this.live = new Live((event, detail) => this.hears[event]?.(detail));
    this.light = new LightDisplay(this.picture, this.live);
    this.walk = new CameraWalk(this.picture, {
      moved: (motion) => this.panels.views.show(motion),
      stood: () => this.building.placeMarks(),
    });
    this.building = new SceneBuilding(this.picture, this.live, this.walk);
    this.edits = new Edits(this.live, this.light, (...said) => this.connection.say(...said));
    this.panels = new Panels(this.picture, this.wants());
    this.selection = new Selection(this);
    this.hears = this.listeners();
    this.hands = new Hands(canvas, this.gestures());
    this.connection = new Connection(liveAddress(location.href), {
      heard: (heard) => this.live.hear(heard),
      state: (state, words) => this.linked(state, words),
      fault: (words) => toast(words),
    });
    backdropsOf(location.href)
      .then((drawings) => this.building.backdrops(drawings))
      .catch((fault) => toast(`The drawings under the plan are not shown: ${fault.message}`));
    libraryOf(location.href)
      .then((library) => this.panels.library.set(library))
      .catch((fault) => toast(`Nothing can be added from the library: ${fault.message}`));
    peopleOf(location.href)
      .then((walkers) => this.walkers(walkers))
      .catch((fault) => toast(`The people who walk are not shown: ${fault.message}`));
    new ResizeObserver(() => this.walk.resize(canvas)).observe(canvas);
    this.last = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }

  /** Actions of the panels' buttons, boxes and sliders. */
  wants() {
    const { walk, edits, building, light } = this;
    return {
      say: (message, key) => edits.say(message, key),
      dim: (name, factor) => edits.dim(name, factor),
      goTo: (done) => this.goTo(done),
      solid: (on) => (walk.solid = on),
      smooth: (on) => light.smooth(on),
      flames: (on) => (this.picture.liveFlames = on),
      marks: (on) => building.showMarks(on),
      suggest: (answer) => building.showSuggestion(answer),
      placed: (time) => building.placePeople(time),
      point: (place) => this.point(place),
      addKind: (kind) => this.selection.addKind(kind),
      selection: {
        nudge: (way, metres) => this.selection.mover.nudge(way, metres),
        place: (axis, metres) => this.selection.mover.place(axis, metres),
        snap: (on) => (this.selection.mover.snaps = on),
        copy: () => this.selection.mover.copy(),
        remove: () => this.selection.remove(),
        close: () => this.selection.clear(),
      },
      views: {
        mode: (mode) => walk.setMode(mode),
        height: (metres) => walk.setHeight(metres),
        jump: (place) => walk.jump(place),
        cut: (height) => walk.setCut(height),
        help: () => byId('help').showModal(),
        render: () => this.render(),
      },
    };
  }

  /** Actions of pointer and keyboard on the picture. */
  gestures() {
    const { walk, selection } = this;
    const keys = keyActions(this);
    return {
      look: (dx, dy, shift) => walk.look(dx, dy, shift),
      shift: (right, up) => walk.shift(right, up),
      zoom: (factor) => walk.zoom(factor),
      step: (forward, side, shift) => walk.step(forward, side, shift),
      click: (x, y) => selection.click(x, y),
      grab: (x, y) => selection.grab(x, y),
      drag: (x, y) => selection.drag(x, y),
      drop: () => selection.mover.drop(),
      key: (code) => keys[code]?.(),
      undo: () => this.panels.history.back(),
      redo: () => this.panels.history.again(),
    };
  }

  /** Receivers of the program's messages, by the events of `Live`. */
  listeners() {
    const { panels, building, light, selection, edits } = this;
    return {
      scene: (scene) => this.shown(scene),
      geometry: (geometry) => (building.geometry(geometry), panels.clock.lay(), light.changed()),
      smoke: (generation) => (building.smoke(generation), light.changed()),
      light: (group) => light.arrived(group),
      fading: (now) => (light.fading(now), panels.top.fading(now)),
      progress: (progress) => panels.top.progress(progress),
      factors: (changes) => (panels.groups.factors(changes), light.dimmed()),
      time: ({ seconds }) =>
        (panels.state.time(seconds), light.dimmed(), panels.checks.changed()),
      probe: (answer) => panels.inspect.probe(answer),
      sign: (verdicts) => panels.inspect.judged(verdicts),
      suggested: (answer) => panels.suggest.suggested(answer),
      checks: (checks) => panels.checks.checked(checks),
      added: (copy) => (selection.awaited = copy),
      picture: (picture) => panels.traced.show(picture),
      step: ({ last }) => (panels.history.goesOn(last), panels.checks.changed()),
      history: (history) => (panels.history.set(history), panels.checks.changed()),
      saved: ({ file }) => toast(`Saved as ${file}`, 'good'),
      refused: (refusal) => this.refused(refusal),
      editor: ({ editor }) => panels.edits(editor),
    };
  }

  walkers(walkers) {
    this.building.setWalkers(walkers);
    this.panels.clock.people(presenceOf(walkers));
  }

  linked(state, words) {
    if (state === 'open') this.live.forget();
    else {
      this.panels.edits(false);
      this.panels.clock.forget();
      this.panels.traced.fail();
    }
    this.panels.top.link(state, words);
  }

  /** Undoes or redoes; a move that is not sent yet is forgotten. */
  goTo(done) {
    this.selection.mover.cancel();
    this.edits.goTo(done);
  }

  shown(scene) {
    const at = scene.states?.at ?? null;
    if (at !== this.shownAt) this.panels.checks.changed();
    this.shownAt = at;
    this.panels.scene(scene);
    this.walk.start(scene);
    this.building.scene(scene);
    this.selection.keep(scene);
    this.light.changed();
  }

  refused({ why, picture, suggestion, checks, sign }) {
    if (checks) return this.panels.checks.refused(why);
    if (sign !== null) return this.panels.inspect.refused(sign, why);
    toast(`Refused: ${why}`);
    this.panels.history.refused();
    if (picture !== null) return this.panels.traced.refused(picture);
    if (suggestion) return this.panels.suggest.refused();
    const { scene } = this.live;
    if (!scene) return;
    this.panels.state.scene(scene);
    this.panels.clock.forget();
    this.selection.keep(scene);
  }

  /** Marks a place, and brings it into view. */
  point(place) {
    this.selection.clear();
    this.building.outline(diamond(place, [0, 0, 1]));
    this.walk.face(place);
  }

  /** A traced picture of the current view. A plan has no perspective. */
  render() {
    const { live, walk, picture, panels } = this;
    if (!live.scene || walk.inPlan) return;
    const { clientWidth, clientHeight } = picture.renderer.domElement;
    panels.traced.ask(walk.view, sizeOf(clientWidth, clientHeight),
      picture.exposure.rendition === 'eye', live.scene.name);
  }

  tick(now) {
    const elapsed = Math.min(0.5, (now - this.last) / 1000);
    this.last = now;
    this.walk.goOn(this.hands.held, Math.min(0.1, elapsed));
    this.panels.clock.tick(elapsed);
    this.light.update(now);
    const burning = this.picture.flamesMove();
    if (burning) this.picture.burn(elapsed);
    const moving = this.walk.moving || this.panels.clock.moving || burning;
    this.walk.show();
    if (this.picture.draw(elapsed, moving)) {
      this.panels.rendition.show();
      this.panels.labels.draw(this.picture.camera, this.walk.motion);
      this.panels.planKey.show(this.walk.motion, this.picture.size[1]);
    }
    requestAnimationFrame((then) => this.tick(then));
  }

  /** Nothing waits to be shown. */
  get settled() {
    return this.light.settled && this.walk.shown && !this.panels.clock.moving &&
      !this.picture.flamesMove() && this.picture.complete;
  }
}

function begin() {
  try {
    const page = new Page();
    // For tests and for the browser's console.
    window.luxodus = {
      page,
      meanLuminance: () => page.picture.meanLuminance(),
      settled: async () => {
        const wait = () => new Promise((done) => requestAnimationFrame(done));
        do await wait();
        while (!page.settled);
      },
    };
  } catch (error) {
    document.body.append(el('p', { className: 'failure', textContent:
      `The view needs WebGL 2 with floating-point targets. ${error.message}` }));
  }
}

begin();
