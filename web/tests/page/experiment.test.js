// @ts-check
// Part 4: variants side by side with the same seeds in parallel workers, bands, an evaluation that fills, the table of finished runs.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { SIZES, inaccessible, start, visit } from './browser.js';

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

test('three variants and two seeds are trained, evaluated and listed; the table is saved as CSV', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1&seed=3' });
  await page.selectOption('#experiment-steps', '5000');
  await page.click('#experiment-run');
  await page.waitForFunction(() => document.querySelectorAll('#variants .small-stage').length === 3);
  await page.waitForFunction(() => document.querySelectorAll('#experiment-curves canvas').length === 3);
  assert.equal(await page.textContent('#experiment-run'), 'Stop');
  // An evaluation is seen filling, before it is whole or at its end.
  await page.waitForFunction(() => /\d+ of \d+ succeed|seeds:/.test(document.getElementById('variants')?.textContent ?? ''), undefined, { timeout: 240_000, polling: 200 });
  await page.waitForFunction(() => document.querySelectorAll('#results tbody tr').length === 6, undefined, { timeout: 400_000, polling: 500 });
  await page.waitForFunction(() => document.getElementById('experiment-run')?.textContent === 'Run side by side');
  const table = (await page.textContent('#results')) ?? '';
  for (const name of ['EP-MDP', 'Standard product', 'Standard DDPG']) assert.ok(table.includes(name), name);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#results-csv')]);
  const lines = (await readFile(await download.path(), 'utf8')).trim().split('\n');
  assert.match(lines[0], /^task,formula,preset,changes,variant,seed,steps,best,/);
  assert.equal(lines.length, 7);
  // Every variant was trained for the same number of steps, with the same two seeds.
  // What is judged is the best of its evaluations, one every thousand steps.
  for (const line of lines.slice(1)) assert.match(line, /,(3|4),5000,[1-5]000,/);
  const saids = await page.$$eval('.variant .verdict', (all) => all.map((one) => one.textContent));
  assert.ok(saids.every((said) => /^2 seeds: /.test(said ?? '')), String(saids));
  assert.deepEqual(problems, []);
  await context.close();
});

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`an experiment at ${SIZES[size].width} px is stopped, and nothing overflows`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1' });
    await page.click('#experiment-variants label:has(input[value=standard_ddpg])');
    await page.selectOption('#experiment-seeds', '1');
    await page.selectOption('#experiment-steps', '300000');
    await page.click('#experiment-run');
    await page.waitForFunction(() => /[1-9][\d,]* of 300,000 steps/.test(document.getElementById('variants')?.textContent ?? ''));
    assert.equal(await page.locator('.variant').count(), 2);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= SIZES[size].width);
    assert.deepEqual(await inaccessible(page, '#compare-panel'), []);
    await page.click('#experiment-run');
    await page.waitForFunction(() => document.getElementById('variants')?.textContent?.includes('stopped'));
    assert.equal(await page.textContent('#experiment-run'), 'Run side by side');
    assert.deepEqual(problems, []);
    await context.close();
  });
}
