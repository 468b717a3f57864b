// The page in a real browser, against the mock server.
// `node browser_test.mjs [FOLDER FOR SCREENSHOTS]`; needs `npm run build` of the page before.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';
import { glossyFloor } from './mock_room.mjs';
import { MockServer } from './mock_server.mjs';

const shots =
  process.env.LUX_SHOTS ?? process.argv[2] ?? new URL('shots', import.meta.url).pathname;
const browserPath = process.env.LUX_CHROMIUM ?? '/usr/bin/chromium';
const flags = ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader'];
/** Timeout for failures. All waits are for states, and no test depends on their duration. */
const patience = { timeout: 180_000 };

/** Shares of the screen's resolution; screenshots are drawn finely if LUX_FINE is set. */
const coarse = 0.4;
const fine = process.env.LUX_FINE ? 1 : coarse;

let server;
let browser;
let address;
let page;
const complaints = [];

async function open(options = {}) {
  const context = await browser.newContext({
    viewport: { width: 1024, height: 640 }, reducedMotion: 'reduce', ...options });
  context.setDefaultTimeout(patience.timeout);
  const opened = await context.newPage();
  opened.on('console', (m) => ['error', 'warning'].includes(m.type()) && complaints.push(m.text()));
  opened.on('pageerror', (error) => complaints.push(error.stack));
  await opened.goto(address);
  await opened.waitForFunction((groups) =>
    window.luxodus?.page.live.shown?.surfaces?.groups.size === groups,
    server.state.sources.length, patience);
  // A machine without a graphics card draws slowly; these tests only need a steady resolution.
  await raster(opened, coarse);
  return opened;
}

const raster = (p, share) => p.evaluate((still) => {
  const { picture } = window.luxodus.page;
  picture.learns = false;
  picture.shares = { moving: 0.4, still };
}, share);
const settled = (p = page) => p.evaluate(() => window.luxodus.settled());
const mean = async (p = page) => {
  await settled(p);
  return p.evaluate(() => window.luxodus.meanLuminance());
};
const eye = (p = page) => p.evaluate(() => [...window.luxodus.page.walk.motion.eye]);
const shot = async (name, p = page) => {
  await raster(p, fine);
  await settled(p);
  await p.screenshot({ path: `${shots}/${name}.png` });
  await raster(p, coarse);
};
const slider = (name) => page.locator(`li[data-name="${name}"] input[type=range]`);
const generation = () => page.evaluate(() => window.luxodus.page.live.number);

async function pull(locator, value) {
  await locator.evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event('input', { bubbles: true }));
    input.dispatchEvent(new Event('change', { bubbles: true }));
  }, value);
}

before(async () => {
  mkdirSync(shots, { recursive: true });
  server = new MockServer({ traceMs: 2500 });
  address = `http://127.0.0.1:${await server.listen()}/`;
  browser = await chromium.launch({ executablePath: browserPath, args: flags, headless: true });
  page = await open();
});

after(async () => {
  await browser?.close();
  server?.close();
});

test('the page loads, draws light, and reports no errors', async () => {
  assert.ok((await mean()) > 0.1);
  await shot('walk_camera');
  assert.deepEqual(complaints, []);
});

test('the page fetches only its backdrops and the live connection', async () => {
  const fetched = await page.evaluate(() =>
    performance.getEntriesByType('resource').map((e) => e.name));
  assert.deepEqual(fetched.filter((name) => !name.startsWith('data:')),
    ['backdrops', 'library', 'people'].map((name) => `${address}${name}.json`));
});

test('a held key walks, and a wall stops the walk', async () => {
  const from = await eye();
  await page.locator('#picture').focus();
  await page.keyboard.down('KeyW');
  await page.waitForFunction((x) => window.luxodus.page.walk.motion.eye[0] > x + 0.3, from[0],
    patience);
  await page.keyboard.up('KeyW');
  await page.evaluate(() => {
    window.luxodus.page.walk.motion.yaw = Math.PI;
    for (let i = 0; i < 200; ++i) window.luxodus.page.walk.go([-0.1, 0, 0]);
  });
  const [x, , z] = await eye();
  assert.ok(x > 0.1 && x < 0.6, `stopped at ${x}`);
  assert.ok(Math.abs(z - 1.65) < 0.01, `eye at ${z}`);
});

test('smoke glows for an eye that looks into its light, and less for one that looks along it', async () => {
  /** Half of the light of all voxels goes east. A viewer who looks east has it in the back. */
  const seen = await page.evaluate(async () => {
    const { page: p } = window.luxodus;
    const { surfaces, air } = p.live.shown;
    surfaces.sum.fill(0);
    for (let i = 0; i < air.sum.length; i += 8) air.sum.set([1, 1, 1, 0, 0.5, 0, 0, 0], i);
    p.picture.signs.object.visible = false;
    const luminances = [];
    for (const gaze of [[1, 0, 0], [-1, 0, 0]]) {
      p.walk.jump({ eye: [3.25, 1.2, 1], gaze });
      p.light.changed();
      await window.luxodus.settled();
      luminances.push(p.picture.luminanceAt(0, 0));
    }
    // The sums are computed again.
    for (const sum of [surfaces, air]) sum.stained(true);
    p.live.settle();
    p.picture.signs.object.visible = true;
    p.light.changed();
    return luminances;
  });
  // Henyey and Greenstein with 0.6: 0.64 / 2.56^1.5 backwards, 0.64 / 0.16^1.5 forwards.
  const expected = (0.5 + 0.5 * 10) / (0.5 + 0.5 * 0.15625);
  const ratio = seen[1] / seen[0];
  assert.ok(Math.abs(ratio / expected - 1) < 0.03, `${ratio}, not ${expected}: ${seen}`);
});

test('a flame has the shape of its cells, and nothing glows around it', async () => {
  /** Luminances from the bin upwards, of the flame only. */
  const seen = await page.evaluate(async () => {
    const { page: p } = window.luxodus;
    const { surfaces, air } = p.live.shown;
    const flame = p.live.scene.flames[0];
    const { shapeSeed } = p.picture.smoke.flames.uniforms;
    const [seed] = shapeSeed.value;
    shapeSeed.value[0] = 0;  // the mean
    for (const sum of [surfaces, air]) sum.sum.fill(0);
    p.picture.signs.object.visible = false;
    p.walk.solid = false;
    const [x, y, z] = flame.low.map((low, k) => low + flame.size[k] / 2);
    p.walk.jump({ eye: [x - 2, y, z], gaze: [1, 0, 0] });
    p.light.changed();
    await window.luxodus.settled();
    const tall = flame.size[2] / 2 / 2 / Math.tan((p.walk.view.fov * Math.PI) / 360);
    const at = (up, right) => p.picture.luminanceAt(right * tall * 0.8, up * tall);
    const found = [at(-0.7, 0), at(0.4, 0), at(1.3, 0), at(-0.7, 1), at(0.9, 0.4)];
    shapeSeed.value[0] = seed;
    for (const sum of [surfaces, air]) sum.stained(true);
    p.live.settle();
    p.picture.signs.object.visible = p.walk.solid = true;
    p.light.changed();
    return found;
  });
  const [low, high, above, beside, corner] = seen;
  assert.ok(low > 100 && high > 20 && low > 2 * high, `${seen}`);
  assert.ok(Math.max(above, beside, corner) < 0.02 * low, `${seen}`);
});

test('the moments of a flame have the mean of the flame on each ray', async () => {
  /** Luminances at places of the flame: of the mean, and of moments. */
  const [mean, moments, sees] = await page.evaluate(async () => {
    const { page: p } = window.luxodus;
    const { surfaces, air } = p.live.shown;
    const { flames } = p.picture.smoke;
    const flame = p.live.scene.flames[0];
    for (const sum of [surfaces, air]) sum.sum.fill(0);
    p.walk.solid = false;
    const [x, y, z] = flame.low.map((low, k) => low + flame.size[k] / 2);
    p.walk.jump({ eye: [x - 2, y, z], gaze: [1, 0, 0] });
    p.light.changed();
    await window.luxodus.settled();
    const tall = flame.size[2] / 2 / 2 / Math.tan((p.walk.view.fov * Math.PI) / 360);
    const places = [[-0.8, 0], [-0.4, 0], [0.1, 0], [-0.6, 0.15]];
    const seen = () => {
      p.picture.again();
      for (let i = 0; i < 2; ++i) p.picture.addPicture(false);
      return places.map(([up, right]) => p.picture.luminanceAt(right * tall, up * tall));
    };
    const { shapeSeed, flameTime } = flames.uniforms;
    const [seed] = shapeSeed.value;
    shapeSeed.value[0] = 0;
    const ofMean = seen();
    shapeSeed.value[0] = seed;
    await window.luxodus.settled();
    const { seesFlames } = p.picture;
    const ofMoments = [];
    for (let k = 0; k < 150; ++k) {
      flameTime.value = 0.37 * k;
      ofMoments.push(seen());
    }
    flameTime.value = 0;
    for (const sum of [surfaces, air]) sum.stained(true);
    p.live.settle();
    p.light.changed();
    p.walk.jump({ eye: [x - 2, y, z], gaze: [-1, 0, 0] });
    await window.luxodus.settled();
    const seesThemBehind = p.picture.seesFlames;
    // Behind the partition, towards the fire.
    p.walk.jump({ eye: [3, 0.5, 1.2], gaze: [x - 3, y - 0.5, z - 1.2] });
    await window.luxodus.settled();
    const seesThemThroughWalls = p.picture.seesFlames;
    p.walk.solid = true;
    return [ofMean, ofMoments, { seesFlames, seesThemBehind, seesThemThroughWalls }];
  });
  assert.deepEqual(sees,
    { seesFlames: true, seesThemBehind: false, seesThemThroughWalls: false });
  for (const [i, luminance] of mean.entries()) {
    const factors = moments.map((seen) => seen[i] / luminance);
    const average = factors.reduce((sum, f) => sum + f) / factors.length;
    const variance = factors.reduce((sum, f) => sum + (f - average) ** 2, 0) / factors.length;
    const error = Math.sqrt(variance / factors.length);
    assert.ok(variance > 0.01, `place ${i} hardly changes`);
    assert.ok(Math.abs(average - 1) < 4.5 * error, `place ${i}: ${average} +- ${error}`);
  }
});

/**
 * Luminances of a room in clear air whose surfaces all emit 1 cd/m2, at places of a view; lamps are
 * visible, signs are not. `gloss`: of the floor; `lamps`: replace those of the room.
 */
const seenInGrey = (gloss, places, lamps = null) => page.evaluate(async ([of, at, others]) => {
  const { page: p } = window.luxodus;
  const { surfaces, air } = p.live.shown;
  surfaces.sum.fill(1);
  const { present } = p.picture.smoke;
  p.picture.smoke.present = false;
  p.picture.signs.object.visible = false;
  p.walk.solid = false;
  p.walk.jump({ eye: [0.5, 3, 1.5], gaze: [1, 0, -0.23], fov: 80 });
  p.walk.show();
  p.picture.gloss.kinds(of);
  if (others) {
    p.picture.lamps.build(others.lamps, others.tables);
    p.picture.lamps.shine(() => 1);
  }
  p.light.awaited = { now: false, soon: false };
  p.picture.surfaces.shine(surfaces);
  p.picture.again();
  await window.luxodus.settled();
  const found = at.map((place) => {
    const [x, y] = p.panels.labels.project(place, p.picture.camera);
    return p.picture.luminanceAt(x, y);
  });
  for (const sum of [surfaces, air]) sum.stained(true);
  p.live.settle();
  p.picture.gloss.kinds(p.live.scene.gloss);
  if (others) p.picture.lamps.build(p.live.scene.lamps, p.live.scene.lampTables);
  p.picture.smoke.present = present;
  p.picture.signs.object.visible = p.walk.solid = true;
  p.light.changed();
  return found;
}, [gloss, places, lamps]);

test('a lamp is seen where it hangs, and where a floor mirrors it', async () => {
  const lamp = [5.2, 3, 2.9];
  /** Between the eye at 1.5 m and the lamp at 2.9 m, heights below the floor divide the path. */
  const mirror = [0.5 + (4.7 * 1.5) / 4.4, 3, 0];
  const places = [lamp, mirror, [mirror[0], 3.5, 0], [mirror[0] + 0.6, 3, 0], [4, 1, 0]];
  const matt = await seenInGrey([], places);
  const sharp = await seenInGrey(glossyFloor(0), places);
  const rough = await seenInGrey(glossyFloor(0.15), places);
  for (const x of matt.slice(1)) assert.ok(Math.abs(x - 1) < 2e-3, `${matt}`);
  // Equally bright from all directions: 200, 195, 180 cd divided by 0.0707 m2.
  const luminance = (0.2126 * 200 + 0.7152 * 195 + 0.0722 * 180) / (Math.PI * 0.15 ** 2) + 1;
  assert.ok(Math.abs(matt[0] / luminance - 1) < 0.02, `${matt[0]}, not ${luminance}`);
  assert.equal(sharp[0], matt[0]);
  // 0.6 of the floor's own light, and 0.2 of what it mirrors: the lamp, or grey.
  const reflected = 0.6 + 0.2 * luminance;
  assert.ok(Math.abs(sharp[1] / reflected - 1) < 0.05, `${sharp[1]}, not ${reflected}`);
  for (const x of sharp.slice(2)) assert.ok(Math.abs(x - 0.8) < 0.01, `${sharp}`);
  // A rough floor spreads it: less bright there, more beside it along the view than across.
  assert.ok(rough[1] < 0.7 * sharp[1] && rough[1] > 2, `${rough}`);
  assert.ok(rough[3] > rough[2] && rough[2] >= 0.75, `${rough}`);
  assert.ok(Math.abs(rough[4] - 0.8) < 0.08, `${rough}`);
});

test('a round luminaire is brighter where it is inclined to the eye', async () => {
  const eye = [0.5, 3, 1.5];
  const centre = [4, 3, 0.8];
  /** This far around the sphere from the point that faces the eye, and the cosine there. */
  const inclined = (angle) => {
    const along = [0, 1, 2].map((k) => (eye[k] - centre[k]) / Math.hypot(3.5, 0.7));
    const normal = along.map((x, k) => Math.cos(angle) * x + (k === 1 ? Math.sin(angle) : 0));
    const place = normal.map((x, k) => centre[k] + 0.5 * x);
    const to = eye.map((x, k) => x - place[k]);
    const cosine = to.reduce((sum, x, k) => sum + x * normal[k], 0) / Math.hypot(...to);
    return { place, cosine };
  };
  const points = [0, 0.4, 0.75].map(inclined);
  const sphere = { group: 'lamp', shape: 'sphere', position: centre, size: [1, 1, 1], corners: [],
    axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], colour: [50, 50, 50], table: 0, ofLuminaire: true };
  const tables = [{ peak: 1, polar: 2, azimuth: 1, values: [65535, 65535] }];
  const seen = await seenInGrey([], points.map(({ place }) => place), { lamps: [sphere], tables });
  points.forEach(({ cosine }, i) => {
    const expected = 1 + 50 / cosine;
    assert.ok(Math.abs(seen[i] / expected - 1) < 0.08, `${seen[i]}, not ${expected}`);
  });
});

test('smoke on the way to a floor and back attenuates what it mirrors', async () => {
  const seen = await page.evaluate(async (of) => {
    const { page: p } = window.luxodus;
    const { picture } = p;
    const { surfaces, air } = p.live.shown;
    const { glow } = picture.smoke.texels;
    const before = glow.slice();
    surfaces.sum.fill(0);
    air.sum.fill(0);
    picture.signs.object.visible = false;
    const { flames } = picture.smoke.flames;
    picture.smoke.flames.uniforms.flameCount.value = 0;
    picture.gloss.kinds(of);
    p.walk.solid = false;
    const mirror = [0.5 + (4.7 * 1.5) / 4.4, 3, 0];
    p.walk.jump({ eye: [0.5, 3, 1.5], gaze: [1, 0, -0.3] });
    const found = [];
    const quarter = glow instanceof Float32Array ? 0.25 : 0x3400;
    for (const extinction of [0, quarter]) {
      for (let i = 3; i < glow.length; i += 4) glow[i] = extinction;
      p.light.changed();
      p.light.update(performance.now());
      surfaces.sum.fill(0);
      await window.luxodus.settled();
      const [x, y] = p.panels.labels.project(mirror, picture.camera);
      found.push(picture.luminanceAt(x, y));
    }
    glow.set(before);
    for (const sum of [surfaces, air]) sum.stained(true);
    p.live.settle();
    picture.gloss.kinds(p.live.scene.gloss);
    picture.smoke.flames.uniforms.flameCount.value = flames.length;
    picture.signs.object.visible = p.walk.solid = true;
    p.light.changed();
    return found;
  }, glossyFloor(0));
  const way = Math.hypot(4.7, 4.4);
  const expected = Math.exp(-0.25 * way);
  const ratio = seen[1] / seen[0];
  assert.ok(Math.abs(ratio / expected - 1) < 0.03, `${ratio}, not ${expected}: ${seen}`);
});

test("the mean luminance is linear in a luminaire's dimming", async () => {
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.walk.jump(p.live.scene.observers[0]);
  });
  const at = {}, onSurfaces = {};
  for (const factor of [1, 0.5, 0]) {
    await pull(slider('lamp west'), factor);
    at[factor] = await mean();
    onSurfaces[factor] = await page.evaluate(() =>
      window.luxodus.page.live.shown.surfaces.sum.reduce((all, light) => all + light, 0));
  }
  assert.ok(at[1] > 1.3 * at[0]);
  // Linear on surfaces; in smoke the directed share is that of all lamps together.
  for (const [light, tolerance] of [[onSurfaces, 0.005], [at, 0.05]]) {
    const half = (light[0] + light[1]) / 2;
    assert.ok(Math.abs(light[0.5] / half - 1) < tolerance, `${light[0.5]} against ${half}`);
  }
  await shot('lamp_off');
  await pull(slider('lamp west'), 1);
  const sent = server.heard.filter((m) => m.type === 'factor');
  assert.ok(sent.every((m) => m.group === 'lamp west'));
});

test('denser smoke shows the old picture faded, then the new one', async () => {
  const before = await mean();
  const old = await generation();
  await pull(page.locator('#smoke'), 0.6);
  await page.locator('#banner').waitFor({ state: 'visible', ...patience });
  assert.equal(await generation(), old);
  await page.screenshot({ path: `${shots}/fading.png` });
  await page.locator('#banner').waitFor({ state: 'hidden', ...patience });
  assert.equal(await generation(), old + 1);
  assert.notEqual(await mean(), before);
  await shot('thick_smoke');
  await pull(page.locator('#smoke'), 0);
  await page.waitForFunction((g) => window.luxodus.page.live.number === g, old + 2, patience);
});

test("a click shows a surface's light or a sign's verdicts, and the sign can be moved", async () => {
  await page.mouse.click(330, 520);
  await page.locator('dl dd').first().waitFor(patience);
  await page.getByText('standard error').waitFor(patience);
  await shot('probe');
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.sign(p.live.scene.signs[0]);
  });
  await page.locator('#panel table').waitFor(patience);
  await shot('sign');
  const old = await generation();
  await page.getByRole('button', { name: 'Left', exact: true }).click();
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  const move = server.heard.findLast((m) => m.type === 'move');
  assert.deepEqual([move.kind, move.name], ['sign', 'exit sign']);
  assert.ok(Math.abs(Math.hypot(...move.position.map((x, i) => x - [6.49, 2.9, 2.4][i])) - 0.25)
    < 1e-6);
});

test('a selected sign is dragged along its wall', async () => {
  await settled();
  const point = () => page.evaluate(() => {
    const { page: p } = window.luxodus;
    const [x, y] = p.panels.labels.project(p.live.scene.signs[0].position, p.picture.camera);
    const { clientWidth, clientHeight } = document.getElementById('picture');
    return [(0.5 + 0.5 * x) * clientWidth, (0.5 - 0.5 * y) * clientHeight];
  });
  const [x, y] = await point();
  const count = server.heard.filter((m) => m.type === 'move').length;
  const old = await generation();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 30, y, { steps: 3 });
  await page.mouse.up();
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  const moves = server.heard.filter((m) => m.type === 'move');
  assert.equal(moves.length, count + 1);
  assert.ok(Math.abs(moves.at(-1).position[0] - 6.49) < 1e-6, 'it stays on its wall');
  await page.keyboard.press('Escape');
});

test("false colours have a legend, and the eye's view and the plan their own pictures", async () => {
  await page.getByRole('button', { name: 'Luminance' }).click();
  assert.ok(await page.locator('#legend').isVisible());
  await shot('luminance');
  await page.getByRole('button', { name: 'Eye', exact: true }).click();
  await shot('eye');
  await page.getByRole('button', { name: 'Camera', exact: true }).click();
  await page.getByRole('button', { name: 'Plan' }).click();
  await shot('plan');
  await page.getByRole('button', { name: 'Orbit' }).click();
  await shot('orbit');
  await page.getByRole('button', { name: 'Walk' }).click();
});

test('a traced picture of the view is refined, shown and saved, and can be stopped', async () => {
  await page.getByRole('button', { name: 'Render this view' }).click();
  await page.locator('#traced', { hasText: '32 paths a pixel' }).waitFor(patience);
  const asked = server.heard.findLast((m) => m.type === 'render');
  const view = await page.evaluate(() => window.luxodus.page.walk.view);
  assert.deepEqual([asked.eye, asked.target, asked.fov], [view.eye, view.target, view.fov]);
  assert.equal(asked.human, false);
  assert.ok(asked.width * asked.height <= 1 << 19);
  const drawn = await page.locator('#traced img').evaluate(async (image) => {
    await image.decode();
    return [image.naturalWidth, image.naturalHeight];
  });
  assert.deepEqual(drawn, [asked.width, asked.height]);
  assert.match(await page.locator('#traced').innerText(), /± 8.8 % .* finished/);
  await shot('traced');
  const [file] = await Promise.all([page.waitForEvent('download'),
    page.getByRole('link', { name: 'Download' }).click()]);
  assert.equal(file.suggestedFilename(), 'mock 32 paths.png');
  server.pictureMs = 1e6;
  await page.getByRole('button', { name: 'Render this view' }).click();
  await page.locator('#traced', { hasText: '400 000 particles' }).waitFor(patience);
  await page.locator('#traced').getByRole('button', { name: 'Stop' }).click();
  await page.locator('#traced', { hasText: 'stopped' }).waitFor(patience);
  await page.getByRole('button', { name: 'Close the traced picture' }).click();
  assert.ok(await page.locator('#traced').isHidden());
  assert.equal(server.heard.filter((m) => m.type === 'stop_render').length, 1);
});

test('no colour is shown brighter than one of more luminance, by the camera or the eye', async () => {
  const points = await page.evaluate(() => {
    const { picture } = window.luxodus.page;
    const { exposure } = picture;
    const uniforms = picture.tone.uniforms;
    const Texture = uniforms.scaleColours.value.constructor;
    const Target = picture.targets.meter.constructor;
    const wide = 64;
    const luminance = (c, i) => 0.2126 * c[i] + 0.7152 * c[i + 1] + 0.0722 * c[i + 2];
    // Random colours, many of them saturated, of luminances spread over eight decades.
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    const lights = new Float32Array(4 * wide * wide);
    for (let i = 0; i < lights.length; i += 4) {
      const colour = [0, 1, 2].map(() => 1e-3 + random() ** 4);
      const level = 1e-3 * 1e8 ** random();
      lights.set(colour.map((c) => (c * level) / luminance(colour, 0)), i);
      lights[i + 3] = 1;
    }
    const [light, out] = [new Texture(lights, wide, wide), new Target(wide, wide)];
    light.type = picture.targets.meter.texture.type;
    light.needsUpdate = true;
    const linear = (byte) =>
      byte <= 10 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4;
    const found = [];
    for (const mode of [0, 1])
      for (const sign of [0, 500]) {
        exposure.metered = { shown: 1, sign };
        exposure.setFor(1);
        uniforms.picture.value = light;
        uniforms.mode.value = mode;
        uniforms.fade.value = 0;
        uniforms.scale.value = exposure.scale;
        const bytes = new Uint8Array(4 * wide * wide);
        picture.toneTo(out, exposure.curve);
        picture.renderer.readRenderTargetPixels(out, 0, 0, wide, wide, bytes);
        const shown = Float32Array.from(bytes, linear);
        for (let i = 0; i < bytes.length; i += 4)
          found.push([mode, sign, luminance(lights, i), luminance(shown, i)]);
      }
    picture.untoned = true;
    return found;
  });
  const encoded = (v) => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
  for (const mode of [0, 1])
    for (const sign of [0, 500]) {
      // The eye sees by cones alone from some 10 cd/m2 on: then luminance is what it sees.
      const codes = points
        .filter(([m, s, level]) => m === mode && s === sign && level > 10 * mode)
        .sort((a, b) => a[2] - b[2])
        .map((point) => encoded(point[3]));
      assert.ok(codes.length > 1000);
      let [highest, inversion] = [0, 0];
      for (const code of codes) {
        inversion = Math.max(inversion, highest - code);
        highest = Math.max(highest, code);
      }
      // A code value, and the grain of another that hides the steps of bytes.
      assert.ok(inversion <= 2, `${mode}, ${sign}: ${inversion}`);
      assert.ok(highest > 200, `${mode}, ${sign}: ${highest}`);
    }
});

test("a click changes the scenario, and the eye's view is darker than the camera's", async () => {
  const old = await generation();
  await page.getByRole('button', { name: /smoke, emergency/ }).click();
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  await page.getByRole('button', { name: 'Eye', exact: true }).click();
  assert.ok((await mean()) < 1);
  await shot('emergency_eye');
  await page.getByRole('button', { name: 'Camera', exact: true }).click();
  await shot('emergency_camera');
  await page.keyboard.press('?');
  await page.locator('#help').waitFor({ state: 'visible', ...patience });
  await shot('help');
  await page.getByRole('button', { name: 'Close' }).click();
});

test('a click sets 0, 5 or 60 s after a failure, and nothing is traced', async () => {
  const old = await generation();
  const at = {};
  for (const time of ['full', '0 s', '5 s', '60 s']) {
    await page.getByRole('button', { name: time, exact: true }).click();
    await page.locator(`.choice button[aria-pressed=true]`, { hasText: time }).waitFor(patience);
    at[time] = await mean();
    if (time === '5 s') await shot('five_seconds');
  }
  assert.ok(at['0 s'] < at['5 s'] && at['5 s'] < at['60 s'], JSON.stringify(at));
  assert.ok(Math.abs(at['60 s'] / at['full'] - 1) < 1e-3, JSON.stringify(at));
  assert.equal(await generation(), old);
});

test('a luminaire moves without fading of the other light', async () => {
  const old = await generation();
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.luminaire(p.live.scene.luminaires[0]);
  });
  await page.getByRole('button', { name: 'Right', exact: true }).click();
  await page.waitForFunction(() => window.luxodus.page.live.next, null, patience);
  assert.ok(await page.locator('#banner').isHidden());
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  assert.equal(await page.evaluate(() => window.luxodus.page.live.shown.surfaces.groups.size), 6);
  await page.keyboard.press('Escape');
});

/** A thing of the shown scene, and the selection. */
const thing = (list, name) => page.evaluate(([l, n]) =>
  window.luxodus.page.live.scene[l].find((t) => t.name === n), [list, name]);
const selected = (name) => page.waitForFunction((n) =>
  (window.luxodus.page.panels.inspect.subject?.name ?? null) === n, name, patience);
const groupsShown = () => page.evaluate(() => window.luxodus.page.live.shown.surfaces.groups.size);

test('a copy of a luminaire stands beside it, is selected, moves, and is removed', async () => {
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.luminaire(p.live.scene.luminaires[0]);
  });
  assert.equal(await page.getByRole('button', { name: 'Remove', exact: true }).count(), 0);
  const { position } = await thing('luminaires', 'lamp west');
  await page.getByRole('button', { name: 'Add a copy' }).click();
  await selected('lamp west copy');
  assert.ok(await page.locator('#banner').isHidden());
  const copy = (await thing('luminaires', 'lamp west copy')).position;
  assert.equal(copy[2], position[2]);
  assert.ok(Math.abs(Math.hypot(copy[0] - position[0], copy[1] - position[1]) - 0.5) < 1e-9);
  assert.equal(await groupsShown(), 7);
  assert.equal(await slider('lamp west copy').count(), 1);
  await shot('added_luminaire');
  const old = await generation();
  await page.getByRole('button', { name: 'Up', exact: true }).click();
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  assert.equal(server.heard.findLast((m) => m.type === 'move').name, 'lamp west copy');
  const height = page.getByLabel('z in metres');
  await height.fill('2.55');
  await height.press('Tab');
  await page.waitForFunction(() => window.luxodus.page.live.scene.luminaires
    .find((l) => l.name === 'lamp west copy').position[2] === 2.55, null, patience);
  assert.equal(await page.evaluate(() => document.activeElement.type), 'checkbox',
    'the handles stay in use while the building changes');
  await page.getByRole('button', { name: 'Remove', exact: true }).click();
  await selected(null);
  assert.equal(await slider('lamp west copy').count(), 0);
  assert.equal(await groupsShown(), 6);
});

test('a copy of a sign stands beside it along its width, is assessed, and is removed', async () => {
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.sign(p.live.scene.signs[0]);
  });
  const { position } = await thing('signs', 'exit sign');
  const triangles = () => page.evaluate(() => window.luxodus.page.live.shown.surfaces.cells);
  const count = await triangles();
  await page.getByRole('button', { name: 'Add a copy' }).click();
  await selected('exit sign copy');
  const copy = await thing('signs', 'exit sign copy');
  const apart = copy.position.map((x, i) => x - position[i]);
  assert.ok(Math.abs(Math.hypot(...apart) - copy.width - 0.05) < 1e-6, `${apart}`);
  assert.ok(Math.abs(apart[0]) < 1e-6, 'it stands on the same wall');
  assert.equal(await triangles(), count + 2);
  assert.equal(await groupsShown(), 7);
  await page.locator('#panel table').waitFor(patience);
  await shot('added_sign');
  const before = await mean();
  await page.getByRole('button', { name: 'Remove', exact: true }).click();
  await selected(null);
  assert.equal(await triangles(), count);
  assert.equal(await page.evaluate(() => window.luxodus.page.live.scene.signs.length), 2);
  assert.ok((await mean()) < before);
});

test('edits are undone and redone by keys, buttons and a click on a step', async () => {
  await settled();
  const steps = () => page.locator('.steps li').allTextContents();
  const done = (n) => page.waitForFunction((k) =>
    window.luxodus.page.panels.history.done === k &&
    document.querySelector('.steps [aria-current]')?.parentElement ===
      document.querySelectorAll('.steps li')[k], n, patience);
  const factor = () => server.state.factors['lamp east'];
  await pull(slider('lamp east'), 0.5);
  await page.waitForFunction(() => document.querySelector('.steps li:last-child')
    ?.textContent === 'lamp east: 50 %', null, patience);
  const count = (await steps()).length - 1;
  const before = server.before[count - 1].factors['lamp east'];
  await page.locator('#picture').focus();
  await page.keyboard.press('Control+z');
  await done(count - 1);
  assert.equal(factor(), before);
  assert.equal(await slider('lamp east').inputValue(), String(before));
  await shot('undone');
  await page.keyboard.press('Control+y');
  await done(count);
  assert.equal(factor(), 0.5);
  await page.getByRole('button', { name: 'Undo' }).click();
  await done(count - 1);
  await page.keyboard.press('Control+Shift+z');
  await done(count);
  assert.ok(await page.getByRole('button', { name: 'Redo' }).isDisabled());
  await page.getByRole('button', { name: 'As opened' }).click();
  await done(0);
  assert.ok(await page.getByRole('button', { name: 'Undo' }).isDisabled());
  assert.equal(factor(), 1);
  await page.getByRole('button', { name: 'lamp east: 50 %' }).last().click();
  await done(count);
  await page.waitForFunction(() => !window.luxodus.page.live.next, null, patience);
});

test('a type of the library is found, seen by its curve, and added before the viewer', async () => {
  const items = page.locator('.library li');
  assert.equal(await items.count(), 3);
  await page.getByLabel('Find a luminaire or sign to add').fill('nobody wide');
  assert.equal(await items.count(), 1);
  assert.match(await items.first().textContent(), /wide downlight.*Nobody WD 250.*250 lm in emer/);
  assert.equal(await items.first().locator('svg.curve polyline').count(), 2);
  await items.first().scrollIntoViewIfNeeded();
  await shot('library');
  const count = (await page.evaluate(() => window.luxodus.page.live.scene.luminaires.length));
  await page.getByRole('button', { name: 'Add wide downlight' }).click();
  await selected('wide downlight');
  const asked = server.heard.findLast((m) => m.type === 'add');
  assert.equal(asked.of_type, true);
  assert.ok(Math.abs(asked.position[2] - 2.97) < 1e-3, `under the ceiling: ${asked.position}`);
  const from = await eye();
  const away = Math.hypot(asked.position[0] - from[0], asked.position[1] - from[1]);
  assert.ok(away > 0.1 && away <= 2.001, `${away} m ahead`);
  assert.equal(await page.evaluate(() => window.luxodus.page.live.scene.luminaires.length),
    count + 1);
  await page.getByRole('button', { name: 'Remove', exact: true }).click();
  await selected(null);
  await page.getByLabel('Find a luminaire or sign to add').fill('no such thing');
  assert.match(await page.locator('.library').textContent(), /Nothing is called so/);
  await page.getByLabel('Find a luminaire or sign to add').fill('');
});

test('the list of checks follows edits, and shows the worst place', async () => {
  await page.getByRole('button', { name: 'Check the codes' }).click();
  const list = page.locator('.checklist');
  const verdict = (word) => page.waitForFunction((w) => {
    const element = document.querySelector('.checklist');
    return !element.hasAttribute('aria-busy') && element.textContent.includes(w);
  }, word, patience);
  await verdict('Pass');
  await page.locator('details', { hasText: 'Luminaires' }).getByRole('button', { name: 'all off' })
    .first().click();
  await verdict('Fail');
  assert.match(await list.textContent(), /E1 Illuminance.*0.* lx, at least 0.300 lx: −\d+ %/);
  assert.match(await page.locator('section', { hasText: 'Checks' }).first().textContent(),
    /Reflected light, smoke and what people read are not in it/);
  await page.getByRole('button', { name: 'Plan' }).click();
  await page.getByRole('button', { name: /E1 Illuminance/ }).click();
  const centre = await page.evaluate(() => window.luxodus.page.walk.motion.plan.centre);
  assert.deepEqual(centre, [3.6, 2.9]);
  assert.match(await page.locator('#plan-key').textContent(), /\d m/);
  await shot('checks_in_plan');
  await page.getByRole('button', { name: 'Undo' }).click();
  await verdict('Pass');
  await page.getByRole('button', { name: 'Walk' }).click();
  await page.getByRole('button', { name: 'Check the codes' }).click();
  assert.equal(await list.textContent(), '');
  await settled();
});

test('illuminance of surfaces is shown in steps with a key', async () => {
  await page.getByRole('button', { name: 'Lux', exact: true }).click();
  await settled();
  const legend = page.locator('#legend');
  assert.match(await legend.textContent(), /Illuminance \[lx\].*0\.1.*10.*5k/s);
  await shot('illuminance');
  const [shown, expected] = await page.evaluate(async () => {
    const { page: p } = window.luxodus;
    const { surfaces } = p.live.shown;
    const smoky = p.picture.smoke.present;
    for (let i = 0; i < surfaces.sum.length; i += 4) surfaces.sum.set([9, 9, 9, 30], i);
    p.light.changed();
    await window.luxodus.settled();
    // A screenshot of a canvas that keeps no drawing must be read in the same task.
    p.picture.untoned = true;
    p.picture.show();
    const { renderer } = p.picture;
    const gl = renderer.getContext();
    const bytes = new Uint8Array(4);
    gl.readPixels(renderer.domElement.width >> 1, renderer.domElement.height >> 1, 1, 1, gl.RGBA,
      gl.UNSIGNED_BYTE, bytes);
    const bar = document.querySelector('#legend canvas').getContext('2d');
    const band = bar.getImageData(8, 0, 1, 1).data;  // above 20 lx: the eighth of the steps
    surfaces.stained(true);
    p.live.settle();
    p.light.changed();
    return [[...bytes.slice(0, 3), smoky], [...band.slice(0, 3), true]];
  });
  shown.forEach((byte, c) => assert.ok(Math.abs(byte - expected[c]) <= 6, `${shown}: ${expected}`));
  await page.getByRole('button', { name: 'Camera', exact: true }).click();
  assert.ok(await legend.isHidden());
  await settled();
});

test('the keyboard alone walks, selects, moves and undoes', async () => {
  await settled();
  await page.locator('#picture').focus();
  await page.keyboard.press('n');
  const first = await page.evaluate(() => window.luxodus.page.panels.inspect.subject);
  assert.ok(['sign', 'luminaire'].includes(first.kind), JSON.stringify(first));
  await page.keyboard.press('n');
  const second = await page.evaluate(() => window.luxodus.page.panels.inspect.subject);
  assert.notEqual(second.name, first.name);
  const active = () => page.evaluate(() => document.activeElement.getAttribute('aria-label'));
  const old = server.heard.filter((m) => m.type === 'move').length;
  for (let i = 0; i < 40 && (await active()) !== 'Right'; ++i) await page.keyboard.press('Tab');
  assert.equal(await active(), 'Right');
  await page.keyboard.press('Enter');
  await page.waitForFunction((n) => window.luxodus.page.panels.history.steps.length &&
    !window.luxodus.page.selection.mover.pending, old, patience);
  const moves = server.heard.filter((m) => m.type === 'move');
  assert.equal(moves.length, old + 1);
  assert.equal(moves.at(-1).name, second.name);
  const done = await page.evaluate(() => window.luxodus.page.panels.history.done);
  await page.keyboard.press('Control+z');
  await page.waitForFunction((n) => window.luxodus.page.panels.history.done === n - 1, done,
    patience);
  await page.keyboard.press('Escape');
  await selected(null);
});

test('a refused edit is reported', async () => {
  await page.getByLabel('Name of the variant').fill('../out');
  await page.getByRole('button', { name: 'Save as' }).click();
  await page.locator('.toast', { hasText: 'Refused' }).waitFor(patience);
  await shot('refused');
  await page.getByLabel('Name of the variant').fill('variant_2');
  await page.getByRole('button', { name: 'Save as' }).click();
  await page.locator('.toast', { hasText: 'variant_2.toml' }).waitFor(patience);
});

test('one of two viewers edits, and the other may take over', async () => {
  await settled();  // at rest it draws nothing, and leaves the machine to the other
  const second = await open();
  assert.ok(await second.locator('#smoke').isDisabled());
  assert.ok(await page.locator('#smoke').isEnabled());
  await pull(slider('lamp east'), 0.25);
  await second.waitForFunction(() => window.luxodus.page.live.scene.groups
    .find((g) => g.name === 'lamp east').factor === 0.25, null, patience);
  await shot('read_only', second);
  await second.getByRole('button', { name: 'take over' }).click();
  await second.locator('#smoke:enabled').waitFor(patience);
  await page.locator('#smoke:disabled').waitFor({ state: 'attached', ...patience });
  await second.context().close();
});

/** Walks 1 m/s north between the sign and its reader, from whom the body hides the sign at 20 s. */
const passer = ([, y]) => {
  const feet = Array.from({ length: 41 }, (_, i) => [2.5, y - 2 + 0.1 * i, 0]);
  return { step: 0.1, people: [{ eye_height: 1.65, from: 18, to: 22,
    feet: Buffer.from(new Float32Array(feet.flat()).buffer).toString('base64') }] };
};

test('people walk by the clock and hide signs, and the light follows', async () => {
  await settled();
  const { position } = server.state.signs[0];
  Object.assign(server, { people: passer(position), states: { from: 0, to: 60, step: 10, at: 0, mains_fail_at: 30 } });
  const second = await open();
  // The first viewer of a building that nobody edits is its editor.
  if (await second.locator('#smoke').isDisabled())
    await second.getByRole('button', { name: 'take over' }).click();
  await second.locator('#smoke:enabled').waitFor(patience);
  const signLuminance = async (time) => {
    await pull(second.locator('#clock'), time);
    await second.waitForFunction((t) => window.luxodus.page.live.scene.states.at === t, time,
      patience);
    await settled(second);
    return second.evaluate(() => window.luxodus.page.picture.luminanceAt(0, 0));
  };
  await second.evaluate((sign) =>
    window.luxodus.page.walk.jump({ eye: [1.5, sign[1], 0.9], target: sign }), position);
  const free = await signLuminance(10);
  const hidden = await signLuminance(20);
  await shot('people', second);
  assert.ok(hidden < 0.5 * free, `${hidden} behind a person, ${free} without`);
  assert.match(await second.locator('section', { hasText: 'Clock' }).textContent(),
    /1 person · light and smoke of 20 s/);
  await second.getByRole('button', { name: 'Mains fail 30 s' }).click();
  await second.waitForFunction(() => window.luxodus.page.live.scene.states.at === 30, null,
    patience);
  await signLuminance(20);
  await second.locator('#picture').focus();
  await second.keyboard.press('k');
  await second.waitForFunction(() => window.luxodus.page.panels.clock.time > 27, null, patience);
  await second.waitForFunction(() => window.luxodus.page.live.scene.states.at === 30, null,
    patience);
  await second.keyboard.press('k');
  assert.equal(await second.locator('#play').textContent(), 'Play');
  await second.context().close();
  Object.assign(server, { people: { step: 1, people: [] }, states: null });
  server.begin();
});

/** Boxes of the page that overlap, by pairs. */
const overlaps = (p) => p.evaluate(() => {
  const names = ['top', 'progress', 'views', 'panel', 'legend', 'banner', 'plan-key'];
  const shown = names.map((id) => document.getElementById(id))
    .filter((e) => e.checkVisibility() && e.getBoundingClientRect().width > 0);
  const box = (e) => e.getBoundingClientRect();
  const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top ||
    b.bottom <= a.top;
  return shown.flatMap((a, i) => shown.slice(i + 1)
    .filter((b) => !apart(box(a), box(b))).map((b) => `${a.id} on ${b.id}`));
});

test('nothing covers anything on a phone, a tablet and a small laptop', async () => {
  await settled();
  const long = 'Emergency lighting of the administration building, third floor, east wing';
  for (const [name, width, height] of [['phone', 390, 844], ['tablet', 820, 1180],
    ['laptop', 1280, 800]]) {
    const small = await open({ viewport: { width, height }, hasTouch: width < 1000 });
    await small.evaluate((title) => (document.getElementById('title').textContent = title), long);
    for (const mode of ['Lux', 'Camera']) {
      await small.evaluate((label) => [...document.querySelectorAll('#panel button')]
        .find((b) => b.textContent === label).click(), mode);
      for (const way of ['Plan', 'Walk']) {
        if (name !== 'phone') await small.getByRole('button', { name: way }).click();
        await settled(small);
        assert.deepEqual(await overlaps(small), [], `${name}, ${mode}, ${way}`);
      }
    }
    await shot(name, small);
    if (name === 'phone') {
      await small.locator('#fold').click();
      await shot('phone_panel', small);
      assert.deepEqual(await overlaps(small), []);
    }
    await small.context().close();
  }
});

test('a touch walks, looks and selects', async () => {
  const small = await open({ viewport: { width: 390, height: 844 }, hasTouch: true });
  const gaze = () => small.evaluate(() => {
    const { motion } = window.luxodus.page.walk;
    return [motion.yaw, ...motion.eye];
  });
  const before = await gaze();
  const session = await small.context().newCDPSession(small);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent',
    { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await touch('touchStart', [200, 400]);
  for (const x of [220, 250, 280]) await touch('touchMove', [x, 400]);
  await touch('touchEnd');
  const looked = await gaze();
  assert.ok(Math.abs(looked[0] - before[0]) > 0.1, 'one finger looks');
  await touch('touchStart', [150, 400], [250, 400]);
  for (const y of [420, 450, 480]) await touch('touchMove', [150, y], [250, y]);
  await touch('touchEnd');
  const walked = await gaze();
  assert.ok(Math.hypot(walked[1] - looked[1], walked[2] - looked[2]) > 0.1, 'two fingers walk');
  await settled(small);
  await small.locator('#picture').tap({ position: { x: 195, y: 600 } });
  await small.waitForFunction(() => window.luxodus.page.panels.inspect.subject !== null, null,
    patience);
  await small.context().close();
});

test('a lost connection is reported, and restored', async () => {
  for (const viewer of server.viewers) viewer.terminate();
  await page.locator('#link[data-state=lost]').waitFor(patience);
  await page.locator('#link[data-state=open]').waitFor(patience);
  await page.waitForFunction(() => !window.luxodus.page.live.fresh, null, patience);
  assert.ok((await mean()) > 0.05);
});

test('malformed frames are reported and do no harm', async () => {
  for (const viewer of server.viewers) {
    viewer.send('{"type":"scene"}');
    viewer.send(Buffer.alloc(7));
    viewer.send(Buffer.alloc(64, 255));
  }
  await page.locator('.toast', { hasText: 'does not understand' }).first().waitFor(patience);
  assert.ok((await mean()) > 0.05);
  assert.deepEqual(complaints.filter((c) => !c.includes('WebSocket')), []);
});
