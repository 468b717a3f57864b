// Decodes text frames: JSON, checked field by field. The result has the fields, types and sizes
// that the rest of the page relies on, and nothing else.
import { bytesOf, fail, list, listed, number, record, text } from './checked.js';
import { limits as frameLimits, ProtocolError } from './decode_frame.js';

export const limits = {
  textBytes: 1 << 24,
  metres: 1e6,
  texels: 1 << 20,
  signColours: 8,
  pngCharacters: 1 << 23,
  flames: 8,
  flameCells: 64,
  tableCells: 1 << 16,
};

const whole = (value, path, low, high) =>
  Number.isInteger(value) ? number(value, path, low, high) : fail(path, 'not a whole number');

const numberOrNull = (value, path) =>
  value === null || value === undefined ? null : number(value, path);

const textOr = (value, path, other) =>
  value === undefined || value === null ? other : text(value, path);

function oneOf(value, path, choices) {
  return choices.includes(value) ? value : fail(path, `not one of ${choices.join(', ')}`);
}

function triple(value, path, low, high) {
  if (!Array.isArray(value) || value.length !== 3) fail(path, 'not three numbers');
  return value.map((item) => number(item, path, low, high));
}

function corner(value, path) {
  if (!Array.isArray(value) || value.length !== 2) fail(path, 'not two numbers');
  return value.map((item) => number(item, path, -limits.metres, limits.metres));
}

const atLeast = (count, items, path) =>
  items.length >= count ? items : fail(path, `fewer than ${count}`);

const place = (value, path) => triple(value, path, -limits.metres, limits.metres);
const colour = (value, path) => triple(value, path, -1e9, 1e9);

const numbersByName = (value, path) =>
  Object.entries(record(value, path)).map(([name, factor]) =>
    [text(name, path), number(factor, `${path}.${name}`, 0, 1e6)]);

function texelsOf(value, path, columns, rows) {
  const bytes = bytesOf(value, path);
  if (bytes.length !== columns * rows) fail(path, `${bytes.length} texels, not ${columns * rows}`);
  return bytes;
}

/** The Base64 of every PNG file begins so: the eight bytes of its signature. */
function pngOf(value, path) {
  if (value === null || value === undefined) return null;
  if (typeof value !== 'string' || value.length > limits.pngCharacters ||
      !/^iVBORw0KGg[A-Za-z0-9+/]+={0,2}$/.test(value))
    fail(path, 'no PNG file in base64');
  return value;
}

function coloursOf(value, path) {
  const colours = list(value, path, colour);
  if (colours.length > limits.signColours) fail(path, 'too many colours');
  return colours;
}

function sign(value, path) {
  const s = record(value, path);
  const columns = whole(s.columns, `${path}.columns`, 1, 4096);
  const rows = whole(s.rows, `${path}.rows`, 1, 4096);
  if (columns * rows > limits.texels) fail(path, 'too many texels');
  return {
    name: text(s.name, `${path}.name`),
    position: place(s.position, `${path}.position`),
    facing: place(s.facing, `${path}.facing`),
    up: place(s.up, `${path}.up`),
    width: number(s.width, `${path}.width`, 1e-3, 100),
    height: number(s.height, `${path}.height`, 1e-3, 100),
    doubleSided: s.double_sided === true,
    columns,
    rows,
    texels: texelsOf(s.texels, `${path}.texels`, columns, rows),
    colours: coloursOf(s.colours, `${path}.colours`),
    group: textOr(s.group, `${path}.group`, ''),
    added: s.added === true,
  };
}

function voxelsOf(value, path) {
  if (value === null || value === undefined) return null;
  const count = triple(value.count, `${path}.count`, 1, 4096).map(Math.round);
  const total = count[0] * count[1] * count[2];
  if (total > frameLimits.voxels) fail(path, `${total} voxels`);
  const low = place(value.low, `${path}.low`);
  return { low, edge: number(value.edge, `${path}.edge`, 1e-3, 1e3), count, total };
}

/** Of a steady flame; null for one that is shown as it is. */
function flameShape(value, path) {
  if (value === null || value === undefined) return null;
  return {
    low: place(value.low, `${path}.low`),
    size: triple(value.size, `${path}.size`, 1e-6, 1e4),
    extinction: number(value.extinction, `${path}.extinction`, 0, 1e6),
    seed: whole(value.seed, `${path}.seed`, 1, 0xffffffff),
  };
}

/** The glow of a flame within its box: a byte for each cell, x fastest. */
function flame(value, path) {
  const f = record(value, path);
  const count = triple(f.count, `${path}.count`, 1, limits.flameCells).map(Math.round);
  return {
    group: text(f.group, `${path}.group`),
    low: place(f.low, `${path}.low`),
    size: triple(f.size, `${path}.size`, 1e-6, 1e4),
    count,
    colour: colour(f.colour, `${path}.colour`),
    cells: texelsOf(f.cells, `${path}.cells`, count[0] * count[1], count[2]),
    shape: flameShape(f.shape, `${path}.shape`),
  };
}

function flames(value, path) {
  const all = list(value, path, flame);
  return all.length <= limits.flames ? all : fail(path, `${all.length} flames`);
}

/** Two bytes each, the lower one first. */
function wordsOf(value, path, count) {
  const bytes = texelsOf(value, path, 2 * count, 1);
  return Uint16Array.from({ length: count }, (_, i) => bytes[2 * i] | (bytes[2 * i + 1] << 8));
}

function lampTable(value, path) {
  const t = record(value, path);
  const polar = whole(t.polar, `${path}.polar`, 1, 4096);
  const azimuth = whole(t.azimuth, `${path}.azimuth`, 1, 4096);
  if (polar * azimuth > limits.tableCells) fail(path, 'too many directions');
  return {
    peak: number(t.peak, `${path}.peak`, 0, 1e9),
    polar,
    azimuth,
    values: wordsOf(t.values, `${path}.values`, polar * azimuth),
  };
}

function axes(value, path) {
  if (!Array.isArray(value) || value.length !== 3) fail(path, 'not three directions');
  return value.map((axis, i) => triple(axis, `${path}[${i}]`, -1.001, 1.001));
}

const lampShapes = ['rectangle', 'disc', 'sphere', 'tube', 'mesh'];

const lamp = (l, path) => ({
  group: text(l.group, `${path}.group`),
  shape: oneOf(l.shape, `${path}.shape`, lampShapes),
  position: place(l.position, `${path}.position`),
  axes: axes(l.axes, `${path}.axes`),
  size: triple(l.size, `${path}.size`, 0, 1e4),
  corners: list(l.corners ?? [], `${path}.corners`, place),
  colour: colour(l.colour, `${path}.colour`),
  table: whole(l.table, `${path}.table`, 0, listed),
  ofLuminaire: l.of_luminaire === true,
});

/** Lamps, each with an existing table. */
function lamps(value, path, tables) {
  const all = list(value, path, lamp);
  all.forEach(({ table }, i) => table < tables || fail(`${path}[${i}].table`, 'no such table'));
  return all;
}

const glossy = (g, path) => ({
  surface: whole(g.surface, `${path}.surface`, 0, 0xffffffff),
  back: g.back === true,
  mirrored: triple(g.mirrored, `${path}.mirrored`, 0, 1),
  spread: number(g.spread, `${path}.spread`, 0, 1),
  roughness: number(g.roughness, `${path}.roughness`, 0, 1),
});

const group = (g, path) => ({
  name: text(g.name, `${path}.name`),
  kind: oneOf(g.kind, `${path}.kind`, ['luminaire', 'sign', 'flame']),
  position: place(g.position, `${path}.position`),
  factor: number(g.factor, `${path}.factor`, 0, 1e6),
  share: number(g.share ?? 1, `${path}.share`, 0, 1e6),
  light: oneOf(g.light ?? 'new', `${path}.light`, ['new', 'kept', 'before']),
});

const luminaire = (l, path) => ({
  name: text(l.name, `${path}.name`),
  position: place(l.position, `${path}.position`),
  group: textOr(l.group, `${path}.group`, ''),
  added: l.added === true,
});

const observer = (o, path) => ({
  name: text(o.name, `${path}.name`),
  eye: place(o.eye, `${path}.eye`),
  gaze: place(o.gaze, `${path}.gaze`),
});

const suggested = (l, path) => ({
  of: text(l.of, `${path}.of`),
  position: place(l.position, `${path}.position`),
  facing: place(l.facing, `${path}.facing`),
});

const helpful = (h, path) => ({
  position: place(h.position, `${path}.position`),
  share: number(h.share, `${path}.share`, 0, 1),
});

const route = (r, path) => ({
  name: text(r.name, `${path}.name`),
  width: number(r.width, `${path}.width`, 0, 1e3),
  path: atLeast(2, list(r.path, `${path}.path`, place), `${path}.path`),
});

const area = (a, path) => ({
  name: text(a.name, `${path}.name`),
  outline: atLeast(3, list(a.outline, `${path}.outline`, corner), `${path}.outline`),
  z: number(a.z, `${path}.z`, -limits.metres, limits.metres),
});

const emphasis = (e, path) => ({
  name: text(e.name, `${path}.name`),
  position: place(e.position, `${path}.position`),
});

const checkVerdicts = ['pass', 'fail', 'not assessed', 'information', 'not verified'];

const check = (c, path) => ({
  rule: text(c.rule, `${path}.rule`),
  title: text(c.title, `${path}.title`),
  clause: textOr(c.clause, `${path}.clause`, ''),
  subject: textOr(c.subject, `${path}.subject`, ''),
  conditions: textOr(c.conditions, `${path}.conditions`, ''),
  verdict: oneOf(c.verdict, `${path}.verdict`, checkVerdicts),
  value: numberOrNull(c.value, `${path}.value`),
  limit: numberOrNull(c.limit, `${path}.limit`),
  atLeast: c.at_least === true,
  unit: textOr(c.unit, `${path}.unit`, ''),
  margin: numberOrNull(c.margin, `${path}.margin`),
  place: c.place === null || c.place === undefined ? null : place(c.place, `${path}.place`),
  reasons: textOr(c.reasons, `${path}.reasons`, ''),
});

const stepKinds = ['factor', 'scenario', 'smoke', 'move', 'add', 'remove'];

const step = (s, path) => ({
  kind: oneOf(s.kind, `${path}.kind`, stepKinds),
  name: textOr(s.name, `${path}.name`, ''),
  count: whole(s.count, `${path}.count`, 0, listed),
  value: numberOrNull(s.value, `${path}.value`),
});

const camera = (c, path) => ({
  name: text(c.name, `${path}.name`),
  eye: place(c.eye, `${path}.eye`),
  target: place(c.target, `${path}.target`),
  fov: number(c.fov_deg, `${path}.fov_deg`, 1, 170),
});

const scenario = (s, path) => ({
  name: text(s.name, `${path}.name`),
  operation: oneOf(s.operation, `${path}.operation`, ['mains', 'emergency', 'dark']),
});

/** The times of a scene with a clock; null without one. */
function statesOf(s, path) {
  if (s === null || s === undefined) return null;
  const from = number(s.from, `${path}.from`, -1e6, 1e6);
  const to = number(s.to, `${path}.to`, from, 1e6);
  return {
    from,
    to,
    step: number(s.step, `${path}.step`, Number.MIN_VALUE, 1e6),
    at: number(s.at, `${path}.at`, -1e9, 1e9),
    mainsFailAt: numberOrNull(s.mains_fail_at, `${path}.mains_fail_at`),
  };
}

const readers = {
  scene: (m) => ({
    generation: whole(m.generation, 'generation', 0, 0xffffffff),
    name: textOr(m.name, 'name', ''),
    title: textOr(m.title, 'title', ''),
    scenarios: list(m.scenarios ?? [], 'scenarios', scenario),
    scenario: textOr(m.scenario, 'scenario', ''),
    states: statesOf(m.states, 'states'),
    smoke: number(m.smoke, 'smoke', 0, 1e6),
    seconds: numberOrNull(m.seconds, 'seconds'),
    low: place(m.low, 'low'),
    high: place(m.high, 'high'),
    relaid: m.relaid === true,
    groups: list(m.groups, 'groups', group),
    signs: list(m.signs ?? [], 'signs', sign),
    luminaires: list(m.luminaires ?? [], 'luminaires', luminaire),
    routes: list(m.routes ?? [], 'routes', route),
    areas: list(m.areas ?? [], 'areas', area),
    emphasis: list(m.emphasis ?? [], 'emphasis', emphasis),
    north: number(m.north_deg ?? 0, 'north_deg', -1e4, 1e4),
    observers: list(m.observers ?? [], 'observers', observer),
    cameras: list(m.cameras ?? [], 'cameras', camera),
    voxels: voxelsOf(m.voxels, 'voxels'),
    flames: flames(m.flames ?? [], 'flames'),
    lamps: lamps(m.lamps ?? [], 'lamps', (m.lamp_tables ?? []).length),
    lampTables: list(m.lamp_tables ?? [], 'lamp_tables', lampTable),
    gloss: list(m.gloss ?? [], 'gloss', glossy),
    editor: m.editor === true,
  }),
  progress: (m) => ({
    generation: whole(m.generation, 'generation', 0, 0xffffffff),
    particles: number(m.particles, 'particles', 0, 1e18),
    relativeError: numberOrNull(m.relative_error, 'relative_error'),
    seconds: number(m.seconds, 'seconds', 0, 1e9),
    groupsOfBefore: whole(m.groups_of_before ?? 0, 'groups_of_before', 0, 1e6),
    done: m.done === true,
  }),
  factors: (m) => ({
    factors: numbersByName(m.factors, 'factors').map(([name, factor]) => ({ name, factor })),
  }),
  time: (m) => ({
    seconds: numberOrNull(m.seconds, 'seconds'),
    shares: numbersByName(m.shares, 'shares').map(([name, share]) => ({ name, share })),
  }),
  probe: (m) => ({
    id: whole(m.id, 'id', 0, 0xffffffff),
    illuminance: numberOrNull(m.illuminance, 'illuminance'),
    illuminanceError: numberOrNull(m.illuminance_error, 'illuminance_error'),
    luminance: numberOrNull(m.luminance, 'luminance'),
    luminanceError: numberOrNull(m.luminance_error, 'luminance_error'),
    direct: numberOrNull(m.direct, 'direct'),
    surface: textOr(m.surface, 'surface', ''),
  }),
  sign: (m) => ({
    id: whole(m.id ?? 0, 'id', 0, 2 ** 53),
    name: text(m.name, 'name'),
    rows: list(m.rows, 'rows', (row, path) => ({
      from: text(row.from, `${path}.from`),
      along: number(row.along ?? 0, `${path}.along`, 0, limits.metres),
      eyeHeight: numberOrNull(row.eye_height, `${path}.eye_height`),
      distance: number(row.distance, `${path}.distance`, 0, limits.metres),
      verdict: text(row.verdict, `${path}.verdict`),
      reason: textOr(row.reason, `${path}.reason`, ''),
    })),
    note: textOr(m.note, 'note', ''),
    provisional: m.provisional === true,
  }),
  picture: (m) => ({
    id: whole(m.id, 'id', 0, 2 ** 53),
    particles: number(m.particles, 'particles', 0, 1e18),
    paths: whole(m.paths, 'paths', 0, 1 << 16),
    relativeError: numberOrNull(m.relative_error, 'relative_error'),
    seconds: number(m.seconds, 'seconds', 0, 1e9),
    done: m.done === true,
    png: pngOf(m.png, 'png'),
  }),
  suggested: (m) => ({
    luminaires: list(m.luminaires, 'luminaires', suggested),
    insteadOf: list(m.instead_of ?? [], 'instead_of', text),
    helpful: list(m.helpful ?? [], 'helpful', helpful),
    least: number(m.least, 'least', -1e6, 1e6),
    missing: number(m.missing, 'missing', 0, 1),
    words: text(m.words, 'words'),
  }),
  checks: (m) => ({
    id: whole(m.id ?? 0, 'id', 0, 2 ** 53),
    rows: list(m.rows, 'rows', check),
    counts: Object.fromEntries(numbersByName(m.counts, 'counts')),
    words: text(m.words, 'words'),
    seconds: number(m.seconds, 'seconds', 0, 1e9),
  }),
  added: (m) => ({
    kind: oneOf(m.kind, 'kind', ['sign', 'luminaire']),
    of: text(m.of, 'of'),
    name: text(m.name, 'name'),
  }),
  history: (m) => {
    const steps = list(m.steps, 'steps', step);
    return { steps, done: whole(m.done, 'done', 0, steps.length) };
  },
  step: (m) => ({ last: step(m.last, 'last') }),
  saved: (m) => ({ file: text(m.file, 'file') }),
  refused: (m) => ({
    why: text(m.why, 'why'),
    picture: m.picture === undefined ? null : whole(m.picture, 'picture', 0, 2 ** 53),
    suggestion: m.suggestion === true,
    checks: m.checks === true,
    sign: m.sign === undefined ? null : text(m.sign, 'sign'),
  }),
  editor: (m) => ({ editor: m.editor === true }),
};

/** Checks and decodes a text frame; throws ProtocolError. */
export function decodeMessage(json) {
  if (json.length > limits.textBytes) throw new ProtocolError('a text frame too long to be read');
  let message;
  try {
    message = record(JSON.parse(json), 'message');
  } catch (error) {
    throw error instanceof ProtocolError ? error : new ProtocolError('text that is not JSON');
  }
  const read = Object.hasOwn(readers, message.type) ? readers[message.type] : null;
  if (!read)
    throw new ProtocolError(`message of unknown type ${String(message.type).slice(0, 40)}`);
  try {
    return { type: message.type, ...read(message) };
  } catch (error) {
    if (error instanceof ProtocolError) error.message = `${message.type}: ${error.message}`;
    throw error instanceof TypeError ? new ProtocolError(`${message.type}: a part missing`) : error;
  }
}
