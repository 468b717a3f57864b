// The building's triangles. Their light is a texture, two texels (front, back) for each triangle
// or, drawn smoothly, for each welded point; dimming only rewrites the texture.
import * as THREE from 'three';
import { placesOf, smooth, weld } from '../light/weld.js';
import { surfaceFragment, surfaceVertex } from './glsl.js';

const texelsAcross = 2048;

/** Drawing order in three.js: mirroring floors before self-luminous faces are added. */
export const drawnAfter = { surfaces: 1, floors: 2 };

function lightTexture(cells) {
  const rows = Math.max(1, Math.ceil((2 * cells) / texelsAcross));
  const data = new Float32Array(4 * texelsAcross * rows);
  return new THREE.DataTexture(data, texelsAcross, rows, THREE.RGBAFormat, THREE.FloatType);
}

export class Surfaces {
  /** `cut` and `above`: heights between which is drawn. */
  constructor({ cut, above }) {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: surfaceVertex,
      fragmentShader: surfaceFragment,
      side: THREE.DoubleSide,
      uniforms: { light: { value: lightTexture(1) }, illuminance: { value: false }, cut, above },
    });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.smooth = true;
  }

  build(geometry) {
    this.source = geometry;
    this.welded = weld(geometry);
    this.layOut();
  }

  setSmooth(wanted) {
    this.smooth = wanted;
    if (this.source) this.layOut();
  }

  layOut() {
    const { triangles, corners } = this.source;
    const { pointOf, points } = this.welded;
    const cells = this.smooth ? points : triangles;
    const geometry = new THREE.BufferGeometry();
    const set = (name, values, size) =>
      geometry.setAttribute(name, new THREE.BufferAttribute(values, size));
    if (this.smooth) {
      // Most points are shared by six triangles, so most work on vertices is done once.
      set('position', placesOf(this.welded, corners), 3);
      set('texel', Uint32Array.from({ length: points }, (_, i) => i), 1);
      geometry.setIndex(new THREE.BufferAttribute(pointOf, 1));
    } else {
      set('position', corners, 3);
      set('texel', Uint32Array.from({ length: 3 * triangles }, (_, i) => (i / 3) | 0), 1);
    }
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
    this.material.uniforms.light.value.dispose();
    this.material.uniforms.light.value = lightTexture(cells);
  }

  /** `light` is a LightSum of eight numbers per triangle, or null for darkness. */
  shine(light) {
    const texture = this.material.uniforms.light.value;
    const data = texture.image.data;
    if (!light || light.cells !== this.source?.triangles) data.fill(0);
    else if (this.smooth) smooth(light.sum, this.welded, data);
    else data.set(light.sum);
    texture.needsUpdate = true;
  }
}
