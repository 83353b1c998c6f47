// @ts-check
// Measures the built page in Chromium: first movement, frames a second and memory over minutes of training at full speed.
// usage: node measure.mjs [--minutes 10] [--hash '#task=…']     prints one line a sample, and the figures of docs/page.md at the end

import { parseArgs } from 'node:util';
import { SIZES, start } from './tests/page/browser.js';

const { values } = parseArgs({ options: { minutes: { type: 'string', default: '10' }, hash: { type: 'string', default: '#task=ball_pass_b1&set=training.evaluate_every=0;training.episodes=0;training.steps=1000000000' } } });
const site = await start();
try {
  const context = await site.browser.newContext({ viewport: SIZES.wide });
  const page = await context.newPage();
  await page.goto(site.url + values.hash);
  await page.waitForSelector('#automaton svg .node.current');
  // Once more, with the browser's cache of compiled code filled.
  const began = Date.now();
  await page.reload({ waitUntil: 'commit' });
  await page.waitForFunction(() => /^[1-9]\d*\//.test(document.getElementById('clock')?.textContent ?? ''), undefined, { polling: 'raf' });
  console.log(`first movement ${Date.now() - began} ms after opening`);
  await page.waitForSelector('#curves canvas', { state: 'attached' });
  const inspector = await context.newCDPSession(page);
  await inspector.send('Performance.enable');
  const count = (/** @type {string} */ id) => page.$eval(`#${id}`, (node) => Number((node.textContent ?? '').replace(/[^\d.]/g, '')));
  await page.click('#train');
  const until = Date.now() + Number(values.minutes) * 60_000;
  /** @type {{ frames: number, heap: number, module: number }[]} */
  const samples = [];
  while (Date.now() < until) {
    const frames = await page.evaluate(() => new Promise((resolve) => {
      const times = /** @type {number[]} */ ([]);
      const tick = (/** @type {number} */ now) => {
        times.push(now);
        if (now - times[0] < 10_000) requestAnimationFrame(tick);
        else resolve(((times.length - 1) * 1000) / (now - times[0]));
      };
      requestAnimationFrame(tick);
    }));
    await inspector.send('HeapProfiler.collectGarbage');
    const { metrics } = await inspector.send('Performance.getMetrics');
    const heap = (metrics.find(({ name }) => name === 'JSHeapUsedSize')?.value ?? 0) / 1e6;
    const module = await count('memory');
    samples.push({ frames: Number(frames), heap, module });
    console.log(`${await count("n-steps")} steps, ${(await count('rate')).toFixed(0)} steps/s, ${Number(frames).toFixed(1)} frames/s, page ${heap.toFixed(1)} MB, module ${module} MB`);
    if ((await page.textContent('#train')) === 'Train') await page.click('#train');
  }
  const mean = (/** @type {number[]} */ list) => list.reduce((sum, x) => sum + x, 0) / list.length;
  const [first, last] = [samples[Math.min(1, samples.length - 1)], samples[samples.length - 1]];
  console.log(`${samples.length} samples: ${mean(samples.map((s) => s.frames)).toFixed(1)} frames/s in the mean; page ${first.heap.toFixed(1)} → ${last.heap.toFixed(1)} MB; module ${first.module} → ${last.module} MB`);
} finally {
  await site.close();
}
