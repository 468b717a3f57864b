// Where people are at a time: between the places that are known, they walk evenly. Pure.

/** The first time at which anybody is there, and the last; null for nobody. */
export function presenceOf({ people }) {
  if (!people.length) return null;
  return people.reduce(({ from, to }, one) => ({
    from: Math.min(from, one.from),
    to: Math.max(to, one.to),
  }), { from: Infinity, to: -Infinity });
}

function footAt({ from, to, feet }, step, time) {
  const last = feet.length / 3 - 1;
  const at = Math.min(last, Math.floor((time - from) / step));
  const next = Math.min(last, at + 1);
  const begin = from + step * at;
  // The last step may be shorter than the others.
  const lasts = Math.min(to, begin + step) - begin;
  const share = lasts > 0 ? (time - begin) / lasts : 0;
  return [0, 1, 2].map((k) =>
    feet[3 * at + k] + share * (feet[3 * next + k] - feet[3 * at + k]));
}

/** `[{eyeHeight, foot: [x, y, z]}]` of those who are there. */
export function peopleAt({ step, people }, time) {
  return people.filter(({ from, to }) => time >= from && time <= to)
    .map((person) => ({ eyeHeight: person.eyeHeight, foot: footAt(person, step, time) }));
}
