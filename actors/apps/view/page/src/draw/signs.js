// The faces of signs: their own luminance on a quad slightly before the wall, added to the light
// that the wall's triangles reflect.
import * as THREE from 'three';
import { add, cross, scale, unit } from '../walk/vectors.js';
import { addedLight } from './added_light.js';
import { signFragment, signVertex } from './glsl.js';
import { drawnAfter } from './surfaces.js';

const beforeWall_m = 0.004;
/** Colours that one texture holds the shares of, in its four channels. */
const perTexture = 4;

/** The shares of four colours, from `first` on, in each texel. */
function sharesOf({ texels, columns, rows }, first) {
  const data = new Uint8Array(perTexture * columns * rows);
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const channel = texels[(rows - 1 - row) * columns + column] - first;
      if (channel >= 0 && channel < perTexture)
        data[perTexture * (row * columns + column) + channel] = 255;
    }
  const texture = new THREE.DataTexture(data, columns, rows);
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapLinearFilter;
  texture.generateMipmaps = true;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}

/** A texture without shares, for a sign of four colours or fewer. */
function noShares() {
  const texture = new THREE.DataTexture(new Uint8Array(perTexture), 1, 1);
  texture.needsUpdate = true;
  return texture;
}

/** The four corners of a face: left and right as its reader sees them. */
export function faceOf({ position, facing, up, width, height }, turned = false) {
  const normal = scale(unit(facing), turned ? -1 : 1);
  const right = unit(cross(up, normal), [1, 0, 0]);
  const above = cross(normal, right);
  const centre = add(position, scale(normal, beforeWall_m));
  const corner = (x, y) =>
    add(centre, add(scale(right, (x * width) / 2), scale(above, (y * height) / 2)));
  return [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
}

function quadOf(corners) {
  const geometry = new THREE.BufferGeometry();
  const positions = new Float32Array(corners.flat());
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  const uv = new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]);
  geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return geometry;
}

export class Signs {
  /** `cut` and `above`: heights between which is drawn. */
  constructor({ cut, above }) {
    this.shared = { cut, above };
    this.object = new THREE.Group();
    this.signs = [];
  }

  build(signs) {
    for (const mesh of this.object.children) {
      mesh.geometry.dispose();
      mesh.material.uniforms.shares.value.dispose();
      mesh.material.uniforms.moreShares.value.dispose();
      mesh.material.dispose();
    }
    this.object.clear();
    this.signs = signs;
    for (const sign of signs) this.addFaces(sign);
  }

  addFaces(sign) {
    const material = new THREE.RawShaderMaterial({
      ...addedLight,
      vertexShader: signVertex,
      fragmentShader: signFragment,
      uniforms: {
        shares: { value: sharesOf(sign, 0) },
        moreShares: {
          value: sign.colours.length > perTexture ? sharesOf(sign, perTexture) : noShares(),
        },
        colours: { value: Array.from({ length: 2 * perTexture }, () => new THREE.Vector3()) },
        ...this.shared,
      },
    });
    for (const turned of sign.doubleSided ? [false, true] : [false]) {
      const mesh = new THREE.Mesh(quadOf(faceOf(sign, turned)), material);
      mesh.userData.sign = sign;
      mesh.renderOrder = drawnAfter.floors;
      this.object.add(mesh);
    }
  }

  /** `factorOf(group)`: the dimming factor of a group. */
  shine(factorOf) {
    for (const { material, userData } of this.object.children) {
      const factor = factorOf(userData.sign.group);
      userData.sign.colours.forEach((colour, i) =>
        material.uniforms.colours.value[i].fromArray(colour).multiplyScalar(factor));
    }
  }

  /** The sign that a ray hits within `reach` metres, or null. */
  pointedAt(origin, direction, reach) {
    const ray = new THREE.Raycaster(
      new THREE.Vector3(...origin), new THREE.Vector3(...direction), 0, reach + 0.05);
    const [hit] = ray.intersectObjects(this.object.children, false);
    return hit ? hit.object.userData.sign : null;
  }
}
