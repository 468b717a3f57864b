// Measures how many pictures a second the page draws while the view turns around, and at what
// resolution: `node frame_rate.mjs [ADDRESS]`; without an address, in the room of mock_server.mjs.
// LUX_GPU holds the browser's flags for a graphics card, else it draws in software (SwiftShader);
// on one of NVIDIA's: LUX_GPU='--use-angle=vulkan --enable-features=Vulkan
// --disable-vulkan-surface', and --disable-frame-rate-limit for more than 60 pictures a second.
// LUX_RASTER=0.5 fixes the share of the screen's resolution, which the page otherwise chooses.
// LUX_HEIGHT is that of the window, 1280 wide [px]. LUX_ROUNDS=5 measures that many rounds of
// LUX_SECONDS each, and prints their minimum and median. LUX_CLEAR=1 draws no smoke. The processor
// time of a picture is that of the whole browser: it hardly depends on the machine's load.
import { readdirSync, readFileSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { MockServer } from './mock_server.mjs';

/** The resolution is chosen first, and then kept. */
const seconds = { learn: 12, count: Number(process.env.LUX_SECONDS ?? 8) };
const rounds = Number(process.env.LUX_ROUNDS ?? 1);
const software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const flags = ['--headless=new', '--no-sandbox', ...(process.env.LUX_GPU?.split(' ') ?? software)];

const raster = Number(process.env.LUX_RASTER ?? 0);
const windowHeight = Number(process.env.LUX_HEIGHT ?? 800);

/** Processor seconds of a process and all its descendants (Linux). */
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
const renderer = await page.evaluate(() => {
  const gl = document.createElement('canvas').getContext('webgl2');
  const named = gl?.getExtension('WEBGL_debug_renderer_info');
  return named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : null;
});
if (!renderer) {
  console.error(`No WebGL 2 with the browser's flags ${flags.join(' ')}; try others in LUX_GPU.`);
  process.exit(1);
}
console.log(`Drawn by ${renderer}.`);
await page.goto(address);
await page.waitForFunction(() => window.luxodus?.page.live.shown?.surfaces?.groups.size > 0 &&
  window.luxodus.page.live.shown.air?.groups.size > 0, null, { timeout: 180_000 });
await page.evaluate(([share, clear]) => {
  const { page: p } = window.luxodus;
  if (clear) p.picture.smoke.present = false;
  const first = p.live.scene.observers[0];
  if (first) p.walk.jump(first);
  if (!share) return;
  p.picture.learns = false;
  p.picture.shares = { moving: share, still: share };
}, [raster, Boolean(process.env.LUX_CLEAR)]);
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
const each_ms = [];
let fastest = 0;
let found;
for (let round = 0; round < rounds; ++round) {
  const before = processorSeconds(process.pid);
  found = await turn(seconds.count);
  each_ms.push((1000 * (processorSeconds(process.pid) - before)) / found.frames);
  fastest = Math.max(fastest, found.frames / found.seconds);
}
each_ms.sort((a, b) => a - b);
const median = (each_ms[(rounds - 1) >> 1] + each_ms[rounds >> 1]) / 2;
const [ms, median_ms] = [each_ms[0], median].map((x) => x.toFixed(0));
const [best, in_rounds] = rounds === 1 ? ['', ''] :
  [' in the best round', ` at least, ${median_ms} ms in the median of ${rounds} rounds`];
console.log(`${fastest.toFixed(1)} pictures a second${best} of ${found.width} x ${found.height} ` +
  `pixels (raster ${found.share.toFixed(2)}), ${ms} ms of processors each${in_rounds}`);
await browser.close();
server?.close();
