// Smoke as two 3D textures: its emitted light as the mean over directions, and its extinction; the
// direction of the light that it scatters, and how much it scatters forwards.
import * as THREE from 'three';
import { halfValues, toHalf } from '../protocol/half.js';
import { Flames } from './flames.js';
import { screenVertex, smokeFragment } from './glsl.js';

/**
 * Steps in one picture, and the factor by which smoke is coarser than the picture; while the camera
 * is still, many pictures are accumulated.
 */
export const smokePaces = {
  hurried: { steps: 8, coarser: 3 },
  moving: { steps: 16, coarser: 2 },
  still: { steps: 32, coarser: 2 },
};

/** Up to this many voxels, textures are of floats, which take twice the memory. */
const floatsMost = 1 << 20;

function volume([nx, ny, nz], data) {
  const texture = new THREE.Data3DTexture(data, nx, ny, nz);
  texture.format = THREE.RGBAFormat;
  texture.type = data instanceof Float32Array ? THREE.FloatType : THREE.HalfFloatType;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

const none = () => volume([1, 1, 1], new Uint16Array(4));

export class Smoke {
  /** `floats`: textures of floats can be interpolated. Software reads them in half the time. */
  constructor(shared, floats = false) {
    this.present = false;
    this.floats = floats;
    this.flames = new Flames();
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: screenVertex,
      fragmentShader: smokeFragment,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        ...shared,
        ...this.flames.uniforms,
        glow: { value: none() },
        beam: { value: none() },
        low: { value: new THREE.Vector3() },
        size: { value: new THREE.Vector3(1, 1, 1) },
        shift: { value: 0 },
        steps: { value: smokePaces.moving.steps },
        flamesAlone: { value: false },
      },
    });
  }

  replace(name, texture) {
    this.material.uniforms[name].value.dispose();
    this.material.uniforms[name].value = texture;
  }

  /**
   * `smoke` has extinction and mean cosine of each voxel, as half floats. Returns whether the
   * graphics card supports this many voxels per side.
   */
  build(voxels, smoke, most) {
    this.present = Boolean(voxels && smoke && Math.max(...voxels.count) <= most);
    if (!this.present) return !voxels || !smoke;
    const asFloats = this.floats && voxels.total <= floatsMost;
    const Texels = asFloats ? Float32Array : Uint16Array;
    this.texels = { glow: new Texels(2 * smoke.length), beam: new Texels(2 * smoke.length) };
    const { glow, beam } = this.texels;
    const texel = asFloats ? (half) => halfValues[half] : (half) => half;
    for (let from = 0, to = 3; from < smoke.length; from += 2, to += 4) {
      glow[to] = texel(smoke[from]);
      beam[to] = texel(smoke[from + 1]);
    }
    this.replace('glow', volume(voxels.count, glow));
    this.replace('beam', volume(voxels.count, beam));
    this.material.uniforms.low.value.fromArray(voxels.low);
    this.material.uniforms.size.value.fromArray(voxels.count.map((n) => n * voxels.edge));
    return true;
  }

  /** `light` is a LightSum of two texels per voxel, or null. */
  shine(light) {
    if (!this.present) return;
    const { glow, beam } = this.texels;
    const sum = light && 4 * light.cells === glow.length ? light.sum : null;
    const texel = glow instanceof Float32Array ? (x) => x : toHalf;
    for (let to = 0; to < glow.length; to += 4)
      for (let k = 0; k < 3; ++k) {
        glow[to + k] = sum ? texel(sum[2 * to + k]) : 0;
        beam[to + k] = sum ? texel(sum[2 * to + 4 + k]) : 0;
      }
    this.material.uniforms.glow.value.needsUpdate = true;
    this.material.uniforms.beam.value.needsUpdate = true;
  }
}
