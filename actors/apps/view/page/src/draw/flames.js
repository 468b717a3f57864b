// Flames as one 3D texture of their glow, stacked with dark layers in between.
import * as THREE from 'three';

/** Limit of the shader. */
export const flamesMost = 8;

const vectors = () => Array.from({ length: flamesMost }, () => new THREE.Vector3());

/** The part of the texture of each flame, and its bytes. Pure. */
export function atlasOf(flames) {
  const most = (axis) => Math.max(1, ...flames.map(({ count }) => count[axis]));
  const size = [most(0), most(1), flames.reduce((sum, { count }) => sum + count[2] + 2, 0) || 1];
  const bytes = new Uint8Array(size[0] * size[1] * size[2]);
  let above = 0;
  const parts = flames.map(({ count: [nx, ny, nz], cells }) => {
    const first = above + 1;
    for (let z = 0; z < nz; ++z)
      for (let y = 0; y < ny; ++y)
        bytes.set(cells.subarray((z * ny + y) * nx, (z * ny + y + 1) * nx),
          ((first + z) * size[1] + y) * size[0]);
    above += nz + 2;
    return { offset: [0, 0, first / size[2]],
      scale: [nx / size[0], ny / size[1], nz / size[2]] };
  });
  return { size, bytes, parts };
}

export class Flames {
  constructor() {
    this.flames = [];
    this.uniforms = {
      flameCells: { value: this.texture([1, 1, 1], new Uint8Array(1)) },
      flameCount: { value: 0 },
      flameLow: { value: vectors() },
      flameSize: { value: vectors() },
      flameColour: { value: vectors() },
      flameOffset: { value: vectors() },
      flameScale: { value: vectors() },
    };
  }

  texture([nx, ny, nz], bytes) {
    const texture = new THREE.Data3DTexture(bytes, nx, ny, nz);
    texture.format = THREE.RedFormat;
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
    });
  }

  /** `weight(name)` is the factor of a group's light. */
  shine(weight) {
    this.flames.forEach(({ group, colour }, i) => this.uniforms.flameColour.value[i]
      .fromArray(colour).multiplyScalar(weight(group)));
  }
}
