// Smoke as two 3D textures: how much it takes away, and what it sends towards the eye.
import * as THREE from 'three';
import { toHalf } from '../protocol/half.js';
import { screenVertex, smokeFragment } from './glsl.js';

/** Steps of one picture; while the eye is still many pictures are added up. */
export const steps = { moving: 16, still: 32 };

function volume([nx, ny, nz], data, format) {
  const texture = new THREE.Data3DTexture(data, nx, ny, nz);
  texture.format = format;
  texture.type = THREE.HalfFloatType;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

const none = (format, channels) => volume([1, 1, 1], new Uint16Array(channels), format);

export class Smoke {
  constructor(shared) {
    this.present = false;
    this.material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: screenVertex,
      fragmentShader: smokeFragment,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        ...shared,
        extinction: { value: none(THREE.RedFormat, 1) },
        scatter: { value: none(THREE.RGBAFormat, 4) },
        low: { value: new THREE.Vector3() },
        size: { value: new THREE.Vector3(1, 1, 1) },
        shift: { value: 0 },
        steps: { value: steps.moving },
      },
    });
  }

  replace(name, texture) {
    this.material.uniforms[name].value.dispose();
    this.material.uniforms[name].value = texture;
  }

  /** Says whether the graphics card can hold so many voxels a side. */
  build(voxels, extinction, most) {
    this.present = Boolean(voxels && extinction && Math.max(...voxels.count) <= most);
    if (!this.present) return !voxels || !extinction;
    this.count = voxels.count;
    this.replace('extinction', volume(voxels.count, extinction, THREE.RedFormat));
    this.halves = new Uint16Array(4 * voxels.total);
    this.replace('scatter', volume(voxels.count, this.halves, THREE.RGBAFormat));
    this.material.uniforms.low.value.fromArray(voxels.low);
    this.material.uniforms.size.value.fromArray(voxels.count.map((n) => n * voxels.edge));
    return true;
  }

  /** `light` is a LightSum of four numbers a voxel, or null. */
  shine(light) {
    if (!this.present) return;
    if (!light || 4 * light.cells !== this.halves.length) this.halves.fill(0);
    else for (let i = 0; i < this.halves.length; ++i) this.halves[i] = toHalf(light.sum[i]);
    this.material.uniforms.scatter.value.needsUpdate = true;
  }
}
