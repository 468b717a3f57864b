// Flames as one 3D texture of their glow, stacked with dark layers in between. Steady ones are
// shown at a moment.
import * as THREE from 'three';
import { normals } from './flame_shape.js';

/** Limit of the shader. */
export const flamesMost = 8;

const vectors = () => Array.from({ length: flamesMost }, () => new THREE.Vector3());

/** Two bytes of a texel: the glow, and the flame's radius at that height relative to its width. */
const channels = 2;

/** The radius of a disc as large as what glows in a layer, relative to the wider side. */
function radiusOf({ size: [width, depth], count: [nx, ny], cells }, z) {
  let glowing = 0;
  for (let i = z * nx * ny; i < (z + 1) * nx * ny; ++i) glowing += cells[i] > 0 ? 1 : 0;
  const area = (glowing * width * depth) / (nx * ny);
  return Math.sqrt(area / Math.PI) / Math.max(width, depth);
}

/** The part of the texture of each flame, and its bytes. Pure. */
export function atlasOf(flames) {
  const most = (axis) => Math.max(1, ...flames.map(({ count }) => count[axis]));
  const size = [most(0), most(1), flames.reduce((sum, { count }) => sum + count[2] + 2, 0) || 1];
  const bytes = new Uint8Array(channels * size[0] * size[1] * size[2]);
  let above = 0;
  const parts = flames.map((flame) => {
    const { count: [nx, ny, nz], cells } = flame;
    const first = above + 1;
    for (let z = 0; z < nz; ++z) {
      const radius = Math.min(255, Math.round(255 * radiusOf(flame, z)));
      for (let y = 0; y < ny; ++y)
        for (let x = 0; x < nx; ++x)
          bytes.set([cells[(z * ny + y) * nx + x], radius],
            channels * (((first + z) * size[1] + y) * size[0] + x));
    }
    above += nz + 2;
    return { offset: [0, 0, first / size[2]],
      scale: [nx / size[0], ny / size[1], nz / size[2]] };
  });
  return { size, bytes, parts };
}

function normalTexture() {
  const values = normals();
  const texture = new THREE.DataTexture(values, values.length, 1, THREE.RedFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

export class Flames {
  constructor() {
    this.flames = [];
    this.uniforms = {
      flameCells: { value: this.texture([1, 1, 1], new Uint8Array(channels)) },
      flameCount: { value: 0 },
      flameLow: { value: vectors() },
      flameSize: { value: vectors() },
      flameColour: { value: vectors() },
      flameOffset: { value: vectors() },
      flameScale: { value: vectors() },
      flameExtinction: { value: new Array(flamesMost).fill(0) },
      flameTime: { value: 0 },
      shapeBase: { value: vectors() },
      shapeSize: { value: vectors() },
      shapeSeed: { value: new Array(flamesMost).fill(0) },
      normals: { value: normalTexture() },
    };
  }

  texture([nx, ny, nz], bytes) {
    const texture = new THREE.Data3DTexture(bytes, nx, ny, nz);
    texture.format = THREE.RGFormat;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
  }

  build(flames) {
    this.flames = flames.slice(0, flamesMost);
    const { size, bytes, parts } = atlasOf(this.flames);
    const { uniforms } = this;
    uniforms.flameCells.value.dispose();
    uniforms.flameCells.value = this.texture(size, bytes);
    uniforms.flameCount.value = this.flames.length;
    this.flames.forEach((flame, i) => {
      uniforms.flameLow.value[i].fromArray(flame.low);
      uniforms.flameSize.value[i].fromArray(flame.size);
      uniforms.flameOffset.value[i].fromArray(parts[i].offset);
      uniforms.flameScale.value[i].fromArray(parts[i].scale);
      this.setShape(i, flame.shape);
    });
  }

  setShape(i, shape) {
    const { uniforms } = this;
    uniforms.shapeSeed.value[i] = shape?.seed ?? 0;
    uniforms.flameExtinction.value[i] = shape?.extinction ?? 0;
    if (!shape) return;
    const { low, size } = shape;
    uniforms.shapeBase.value[i].set(low[0] + size[0] / 2, low[1] + size[1] / 2, low[2]);
    uniforms.shapeSize.value[i].fromArray(size);
  }

  /** Whether a camera has a flame in its picture that moves, and that is lit. */
  movesBefore(camera) {
    const seen = new THREE.Frustum().setFromProjectionMatrix(
      new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    return this.flames.some(({ low, size, shape }, i) => {
      if (!shape || this.uniforms.flameColour.value[i].lengthSq() === 0) return false;
      const corner = new THREE.Vector3(...low);
      return seen.intersectsBox(
        new THREE.Box3(corner, corner.clone().add(new THREE.Vector3(...size))));
    });
  }

  /** `weight(name)` is the factor of a group's light. */
  shine(weight) {
    this.flames.forEach(({ group, colour }, i) => this.uniforms.flameColour.value[i]
      .fromArray(colour).multiplyScalar(weight(group)));
  }
}
