// Shapes of steady flames at a moment, as in traced pictures (scenes/light/optics/flame_shape.hpp):
// along each ray the light of the mean flame is multiplied by a factor whose mean over time is 1.

/** Values of the lattice: of equal probability, standard normal. */
const valuesOfLattice = 1024;

/** How much brighter than its mean a flame is at most, on the axis of its base. */
export const brighterThanMean = 1.6;

/** By Abramowitz and Stegun, 7.1.26; its error is at most 1.5e-7. */
export function erfc(x) {
  const t = 1 / (1 + 0.3275911 * Math.abs(x));
  const tail = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 +
    t * 1.061405429)))) * Math.exp(-x * x);
  return x < 0 ? 2 - tail : tail;
}

/** The inverse of the standard normal distribution, by halving. */
function normalQuantile(u) {
  let low = -8;
  let high = 8;
  for (let i = 0; i < 60; ++i) {
    const middle = (low + high) / 2;
    if (0.5 * erfc(-middle / Math.SQRT2) < u) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** Their mean is 0, and their variance 1. */
export function normals() {
  const out = Float32Array.from({ length: valuesOfLattice },
    (_, i) => normalQuantile((i + 0.5) / valuesOfLattice));
  const squares = out.reduce((sum, v) => sum + v * v, 0);
  return out.map((v) => v / Math.sqrt(squares / valuesOfLattice));
}

/**
 * GLSL: `flameFactor` of flame `i` at the middle of a ray's chord. The numbers are those of
 * flame_shape.cpp, which has their sources. `radius`: of the flame at that height [m]; `opacity`:
 * the share of light from behind that the mean flame takes away.
 */
export const flameShapeTools = (flamesMost) => `
uniform vec3 shapeBase[${flamesMost}], shapeSize[${flamesMost}];
uniform uint shapeSeed[${flamesMost}];
uniform float flameTime;
uniform sampler2D normals;
uint mixedNumber(ivec3 at, uint seed) {
  uint h = seed;
  for (int k = 0; k < 3; ++k) {
    h ^= uint(at[k]) * 0x9e3779b1u;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h ^= h >> 16;
  }
  return h;
}
/** Standard normal at every place: the squares of the weights add up to 1. */
float latticeNoise(vec3 p, uint seed) {
  vec3 lower = floor(p);
  vec3 part = p - lower;
  vec3 angle = part * part * (3.0 - 2.0 * part) * 1.57079633;
  vec3 weights[2] = vec3[2](cos(angle), sin(angle));
  float sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    ivec3 o = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
    uint number = mixedNumber(ivec3(lower) + o, seed) % ${valuesOfLattice}u;
    sum += weights[o.x].x * weights[o.y].y * weights[o.z].z *
      texelFetch(normals, ivec2(int(number), 0), 0).r;
  }
  return sum;
}
float flameField(int i, vec3 above) {
  const vec4 sizes = vec4(0.8, 0.4, 0.19, 0.09);
  const vec4 perPuff = vec4(2.0, 3.2, 5.5, 10.0);
  const vec4 variances = vec4(0.2, 0.34, 0.27, 0.19);
  float width = max(shapeSize[i].x, shapeSize[i].y);
  float height = max(0.0, above.z);
  float onTheWay = 2.0 * sqrt(height) / 6.8;
  float puffs = 1.5 * inversesqrt(width);
  float reach = 0.11 * width * (0.4 + height / shapeSize[i].z);
  vec3 slow = vec3(above.xy / (0.5 * width), 3.0 * puffs * (onTheWay - 0.6 * flameTime));
  vec2 at = above.xy +
    reach * vec2(latticeNoise(slow, shapeSeed[i]), latticeNoise(slow, shapeSeed[i] + 1u));
  float sum = 0.0;
  for (int k = 0; k < 4; ++k)
    sum += sqrt(variances[k]) * latticeNoise(
      vec3(at / (sizes[k] * width), perPuff[k] * puffs * (onTheWay - flameTime)),
      shapeSeed[i] + 2u + uint(k));
  return sum;
}
float erfcOf(float x) {
  float t = 1.0 / (1.0 + 0.3275911 * abs(x));
  float tail = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 +
    t * 1.061405429)))) * exp(-x * x);
  return x < 0.0 ? 2.0 - tail : tail;
}
float flameFactor(int i, vec3 place, vec3 ray, float radius, float opacity) {
  if (shapeSeed[i] == 0u) return 1.0;
  vec3 above = place - shapeBase[i];
  float up = clamp(above.z / shapeSize[i].z, 0.0, 1.0);
  vec2 across = vec2(-ray.y, ray.x);
  float level = length(across);
  float off = level < 1e-6 ? 0.0
    : min(1.0, abs(dot(above.xy, across)) / (level * max(radius, 1e-4)));
  float wanted = (0.985 - 0.8 * pow(up, 1.4)) * (1.0 - 0.97 * off * off * off);
  float covered = clamp(max(wanted, 1.35 * opacity), max(opacity, 0.02), 1.0);
  float power = opacity > 0.0 ? min(0.6, covered / opacity - 1.0) : 0.6;
  float rank = 0.5 * erfcOf(-flameField(i, above) / 1.41421356);
  float within = (rank - (1.0 - covered)) / covered;
  if (within <= 0.0) return 0.0;
  return min((power + 1.0) / covered * pow(within, power), opacity > 0.0 ? 1.0 / opacity : 1e9);
}
`;
