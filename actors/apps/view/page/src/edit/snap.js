// Where a dragged thing comes to rest: in line with others, else on a grid. Pure.

export const grid_m = 0.05;
const reach_m = 0.12;

/** The coordinate of the nearest of `others` within reach, else the nearest one of the grid. */
function coordinate(value, others) {
  let best = Math.round(value / grid_m) * grid_m;
  let apart = reach_m;
  for (const other of others)
    if (Math.abs(other - value) < apart) [best, apart] = [other, Math.abs(other - value)];
  return best;
}

/**
 * Snaps the coordinates that a drag changes: `free` says which. Luminaires thus stand in rows, and
 * signs at one height.
 */
export function snapped(position, others, free) {
  return position.map((value, k) =>
    (free[k] ? coordinate(value, others.map((p) => p[k])) : value));
}

/** The horizontal direction of the building's axes nearest to a yaw: ahead, and to the right. */
export function axesOf(yaw) {
  const quarter = Math.round(yaw / (Math.PI / 2));
  const ahead = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]][((quarter % 4) + 4) % 4];
  return { ahead, right: [ahead[1], -ahead[0], 0] };
}
