// A small building for tests of the page: two rooms, a doorway, three luminaires, a flame, signs,
// and a smoke layer, lit by the inverse square law and a little ambient light. Physically crude,
// but linear in every group, as the page must be.
import { toHalf } from '../../actors/apps/view/page/src/protocol/half.js';

export const low = [0, 0, 0];
export const high = [11, 6, 3];
const wallAt = 6.5;
const door = { low: 2.3, high: 3.5, top: 2.1 };
const tile_m = 0.25;

const minus = (a, b) => a.map((x, i) => x - b[i]);
const plus = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export const surfaces = {
  floor: [0.3, 0.28, 0.25],
  ceiling: [0.8, 0.8, 0.8],
  wall: [0.6, 0.58, 0.54],
  partition: [0.55, 0.5, 0.42],
  table: [0.4, 0.25, 0.15],
};
export const surfaceNames = Object.keys(surfaces);

/** Triangles of parallelograms in tiles; the front faces along u x v. */
class Mesh {
  corners = [];
  kinds = [];

  sheet(name, origin, u, v) {
    const tiles = [u, v].map((e) => Math.max(1, Math.round(Math.hypot(...e) / tile_m)));
    const at = (i, j) => plus(plus(origin, u, i / tiles[0]), v, j / tiles[1]);
    for (let i = 0; i < tiles[0]; ++i)
      for (let j = 0; j < tiles[1]; ++j) {
        const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        this.corners.push(...a, ...b, ...c, ...a, ...c, ...d);
        const surface = surfaceNames.indexOf(name);
        this.kinds.push(surface, surface);
      }
  }

  box(name, from, size) {
    const [x, y, z] = [[size[0], 0, 0], [0, size[1], 0], [0, 0, size[2]]];
    this.sheet(name, from, y, x);
    this.sheet(name, plus(from, z), x, y);
    this.sheet(name, from, x, z);
    this.sheet(name, plus(from, y), z, x);
    this.sheet(name, from, z, y);
    this.sheet(name, plus(from, x), y, z);
  }
}

function makeMesh() {
  const mesh = new Mesh();
  const [w, d, h] = high;
  mesh.sheet('floor', [0, 0, 0], [w, 0, 0], [0, d, 0]);
  mesh.sheet('ceiling', [0, 0, h], [0, d, 0], [w, 0, 0]);
  mesh.sheet('wall', [0, 0, 0], [0, 0, h], [w, 0, 0]);
  mesh.sheet('wall', [0, d, 0], [w, 0, 0], [0, 0, h]);
  mesh.sheet('wall', [0, 0, 0], [0, d, 0], [0, 0, h]);
  mesh.sheet('wall', [w, 0, 0], [0, 0, h], [0, d, 0]);
  const thick = 0.12;
  mesh.box('partition', [wallAt, 0, 0], [thick, door.low, h]);
  mesh.box('partition', [wallAt, door.high, 0], [thick, d - door.high, h]);
  mesh.box('partition', [wallAt, door.low, door.top], [thick, door.high - door.low, h - door.top]);
  mesh.box('table', [1.5, 4.2, 0.68], [1.8, 0.8, 0.06]);
  for (const [x, y] of [[1.55, 4.25], [3.2, 4.25], [1.55, 4.9], [3.2, 4.9]])
    mesh.box('table', [x, y, 0], [0.05, 0.05, 0.68]);
  mesh.box('table', [4.1, 0.1, 0], [0.9, 0.45, 1.7]);
  return mesh;
}

const mesh = makeMesh();

/** The room with the faces of added signs, which come last. */
function meshOf(state) {
  const added = state?.signs.filter((sign) => sign.added) ?? [];
  if (!added.length) return mesh;
  const all = Object.assign(new Mesh(), { corners: [...mesh.corners], kinds: [...mesh.kinds] });
  for (const { position, facing, up, width, height } of added) {
    const right = cross(up, facing);
    const low = plus(plus(position, right, -width / 2), up, -height / 2);
    const [u, v] = [right.map((x) => x * width), up.map((x) => x * height)];
    const [b, c, d] = [plus(low, u), plus(plus(low, u), v), plus(low, v)];
    all.corners.push(...low, ...b, ...c, ...low, ...c, ...d);
    const dark = surfaceNames.indexOf('table');
    all.kinds.push(dark, dark);
  }
  return all;
}

export const trianglesOf = (state) => meshOf(state).kinds.length;

export function geometryFrame(generation, state = null) {
  const mesh = meshOf(state);
  const triangles = mesh.kinds.length;
  const frame = new ArrayBuffer(16 + 40 * triangles);
  new Uint32Array(frame, 0, 4).set([1, generation, triangles, 0]);
  new Float32Array(frame, 16, 9 * triangles).set(mesh.corners);
  new Uint32Array(frame, 16 + 36 * triangles).set(mesh.kinds);
  return frame;
}

/** Light sources: intensity [cd] by colour, equal in all directions. */
export const sources = [
  { name: 'lamp west', kind: 'luminaire', position: [2.2, 3, 2.9], colour: [260, 250, 230] },
  { name: 'lamp door', kind: 'luminaire', position: [5.2, 3, 2.9], colour: [200, 195, 180] },
  { name: 'lamp east', kind: 'luminaire', position: [8.8, 3, 2.9], colour: [260, 255, 250] },
  { name: 'exit sign', kind: 'sign', position: [6.4, 2.9, 2.4], colour: [0.2, 1.8, 0.7] },
  { name: 'far exit', kind: 'sign', position: [10.9, 4.6, 2.3], colour: [0.2, 1.8, 0.7] },
  { name: 'fire in a bin', kind: 'flame', position: [9.6, 1, 0.5], colour: [130, 48, 9] },
];

const arrow = (x, y) =>
  (Math.abs(y) < 0.13 && x > -0.2 && x < 0.25) || (x >= 0.25 && x < 0.55 && Math.abs(y) < 0.55 - x);

function texels(columns, rows) {
  const bytes = Buffer.alloc(columns * rows, 1);
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < columns; ++c) {
      const x = (2 * (c + 0.5)) / columns - 1;
      const y = (1 - (2 * (r + 0.5)) / rows) * 0.5;
      const doorway = x > -0.85 && x < -0.45 && Math.abs(y) < 0.36;
      if (arrow(x, y) || doorway) bytes[r * columns + c] = 0;
    }
  return bytes.toString('base64');
}

const face = { width: 0.6, height: 0.3, columns: 128, rows: 64, texels: texels(128, 64),
  colours: [[160, 165, 170], [0.6, 46, 9]], up: [0, 0, 1] };

export function startState() {
  return {
    scenario: 'smoke, mains',
    smoke: 1,
    sources: [...sources],
    factors: Object.fromEntries(sources.map(({ name }) => [name, 1])),
    signs: [
      { ...face, name: 'exit sign', position: [6.49, 2.9, 2.4], facing: [-1, 0, 0],
        double_sided: false, group: 'exit sign' },
      { ...face, name: 'far exit', position: [10.99, 4.6, 2.3], facing: [-1, 0, 0],
        double_sided: false, group: 'far exit' },
    ],
    luminaires: sources.filter((s) => s.kind === 'luminaire')
      .map(({ name, position }) => ({ name, position, group: name })),
  };
}

const edge = 0.5;
export const voxels = { low, edge, count: [22, 12, 6] };
const voxelCount = voxels.count.reduce((a, b) => a * b);

const voxelCentre = (i) => {
  const [nx, ny] = voxels.count;
  return [i % nx, Math.floor(i / nx) % ny, Math.floor(i / (nx * ny))].map((n) => (n + 0.5) * edge);
};

const weigh = (c) => 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

/** Mean cosine of the smoke's scattering. */
const meanCosine = 0.6;

/** Extinction [1/m]: a layer below the ceiling, a plume above the flame. */
function extinction([x, y, z], smoke) {
  const layer = 0.35 / (1 + Math.exp(-(z - 1.9) / 0.18));
  const plume = 1.2 * Math.exp(-((x - 9.6) ** 2 + (y - 1) ** 2) / 0.25);
  return smoke * (layer + plume + 0.015);
}

/** Whether the partition, apart from its doorway, lies between two points. */
function hidden(a, b) {
  if (a[0] < wallAt === b[0] < wallAt) return false;
  const s = (wallAt - a[0]) / (b[0] - a[0]);
  const [, y, z] = plus(a, minus(b, a), s);
  return !(y > door.low && y < door.high && z < door.top);
}

const positionOf = (source, state) =>
  [...state.signs, ...state.luminaires].find((t) => t.name === source.name)?.position ??
  source.position;

/** Illuminance by colour at a point that faces `normal`, without and with the ambient light. */
function lit(source, state, point, normal) {
  const to = minus(positionOf(source, state), point);
  const far2 = Math.max(0.02, dot(to, to));
  const cosine = Math.max(0, dot(to, normal) / Math.sqrt(far2));
  const seen = hidden(point, plus(point, to)) ? 0 : 1;
  const clear = Math.exp(-extinction(plus(point, to, 0.5), state.smoke) * Math.sqrt(far2) * 0.5);
  const around = 0.012 * (seen ? 1 : 0.15);
  return source.colour.map((c) => c * clear * ((seen * cosine) / far2 + around));
}

function triangleAt(t, mesh) {
  const at = (c) => mesh.corners.slice(9 * t + 3 * c, 9 * t + 3 * c + 3);
  const [a, b, c] = [at(0), at(1), at(2)];
  const n = cross(minus(b, a), minus(c, a));
  const size = Math.hypot(...n);
  const centre = plus(plus(a, b), c).map((x) => x / 3);
  return { centre, normal: n.map((x) => x / size), albedo: Object.values(surfaces)[mesh.kinds[t]] };
}

function framed(kind, generation, group, halves) {
  const frame = new ArrayBuffer(16 + 2 * halves.length);
  new Uint32Array(frame, 0, 4).set([kind, generation, group, 0]);
  new Uint16Array(frame, 16).set(halves);
  return frame;
}

export function lightFrame(generation, group, state) {
  const mesh = meshOf(state);
  const triangles = mesh.kinds.length;
  const halves = new Uint16Array(8 * triangles + 3);
  const white = [0, 0, 0];
  let reached = 0;
  for (let t = 0; t < triangles; ++t) {
    const { centre, normal, albedo } = triangleAt(t, mesh);
    [1, -1].forEach((side, s) => {
      const n = normal.map((x) => side * x);
      const e = lit(state.sources[group], state, plus(centre, n, 0.01), n);
      e.forEach((x, c) => (halves[8 * t + 4 * s + c] = toHalf((x * albedo[c]) / Math.PI)));
      halves[8 * t + 4 * s + 3] = toHalf(weigh(e));
      if (!e.some((x) => x > 0)) return;
      reached += 1;
      e.forEach((x, c) => (white[c] += x / Math.PI));
    });
  }
  white.forEach((x, c) => (halves[8 * triangles + c] = toHalf(reached ? x / reached : 0)));
  return framed(2, generation, group, halves);
}

export function smokeFrame(generation, state) {
  const halves = new Uint16Array(2 * voxelCount);
  for (let i = 0; i < voxelCount; ++i) {
    halves[2 * i] = toHalf(extinction(voxelCentre(i), state.smoke));
    halves[2 * i + 1] = toHalf(meanCosine);
  }
  return framed(3, generation, 0, halves);
}

export function smokeLightFrame(generation, group, state) {
  const halves = new Uint16Array(6 * voxelCount);
  const { colour } = state.sources[group];
  const position = positionOf(state.sources[group], state);
  for (let i = 0; i < voxelCount; ++i) {
    const centre = voxelCentre(i);
    const to = minus(position, centre);
    const far2 = Math.max(0.1, dot(to, to));
    const seen = hidden(centre, position) ? 0.05 : 1;
    const j = (0.6 * extinction(centre, state.smoke) * seen) / (4 * Math.PI * far2);
    const scattered = 0.8 * j * weigh(colour);
    for (let k = 0; k < 3; ++k) {
      halves[6 * i + k] = toHalf(j * colour[k]);
      halves[6 * i + 3 + k] = toHalf((-scattered * to[k]) / Math.sqrt(far2));
    }
  }
  return framed(4, generation, group, halves);
}

export function probe(state, { triangle, front }) {
  const mesh = meshOf(state);
  const { centre, normal, albedo } = triangleAt(triangle, mesh);
  const n = normal.map((x) => (front ? x : -x));
  const e = [0, 0, 0];
  for (const source of state.sources)
    lit(source, state, centre, n).forEach((x, c) => (e[c] += state.factors[source.name] * x));
  const illuminance = weigh(e);
  const luminance = weigh(e.map((x, c) => (x * albedo[c]) / Math.PI));
  return { illuminance, illuminance_error: 0.02 * illuminance, luminance,
    luminance_error: 0.02 * luminance, direct: 0.9 * illuminance,
    surface: surfaceNames[mesh.kinds[triangle]] };
}

/** A cone over the bin, brightest below. */
function flameCells([nx, ny, nz]) {
  const cells = new Uint8Array(nx * ny * nz);
  for (let i = 0; i < cells.length; ++i) {
    const [x, y] = [i % nx, Math.floor(i / nx) % ny].map((n, k) => (2 * n + 1) / [nx, ny][k] - 1);
    const z = (Math.floor(i / (nx * ny)) + 0.5) / nz;
    if (Math.hypot(x, y) < 1 - z) cells[i] = Math.round(255 * (1 - z));
  }
  return Buffer.from(cells).toString('base64');
}

export const flames = [
  { group: 'fire in a bin', low: [9.35, 0.75, 0.4], size: [0.5, 0.5, 0.9], count: [10, 10, 18],
    colour: [9000, 3300, 600], cells: flameCells([10, 10, 18]),
    shape: { low: [9.37, 0.77, 0.42], size: [0.46, 0.46, 0.86], extinction: 1, seed: 2018 } },
];

const lampAcross_m = 0.3;
const polar = 36;

/**
 * Lambertian: the density of directions divided by their cosine is 1 / pi below, and nothing above.
 */
function lambertTable() {
  const bytes = Buffer.alloc(2 * polar);
  for (let i = 0; i < polar / 2; ++i) bytes.writeUInt16LE(65535, 2 * i);
  return { peak: 1 / Math.PI, polar, azimuth: 1, values: bytes.toString('base64') };
}
export const lampTables = [lambertTable()];

/** A disc that faces down at each luminaire. Along its axis it has the luminaire's intensity. */
export const lampsOf = (state) => state.luminaires.map(({ name, position, group }) => ({
  group, shape: 'disc', position, axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  size: [lampAcross_m, lampAcross_m, 0], corners: [], table: 0, of_luminaire: false,
  colour: (state.sources.find((s) => s.name === name) ?? sources[0]).colour
    .map((x) => (4 * x) / lampAcross_m ** 2),
}));

/** A floor with a lobe of this roughness. */
export const glossyFloor = (roughness) => [{ surface: surfaceNames.indexOf('floor'), back: false,
  mirrored: [0.2, 0.2, 0.2], spread: 0.6, roughness }];

export const observers = [
  { name: 'west, by the table', eye: [0.8, 2.2, 1.65], gaze: [5.7, 0.7, 0.35] },
  { name: 'east, at the door', eye: [7.2, 3.2, 1.65], gaze: [3.8, 1.0, 0.25] },
];
/** What may be added: a type that is not placed, a lamp of the room, and its sign. */
export const library = () => ({
  step: 5,
  luminaires: [
    { of: 'wide downlight', of_type: true, product: 'WD 250', maker: 'Nobody', file: 'wide.ldt',
      mains: 0, emergency: 250, unit: 'lm', curves: [0, 1].map((plane) =>
        Array.from({ length: 73 }, (_, i) =>
          Math.max(0, Math.cos(((5 * i - 180) * Math.PI) / 180)) ** (1 + plane) * 400)) },
    { of: 'lamp west', of_type: false, product: '', maker: '', file: '', mains: 3100,
      emergency: 0, unit: 'lm', curves: null },
  ],
  signs: [{ of: 'exit sign', of_type: false, file: 'exit_right.svg', text: '', width: face.width,
    height: face.height, colours: [[236, 236, 231], [0, 132, 61]],
    face: { columns: 64, rows: 32, texels: texels(64, 32) } }],
});

export const routes = [
  { name: 'way out', width: 1.2, path: [[9, 3, 0], [6.5, 2.9, 0], [1, 2.9, 0]] },
];
export const areas = [
  { name: 'east room', z: 0, outline: [[6.7, 0.1], [10.9, 0.1], [10.9, 5.9], [6.7, 5.9]] },
];
export const emphasis = [{ name: 'first aid', position: [1, 5, 1.2] }];

/** Checks of the route's darkest place, by the ceiling's lamps alone. */
export function checks(state) {
  const floor = [3.6, 2.9, 0.02];
  let lux = 0;
  for (const source of state.sources)
    if (source.kind === 'luminaire')
      lux += state.factors[source.name] * weigh(lit(source, state, floor, [0, 0, 1]));
  const limit = 0.3;
  const pass = lux >= limit;
  const rows = [
    { rule: 'E1', title: 'Illuminance on the centre line', clause: 'EN 1838:2013 4.2.1',
      subject: 'route "way out"', conditions: 'without furniture', value: lux, limit,
      at_least: true, unit: 'lx', margin: lux / limit - 1, place: floor,
      verdict: pass ? 'pass' : 'fail', reasons: '' },
    { rule: 'N8', title: 'Duration', clause: '', subject: 'the building', conditions: '',
      value: null, limit: 1, at_least: true, unit: 'h', margin: null, place: null,
      verdict: 'not assessed', reasons: 'no luminaire states duration_h' }];
  const counts = { [pass ? 'pass' : 'fail']: 1, 'not assessed': 1 };
  return { rows, counts, seconds: 0.1,
    words: `${pass ? 'no check made fails' : '1 check fails'}, 1 not assessed` };
}

export const cameras = [
  { name: 'overview', eye: [0.4, 0.4, 2.5], target: [6, 4, 1], up: [0, 0, 1], fov_deg: 75 },
];
