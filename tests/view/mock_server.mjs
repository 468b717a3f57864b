// A server that speaks actors/apps/view/PROTOCOL.md without a simulation.
// Manual use: `node mock_server.mjs 8099`, then open http://127.0.0.1:8099/
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { deflateSync } from 'node:zlib';
import { fileURLToPath } from 'node:url';
import * as room from './mock_room.mjs';

/** A grey PNG file. Its checksums are correct, so browsers show it. */
export function greyPng(width, height) {
  const crc = (bytes) => {
    let c = 0xffffffff;
    for (const byte of bytes) {
      c ^= byte;
      for (let k = 0; k < 8; ++k) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
    }
    return (c ^ 0xffffffff) >>> 0;
  };
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type), data]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(crc(body), body.length + 4);
    return out;
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 0, 0, 0, 0], 8);
  const rows = Buffer.alloc((width + 1) * height, 128);
  for (let y = 0; y < height; ++y) rows[y * (width + 1)] = 0;
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head),
    chunk('IDAT', deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

const pageFile = fileURLToPath(
  new URL('../../actors/apps/view/page/dist/index.html', import.meta.url));
const scenarios = [
  { name: 'smoke, mains', operation: 'mains', smoke: 1, lamps: 1 },
  { name: 'smoke, emergency', operation: 'emergency', smoke: 1, lamps: 0.05 },
  { name: 'clear, mains', operation: 'mains', smoke: 0, lamps: 1 },
  { name: 'smoke, dark', operation: 'dark', smoke: 1, lamps: 0 },
];

export class MockServer {
  /** `traceMs`: delay of the first light of a new generation. */
  constructor({ traceMs = 400, pictureMs = 300 } = {}) {
    this.traceMs = traceMs;
    this.pictureMs = pictureMs;
    this.viewers = new Set();
    this.editor = null;
    this.state = room.startState();
    this.generation = 1;
    this.particles = 0;
    this.heard = [];
    this.frames = null;
    this.seconds = null;
    this.relaid = false;
    this.gloss = [];
    this.backdrops = [];
    this.people = { step: 1, people: [] };
    this.states = null;
    Object.assign(this, { steps: [], done: 0, before: [structuredClone(this.state)] });
  }

  async listen(port = 0) {
    // Imported only to listen: unit tests run without this folder's npm packages.
    const { WebSocketServer } = await import('ws');
    const page = readFileSync(pageFile);
    this.http = createServer(({ url }, answer) => {
      const { pathname } = new URL(url, 'http://mock');
      const fixed = { '/backdrops.json': this.backdrops, '/people.json': this.people,
        '/library.json': room.library() }[pathname];
      if (fixed) {
        answer.writeHead(200, { 'content-type': 'application/json' });
        answer.end(JSON.stringify(fixed));
        return;
      }
      const here = pathname === '/';
      answer.writeHead(here ? 200 : 404, { 'content-type': here ? 'text/html' : 'text/plain' });
      answer.end(here ? page : 'not here');
    });
    this.sockets = new WebSocketServer({ server: this.http, path: '/live' });
    this.sockets.on('connection', (socket) => this.welcome(socket));
    this.pulse = setInterval(() => this.progress(), 400);
    await new Promise((done) => this.http.listen(port, '127.0.0.1', done));
    return this.http.address().port;
  }

  close() {
    clearInterval(this.pulse);
    clearTimeout(this.tracing);
    clearInterval(this.rendering);
    for (const viewer of this.viewers) viewer.terminate();
    this.http.close();
  }

  trace() {
    const { generation, state } = this;
    const frames = [room.smokeFrame(generation, state)];
    state.sources.forEach((_, group) => frames.push(
      room.lightFrame(generation, group, state),
      room.smokeLightFrame(generation, group, state)));
    return frames;
  }

  scene(viewer) {
    const { state, generation } = this;
    const groups = state.sources.map(({ name, kind, position }) =>
      ({ name, kind, position, factor: state.factors[name], share: this.share(kind),
        light: this.light?.(name) ?? 'new' }));
    return { type: 'scene', generation, name: 'mock', title: 'Two rooms and a fire in a bin',
      scenarios: scenarios.map(({ name, operation }) => ({ name, operation })),
      scenario: state.scenario, states: this.states, smoke: state.smoke, seconds: this.seconds,
      low: room.low,
      high: room.high, relaid: this.relaid, groups,
      signs: state.signs, luminaires: state.luminaires, observers: room.observers,
      routes: room.routes, areas: room.areas, emphasis: room.emphasis, north_deg: 30,
      cameras: room.cameras, voxels: room.voxels, flames: room.flames,
      lamps: room.lampsOf(state), lamp_tables: room.lampTables, gloss: this.gloss,
      editor: viewer !== null && viewer === this.editor,
    };
  }

  welcome(viewer) {
    this.viewers.add(viewer);
    this.editor ??= viewer;
    viewer.on('message', (data) => this.hear(viewer, JSON.parse(String(data))));
    viewer.on('close', () => {
      this.viewers.delete(viewer);
      if (this.editor === viewer) this.editor = null;
    });
    this.tell(viewer, this.scene(viewer));
    viewer.send(room.geometryFrame(this.generation, this.state));
    this.frames ??= this.trace();
    for (const frame of this.frames) viewer.send(frame);
    this.tell(viewer, this.history());
  }

  tell(viewer, message) {
    viewer.send(JSON.stringify(message));
  }

  tellAll(message) {
    for (const viewer of this.viewers) this.tell(viewer, message);
  }

  progress() {
    this.particles += 40_000;
    const done = this.particles > 4_000_000;
    this.tellAll({ type: 'progress', generation: this.generation, particles: this.particles,
      relative_error: Math.min(1, 12 / Math.sqrt(this.particles)),
      seconds: this.particles / 1e5, done });
  }

  hear(viewer, message) {
    this.heard.push(message);
    const edits = ['factor', 'scenario', 'smoke', 'state', 'time', 'move', 'add', 'remove', 'save',
      'history'];
    if (edits.includes(message.type) && viewer !== this.editor)
      this.tell(viewer, { type: 'refused', why: 'somebody else is editing' });
    else {
      this[`do_${message.type}`]?.(viewer, message);
      this.note(message);
    }
  }

  /** Records an edit as a step. */
  note({ type, name, group, of, factor }) {
    const kinds = { factor: group, scenario: name, smoke: '', move: name, add: `${of} copy`,
      remove: name };
    if (!(type in kinds)) return;
    this.steps.splice(this.done);
    this.before.splice(this.done + 1);
    this.steps.push({ kind: type, name: kinds[type], count: 1, value: factor ?? null });
    this.before.push(structuredClone(this.state));
    this.done = this.steps.length;
    this.tellAll(this.history());
  }

  history() {
    return { type: 'history', steps: this.steps, done: this.done };
  }

  do_history(_, { done }) {
    const before = this.state;
    this.done = done;
    this.state = structuredClone(this.before[done]);
    this.tellAll(this.history());
    this.tellAll({ type: 'factors', factors: this.state.factors });
    this.begin(() => 'new', room.trianglesOf(before) !== room.trianglesOf(this.state));
  }

  /**
   * A new generation: announced at once, its light follows later; that of groups not `new` stays.
   * `relaid`: its triangles differ, and light of before is sent with them.
   */
  begin(light = () => 'new', relaid = false) {
    ++this.generation;
    this.particles = 0;
    Object.assign(this, { light, relaid });
    for (const viewer of this.viewers) this.tell(viewer, this.scene(viewer));
    Object.assign(this, { light: null, relaid: false });
    if (relaid) this.lay(light);
    clearTimeout(this.tracing);
    this.tracing = setTimeout(() => {
      this.frames = this.trace();
      const sent = this.frames.filter((frame) => {
        const [kind, , group] = new Uint32Array(new Uint8Array(frame).slice(0, 12).buffer);
        return ![2, 4].includes(kind) || light(this.state.sources[group].name) !== 'kept';
      });
      for (const viewer of this.viewers) for (const frame of sent) viewer.send(frame);
    }, this.traceMs);
  }

  lay(light) {
    const { generation, state } = this;
    const frames = [room.geometryFrame(generation, state)];
    state.sources.forEach(({ name }, group) => light(name) === 'new' || frames.push(
      room.lightFrame(generation, group, state), room.smokeLightFrame(generation, group, state)));
    for (const viewer of this.viewers) for (const frame of frames) viewer.send(frame);
  }

  do_factor(_, { group, factor }) {
    this.state.factors[group] = factor;
    this.tellAll({ type: 'factors', factors: { [group]: factor } });
  }

  do_scenario(_, { name }) {
    const chosen = scenarios.find((s) => s.name === name);
    this.state.scenario = name;
    this.state.smoke = chosen.smoke;
    for (const { name: group, kind } of this.state.sources)
      if (kind === 'luminaire') this.state.factors[group] = chosen.lamps;
    this.begin();
  }

  /** Luminaires come on within ten seconds. */
  share(kind) {
    return kind === 'luminaire' && this.seconds !== null ? Math.min(1, this.seconds / 10) : 1;
  }

  do_time(_, { seconds }) {
    this.seconds = seconds;
    const shares = Object.fromEntries(
      this.state.sources.map(({ name, kind }) => [name, this.share(kind)]));
    this.tellAll({ type: 'time', seconds, shares });
  }

  do_smoke(_, { factor }) {
    this.state.smoke = factor;
    this.begin();
  }

  do_state(_, { at }) {
    this.states = { ...this.states, at };
    this.begin();
  }

  do_move(_, { kind, name, position }) {
    const things = kind === 'sign' ? this.state.signs : this.state.luminaires;
    const thing = things.find((t) => t.name === name);
    thing.position = position;
    const others = kind === 'sign' ? 'before' : 'kept';
    this.begin((group) => (group === thing.group ? 'new' : others));
  }

  /** A type of the library is as bright here as the first luminaire. */
  do_add(viewer, { kind, of, of_type: ofType, position, facing }) {
    const { state } = this;
    const things = kind === 'sign' ? state.signs : state.luminaires;
    const original = ofType ? things[0] : things.find((t) => t.name === of);
    const count = things.filter((t) => t.added).length + 1;
    const name = ofType ? of
      : `${of.replace(/ copy.*/, '')} copy${count > 1 ? ` ${count}` : ''}`;
    things.push({ ...original, name, position, facing: facing ?? original.facing, group: name,
      added: true });
    const source = state.sources.find((s) => s.name === original.group);
    state.sources.push({ ...source, name, position });
    state.factors[name] = state.factors[original.group];
    this.tell(viewer, { type: 'added', kind, of, name });
    this.begin((group) => (group === name ? 'new' : kind === 'sign' ? 'before' : 'kept'),
      kind === 'sign');
  }

  do_remove(viewer, { name }) {
    const { state } = this;
    const is = (thing) => thing.name === name;
    const sign = state.signs.some(is);
    if (!(sign ? state.signs : state.luminaires).find(is)?.added)
      return this.tell(viewer, { type: 'refused', why: `"${name}" was not added` });
    for (const key of ['signs', 'luminaires', 'sources'])
      state[key] = state[key].filter((thing) => !is(thing));
    this.begin(() => (sign ? 'before' : 'kept'), sign);
  }

  do_save(viewer, { name }) {
    if (/^[\w-]{1,64}$/.test(name)) this.tell(viewer, { type: 'saved', file: `${name}.toml` });
    else this.tell(viewer, { type: 'refused', why: `"${name}" is no name for a file` });
  }

  /** Refines by a pass every `pictureMs`, until 32 paths. */
  do_render(viewer, { id, width, height }) {
    clearInterval(this.rendering);
    let paths = 0;
    const png = greyPng(width, height).toString('base64');
    const tell = () => {
      const done = paths === 32;
      this.tell(viewer, { type: 'picture', id, particles: 400_000, paths, seconds: 1 + paths / 8,
        relative_error: paths ? 0.5 / Math.sqrt(paths) : null, done, png: paths ? png : null });
      if (done) clearInterval(this.rendering);
      paths = Math.max(4, 2 * paths);
    };
    tell();
    this.rendering = setInterval(tell, this.pictureMs);
  }

  do_stop_render() {
    clearInterval(this.rendering);
  }

  do_edit(viewer, { wanted }) {
    const old = this.editor;
    if (wanted) this.editor = viewer;
    else if (old === viewer) this.editor = null;
    if (old && old !== this.editor) this.tell(old, { type: 'editor', editor: false });
    this.tell(viewer, { type: 'editor', editor: viewer === this.editor });
  }

  do_checks(viewer, { id }) {
    this.tell(viewer, { type: 'checks', id, ...room.checks(this.state) });
  }

  do_probe(viewer, message) {
    this.tell(viewer, { type: 'probe', id: message.id, ...room.probe(this.state, message) });
  }

  do_judge(viewer, { sign, id }) {
    const { position } = this.state.signs.find((s) => s.name === sign);
    const rows = room.observers.map(({ name, eye }) => {
      const distance = Math.hypot(...eye.map((x, i) => x - position[i]));
      const legible = distance * this.state.smoke < 7;
      return { from: name, along: 0, eye_height: eye[2], distance, verdict: legible ? 'legible' : 'visible but not legible',
        reason: `the detail is at visibility level ${legible ? 11 : 4}, 7 is needed` };
    });
    for (const provisional of [true, false])
      this.tell(viewer, { type: 'sign', id, name: sign, rows, provisional });
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const port = await new MockServer().listen(Number(process.argv[2] ?? 8099));
  console.log(`http://127.0.0.1:${port}/`);
}
