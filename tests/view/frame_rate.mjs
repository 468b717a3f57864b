// How many pictures a second the page draws while somebody turns around, and how fine they are:
// `node frame_rate.mjs [ADDRESS]`; without an address, of the room of mock_server.mjs. LUX_GPU=1
// leaves the choice of the renderer to the browser, else it draws in software (SwiftShader).
// LUX_RASTER=0.5 keeps that share of the screen's raster, instead of letting the page learn it.
// LUX_HEIGHT is that of the window, 1280 wide [px]. The processor time of a picture is that of all of
// the browser: it hardly depends on what else runs.
import { readdirSync, readFileSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { MockServer } from './mock_server.mjs';

/** The raster is learned first, and then kept. */
const seconds = { learn: 12, count: 8 };
const software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const flags = ['--headless=new', '--no-sandbox', ...(process.env.LUX_GPU ? [] : software)];

const raster = Number(process.env.LUX_RASTER ?? 0);
const windowHeight = Number(process.env.LUX_HEIGHT ?? 800);

/** Processor seconds of a process and of all that it has begun (Linux). */
function processorSeconds(root) {
  const all = readdirSync('/proc').filter((name) => /^\d+$/.test(name)).flatMap((pid) => {
    try {
      const stat = readFileSync(`/proc/${pid}/stat`, 'utf8');
      const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
      return [{ pid: Number(pid), parent: Number(fields[1]),
        ticks: Number(fields[11]) + Number(fields[12]) }];
    } catch {
      return [];  // it has ended meanwhile
    }
  });
  const below = (pid) => all.filter(({ parent }) => parent === pid)
    .reduce((sum, one) => sum + one.ticks + below(one.pid), 0);
  return below(root) / 100;
}

const server = process.argv[2] ? null : new MockServer();
const address = process.argv[2] ?? `http://127.0.0.1:${await server.listen()}/`;
const browser = await chromium.launch({
  executablePath: process.env.LUX_CHROMIUM ?? '/usr/bin/chromium', args: flags });
const page = await browser.newPage({ viewport: { width: 1280, height: windowHeight } });
await page.goto(address);
await page.waitForFunction(() => window.luxodus?.page.live.shown?.surfaces?.groups.size > 0 &&
  window.luxodus.page.live.shown.air?.groups.size > 0, null, { timeout: 180_000 });
await page.evaluate((share) => {
  const { page: p } = window.luxodus;
  const first = p.live.scene.observers[0];
  if (first) p.walk.jump(first);
  if (!share) return;
  p.picture.learns = false;
  p.picture.shares = { moving: share, still: share };
}, raster);
const turn = (time) => page.evaluate(async (ms) => {
  const { page: p } = window.luxodus;
  const start = performance.now();
  let frames = 0;
  for (; performance.now() < start + ms; ++frames) {
    p.walk.look(0.005, 0);
    await new Promise((done) => requestAnimationFrame(done));
  }
  const { width, height, share } = p.picture;
  return { frames, seconds: (performance.now() - start) / 1000, width, height, share };
}, 1000 * time);
await turn(raster ? 2 : seconds.learn);
await page.evaluate(() => (window.luxodus.page.picture.learns = false));
const before = processorSeconds(process.pid);
const found = await turn(seconds.count);
const used = processorSeconds(process.pid) - before;
console.log(`${(found.frames / found.seconds).toFixed(1)} pictures a second of ${found.width} x ` +
  `${found.height} pixels (raster ${found.share.toFixed(2)}), ` +
  `${((1000 * used) / found.frames).toFixed(0)} ms of processors each`);
await browser.close();
server?.close();
