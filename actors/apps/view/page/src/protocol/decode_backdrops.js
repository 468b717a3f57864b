// Decodes backdrops.json: drawings under plans. The result has the fields, types and sizes that the
// rest of the page relies on, and nothing else.
import { fail } from './checked.js';

export const limits = {
  backdrops: 50,
  lines: 20000,
  metres: 1e7,
  pictureCharacters: 24 << 20,
};

function numbers(value, path, count) {
  const good = (n) => typeof n === 'number' && Math.abs(n) <= limits.metres;
  if (!Array.isArray(value) || value.length !== count || !value.every(good))
    fail(path, `not ${count} numbers`);
  return value;
}

function pictureOf(one, path) {
  if (typeof one.png !== 'string' || one.png.length > limits.pictureCharacters ||
      !/^[A-Za-z0-9+/]+=*$/.test(one.png))
    fail(`${path}.png`, 'no picture');
  return {
    png: one.png,
    corner: numbers(one.corner, `${path}.corner`, 2),
    across: numbers(one.across, `${path}.across`, 2),
    up: numbers(one.up, `${path}.up`, 2),
  };
}

function linesOf(lines, path) {
  if (!Array.isArray(lines) || lines.length > limits.lines) fail(`${path}.lines`, 'no lines');
  return lines.map((line, i) => numbers(line, `${path}.lines[${i}]`, 4));
}

/** `{floors: [low, high], lines: [[x, y, x, y]]}`, or with a picture `{floors, picture}`. */
export function decodeBackdrops(value) {
  if (!Array.isArray(value) || value.length > limits.backdrops) fail('backdrops', 'no list');
  return value.map((one, i) => {
    const path = `backdrops[${i}]`;
    if (typeof one !== 'object' || one === null) fail(path, 'no object');
    const floors = numbers(one.floors, `${path}.floors`, 2);
    return one.png === undefined
      ? { floors, lines: linesOf(one.lines, path) }
      : { floors, picture: pictureOf(one, path) };
  });
}

/** A plan is cut at most this far above its floor [m]. */
const cutAboveFloor = 2.2;
/** The lowest floor of a drawing that states none: below any other. */
const anyFloor = -1e6;

/**
 * The drawings of the highest storey whose floor may be under the height at which a plan is cut,
 * and those of all storeys.
 */
export function under(backdrops, cut) {
  const here = backdrops.filter(({ floors: [low, high] }) => {
    return low <= cut && high >= cut - cutAboveFloor;
  });
  const highest = Math.max(...here.map(({ floors }) => floors[0]));
  return here.filter(({ floors: [low] }) => low === highest || low < anyFloor);
}
