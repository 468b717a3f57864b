// Position and movement of the eye: walking, orbiting a point, and the plan from above. Pure
// functions on one plain object; z is up, yaw turns from +x towards +y, angles in radians.
import { add, clamp, cross, length, scale, subtract, unit } from './vectors.js';

export const eyeHeights = { standing: 1.65, sitting: 1.2, crawling: 0.6 };
export const speeds = { walk: 1.4, fast: 4, turn: 1.6 };
const steepest = 1.5;
const fovs = { low: 15, high: 110, usual: 65 };

/** `aspect`: of the picture, so that plan and orbit can show all of the building. */
export function startMotion(low, high, aspect = 1.6) {
  const centre = scale(add(low, high), 0.5);
  const size = subtract(high, low);
  const away = (0.9 * length(size) + 1) * Math.max(1, 1.4 / aspect);
  return {
    mode: 'walk',
    eye: [centre[0], centre[1], low[2] + eyeHeights.standing],
    yaw: 0,
    pitch: 0,
    fov: fovs.usual,
    height: eyeHeights.standing,
    orbit: { centre, distance: away, yaw: -2, pitch: 0.7 },
    plan: {
      centre: [centre[0], centre[1]],
      span: 1.25 * Math.max(size[1], size[0] / aspect, 2),
      cut: low[2] + Math.min(2.2, 0.9 * size[2]),
    },
  };
}

const direction = (yaw, pitch) => [
  Math.cos(pitch) * Math.cos(yaw),
  Math.cos(pitch) * Math.sin(yaw),
  Math.sin(pitch),
];

export const gazeOf = (motion) => direction(motion.yaw, motion.pitch);

/** The step of the held keys in `seconds`; forward and side from -1 to 1. It is horizontal. */
export function stride(motion, { forward, side, fast }, seconds) {
  const asked = Math.hypot(forward, side);
  if (asked === 0) return [0, 0, 0];
  const metres = ((fast ? speeds.fast : speeds.walk) * seconds) / Math.max(1, asked);
  const [c, s] = [Math.cos(motion.yaw), Math.sin(motion.yaw)];
  return [metres * (forward * c + side * s), metres * (forward * s - side * c), 0];
}

export function turn(motion, byYaw, byPitch) {
  const target = motion.mode === 'orbit' ? motion.orbit : motion;
  target.yaw = (target.yaw + byYaw) % (2 * Math.PI);
  const low = motion.mode === 'orbit' ? -0.3 : -steepest;
  target.pitch = clamp(target.pitch + byPitch, low, steepest);
}

/**
 * Nearer (factor below 1) or farther: changes the span in plan, the distance in orbit, else the
 * angle of view.
 */
export function zoom(motion, factor) {
  if (motion.mode === 'plan') motion.plan.span = clamp(motion.plan.span * factor, 1, 2000);
  else if (motion.mode === 'orbit')
    motion.orbit.distance = clamp(motion.orbit.distance * factor, 0.5, 2000);
  else motion.fov = clamp(motion.fov * factor, fovs.low, fovs.high);
}

/** Shifts the view by shares of the picture's height, in plan and in orbit. */
export function pan(motion, right, up) {
  if (motion.mode === 'plan') {
    motion.plan.centre[0] += right * motion.plan.span;
    motion.plan.centre[1] += up * motion.plan.span;
  } else if (motion.mode === 'orbit') {
    const { yaw, distance } = motion.orbit;
    const [s, c] = [Math.sin(yaw), Math.cos(yaw)];
    const shift = [-s * right - c * up, c * right - s * up, 0];
    motion.orbit.centre = add(motion.orbit.centre, scale(shift, distance));
  }
}

/** Stands at a place and looks at another; keeps the height of cameras. */
export function stand(motion, eye, target, fov = fovs.usual, floor = null) {
  const gaze = unit(subtract(target, eye), [1, 0, 0]);
  motion.mode = 'walk';
  motion.eye = [...eye];
  motion.yaw = Math.atan2(gaze[1], gaze[0]);
  motion.pitch = clamp(Math.asin(clamp(gaze[2], -1, 1)), -steepest, steepest);
  motion.fov = clamp(fov, fovs.low, fovs.high);
  if (floor !== null) motion.height = eye[2] - floor;
}

/** The camera of this motion: eye, target, up, and an angle or, in plan, a span in metres. */
export function viewOf(motion) {
  if (motion.mode === 'plan') {
    const [x, y] = motion.plan.centre;
    return { eye: [x, y, 500], target: [x, y, 0], up: [0, 1, 0], span: motion.plan.span };
  }
  if (motion.mode === 'orbit') {
    const { centre, distance, yaw, pitch } = motion.orbit;
    const eye = add(centre, scale(direction(yaw, pitch), distance));
    return { eye, target: centre, up: [0, 0, 1], fov: 45 };
  }
  const up = [0, 0, 1];
  return { eye: motion.eye, target: add(motion.eye, gazeOf(motion)), up, fov: motion.fov };
}

/** The ray through a place of the picture, each from -1 to 1, right and up. */
export function rayThrough(view, aspect, x, y) {
  const ahead = unit(subtract(view.target, view.eye));
  const right = unit(cross(ahead, view.up), [1, 0, 0]);
  const up = cross(right, ahead);
  const half = view.span ? view.span / 2 : Math.tan((view.fov * Math.PI) / 360);
  const shift = add(scale(right, x * half * aspect), scale(up, y * half));
  if (view.span) return { origin: add(view.eye, shift), direction: ahead };
  return { origin: view.eye, direction: unit(add(ahead, shift)) };
}
