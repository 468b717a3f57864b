// Draws self-luminous faces of signs and lamps: added to the surface that they lie on, slightly
// before it.
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
