// Glossy floors: the picture from behind a floor, and the floor that shows it. Only one height at a
// time, the one that fills most of the view; other floors spread all light evenly, as on plans.
import * as THREE from 'three';
import { behindFragment, glossFragment, glossVertex } from './gloss_glsl.js';
import { isSameGloss, levelIn, levelsOf, mirrored } from './levels.js';
import { smokePaces } from './smoke.js';
import { drawnAfter } from './surfaces.js';

/** Samples of the lobe in one picture; while the camera is still, many pictures are accumulated. */
const samples = { moving: 3, still: 8 };
/** The floor's own triangles lie this far below everything that it mirrors [m]. */
const aboveFloor_m = 1e-3;
/** A lobe this wide shows nothing that half the resolution does not. */
const rough = 0.05;
/** How much wider than the view the mirrored view is, because lobes extend beyond its edges. */
const wider = 1.25;
export const nothingBelow = -1e9;

export class Gloss {
  /** `shared`: uniforms of everything drawn; `target` and `screenPass` make targets and passes. */
  constructor(shared, { target, screenPass }) {
    this.shared = shared;
    this.object = new THREE.Group();
    this.levels = [];
    this.view = null;
    this.level = null;
    this.camera = new THREE.PerspectiveCamera(60, 1, 0.05, 600);
    this.targets = {
      surfaces: target({ depthBuffer: true,
        depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType) }),
      smoke: target(),
      behind: target({ minFilter: THREE.LinearMipmapLinearFilter, generateMipmaps: true }),
    };
    this.behind = screenPass(behindFragment, {
      ...shared,
      eyeDepth: { value: shared.depth.value },
      toEye: { value: new THREE.Matrix4() },
      surfaces: { value: this.targets.surfaces.texture },
      smoke: { value: this.targets.smoke.texture },
      smoky: { value: false },
    });
    this.seen = {
      behind: { value: this.targets.behind.texture },
      mirrorDepth: { value: this.targets.surfaces.depthTexture },
      toMirror: { value: new THREE.Matrix4() },
      pixel: { value: 1 },
      samples: { value: samples.moving },
      first: { value: 0 },
    };
  }

  /** Sets which sides of which surfaces are glossy. Moved and dimmed lamps do not change them. */
  kinds(gloss) {
    const same = isSameGloss(gloss, this.all);
    this.all = gloss;
    if (!same) this.lay();
  }

  /** `building`: the triangles, as they are walked through. */
  build(building, { surfaces }) {
    Object.assign(this, { building, surfaces });
    this.lay();
  }

  lay() {
    for (const { geometry, material } of this.object.children) {
      geometry.dispose();
      material.dispose();
    }
    this.object.clear();
    this.levels = this.building ? levelsOf(this.building, this.surfaces, this.all ?? []) : [];
    for (const level of this.levels)
      for (const [kind, corners] of level.parts) this.add(level, kind, corners);
    this.choose();
  }

  /** The floor keeps the light that it spreads evenly, and its mirror image is added. */
  add(level, { mirrored: share, spread, roughness }, corners) {
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: glossVertex,
      fragmentShader: glossFragment,
      blending: THREE.CustomBlending,
      blendSrc: THREE.OneFactor,
      blendDst: THREE.ConstantColorFactor,
      blendColor: new THREE.Color(spread, spread, spread),
      depthWrite: false,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: -1,
      polygonOffsetUnits: -4,
      uniforms: { ...this.seen, share: { value: new THREE.Vector3(...share) },
        roughness: { value: roughness } },
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(corners), 3));
    const mesh = new THREE.Mesh(geometry, material);
    mesh.userData = { level, roughness };
    mesh.renderOrder = drawnAfter.surfaces;
    this.object.add(mesh);
  }

  /** Selects the level that a view shows; null for plans, which are cut. */
  look(view, aspect) {
    Object.assign(this, { view, aspect });
    this.choose();
  }

  choose() {
    const { view, aspect } = this;
    this.level = view ? levelIn(this.levels, view, aspect) : null;
    if (this.level) this.place(mirrored(view, this.level.height), aspect);
  }

  place({ eye, target, up, fov }, aspect) {
    const { camera, seen } = this;
    const half = wider * Math.tan((fov * Math.PI) / 360);
    camera.fov = (360 / Math.PI) * Math.atan(half);
    camera.aspect = aspect;
    camera.up.fromArray(up);
    camera.position.fromArray(eye);
    camera.lookAt(...target);
    camera.updateMatrixWorld();
    camera.updateProjectionMatrix();
    seen.toMirror.value.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.across = 2 * half;
  }

  /**
   * Draws the picture behind the floor of the present level, and makes the floor show it. `eye`:
   * the camera whose surfaces are already drawn. False if there is no such floor.
   */
  draw(picture, eye, n, moving) {
    const { level, shared, targets } = this;
    const shown = this.object.children.filter((mesh) => {
      mesh.visible = false;
      return level && mesh.userData.level === level;
    });
    if (!level) return false;
    const sharpest = Math.min(...shown.map(({ userData }) => userData.roughness));
    const coarser = moving || sharpest > rough ? 2 : 1;
    const [width, height] = [picture.width, picture.height].map((x) => Math.ceil(x / coarser));
    for (const t of [targets.surfaces, targets.behind]) t.setSize(width, height);
    this.seen.pixel.value = (this.across / height) ** 2;
    this.seen.samples.value = moving ? samples.moving : samples.still;
    this.seen.first.value = n * samples.still;
    const depth = shared.depth.value;
    shared.depth.value = targets.surfaces.depthTexture;
    shared.above.value = level.height + aboveFloor_m;
    picture.drawSurfaces(this.camera, targets.surfaces);
    picture.drawShining(this.camera, targets.surfaces);
    picture.drawSmoke(targets.smoke, moving ? smokePaces.hurried : smokePaces.moving, n);
    this.behind.uniforms.smoky.value = picture.smoke.present;
    this.behind.uniforms.toEye.value.multiplyMatrices(eye.projectionMatrix, eye.matrixWorldInverse);
    picture.pass(this.behind, targets.behind);
    shared.depth.value = depth;
    shared.above.value = nothingBelow;
    for (const mesh of shown) mesh.visible = true;
    return true;
  }
}
