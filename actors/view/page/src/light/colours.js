// Colours for luminances: the scale of false colours and words for numbers.

/** Linear sRGB weights of luminance. */
export const luminanceWeights = [0.2126, 0.7152, 0.0722];

export const luminanceOf = ([r, g, b]) =>
  luminanceWeights[0] * r + luminanceWeights[1] * g + luminanceWeights[2] * b;

/** The legend's decades: from a moonlit floor to a luminaire looked at. */
export const scaleLow = 1e-3;
export const scaleHigh = 1e3;

// Lightness rises all the way, so that the scale survives colour blindness and grey print.
const stops = [
  [0, 12, 10, 24],
  [1 / 6, 46, 30, 110],
  [2 / 6, 24, 92, 160],
  [3 / 6, 22, 148, 140],
  [4 / 6, 112, 190, 72],
  [5 / 6, 246, 208, 76],
  [1, 255, 246, 224],
];

/** sRGB bytes at `t` from 0 to 1 along the scale. */
export function scaleColour(t) {
  const x = Math.min(1, Math.max(0, t));
  const i = Math.max(1, stops.findIndex(([at]) => at >= x));
  const [from, to] = [stops[i - 1], stops[i]];
  const share = (x - from[0]) / (to[0] - from[0]);
  return [1, 2, 3].map((c) => Math.round(from[c] + share * (to[c] - from[c])));
}

/** Where a luminance lies on the scale. */
export const scalePlace = (luminance) =>
  Math.log10(Math.max(luminance, 1e-12) / scaleLow) / Math.log10(scaleHigh / scaleLow);

/** 256 colours as r g b a bytes. */
export function scaleTexels() {
  const texels = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) texels.set([...scaleColour(i / 255), 255], 4 * i);
  return texels;
}

const significant = (value, digits) => {
  if (value === 0) return '0';
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value))));
  return decimals > 6 ? value.toExponential(digits - 1) : value.toFixed(Math.min(6, decimals));
};

const grouped = (digits) =>
  digits.length > 4 ? digits.replace(/\B(?=(\d{3})+$)/g, '\u202f') : digits;

/** How many: all digits of a whole number. */
export const count = (n) => grouped(Math.round(n).toFixed(0));

/** A number in words, e.g. 0.0123, 1.23, 12 300; three digits unless told. */
export function words(value, digits = 3) {
  if (value === null || !Number.isFinite(value)) return '–';
  const [head, tail] = significant(value, digits).split('.');
  return tail ? `${grouped(head)}.${tail}` : grouped(head);
}

/** Value and standard error: the error with two digits, the value with as many places. */
export function wordsWithError(value, error) {
  if (value === null) return '–';
  if (!(error > 0)) return words(value);
  const places = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(error))));
  const [head, tail] = value.toFixed(places).split('.');
  return `${grouped(head)}${tail ? `.${tail}` : ''} ± ${words(error, 2)}`;
}
