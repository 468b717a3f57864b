// How faces that shine by themselves are drawn, signs and lamps: added to the surface that they lie
// on, just before it.
import * as THREE from 'three';

export const addedLight = {
  glslVersion: THREE.GLSL3,
  blending: THREE.CustomBlending,
  blendSrc: THREE.OneFactor,
  blendDst: THREE.OneFactor,
  depthWrite: false,
  polygonOffset: true,
  polygonOffsetFactor: -1,
  polygonOffsetUnits: -4,
};
