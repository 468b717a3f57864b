// Parts of messages, each checked before it is used: what is not of its type, range or length throws
// a ProtocolError that names its place.
import { ProtocolError } from './decode_frame.js';

const characters = 2048;
/** Most things in a list. */
export const listed = 4096;

export function fail(path, what) {
  throw new ProtocolError(`${path}: ${what}`);
}

export function number(value, path, low = -1e12, high = 1e12) {
  if (typeof value !== 'number' || !(value >= low && value <= high))
    fail(path, `not a number from ${low} to ${high}`);
  return value;
}

export function text(value, path) {
  if (typeof value !== 'string' || value.length > characters) fail(path, 'not a short text');
  return value;
}

export function list(value, path, read, most = listed) {
  if (!Array.isArray(value) || value.length > most) fail(path, 'not a list');
  return value.map((item, i) => read(item, `${path}[${i}]`));
}

export function record(value, path) {
  if (typeof value !== 'object' || value === null || Array.isArray(value)) fail(path, 'no object');
  return value;
}

/** The bytes of a text in base64. */
export function bytesOf(value, path) {
  if (typeof value !== 'string' || value.length % 4 || !/^[A-Za-z0-9+/]*={0,2}$/.test(value))
    fail(path, 'not base64');
  return Uint8Array.from(atob(value), (c) => c.charCodeAt(0));
}
