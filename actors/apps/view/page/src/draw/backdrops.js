// Imported drawings, faintly under the plan: lines and pictures. They are not light, and are drawn
// before the marks.
import * as THREE from 'three';
import { under } from '../protocol/decode_backdrops.js';
import { lineFragment, lineVertex, pictureFragment, pictureVertex } from './glsl.js';

const faint = 0.3;

function material(vertexShader, fragmentShader, uniforms) {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader,
    fragmentShader,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    side: THREE.DoubleSide,
    uniforms,
  });
}

function linesOf({ lines }) {
  const geometry = new THREE.BufferGeometry();
  const points = new Float32Array(lines.flatMap(([a, b, c, d]) => [a, b, 0, c, d, 0]));
  geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
  const ink = { value: new THREE.Vector4(0.75, 0.8, 0.88, faint) };
  return new THREE.LineSegments(geometry, material(lineVertex, lineFragment, { ink }));
}

/** `drawn` is called when the picture has been decoded. */
function pictureOf({ picture: { png, corner, across, up } }, drawn) {
  const at = (s, t) => [corner[0] + s * across[0] + t * up[0], corner[1] + s * across[1] + t * up[1], 0];
  const geometry = new THREE.BufferGeometry();
  const set = (name, values, size) =>
    geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(values), size));
  set('position', [at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)].flat(), 3);
  set('uv', [0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1], 2);
  const texture = new THREE.Texture();
  const image = new Image();
  image.onload = () => {
    texture.image = image;
    texture.needsUpdate = true;
    drawn();
  };
  image.src = `data:image/png;base64,${png}`;
  const uniforms = { picture: { value: texture }, faint: { value: faint } };
  return new THREE.Mesh(geometry, material(pictureVertex, pictureFragment, uniforms));
}

export class Backdrops {
  constructor() {
    this.group = new THREE.Group();
    this.group.visible = false;
    this.all = [];
  }

  /** Takes the result of `decodeBackdrops`; `drawn`: something became visible. */
  build(backdrops, drawn) {
    this.group.clear();
    this.all = backdrops.map((one) => {
      const object = one.picture ? pictureOf(one, drawn) : linesOf(one);
      object.frustumCulled = false;
      object.renderOrder = -1;
      this.group.add(object);
      return { ...one, object };
    });
    this.cutAt(this.cut);
    drawn();
  }

  /** Shows the drawings under a plan that is cut at a height. */
  cutAt(cut) {
    this.cut = cut;
    const shown = cut === undefined ? [] : under(this.all, cut);
    for (const one of this.all) one.object.visible = shown.includes(one);
  }
}
