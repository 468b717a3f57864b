// White as eyes take it, as in pictures (scenes/light/vision/adapted_white.*): they adapt to the
// colour of the light on surfaces, the less, the dimmer and the warmer it is. Pure.

/** A typical monitor, whose white is D65 [cd/m2]. */
const monitor_cd_m2 = 200;
const d65 = [0.95047, 1, 1.08883];

/** Rows of matrices: linear sRGB to XYZ, and responses of cones (Hunt, Pointer and Estevez). */
const xyzOfRgb = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175],
  [0.0193339, 0.119192, 0.9503041]];
const conesOfXyz = [[0.38971, 0.68898, -0.07868], [-0.22981, 1.1834, 0.04641], [0, 0, 1]];

const times = (matrix, v) => matrix.map((row) => row.reduce((sum, m, i) => sum + m * v[i], 0));
const product = (a, b) => a.map((row) =>
  [0, 1, 2].map((c) => row.reduce((sum, m, i) => sum + m * b[i][c], 0)));

function inverse([[a, b, c], [d, e, f], [g, h, i]]) {
  const [x, y, z] = [e * i - f * h, f * g - d * i, d * h - e * g];
  const whole = a * x + b * y + c * z;
  return [[x, c * h - b * i, b * f - c * e], [y, a * i - c * g, c * d - a * f],
    [z, b * g - a * h, a * e - b * d]].map((row) => row.map((v) => v / whole));
}

const conesOfRgb = product(conesOfXyz, xyzOfRgb);
const rgbOfCones = inverse(conesOfRgb);

/** Gain of each kind of cones of an eye adapted to this light: Fairchild 1991. */
function gains(xyz) {
  const root = Math.cbrt(xyz[1]);
  const cones = times(conesOfXyz, xyz.map((v) => v / xyz[1]));
  const sum = cones[0] + cones[1] + cones[2];
  return cones.map((cone) => {
    const against = (3 * cone) / sum;
    return (1 + root + against) / (1 + root + 1 / against) / cone;
  });
}

/**
 * The matrix, by columns, that turns linear sRGB into what it looks like on a monitor, but for its
 * luminance, which stays. `white`: a white surface in the light, linear sRGB [cd/m2].
 */
export function adaptedWhite(white) {
  const xyz = times(xyzOfRgb, white);
  const same = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  if (!(xyz[1] > 0) || times(conesOfXyz, xyz).some((cone) => !(cone > 0))) return same;
  const own = gains(xyz);
  const monitor = gains(d65.map((v) => v * monitor_cd_m2));
  const matrix = product(rgbOfCones, conesOfRgb.map((row, k) =>
    row.map((v) => (v * own[k]) / monitor[k])));
  return [0, 1, 2].flatMap((column) => matrix.map((row) => row[column]));
}

/** GLSL; needs `luminance`. */
export const whiteTools = `
uniform mat3 white;
vec3 onMonitor(vec3 c) {
  vec3 seen = white * c;
  float y = luminance(seen);
  return y > 0.0 ? seen * (luminance(c) / y) : c;
}
`;
