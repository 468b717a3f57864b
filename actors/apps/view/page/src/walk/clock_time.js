// Time of a scene that changes: fire, doors, mains and people. Light is traced for states at even
// steps; people move between them. Pure.

/** The first and last time of states and people, either of which may be null; or null. */
export function spanOf(states, people) {
  const spans = [states, people].filter((span) => span !== null);
  if (!spans.length) return null;
  return {
    from: Math.min(...spans.map(({ from }) => from)),
    to: Math.max(...spans.map(({ to }) => to)),
  };
}

/** Steps until a time is reached or passed. */
export const stepsIn = (seconds, step) => Math.ceil(seconds / step - 1e-9);

/** The time of the state nearest to a time: the last one is where the clock ends. */
export function stateAt({ from, to, step }, time) {
  const before = from + step * Math.floor((Math.min(to, Math.max(from, time)) - from) / step);
  const after = Math.min(to, before + step);
  return time - before < after - time ? before : after;
}
