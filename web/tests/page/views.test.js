// @ts-check
// Part 2: the views that are linked by one clock, and what is drawn over the ground.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { SIZES, inaccessible, start, visit } from './browser.js';

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

/** @param {import('playwright-core').Page} page */
const picture = (page) => page.$eval('#stage', (canvas) => /** @type {HTMLCanvasElement} */ (canvas).toDataURL());
/** @param {import('playwright-core').Page} page */
const rested = async (page) => {
  await page.click('#play');
  await page.waitForSelector('#play.paused');
};

/** What a click changed is on the screen from the next frame on. @param {import('playwright-core').Page} page */
const painted = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`at ${SIZES[size].width} px one clock moves all: chips, automaton, reward, timeline agree at each event`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1' });
    await rested(page);
    // To the first visit that pays: the set is no longer in the frontier, or the round is closed and it was refilled.
    for (let k = 0; k < 12; k++) {
      await page.click('#following');
      await painted(page);
      if (/this pays/.test((await page.textContent('#r-words')) ?? '')) break;
    }
    assert.match((await page.textContent('#r-words')) ?? '', /this pays/);
    const fresh = await page.$$eval('#frontier .chip.fresh', (chips) => chips.map((chip) => chip.textContent));
    assert.equal(fresh.length > 0, true);
    assert.match((await page.textContent('#r-words')) ?? '', new RegExp(String(fresh[0])));
    assert.notEqual(await page.textContent('#r-accepting'), '0');
    const [from, to] = /^(q\S+) → (q\S+) on/.exec((await page.textContent('#automaton-now')) ?? '')?.slice(1) ?? [];
    assert.ok(from && to);
    assert.equal((await page.textContent('#automaton .node.current text')) ?? '', to);
    assert.equal(await page.locator('#automaton .edge.last').count(), 1);
    assert.deepEqual(problems, []);
    await context.close();
  });

  test(`at ${SIZES[size].width} px the value map is drawn for a chosen state and frontier, and taken away`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1&watch=policy' });
    await rested(page);
    await page.evaluate(() => document.fonts.ready.then(() => undefined));
    const plain = await picture(page);
    await page.click('#layers label:has(input[value=value])');
    await page.waitForFunction(() => /^V from/.test(document.getElementById('value-said')?.textContent ?? ''));
    await page.waitForFunction(() => location.hash.includes('value'));
    const mapped = await picture(page);
    assert.notEqual(mapped, plain);
    // Another frontier is another picture.
    const said = await page.textContent('#value-said');
    await page.click('#value-sets label >> nth=0');
    await page.waitForFunction((before) => document.getElementById('value-said')?.textContent !== before, said);
    assert.equal(await page.isChecked('#value-follow'), false);
    await page.selectOption('#value-state', '1');
    await page.waitForFunction(() => /module in r1/.test(document.getElementById('value-said')?.textContent ?? ''));
    assert.deepEqual(await inaccessible(page, '#stage-panel'), []);
    await page.click('#layers label:has(input[value=value])');
    await page.waitForSelector('#value-panel', { state: 'hidden' });
    const last = await picture(page);
    assert.notEqual(last, mapped);
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test('the rover’s map: labels, unsafe ground and earlier runs are switched one by one', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=melas&watch=policy&layers=' });
  await page.waitForFunction(() => performance.getEntriesByType('resource').some((entry) => entry.name.endsWith('melas.webp') && /** @type {any} */ (entry).responseEnd > 0));
  await rested(page);
  let before = await picture(page);
  for (const layer of ['labels', 'unsafe']) {
    await page.click(`#layers label:has(input[value=${layer}])`);
    await page.waitForFunction((old) => /** @type {HTMLCanvasElement} */ (document.getElementById('stage')).toDataURL() !== old, before);
    before = await picture(page);
  }
  assert.match(await page.evaluate(() => decodeURIComponent(location.hash)), /layers=labels,unsafe/);
  assert.deepEqual(problems, []);
  await context.close();
});

test('cart and pole: the values are a slice over position and angle', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=cart_pole_c1&watch=policy&layers=labels,unsafe,value' });
  await page.waitForFunction(() => /^V from/.test(document.getElementById('value-said')?.textContent ?? ''));
  await rested(page);
  const before = await picture(page);
  await page.click('#layers label:has(input[value=value])');
  await page.waitForFunction((old) => /** @type {HTMLCanvasElement} */ (document.getElementById('stage')).toDataURL() !== old, before);
  assert.deepEqual(problems, []);
  await context.close();
});

test('curves with success and the losses of each module; the modules’ visits and replays fill', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1' });
  await page.click('#train');
  await page.waitForFunction(() => document.querySelectorAll('#curves .curve canvas').length === 5);
  await page.waitForFunction(() => /[1-9]/.test(document.querySelector('#modules td:nth-child(2)')?.textContent ?? ''));
  await page.waitForFunction(() => /[1-9]\d* %/.test(document.querySelector('#modules td:nth-child(3)')?.textContent ?? ''), undefined, { timeout: 120_000 });
  assert.deepEqual(await page.$$eval('#curves .name', (all) => all.map((one) => one.textContent)), ['Average reward', 'Total reward', 'Rounds', 'Success', 'Critic loss']);
  await page.click('#train');
  assert.deepEqual(problems, []);
  await context.close();
});
