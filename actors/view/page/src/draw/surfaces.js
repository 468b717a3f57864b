// The building's triangles. Their light lies in a texture, two texels (front, back) for each
// triangle or, drawn smoothly, for each welded point; dimming writes the texture and nothing else.
import * as THREE from 'three';
import { smooth, weld } from '../light/weld.js';
import { surfaceFragment, surfaceVertex } from './glsl.js';

const texelsAcross = 2048;

function lightTexture(cells) {
  const rows = Math.max(1, Math.ceil((2 * cells) / texelsAcross));
  const data = new Float32Array(4 * texelsAcross * rows);
  return new THREE.DataTexture(data, texelsAcross, rows, THREE.RGBAFormat, THREE.FloatType);
}

export class Surfaces {
  constructor() {
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: surfaceVertex,
      fragmentShader: surfaceFragment,
      side: THREE.DoubleSide,
      uniforms: { light: { value: lightTexture(1) }, cut: { value: Infinity } },
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
    const texel = this.smooth
      ? this.welded.pointOf
      : Uint32Array.from({ length: 3 * triangles }, (_, i) => (i / 3) | 0);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new THREE.BufferGeometry();
    this.mesh.geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    this.mesh.geometry.setAttribute('texel', new THREE.BufferAttribute(texel, 1));
    this.material.uniforms.light.value.dispose();
    const cells = this.smooth ? this.welded.points : triangles;
    this.material.uniforms.light.value = lightTexture(cells);
  }

  /** `light` is a LightSum of eight numbers a triangle, or null for darkness. */
  shine(light) {
    const texture = this.material.uniforms.light.value;
    const data = texture.image.data;
    if (!light || light.cells !== this.source?.triangles) data.fill(0);
    else if (this.smooth) smooth(light.sum, this.welded, data);
    else data.set(light.sum);
    texture.needsUpdate = true;
  }
}
