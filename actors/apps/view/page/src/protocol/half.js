// IEEE half floats. Light arrives as halves and stays so in memory; a table of all 65 536 values
// makes decoding one look-up, which keeps dimming below a tenth of a second.

function valueOf(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 0x1f;
  const fraction = bits & 0x3ff;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 0x1f) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

export const halfValues = Float32Array.from({ length: 0x10000 }, (_, bits) => valueOf(bits));

export function allFinite(halves) {
  for (let i = 0; i < halves.length; ++i) if ((halves[i] & 0x7c00) === 0x7c00) return false;
  return true;
}

const asFloat = new Float32Array(1);
const asBits = new Uint32Array(asFloat.buffer);

/**
 * The nearest half; a value that is too large becomes the largest, since a picture needs no
 * infinities.
 */
export function toHalf(value) {
  asFloat[0] = value;
  const bits = asBits[0];
  const sign = (bits >>> 16) & 0x8000;
  const magnitude = bits & 0x7fffffff;
  if (magnitude >= 0x477fe000) return sign | 0x7bff;
  if (magnitude < 0x38800000) return sign | Math.round(Math.abs(asFloat[0]) * 2 ** 24);
  const rebased = magnitude - 0x38000000;
  const odd = (rebased >>> 13) & 1;
  return sign | ((rebased + 0xfff + odd) >>> 13);
}
