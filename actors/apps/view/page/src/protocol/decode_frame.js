// Decodes binary frames: a header of 16 bytes, then content by kind. Every length is checked
// against the counts that announce it before anything is read.
import { allFinite, halfValues } from './half.js';

export const kinds = { geometry: 1, surfaceLight: 2, smoke: 3, smokeLight: 4 };
export const headerBytes = 16;
export const limits = { triangles: 4_000_000, groups: 4096, voxels: 1 << 24 };

const whiteNumbers = 3;

export class ProtocolError extends Error {}

function demand(condition, what) {
  if (!condition) throw new ProtocolError(what);
}

function geometryOf(buffer, triangles) {
  demand(triangles > 0 && triangles <= limits.triangles, `${triangles} triangles`);
  const cornerBytes = 36 * triangles;
  const expected = headerBytes + cornerBytes + 4 * triangles;
  demand(buffer.byteLength === expected, `geometry of ${buffer.byteLength} bytes, not ${expected}`);
  const corners = new Float32Array(buffer, headerBytes, 9 * triangles);
  demand(corners.every(Number.isFinite), 'a corner that is not finite');
  return { triangles, corners, surfaces: new Uint32Array(buffer, headerBytes + cornerBytes) };
}

function halvesOf(buffer) {
  demand((buffer.byteLength - headerBytes) % 2 === 0, 'half a half number');
  const halves = new Uint16Array(buffer, headerBytes);
  demand(halves.length <= 6 * limits.voxels, `${halves.length} numbers in a frame`);
  demand(allFinite(halves), 'light that is not finite');
  return halves;
}

/** Light on surfaces, and behind it a white surface in it, as numbers. */
function surfaceLightOf(numbers) {
  const end = numbers.length - whiteNumbers;
  demand(end >= 0, `light of ${numbers.length} numbers`);
  const white = Array.from(numbers.subarray(end), (half) => halfValues[half]);
  return { halves: numbers.subarray(0, end), white };
}

/** Checks and decodes a frame; throws ProtocolError. The result refers to the buffer. */
export function decodeFrame(buffer) {
  demand(buffer.byteLength >= headerBytes, 'a frame without a header');
  const [kind, generation, a] = new Uint32Array(buffer, 0, 4);
  switch (kind) {
    case kinds.geometry:
      return { kind, generation, ...geometryOf(buffer, a) };
    case kinds.surfaceLight:
      demand(a < limits.groups, `group number ${a}`);
      return { kind, generation, group: a, ...surfaceLightOf(halvesOf(buffer)) };
    case kinds.smokeLight:
      demand(a < limits.groups, `group number ${a}`);
      return { kind, generation, group: a, halves: halvesOf(buffer) };
    case kinds.smoke:
      return { kind, generation, halves: halvesOf(buffer) };
    default:
      throw new ProtocolError(`frame of unknown kind ${kind}`);
  }
}
