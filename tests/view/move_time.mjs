// Measures latencies: from a change of smoke until all groups have light, from dimming until the
// page is informed, and from a move of a luminaire and of a sign, and a copy of each, until its
// first light: `node move_time.mjs [SCENE SCENARIO LUMINAIRE SIGN]`; LUX_PROGRAM names the program,
// LUX_OPTIONS additional options (`LUX_OPTIONS="--nodes 2"`).
import { spawn } from 'node:child_process';
import { WebSocket } from 'ws';

const root = new URL('../..', import.meta.url).pathname;
const program = process.env.LUX_PROGRAM ?? `${root}/build/release/luxodus`;
const [scene = `${root}/scenes/library/office_floor.toml`, scenario = 'smoke_emergency',
  luminaire = 'corridor emergency light 3', sign = 'exit east'] = process.argv.slice(2);
const moves = Number(process.env.LUX_MOVES ?? 11);
/** Time for which the view traces undisturbed between moves. */
const rest_ms = 3000;

const options = (process.env.LUX_OPTIONS ?? '').split(' ').filter(Boolean);
const child = spawn(program, ['view', scene, '--scenario', scenario, '--port', '0', ...options]);
const address = await new Promise((resolve) => {
  child.stdout.on('data', (bytes) => {
    const found = String(bytes).match(/http:\S+/);
    if (found) resolve(found[0]);
  });
});
const socket = new WebSocket(`${address.replace('http', 'ws').replace(/\/$/, '')}/live`);
socket.binaryType = 'arraybuffer';

let known = null;
let heard = () => {};
socket.onmessage = ({ data }) => {
  if (typeof data === 'string') {
    const message = JSON.parse(data);
    if (message.type === 'scene') known = message;
    heard(message, data.length);
  } else {
    const [kind, generation, a] = new Uint32Array(data, 0, 3);
    heard({ kind, generation, a }, data.byteLength);
  }
};
const until = (holds) => new Promise((resolve) => {
  heard = (message, bytes) => holds(message, bytes) && resolve(performance.now());
});
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const median = (list) => list.toSorted((a, b) => a - b)[list.length >> 1];

/** Waits for the light of a group in a later generation. */
async function light(message, group) {
  const before = known.generation;
  const start = performance.now();
  let bytes = 0;
  let announced = 0;
  const lit = until((heardOf, size) => {
    bytes += size;
    if (heardOf.type === 'scene') announced = performance.now();
    const number = known.groups.findIndex((g) => g.name === group);
    return heardOf.kind === 2 && heardOf.generation > before && heardOf.a === number;
  });
  socket.send(JSON.stringify(message));
  const end = await lit;
  return { scene: announced - start, light: end - start, kib: bytes / 1024 };
}

function thingOf(kind, name) {
  return known[kind === 'sign' ? 'signs' : 'luminaires'].find((t) => t.name === name);
}

function move(kind, name, i) {
  const { position: [x, y, z], facing, group } = thingOf(kind, name);
  const position = [x, y + (i % 2 ? -0.1 : 0.1), z];
  return light({ type: 'move', kind, name, position, facing }, group);
}

/** Adds a copy, and removes it. */
async function copy(kind, name) {
  const { position: [x, y, z], facing, group } = thingOf(kind, name);
  const found = await light(
    { type: 'add', kind, of: name, position: [x, y + 0.3, z], facing }, `${group} copy`);
  await pause(rest_ms);
  const gone = until(({ type }) => type === 'scene');
  socket.send(JSON.stringify({ type: 'remove', name: `${name} copy` }));
  await gone;
  return found;
}

/** Changes the smoke, so that all light begins anew: waits until each group has some. */
async function thicken(i) {
  const before = known.generation;
  const start = performance.now();
  const lit = new Set();
  const end = until((message) => {
    if (message.kind === 2 && message.generation > before) lit.add(message.a);
    return known.generation > before && lit.size === known.groups.length;
  });
  socket.send(JSON.stringify({ type: 'smoke', factor: i % 2 ? 1 : 1.1 }));
  return (await end) - start;
}

/** Waits until the page is informed that a group is dimmed; the rest is done by the page. */
async function dim(i) {
  const start = performance.now();
  const told = until(({ type }) => type === 'factors');
  const { group } = thingOf('luminaire', luminaire);
  socket.send(JSON.stringify({ type: 'factor', group, factor: i % 2 ? 1 : 0.5 }));
  return (await told) - start;
}

await until((message) => message.kind === 2);
for (const [words, change] of [['other smoke: all groups lit', thicken], ['dimmed: told', dim]]) {
  const all = [];
  for (let i = 0; i < moves; ++i) {
    await pause(rest_ms);
    all.push(await change(i));
  }
  console.log(`${words} after ${median(all).toFixed(0)} ms (median of ${moves} times)`);
}
for (const [word, change] of [['moved', move], ['copied', copy]])
  for (const [kind, name] of [['luminaire', luminaire], ['sign', sign]]) {
    const all = [];
    for (let i = 0; i < moves; ++i) {
      await pause(rest_ms);
      all.push(await change(kind, name, i));
    }
    const of = (key) => median(all.map((one) => one[key])).toFixed(0);
    console.log(`${kind} "${name}" ${word}: told after ${of('scene')} ms, its first light after ` +
      `${of('light')} ms, ${of('kib')} KiB until then (medians of ${moves} times)`);
  }
socket.close();
child.kill('SIGINT');
