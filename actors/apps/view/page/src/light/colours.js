// Luminances: their place on the scale of false colours, and text for numbers.
import { scaleColours, scaleHigh, scaleLow } from './colour_map.js';

/** Linear sRGB weights of luminance. */
export const luminanceWeights = [0.2126, 0.7152, 0.0722];

export const luminanceOf = ([r, g, b]) =>
  luminanceWeights[0] * r + luminanceWeights[1] * g + luminanceWeights[2] * b;

/** Where the colours of illuminance change [lx]; 0.5, 1 and 5 lx of EN 1838 are among them. */
export const luxSteps =
  [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

/** sRGB bytes at `t` from 0 to 1 along the scale. */
export function scaleColour(t) {
  const last = scaleColours.length - 1;
  const rgb = parseInt(scaleColours[Math.round(Math.min(1, Math.max(0, t)) * last)], 16);
  return [rgb >> 16, (rgb >> 8) & 255, rgb & 255];
}

/** The position of a luminance on the scale. */
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

/** A count: all digits of a whole number. */
export const count = (n) => grouped(Math.round(n).toFixed(0));

/** A number as text, e.g. 0.0123, 1.23, 12 300; three digits by default. */
export function words(value, digits = 3) {
  if (value === null || !Number.isFinite(value)) return '–';
  const [head, tail] = significant(value, digits).split('.');
  return tail ? `${grouped(head)}.${tail}` : grouped(head);
}

/** Value and standard error: the error with two digits, the value with as many decimals. */
export function wordsWithError(value, error) {
  if (value === null) return '–';
  if (!(error > 0)) return words(value);
  const places = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(error))));
  const [head, tail] = value.toFixed(places).split('.');
  return `${grouped(head)}${tail ? `.${tail}` : ''} ± ${words(error, 2)}`;
}
