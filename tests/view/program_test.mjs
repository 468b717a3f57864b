// The page in a real browser, served by the program itself.
// `node program_test.mjs`; LUX_PROGRAM names the program, LUX_SHOTS the folder for pictures.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';

const root = new URL('../..', import.meta.url).pathname;
const program = process.env.LUX_PROGRAM ?? `${root}/build/release/luxodus`;
const scene = `${root}/scenes/library/office_floor.toml`;
const shots = process.env.LUX_SHOTS ?? new URL('shots', import.meta.url).pathname;
const flags = ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader'];
/** Timeout for failures. All waits are for states, and no test depends on their duration. */
const patience = { timeout: 180_000 };
const lamp = 'corridor emergency light 3';

let served;
let browser;
let address;
let page;
let folder;
const complaints = [];

/** The address that the program prints. */
function started(child) {
  return new Promise((resolve, reject) => {
    let said = '';
    child.stdout.on('data', (bytes) => {
      said += bytes;
      const found = said.match(/http:\S+/);
      if (found) resolve(found[0]);
    });
    child.on('exit', (code) => reject(new Error(`the program ended with ${code}`)));
  });
}

async function open() {
  const context = await browser.newContext({
    viewport: { width: 1024, height: 640 }, reducedMotion: 'reduce' });
  context.setDefaultTimeout(patience.timeout);
  const opened = await context.newPage();
  opened.on('console', (m) => m.type() === 'error' && complaints.push(m.text()));
  opened.on('pageerror', (error) => complaints.push(error.stack));
  await opened.goto(address);
  await lit(opened, 1);
  await opened.evaluate(() => {
    const { picture } = window.luxodus.page;
    picture.learns = false;
    picture.shares = { moving: 0.3, still: 0.4 };
  });
  return opened;
}

/** Waits until a generation, or a later one, is completely traced and shown. */
const lit = (p, generation) => p.waitForFunction((wanted) => {
  const { live } = window.luxodus.page;
  return live.number >= wanted && live.shown?.surfaces?.groups.size > 10 &&
    document.querySelector('.done');
}, generation, patience);
const generation = () => page.evaluate(() => window.luxodus.page.live.number);
const mean = async () => {
  await page.evaluate(() => window.luxodus.settled());
  return page.evaluate(() => window.luxodus.meanLuminance());
};
const shot = (name) => page.screenshot({ path: `${shots}/${name}.png` });

async function pull(locator, value) {
  await locator.evaluate((input, v) => {
    input.value = v;
    input.dispatchEvent(new Event('input', { bubbles: true }));
    input.dispatchEvent(new Event('change', { bubbles: true }));
  }, value);
}

before(async () => {
  mkdirSync(shots, { recursive: true });
  folder = mkdtempSync(`${tmpdir()}/luxodus-view-`);
  served = spawn(program, ['view', scene, '--scenario', 'clear_emergency', '--port', '0',
    '--save-folder', folder, '--particles', '300k']);
  address = await started(served);
  browser = await chromium.launch({
    executablePath: process.env.LUX_CHROMIUM ?? '/usr/bin/chromium', args: flags });
  page = await open();
});

after(async () => {
  await browser?.close();
  served?.kill('SIGINT');
});

test('the office floor loads, is lit, and reports no errors', async () => {
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.walk.jump(p.live.scene.observers.find((o) => o.name === 'walker'));
  });
  // The views face along the corridor, to the east.
  const yaw = await page.evaluate(() => window.luxodus.page.walk.motion.yaw);
  assert.ok(Math.abs(yaw) < 0.01, `they look ${yaw} rad off the corridor`);
  assert.ok((await mean()) > 0.01);
  await shot('program_corridor');
  assert.deepEqual(complaints, []);
});

test("the mean luminance is linear in a luminaire's dimming", async () => {
  const slider = page.locator(`li[data-name="${lamp}"] input[type=range]`);
  const at = {};
  for (const factor of [1, 0.5, 0]) {
    await pull(slider, factor);
    at[factor] = await mean();
  }
  assert.ok(at[1] > 1.02 * at[0], `${at[1]} lit, ${at[0]} dark`);
  const half = (at[0] + at[1]) / 2;
  assert.ok(Math.abs(at[0.5] / half - 1) < 0.005, `${at[0.5]} against ${half}`);
  await pull(slider, 1);
});

test('smoke begins a new generation', async () => {
  const old = await generation();
  await page.getByRole('button', { name: /smoke_emergency/ }).click();
  await lit(page, old + 1);
  await shot('program_smoke');
  assert.ok((await generation()) > old);
});

test('a luminaire moves, and only its own light is sent again', async () => {
  const old = await generation();
  await page.evaluate((name) => {
    const { page: p } = window.luxodus;
    p.selection.luminaire(p.live.scene.luminaires.find((l) => l.name === name));
  }, lamp);
  await page.getByRole('button', { name: 'Right', exact: true }).click();
  await page.waitForFunction((g) => window.luxodus.page.live.number > g, old, patience);
  const groups = await page.evaluate(() => window.luxodus.page.live.scene.groups);
  assert.deepEqual(groups.filter((g) => g.light === 'new').map((g) => g.name), [lamp]);
  assert.ok(await page.locator('#banner').isHidden());
  await lit(page, old + 1);
  await shot('program_moved_lamp');
  await page.keyboard.press('Escape');
});

test('a sign is assessed, moved, and saved as a variant', async () => {
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.sign(p.live.scene.signs.find((s) => s.name === 'exit east'));
  });
  await page.locator('#panel table').waitFor(patience);
  await shot('program_sign');
  const old = await generation();
  await page.getByRole('button', { name: 'Left', exact: true }).click();
  await lit(page, old + 1);
  await page.getByLabel('Name of the variant').fill('moved sign');
  await page.getByRole('button', { name: 'Save as' }).click();
  await page.locator('.toast', { hasText: 'moved sign.toml' }).waitFor(patience);
  const saved = readFileSync(`${folder}/moved sign.toml`, 'utf8');
  assert.match(saved, /kind = "sign"\nof = "exit east"\nposition = /);
});

const selected = (name) => page.waitForFunction((n) =>
  (window.luxodus.page.panels.inspect.subject?.name ?? null) === n, name, patience);
const lightOf = (light) => page.evaluate((l) =>
  window.luxodus.page.live.scene.groups.filter((g) => g.light === l).map((g) => g.name), light);

test('a luminaire is added, the others keep their light, and it is removed', async () => {
  const old = await generation();
  const others = await page.evaluate(() => window.luxodus.page.live.scene.groups.length);
  await page.evaluate((name) => {
    const { page: p } = window.luxodus;
    p.selection.luminaire(p.live.scene.luminaires.find((l) => l.name === name));
  }, lamp);
  await page.getByRole('button', { name: 'Add a copy' }).click();
  await selected(`${lamp} copy`);
  assert.deepEqual(await lightOf('new'), [`${lamp} copy`]);
  assert.equal((await lightOf('kept')).length + (await lightOf('before')).length, others);
  assert.ok(await page.locator('#banner').isHidden());
  await lit(page, old + 1);
  await shot('program_added_lamp');
  await page.getByRole('button', { name: 'Remove', exact: true }).click();
  await selected(null);
  assert.equal((await lightOf('kept')).length, others);
});

test('a sign is added, assessed, saved as a variant, and removed', async () => {
  const old = await generation();
  await page.evaluate(() => {
    const { page: p } = window.luxodus;
    p.selection.sign(p.live.scene.signs.find((s) => s.name === 'exit east'));
  });
  await page.getByRole('button', { name: 'Add a copy' }).click();
  await selected('exit east copy');
  assert.deepEqual(await lightOf('new'), ['sign exit east copy']);
  assert.equal((await lightOf('kept')).length, 0);
  assert.ok(await page.locator('#banner').isHidden());
  assert.ok((await mean()) > 0.001, 'the light of before is shown');
  await page.locator('#panel table').waitFor(patience);
  await lit(page, old + 1);
  await shot('program_added_sign');
  await page.getByLabel('Name of the variant').fill('one sign more');
  await page.getByRole('button', { name: 'Save as' }).click();
  await page.locator('.toast', { hasText: 'one sign more.toml' }).waitFor(patience);
  const saved = readFileSync(`${folder}/one sign more.toml`, 'utf8');
  assert.match(saved, /kind = "sign"\nof = "exit east"\ncopy = "exit east copy"\nposition = /);
  await page.getByRole('button', { name: 'Remove', exact: true }).click();
  await selected(null);
  assert.deepEqual(await lightOf('new'), []);
  assert.ok((await mean()) > 0.001);
  assert.deepEqual(complaints, []);
});

test('a traced picture of the view is refined, with its error', async () => {
  await page.getByRole('button', { name: 'Render this view' }).click();
  await page.locator('#traced', { hasText: /paths a pixel · ± [0-9.]+ %/ }).waitFor(patience);
  const size = await page.locator('#traced img').evaluate(async (image) => {
    await image.decode();
    return image.naturalWidth * image.naturalHeight;
  });
  assert.ok(size > 4e5 && size <= 1 << 19, `${size} pixels`);
  await shot('program_traced');
  await page.getByRole('button', { name: 'Close the traced picture' }).click();
  assert.deepEqual(complaints, []);
});

test('a second viewer may watch, not edit', async () => {
  const second = await open();
  assert.ok(await second.locator('#smoke').isDisabled());
  await second.context().close();
});
