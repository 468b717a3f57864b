// The luminous faces of lamps, each as bright as its photometric data give for the direction to the
// eye. They are added to what lies behind them, like those of signs.
import * as THREE from 'three';
import { toHalf } from '../protocol/half.js';
import { addedLight } from './added_light.js';
import { lampFragment, lampVertex } from './gloss_glsl.js';
import { facesOf, isFlat } from './lamp_faces.js';
import { drawnAfter } from './surfaces.js';

function tableTexture({ peak, polar, azimuth, values }) {
  const halves = Uint16Array.from(values, (value) => toHalf((peak * value) / 65535));
  const texture = new THREE.DataTexture(halves, azimuth, polar, THREE.RedFormat,
    THREE.HalfFloatType);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.wrapS = THREE.RepeatWrapping;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

export class Lamps {
  constructor({ cut, above }) {
    this.shared = { cut, above };
    this.object = new THREE.Group();
    this.tables = [];
  }

  build(lamps, tables) {
    for (const { geometry, material } of this.object.children) {
      geometry.dispose();
      material.dispose();
    }
    for (const texture of this.tables) texture.dispose();
    this.object.clear();
    this.tables = tables.map(tableTexture);
    for (const lamp of lamps) this.add(lamp);
  }

  add(lamp) {
    const material = new THREE.RawShaderMaterial({
      ...addedLight,
      vertexShader: lampVertex,
      fragmentShader: lampFragment,
      side: isFlat(lamp) ? THREE.DoubleSide : THREE.FrontSide,
      uniforms: {
        ...this.shared,
        table: { value: this.tables[lamp.table] },
        frame: { value: new THREE.Matrix3().fromArray(lamp.axes.flat()) },
        ofLuminaire: { value: lamp.ofLuminaire },
        byOwnCosine: { value: lamp.ofLuminaire && !isFlat(lamp) },
        light: { value: new THREE.Vector3() },
      },
    });
    const { positions, normals } = facesOf(lamp);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(new Float32Array(normals), 3));
    const mesh = new THREE.Mesh(geometry, material);
    mesh.userData.lamp = lamp;
    mesh.renderOrder = drawnAfter.floors;
    this.object.add(mesh);
  }

  /** `factorOf(group)`: the dimming factor of a group. */
  shine(factorOf) {
    for (const { material, userData } of this.object.children)
      material.uniforms.light.value.fromArray(userData.lamp.colour)
        .multiplyScalar(factorOf(userData.lamp.group));
  }
}
