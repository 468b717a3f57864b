// From luminance to the brightness of the screen: the same curve and the same fit of colours into
// the screen's gamut as in scenes/light/vision (tone.hpp, display_colour.hpp), as JavaScript for
// the curve's numbers and as GLSL for pixels. Pure.

/** The brightest face of a sign is shown no brighter than this. */
export const signLevel = 0.8;
/** A ratio r of luminances up to the knee is shown as at least r to this power. */
export const leastSlope = 0.45;
const knee = 0.7;

const bent = ({ bend }, exposed) => exposed * (1 + bend * exposed) ** (leastSlope - 1);

function slopeAt(curve, exposed) {
  const share = (curve.bend * exposed) / (1 + curve.bend * exposed);
  return (bent(curve, exposed) / exposed) * (1 + (leastSlope - 1) * share);
}

/** The shoulder's slope at the knee, over that of the straight line to white. */
const shoulderSlope = (curve) =>
  (slopeAt(curve, curve.knee) * (curve.white - curve.knee)) / (1 - bent(curve, curve.knee));

/** Screen value, 0 black to 1 white, of an exposed luminance. */
export function shownBy(curve, exposed) {
  if (!(exposed > 0)) return 0;
  if (exposed <= curve.knee) return bent(curve, exposed);
  if (exposed >= curve.white) return 1;
  const begin = bent(curve, curve.knee);
  const t = (exposed - curve.knee) / (curve.white - curve.knee);
  const slope = shoulderSlope(curve);
  return begin + ((1 - begin) * slope * t) / (1 + (slope - 1) * t);
}

/** The curve for an exposed white and the exposed luminance of the brightest sign (0: none). */
export function cameraCurve(white, sign) {
  const curve = { bend: 0, knee, white: Math.max(1, white) };
  if (!(shownBy(curve, sign) > signLevel)) return curve;
  curve.knee = sign;
  curve.bend = Math.max(0, (sign / signLevel) ** (1 / (1 - leastSlope)) - 1) / sign;
  const straight = sign + (1 - signLevel) / slopeAt(curve, sign);
  curve.white = Math.max(curve.white, straight);
  return curve;
}

/** The uniform `curve` of toneTools. */
export const curveUniform = (curve) =>
  [curve.bend, curve.knee, curve.white, shoulderSlope(curve)];

/** GLSL; needs `luminance`. `curve`: bend, knee, white, slope of the shoulder. */
export const toneTools = `
uniform vec4 curve;
float bent(float exposed) { return exposed * pow(1.0 + curve.x * exposed, ${leastSlope - 1}); }
float shownOf(float exposed) {
  if (exposed <= curve.y) return bent(max(exposed, 0.0));
  float begin = bent(curve.y);
  float t = clamp((exposed - curve.y) / max(curve.z - curve.y, 1e-6), 0.0, 1.0);
  return begin + (1.0 - begin) * curve.w * t / (1.0 + (curve.w - 1.0) * t);
}
// Oklab (B. Ottosson 2020) from linear sRGB and back: cone signals, and the weights of their cube
// roots in lightness.
const mat3 conesFromRgb = mat3(0.4122214708, 0.2119034982, 0.0883024619, 0.5363325363, 0.6806995451,
  0.2817188376, 0.0514459929, 0.1073969566, 0.6299787005);
const mat3 rgbFromCones = mat3(4.0767416621, -1.2684380046, -0.0041960863, -3.3077115913,
  2.6097574011, -0.7034186147, 0.2309699292, -0.3413193965, 1.7076147010);
const vec3 lightnessWeights = vec3(0.2104542553, 0.7936177850, -0.0040720468);
bool inGamut(vec3 c) {
  return all(greaterThanEqual(c, vec3(0.0))) && all(lessThanEqual(c, vec3(1.0)));
}
/** The colour at this luminance; it loses saturation if the screen cannot show it so bright. */
vec3 displayColour(vec3 c, float shown) {
  float y = luminance(c);
  if (!(y > 0.0)) return vec3(0.0);
  vec3 scaled = c / y;
  if (inGamut(scaled * shown)) return scaled * shown;
  vec3 cones = conesFromRgb * scaled;
  vec3 roots = sign(cones) * pow(abs(cones), vec3(1.0 / 3.0));
  vec3 apart = roots / dot(lightnessWeights, roots) - 1.0;
  vec3 inside = vec3(shown);
  float low = 0.0, high = 1.0;
  for (int i = 0; i < 9; ++i) {
    float saturation = 0.5 * (low + high);
    vec3 root = 1.0 + saturation * apart;
    vec3 rgb = rgbFromCones * (root * root * root);
    rgb *= shown / luminance(rgb);
    if (inGamut(rgb)) { low = saturation; inside = rgb; }
    else high = saturation;
  }
  return inside;
}
`;
