// The picture: surfaces and signs, then smoke, then accumulation of several such pictures while the
// camera is still (which also smooths edges), then exposure and the screen.
import * as THREE from 'three';
import { scaleTexels } from '../light/colours.js';
import { halfValues } from '../protocol/half.js';
import { Exposure, renditions } from './exposure.js';
import { brighterThanMean } from './flame_shape.js';
import { composeFragment, meterFragment, screenVertex, toneFragment } from './glsl.js';
import { Gloss, nothingBelow } from './gloss.js';
import { Lamps } from './lamps.js';
import { Marks } from './marks.js';
import { People } from './people.js';
import { Signs } from './signs.js';
import { Smoke, smokePaces } from './smoke.js';
import { Surfaces } from './surfaces.js';
import { curveUniform } from './tone.js';
import { adaptedWhite } from './white.js';

/** This many pictures are accumulated before the page rests; fewer on a slow machine. */
const pictures = { least: 6, most: 24, seconds: 4 };
const meterCells = 32;
/** The meter reads four places along each side of a cell. */
const meterSamples = 4 * meterCells;
const nothingCut = 1e9;
const ratioMost = 2;
/** Size of marks on the screen [px]. */
const markAcross = 13;
/** The resolution is lowered until a picture takes no longer than this. */
const slowest_ms = { moving: 45, still: 300 };
/** A machine that moves at this share of the resolution has no time for flames that move. */
const slowMachine = 0.5;
const coarsest = { moving: 0.2, still: 0.4 };

function target(options = {}) {
  return new THREE.WebGLRenderTarget(1, 1, {
    type: THREE.HalfFloatType,
    depthBuffer: false,
    minFilter: THREE.LinearFilter,
    magFilter: THREE.LinearFilter,
    ...options,
  });
}

function screenPass(fragmentShader, uniforms) {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: screenVertex,
    fragmentShader,
    uniforms,
    depthTest: false,
    depthWrite: false,
  });
}

/** The van der Corput sequence: fills positions in a pixel, and starts of steps, evenly. */
function radicalInverse(i, base) {
  let value = 0;
  for (let share = 1 / base; i > 0; i = Math.floor(i / base), share /= base)
    value += share * (i % base);
  return value;
}

export class Picture {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false, depth: false });
    this.renderer.autoClear = false;
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    if (!this.renderer.extensions.get('EXT_color_buffer_float'))
      throw new Error('This graphics card cannot draw in floating point.');
    this.exposure = new Exposure();
    this.fade = { now: 0, wanted: 0 };
    this.share = 1;
    this.size = [1, 1];
    this.shares = { moving: 1, still: 1 };
    this.learns = true;
    /** Whether flames are to move, and whether the last picture that was metered shows any. */
    this.liveFlames = true;
    this.seesFlames = false;
    /** Whether the picture is one of surfaces' illuminance, without all that shines. */
    this.surfacesAlone = false;
    this.added = 0;
    this.makeTargets();
    this.makePasses();
  }

  makeTargets() {
    const depth = new THREE.DepthTexture(1, 1, THREE.UnsignedIntType);
    this.targets = {
      surfaces: target({ depthBuffer: true, depthTexture: depth }),
      smoke: target(),
      sums: [target(), target()],
      flames: target({ minFilter: THREE.NearestFilter }),
      meter: target({ type: THREE.FloatType, minFilter: THREE.NearestFilter }),
    };
    this.targets.meter.setSize(meterCells, meterCells);
    this.targets.flames.setSize(meterSamples, meterSamples);
    this.shared = {
      depth: { value: depth },
      clipToWorld: { value: new THREE.Matrix4() },
      unproject: { value: new THREE.Vector4() },
      cut: { value: nothingCut },
      above: { value: nothingBelow },
    };
  }

  makePasses() {
    const { shared } = this;
    this.surfaces = new Surfaces(shared);
    this.people = new People(shared);
    this.signs = new Signs(shared);
    this.lamps = new Lamps(shared);
    this.gloss = new Gloss(shared, { target, screenPass });
    const floats = this.renderer.extensions.has('OES_texture_float_linear');
    this.smoke = new Smoke(shared, floats);
    this.marks = new Marks(shared.depth);
    this.world = new THREE.Scene();
    this.crowd = new THREE.Group().add(this.people.mesh);
    this.world.add(this.surfaces.mesh, this.crowd);
    this.shining = new THREE.Scene();
    this.shining.add(this.gloss.object, this.signs.object, this.lamps.object);
    this.compose = screenPass(composeFragment, {
      ...shared,
      surfaces: { value: this.targets.surfaces.texture },
      smoke: { value: this.targets.smoke.texture },
      before: { value: null },
      weight: { value: 1 },
      smoky: { value: false },
    });
    this.meterPass = screenPass(meterFragment, {
      picture: { value: null },
      flames: { value: this.targets.flames.texture },
      brighterThanMean: { value: brighterThanMean },
    });
    const colours = new THREE.DataTexture(scaleTexels(), 256, 1);
    colours.minFilter = colours.magFilter = THREE.LinearFilter;
    colours.needsUpdate = true;
    this.tone = screenPass(toneFragment, {
      picture: { value: null },
      scaleColours: { value: colours },
      mode: { value: 0 },
      scale: { value: 1 },
      curve: { value: new THREE.Vector4() },
      white: { value: new THREE.Matrix3() },
      fade: { value: 0 },
      seed: { value: 0 },
    });
    const triangle = new THREE.BufferGeometry();
    const corners = new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]);
    triangle.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    this.sheet = new THREE.Mesh(triangle, this.tone);
    this.sheet.frustumCulled = false;
    this.flat = new THREE.OrthographicCamera();
    this.cameras = {
      walk: new THREE.PerspectiveCamera(60, 1, 0.05, 600),
      plan: new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 1200),
    };
  }

  get voxelsMost() {
    const gl = this.renderer.getContext();
    return gl.getParameter(gl.MAX_3D_TEXTURE_SIZE);
  }

  resize(width, height) {
    this.size = [width, height];
    this.layTargets();
  }

  /**
   * A low resolution applies to the canvas, too, which the browser enlarges: without a graphics
   * card, showing a fine canvas takes longer than drawing the picture.
   */
  layTargets() {
    const { renderer, targets, share } = this;
    const ratio = Math.min(window.devicePixelRatio, ratioMost) * share;
    renderer.setSize(...this.size.map((n) => Math.max(1, Math.round(n * ratio))), false);
    [this.width, this.height] = renderer.getDrawingBufferSize(new THREE.Vector2()).toArray();
    for (const t of [targets.surfaces, ...targets.sums]) t.setSize(this.width, this.height);
    this.again();
  }

  /** `light`: a white surface in the light on surfaces, linear sRGB [cd/m2]. */
  setWhite(light) {
    this.tone.uniforms.white.value.fromArray(adaptedWhite(light));
    this.untoned = true;
  }

  /** The accumulated pictures show another light or place. */
  again() {
    this.added = 0;
    this.since = performance.now();
  }

  look(view, cut) {
    const camera = view.span ? this.cameras.plan : this.cameras.walk;
    const aspect = this.width / this.height;
    if (view.span) {
      camera.top = view.span / 2;
      camera.bottom = -camera.top;
      camera.right = camera.top * aspect;
      camera.left = -camera.right;
    } else {
      camera.fov = view.fov;
      camera.aspect = aspect;
    }
    camera.up.fromArray(view.up);
    camera.position.fromArray(view.eye);
    camera.lookAt(...view.target);
    camera.updateMatrixWorld();
    this.camera = camera;
    this.shared.cut.value = cut ?? nothingCut;
    this.gloss.look(view.span || this.shared.cut.value < nothingCut ? null : view, aspect);
    this.marks.walls.visible = Boolean(view.span);
    this.marks.backdrops.group.visible = Boolean(view.span);
    this.again();
  }

  /**
   * Whether steady flames move. A slow machine shows one moment of them, so that it may rest and
   * draw finely.
   */
  flamesMove() {
    const shown = this.seesFlames && !this.surfacesAlone;
    return this.liveFlames && shown && this.shares.moving > slowMachine;
  }

  /** Lets flames go on by this many seconds. */
  burn(elapsed) {
    this.smoke.flames.uniforms.flameTime.value += elapsed;
    this.again();
  }

  /** Draws what is needed; returns true if the picture on the screen has changed. */
  draw(elapsed, moving) {
    if (!this.camera) return false;
    this.choose(elapsed, moving ? 'moving' : 'still');
    const adding = moving ? this.added === 0 : !this.rested;
    if (adding) this.addPicture(moving);
    this.wasAdding = adding;
    const adapting = this.exposure.adapt(elapsed, this.hurried);
    const fading = this.fadeOn(elapsed);
    this.changing = adding || adapting || fading;
    if (this.changing || this.untoned) this.show();
    return this.changing;
  }

  get rested() {
    const late = performance.now() - this.since > 1000 * pictures.seconds;
    return this.added >= (late ? pictures.least : pictures.most);
  }

  /** Adapts the resolution, from the time of previous pictures, for moving and still views. */
  choose(elapsed, pace) {
    if (pace !== this.pace) this.changePace(pace);
    else if (this.learns && this.wasAdding) this.learn(Math.min(1000, 1000 * elapsed));
    if (this.shares[pace] === this.share) return;
    this.share = this.shares[pace];
    this.layTargets();
  }

  /** A resolution that was always fast may be raised next time: a single delay does not decide. */
  changePace(pace) {
    const { samples = 0, ms } = this.slow ?? {};
    if (samples > 4 && ms < slowest_ms[this.pace] / 4)
      this.shares[this.pace] = Math.min(1, 1.25 * this.shares[this.pace]);
    this.pace = pace;
    this.slow = { samples: 0, ms: 0 };
  }

  learn(ms) {
    const { slow, pace } = this;
    slow.samples += 1;
    slow.ms += 0.3 * (ms - slow.ms);
    if (slow.ms < slowest_ms[pace]) return;
    this.shares[pace] = Math.max(coarsest[pace], 0.75 * this.shares[pace]);
    slow.ms = slow.samples = 0;
  }

  /** Illuminance is that of surfaces alone: nothing that shines, reflects or scatters is drawn. */
  setRendition(rendition) {
    const alone = rendition === 'illuminance';
    if (alone === this.surfacesAlone) return;
    this.surfacesAlone = alone;
    this.surfaces.material.uniforms.illuminance.value = alone;
    this.crowd.visible = !alone;
    this.again();
  }

  addPicture(moving) {
    const n = this.added++;
    const shift = [0.5 - radicalInverse(n + 1, 2), 0.5 - radicalInverse(n + 1, 3)];
    const { width, height, camera, targets } = this;
    camera.setViewOffset(width, height, n ? shift[0] : 0, n ? shift[1] : 0, width, height);
    this.drawSurfaces(camera, targets.surfaces);
    if (!this.surfacesAlone) this.drawLights(camera, n, moving);
    const uniforms = this.compose.uniforms;
    uniforms.smoky.value = this.smoke.present && !this.surfacesAlone;
    uniforms.before.value = targets.sums[1].texture;
    uniforms.weight.value = 1 / (n + 1);
    this.pass(this.compose, targets.sums[0]);
    targets.sums.reverse();
    if (!this.surfacesAlone && (n === 0 || n === pictures.least - 1)) this.meter();
  }

  /** Adds to surfaces what they mirror, and what shines; then smoke. */
  drawLights(camera, n, moving) {
    const { targets } = this;
    if (this.gloss.draw(this, camera, n, moving)) this.aim(camera);
    this.drawShining(camera, targets.surfaces);
    this.drawSmoke(targets.smoke, this.smokePace(moving), n);
  }

  /** Screen passes use the camera that has drawn their input. */
  aim(camera) {
    const { clipToWorld, unproject } = this.shared;
    clipToWorld.value.copy(camera.matrixWorld).multiply(camera.projectionMatrixInverse);
    const inverse = camera.projectionMatrixInverse.elements;
    unproject.value.set(inverse[10], inverse[14], inverse[11], inverse[15]);
  }

  drawSurfaces(camera, to) {
    this.aim(camera);
    this.renderer.setRenderTarget(to);
    this.renderer.clear();
    this.renderer.render(this.world, camera);
  }

  /** Adds reflections of glossy floors, and the faces of signs and lamps, to surfaces. */
  drawShining(camera, to) {
    this.renderer.setRenderTarget(to);
    this.renderer.render(this.shining, camera);
  }

  /** Smoke in front of what was drawn last, at a lower resolution than the picture. */
  drawSmoke(to, { steps, coarser }, n) {
    if (!this.smoke.present) return;
    to.setSize(Math.ceil(this.width / coarser), Math.ceil(this.height / coarser));
    const { uniforms } = this.smoke.material;
    uniforms.steps.value = steps;
    uniforms.shift.value = (0.618034 * n) % 1;
    this.pass(this.smoke.material, to);
  }

  /** A machine that needs a low resolution also gets fewer steps and pixels of smoke. */
  smokePace(moving) {
    if (!moving) return smokePaces.still;
    return this.share > 0.5 ? smokePaces.moving : smokePaces.hurried;
  }

  /** Nothing is left to accumulate or to adapt to. */
  get complete() {
    return this.pace === 'still' && this.rested && !this.metering && !this.changing;
  }

  get finished() {
    return this.targets.sums[1];
  }

  pass(material, to) {
    this.sheet.material = material;
    this.renderer.setRenderTarget(to);
    this.renderer.render(this.sheet, this.flat);
  }

  /** Requests the exposure without waiting for the graphics card. */
  async meter() {
    if (this.metering) return;
    this.metering = true;
    const mayBurn = this.drawFlames();
    this.meterPass.uniforms.picture.value = this.finished.texture;
    this.pass(this.meterPass, this.targets.meter);
    const cells = new Float32Array(4 * meterCells * meterCells);
    try {
      await this.renderer.readRenderTargetPixelsAsync(
        this.targets.meter, 0, 0, meterCells, meterCells, cells);
      this.exposure.meter(cells);
      this.seesFlames = mayBurn && await this.showsFlames();
    } finally {
      this.metering = false;
    }
  }

  /**
   * Draws the means of steady flames in view, with which exposure does not flicker. Returns whether
   * there may be any: walls may hide them.
   */
  drawFlames() {
    const { smoke, targets } = this;
    const mayBurn = smoke.present && smoke.flames.movesBefore(this.camera);
    if (mayBurn) {
      smoke.material.uniforms.flamesAlone.value = true;
      this.pass(smoke.material, targets.flames);
      smoke.material.uniforms.flamesAlone.value = false;
    } else {
      this.renderer.setRenderTarget(targets.flames);
      this.renderer.clear();
    }
    return mayBurn;
  }

  /** Whether what drawFlames has drawn has light. */
  async showsFlames() {
    const halves = new Uint16Array(4 * meterSamples * meterSamples);
    await this.renderer.readRenderTargetPixelsAsync(
      this.targets.flames, 0, 0, meterSamples, meterSamples, halves);
    return halves.some((half, i) => i % 4 < 3 && half > 0);
  }

  fadeOn(elapsed) {
    const { now, wanted } = this.fade;
    if (now === wanted) return false;
    const step = this.hurried ? 1 : elapsed / 0.3;
    this.fade.now = wanted > now ? Math.min(wanted, now + step) : Math.max(wanted, now - step);
    return true;
  }

  show() {
    this.untoned = false;
    const uniforms = this.tone.uniforms;
    uniforms.picture.value = this.finished.texture;
    uniforms.mode.value = renditions[this.exposure.rendition];
    uniforms.scale.value = this.exposure.scale;
    uniforms.fade.value = this.fade.now;
    uniforms.seed.value = (this.added * 17.3) % 97;
    this.toneTo(null, this.exposure.curve);
    this.camera.clearViewOffset();
    this.renderer.getDrawingBufferSize(this.marks.points.material.uniforms.raster.value);
    this.marks.points.material.uniforms.size.value = (markAcross * this.height) / this.size[1];
    this.renderer.render(this.marks.scene, this.camera);
  }

  /** Shows the tone pass's picture by this curve; `target`: null for the screen. */
  toneTo(target, curve) {
    this.tone.uniforms.curve.value.fromArray(curveUniform(curve));
    this.pass(this.tone, target);
  }

  /** The picture's luminances [cd/m2] within a window of its pixels. */
  luminances(x, y, width, height) {
    const halves = new Uint16Array(4 * width * height);
    this.renderer.readRenderTargetPixels(this.finished, x, y, width, height, halves);
    const values = new Float32Array(width * height);
    for (let i = 0; i < values.length; ++i)
      values[i] = 0.2126 * halfValues[halves[4 * i]] + 0.7152 * halfValues[halves[4 * i + 1]] +
        0.0722 * halfValues[halves[4 * i + 2]];
    return values;
  }

  meanLuminance() {
    const values = this.luminances(0, 0, this.width, this.height);
    return values.reduce((sum, y) => sum + y, 0) / values.length;
  }

  /** Luminance [cd/m2] that arrives from a place of the picture, each -1 to 1, right and up. */
  luminanceAt(x, y) {
    const at = (share, n) => Math.min(n - 1, Math.floor((0.5 + 0.5 * share) * n));
    return this.luminances(at(x, this.width), at(y, this.height), 1, 1)[0];
  }
}
