// People as silhouettes: a body as wide as those that hide signs, up to the chin, and a ball about
// the eyes, like the bodies of people_as_bodies. They hide what is behind them and stand in smoke,
// but the traced light knows nothing of them.
import * as THREE from 'three';
import { peopleFragment, peopleVertex } from './glsl.js';

const bodyRadius_m = 0.25;
const headRadius_m = 0.13;
const shouldersBelowEyes_m = 0.12;
/** Clothes send less light back than the floor before them. */
const darkerThanFloor = 0.5;
const sides = 32;
/** The floor under a person is looked for this far above and below the feet. */
const floorWithin_m = 0.3;

/** About the foot: a body 1 m high, and a head about the eyes; `head` tells them apart. */
function silhouette() {
  const body = new THREE.CylinderGeometry(bodyRadius_m, bodyRadius_m, 1, sides)
    .rotateX(Math.PI / 2).translate(0, 0, 0.5);
  const head = new THREE.SphereGeometry(headRadius_m, sides, sides / 2);
  const out = new THREE.InstancedBufferGeometry();
  const count = body.attributes.position.count;
  const positions = [...body.attributes.position.array, ...head.attributes.position.array];
  const heads = positions.slice(0, positions.length / 3).map((_, i) => (i < count ? 0 : 1));
  out.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
  out.setAttribute('head', new THREE.BufferAttribute(new Float32Array(heads), 1));
  out.setIndex([...body.index.array, ...[...head.index.array].map((i) => i + count)]);
  return out;
}

export class People {
  /** `cut` and `above`: heights between which is drawn; people below a cut are drawn whole. */
  constructor({ cut, above }) {
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: peopleVertex,
      fragmentShader: peopleFragment,
      uniforms: { cut, above, shouldersBelowEyes: { value: shouldersBelowEyes_m } },
    });
    this.mesh = new THREE.Mesh(silhouette(), material);
    this.mesh.frustumCulled = false;
    this.build(0);
  }

  /** Room for this many people at a time. */
  build(most) {
    const { geometry } = this.mesh;
    geometry.dispose();
    const sizes = { foot: 3, eye: 1, light: 3 };
    for (const [name, size] of Object.entries(sizes)) {
      const values = new THREE.InstancedBufferAttribute(new Float32Array(size * most), size);
      geometry.setAttribute(name, values.setUsage(THREE.DynamicDrawUsage));
    }
    this.floors = [];
    geometry.instanceCount = 0;
    this.mesh.visible = false;
  }

  /** `people`: as of peopleAt. `building`: where they stand; null before there is one. */
  place(people, building) {
    const { foot, eye } = this.mesh.geometry.attributes;
    people.forEach((one, i) => {
      foot.array.set(one.foot, 3 * i);
      eye.array[i] = one.eyeHeight;
    });
    this.floors = people.map(({ foot: [x, y, z] }) =>
      building?.ahead([x, y, z + floorWithin_m], [0, 0, -1], 2 * floorWithin_m)?.triangle ?? -1);
    foot.needsUpdate = eye.needsUpdate = true;
    this.mesh.geometry.instanceCount = people.length;
    this.mesh.visible = people.length > 0;
  }

  /**
   * `light`: the LightSum of surfaces, or null. A person is as bright as the floor at the feet, but
   * for darker clothes; black where there is no floor.
   */
  shine(light) {
    const colours = this.mesh.geometry.attributes.light;
    this.floors.forEach((triangle, i) => {
      const lit = triangle >= 0 && light !== null && triangle < light.cells;
      for (let c = 0; c < 3; ++c)
        colours.array[3 * i + c] = lit ? darkerThanFloor * light.sum[8 * triangle + c] : 0;
    });
    colours.needsUpdate = true;
  }
}
