// @ts-check
// Training in the page against native training of the same recipe, in steps a second, one after the other for each task.
// usage: LTL_ROVER=path/to/ltl-rover node compare_training.mjs [--seconds 20] [--tasks ball_pass_b1,cart_pole_c1,melas,victoria]

import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { SIZES, number, start } from './tests/page/browser.js';

const { values } = parseArgs({
  options: {
    seconds: { type: 'string', default: '20' },
    tasks: { type: 'string', default: 'ball_pass_b1,cart_pole_c1,melas,victoria' },
  },
});
const program = process.env.LTL_ROVER;
if (!program) throw new Error('LTL_ROVER must name the command line program');
const seconds = Number(values.seconds);
/** What is compared is training alone, and as long as is asked for. */
const alone = ['training.evaluate_every=0', 'training.episodes=0', 'training.stop=budget'];

/** Steps a second of the page between two looks. @param {import('playwright-core').Browser} browser @param {string} url @param {string} task */
async function inThePage(browser, url, task) {
  const context = await browser.newContext({ viewport: SIZES.wide });
  const page = await context.newPage();
  await page.goto(`${url}#task=${task}&set=${[...alone, 'training.steps=1000000000'].join(';')}`);
  await page.waitForSelector('#automaton svg .node.current');
  await page.click('#train');
  // Past the warm-up, in which nothing is updated.
  while ((await number(page, 'n-steps')) <= 3000) await page.waitForTimeout(100);
  const [from, began] = [await number(page, 'n-steps'), performance.now()];
  await page.waitForTimeout(1000 * seconds);
  const rate = (1000 * ((await number(page, 'n-steps')) - from)) / (performance.now() - began);
  await context.close();
  return rate;
}

/** Seconds of a native training of so many steps. @param {string} task @param {number} steps */
function natively(task, steps) {
  const folder = mkdtempSync(join(tmpdir(), 'ltl-rover-'));
  const set = alone.flatMap((value) => ['--set', value]);
  const began = performance.now();
  const spec = join(import.meta.dirname, '../specs', `${task}.toml`);
  const made = spawnSync(String(program), ['train', spec, '--steps', String(steps), '--log-every', '1000000000', '--quiet', '--out', join(folder, 'run'), ...set], { encoding: 'utf8' });
  const took = (performance.now() - began) / 1000;
  rmSync(folder, { recursive: true, force: true });
  if (made.status !== 0) throw new Error(made.stderr);
  return took;
}

const site = await start();
try {
  for (const task of values.tasks.split(',')) {
    const page = await inThePage(site.browser, site.url, task);
    // Two lengths, whose difference has no warm-up and no opening and closing in it.
    const count = Math.ceil(page * seconds);
    const native = count / (natively(task, 4000 + count) - natively(task, 4000));
    console.log(`${task.padEnd(16)} page ${page.toFixed(0).padStart(6)} steps/s   native ${native.toFixed(0).padStart(6)} steps/s   native over page ${(native / page).toFixed(2)}`);
  }
} finally {
  await site.close();
}
