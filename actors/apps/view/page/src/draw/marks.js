// Marks over the finished picture: luminaires, flames, in plan also signs, observers and the
// walker; the plan's cut walls; the outline of what is being moved. They are not light, so neither
// metered nor exposed.
import * as THREE from 'three';
import { Backdrops } from './backdrops.js';
import { emphasisBelow, escapeLines } from './escape_lines.js';
import { lineFragment, lineVertex, markFragment, markVertex } from './glsl.js';

const shapes = { luminaire: 0, flame: 1, sign: 2, walker: 3 };
const inks = {
  luminaire: [1, 0.86, 0.5],
  flame: [1, 0.48, 0.2],
  sign: [0.3, 0.95, 0.55],
  observer: [0.6, 0.75, 1],
  walker: [0.45, 0.7, 1],
  suggested: [0.4, 1, 0.95],
  emphasis: [1, 0.55, 0.9],
};

/** Places where a luminaire would help: from blue for little to red for most. */
const heat = (share) => [0.25 + 0.75 * share, 0.35 + 0.3 * share * (1 - share), 1 - 0.9 * share];

function lines(ink) {
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: lineVertex,
    fragmentShader: lineFragment,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    uniforms: { ink: { value: new THREE.Vector4(...ink) } },
  });
  const object = new THREE.LineSegments(new THREE.BufferGeometry(), material);
  object.frustumCulled = false;
  return object;
}

function setLines(object, positions) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  object.geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
}

export class Marks {
  constructor(depth) {
    this.scene = new THREE.Scene();
    this.points = new THREE.Points(new THREE.BufferGeometry(), new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: markVertex,
      fragmentShader: markFragment,
      transparent: true,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        depth,
        size: { value: 12 },
        raster: { value: new THREE.Vector2(1, 1) },
        plan: { value: false },
      },
    }));
    this.points.frustumCulled = false;
    this.walls = lines([0.75, 0.8, 0.88, 0.9]);
    this.outline = lines([1, 0.85, 0.35, 1]);
    /** Shown in plan. */
    this.escape = { lines: lines([0.35, 0.9, 0.55, 0.95]), edges: lines([0.35, 0.9, 0.55, 0.35]),
      areas: lines([0.55, 0.75, 1, 0.6]) };
    this.escapeGroup = new THREE.Group();
    this.escapeGroup.add(...Object.values(this.escape));
    this.backdrops = new Backdrops();
    this.scene.add(this.backdrops.group, this.escapeGroup, this.points, this.walls, this.outline);
    this.wanted = true;
    this.suggestion = null;
  }

  /** Marks of a scene: fixed places, and with `plan` also those shown only from above. */
  place(scene, plan, walker, cut) {
    this.escapeGroup.visible = plan && this.wanted;
    if (this.escapeGroup.visible)
      for (const [kind, positions] of Object.entries(escapeLines(scene, cut)))
        setLines(this.escape[kind], new Float32Array(positions));
    const marks = [];
    const put = (kind, position, ink = kind) => marks.push({ kind, position, ink });
    const on = this.wanted;
    const most = Math.max(0, ...(this.suggestion?.helpful ?? []).map((h) => h.share));
    for (const h of this.suggestion?.helpful ?? [])
      marks.push({ kind: 'flame', position: h.position, tint: heat(h.share / (most || 1)) });
    for (const l of this.suggestion?.luminaires ?? []) put('sign', l.position, 'suggested');
    if (on) for (const l of scene.luminaires) put('luminaire', l.position);
    if (on) for (const g of scene.groups) if (g.kind === 'flame') put('flame', g.position);
    if (on && plan)
      for (const e of emphasisBelow(scene, cut)) put('sign', e.position, 'emphasis');
    if (on && plan) for (const s of scene.signs) put('sign', s.position);
    if (on && plan) for (const o of scene.observers) put('flame', o.eye, 'observer');
    if (plan) put('walker', walker);
    const geometry = new THREE.BufferGeometry();
    const attribute = (name, values, size) =>
      geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(values), size));
    attribute('position', marks.flatMap((m) => m.position), 3);
    attribute('tint', marks.flatMap((m) => m.tint ?? inks[m.ink]), 3);
    attribute('kind', marks.map((m) => shapes[m.kind]), 1);
    this.points.geometry.dispose();
    this.points.geometry = geometry;
    this.points.material.uniforms.plan.value = plan;
  }

  setWalls(positions) {
    setLines(this.walls, positions);
  }

  /** A closed line through corners; none without corners. */
  setOutline(corners) {
    const around = corners.flatMap((c, i) => [...c, ...corners[(i + 1) % corners.length]]);
    setLines(this.outline, new Float32Array(around));
  }
}
