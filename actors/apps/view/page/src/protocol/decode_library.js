// Decodes library.json: kinds of luminaires and signs that may be added. The result has the fields,
// types and sizes that the rest of the page relies on, and nothing else.
import { bytesOf, fail, list, number, record, text } from './checked.js';

export const limits = { kinds: 500, colours: 8, angles: 361 };

/** Two half planes of intensities from -180 to 180 degrees, 0 straight down; null without. */
function curvesOf(value, path, step) {
  if (value === null || value === undefined) return null;
  const count = 360 / step + 1;
  const curves = list(value, path, (curve, at) => {
    const values = list(curve, at, (cd, i) => number(cd, i, 0, 1e9), limits.angles);
    return values.length === count ? values : fail(at, `${values.length} angles, not ${count}`);
  }, 2);
  return curves.length === 2 ? curves : fail(path, 'not two planes');
}

const luminaire = (step) => (value, path) => {
  const l = record(value, path);
  return {
    kind: 'luminaire',
    of: text(l.of, `${path}.of`),
    ofType: l.of_type === true,
    product: text(l.product, `${path}.product`),
    maker: text(l.maker, `${path}.maker`),
    file: text(l.file, `${path}.file`),
    mains: number(l.mains, `${path}.mains`, 0, 1e12),
    emergency: number(l.emergency, `${path}.emergency`, 0, 1e12),
    unit: l.unit === 'W' ? 'W' : 'lm',
    curves: curvesOf(l.curves, `${path}.curves`, step),
  };
};

function faceOf(value, path) {
  const { columns, rows, texels } = record(value, path);
  const cells = number(columns, `${path}.columns`, 1, 96) * number(rows, `${path}.rows`, 1, 96);
  const bytes = bytesOf(texels, path);
  if (bytes.length !== cells) fail(path, `${bytes.length} texels, not ${cells}`);
  return { columns, rows, texels: bytes };
}

function sign(value, path) {
  const s = record(value, path);
  const byte = (v, at) => number(v, at, 0, 255);
  return {
    kind: 'sign',
    of: text(s.of, `${path}.of`),
    ofType: s.of_type === true,
    file: text(s.file, `${path}.file`),
    text: text(s.text, `${path}.text`),
    width: number(s.width, `${path}.width`, 1e-3, 100),
    height: number(s.height, `${path}.height`, 1e-3, 100),
    colours: list(s.colours, `${path}.colours`, (rgb, at) => list(rgb, at, byte, 3),
      limits.colours),
    face: faceOf(s.face, `${path}.face`),
  };
}

/** `{step, kinds}`: luminaires first. */
export function decodeLibrary(value) {
  const { step, luminaires, signs } = record(value, 'library');
  if (360 % number(step, 'step', 1, 90) !== 0) fail('step', 'no part of a circle');
  return {
    step,
    kinds: [...list(luminaires, 'luminaires', luminaire(step), limits.kinds),
      ...list(signs, 'signs', sign, limits.kinds)],
  };
}
