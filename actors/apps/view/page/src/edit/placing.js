// Where something that is added from the library is put: in front of the viewer, luminaires under
// the ceiling, signs on the wall in view. Pure, with a building of walls and floors.
import { add, scale, unit } from '../walk/vectors.js';

const ahead_m = 2;
const offWall_m = 0.3;
const underCeiling_m = 0.03;
/** The face of a sign, whose body is behind it, before its wall. */
const offFace_m = 0.04;
const usualCeiling_m = 2.7;
const usualSign_m = 2.2;
const farthest_m = 30;
const up = [0, 0, 1];

/** Below the ceiling over a place at eye height, else at a usual height above its floor. */
function underCeiling(building, [x, y, z]) {
  const over = building.ahead([x, y, z], up, farthest_m);
  const floor = building.floorUnder([x, y, z]) ?? 0;
  return [x, y, over ? z + over.distance - underCeiling_m : floor + usualCeiling_m];
}

/** A place ahead of an eye, before the next wall. */
function aheadOf(building, eye, direction) {
  const level = unit([direction[0], direction[1], 0], [1, 0, 0]);
  const wall = building.ahead(eye, level, ahead_m + offWall_m);
  const far = wall ? Math.max(0, wall.distance - offWall_m) : ahead_m;
  return { place: add(eye, scale(level, far)), level };
}

/**
 * `ray`: through the middle of the picture. `centre`: of plan and orbit, where nobody stands; they
 * show nothing above `cut`.
 */
export function placeOf(kind, building, { eye, ray, mode, centre, cut }) {
  const walking = mode === 'walk';
  if (kind === 'luminaire') {
    const under = walking ? aheadOf(building, eye, ray.direction).place : centre;
    return { position: underCeiling(building, under) };
  }
  const hit = mode === 'plan' ? null : building.nearest(ray.origin, ray.direction, cut);
  if (hit && Math.abs(hit.normal[2]) < 0.5) {
    const normal = scale(hit.normal, hit.front ? 1 : -1);
    const facing = unit([normal[0], normal[1], 0]);
    return { position: add(hit.point, scale(facing, offFace_m)), facing };
  }
  const { place, level } = walking ? aheadOf(building, eye, ray.direction)
    : { place: centre, level: [1, 0, 0] };
  const floor = building.floorUnder(place) ?? 0;
  return { position: [place[0], place[1], floor + usualSign_m], facing: scale(level, -1) };
}
