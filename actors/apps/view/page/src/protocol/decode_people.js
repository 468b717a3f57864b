// Decodes people.json: where people are at even steps of time. The result has the fields, types and
// sizes that the rest of the page relies on, and nothing else.
import { bytesOf, fail, number } from './checked.js';

export const limits = { people: 20000, places: 1000000, seconds: 1e7, metres: 1e7 };

function feetOf(value, path) {
  const bytes = bytesOf(value, path);
  if (bytes.length === 0 || bytes.length % 12) fail(path, `${bytes.length} bytes`);
  const feet = new Float32Array(bytes.buffer);
  if (!feet.every((x) => Math.abs(x) <= limits.metres)) fail(path, 'a place is too far away');
  return feet;
}

/** `{step, people: [{eyeHeight, from, to, feet: Float32Array}]}` */
export function decodePeople(value) {
  if (typeof value !== 'object' || value === null) fail('people', 'no object');
  const step = number(value.step, 'step', 1e-3, limits.seconds);
  if (!Array.isArray(value.people) || value.people.length > limits.people)
    fail('people', 'no list');
  let places = 0;
  const people = value.people.map((one, i) => {
    const path = `people[${i}]`;
    if (typeof one !== 'object' || one === null) fail(path, 'no object');
    const from = number(one.from, `${path}.from`, -limits.seconds, limits.seconds);
    const to = number(one.to, `${path}.to`, from, limits.seconds);
    const feet = feetOf(one.feet, `${path}.feet`);
    places += feet.length / 3;
    if (places > limits.places) fail('people', 'too many places');
    return { eyeHeight: number(one.eye_height, `${path}.eye_height`, 0.1, 10), from, to, feet };
  });
  return { step, people };
}
