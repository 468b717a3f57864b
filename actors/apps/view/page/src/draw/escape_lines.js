// Routes, areas and points of emphasis as lines on the plan. Pure.

/** A storey's routes are drawn below its cut, as far as this [m]. */
const storey_m = 3.5;
const arrow_m = 0.35;

export const isBelow = (z, cut) => z <= cut && z > cut - storey_m;

function segment(out, [ax, ay], [bx, by], z) {
  out.push(ax, ay, z, bx, by, z);
}

/** A centre line with an arrow at its end, and the edges of its width. */
function routeLines({ path, width }, cut, out) {
  for (let i = 0; i + 1 < path.length; ++i) {
    const [a, b] = [path[i], path[i + 1]];
    const far = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (!(far > 0) || !(isBelow(a[2], cut) || isBelow(b[2], cut))) continue;
    const along = [(b[0] - a[0]) / far, (b[1] - a[1]) / far];
    const side = [-along[1] * (width / 2), along[0] * (width / 2)];
    segment(out.lines, a, b, a[2]);
    for (const s of [1, -1])
      segment(out.edges, [a[0] + s * side[0], a[1] + s * side[1]],
        [b[0] + s * side[0], b[1] + s * side[1]], a[2]);
    if (i + 2 < path.length) continue;
    for (const s of [1, -1])
      segment(out.lines, b, [b[0] - arrow_m * (along[0] + s * 0.5 * along[1]),
        b[1] - arrow_m * (along[1] - s * 0.5 * along[0])], a[2]);
  }
}

/** `lines` of routes, their `edges`, and outlines of `areas`: six numbers for each segment. */
export function escapeLines({ routes, areas }, cut) {
  const out = { lines: [], edges: [], areas: [] };
  for (const route of routes) routeLines(route, cut, out);
  for (const { outline, z } of areas)
    if (isBelow(z, cut))
      outline.forEach((corner, i) =>
        segment(out.areas, corner, outline[(i + 1) % outline.length], z));
  return out;
}

/** Points of emphasis of the storey below a cut. */
export const emphasisBelow = ({ emphasis }, cut) =>
  emphasis.filter(({ position }) => isBelow(position[2], cut));
