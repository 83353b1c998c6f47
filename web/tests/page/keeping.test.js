// @ts-check
// Keep and share: nothing is lost by a reload, everything that goes out comes in again, the page works with the server gone.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { SIZES, kept, number, start, untilKept, visit } from './browser.js';
import { file } from './files.js';

/** @typedef {import('playwright-core').Page} Page */
/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

/** Small networks that learn early: what is tested here does not depend on how well they learn. */
const LIGHT = 'set=learner.hidden=[8,8];learner.exploration.warm_up=50;training.evaluate_every=0';

/** Plays one episode of training to its end. @param {Page} page */
async function episode(page) {
  const before = await number(page, 'n-steps');
  await page.click('#episode');
  await page.waitForFunction((old) => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > old, before);
}

/** @param {Page} page */
async function checkpoint(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  return readFile(await download.path());
}

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`after a reload at ${SIZES[size].width} px the run is offered and goes on bit for bit`, async () => {
    const hash = `#seed=5&speed=4&${LIGHT}`;
    const [whole, halved] = [await visit(site, { hash, size }), await visit(site, { hash, size })];
    for (let k = 0; k < 3; k++) await episode(whole.page);
    const { page } = halved;
    for (let k = 0; k < 2; k++) await episode(page);
    const steps = await number(page, 'n-steps');
    await untilKept(page, (k) => k === steps);
    await page.goto(site.url); // without its link
    await page.reload();
    await page.waitForSelector('#offer');
    assert.match((await page.textContent('#offer')) ?? '', new RegExp(`^Continue where you were: ${steps.toLocaleString('en')} steps of “Ball-Pass`));
    await page.click('#offer button.primary');
    await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('exactly where it was'));
    await page.waitForFunction((wanted) => document.getElementById('n-steps')?.textContent?.replaceAll(',', '') === String(wanted), steps);
    await page.waitForFunction(() => /** @type {HTMLInputElement} */ (document.getElementById('seed')).value === '5' && /** @type {HTMLSelectElement} */ (document.getElementById('speed')).value === '4');
    assert.match(decodeURIComponent(page.url()), /learner.hidden=\[8, ?8\]/);
    await episode(page);
    assert.equal(await number(page, 'n-steps'), await number(whole.page, 'n-steps'));
    assert.ok((await checkpoint(page)).equals(await checkpoint(whole.page)), 'the two checkpoints are the same bytes');
    assert.deepEqual([...whole.problems, ...halved.problems], []);
    await Promise.all([whole.context.close(), halved.context.close()]);
  });
}

test('a run is kept while it trains, and at once when the page is hidden', async () => {
  const { page, context, problems } = await visit(site, { hash: `#${LIGHT};training.steps=10000000` });
  await page.click('#train');
  const first = await untilKept(page, (steps) => steps > 0);
  assert.equal(await page.textContent('#train'), 'Pause', 'training goes on meanwhile');
  await page.waitForFunction((old) => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > old + 50, first);
  await page.evaluate(() => {
    Object.defineProperty(document, 'visibilityState', { value: 'hidden', configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  });
  const began = Date.now();
  await untilKept(page, (steps) => steps > first);
  console.log(`# kept ${Date.now() - began} ms after the page was hidden`);
  assert.deepEqual(problems, []);
  await context.close();
});

test('a training that ends by itself is kept as it ended', async () => {
  const { page, context, problems } = await visit(site, { hash: `#${LIGHT};training.steps=2000` });
  await page.click('#train');
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('used up the budget'));
  const steps = await number(page, 'n-steps');
  assert.ok(steps >= 2000);
  await untilKept(page, (k) => k === steps);
  assert.deepEqual(problems, []);
  await context.close();
});

test('kept runs are listed, continued, forgotten one by one, and everything at once', async () => {
  const { page, context, problems } = await visit(site, { hash: `#${LIGHT}` });
  await episode(page);
  await untilKept(page, (steps) => steps > 0);
  await page.selectOption('#task', 'cart_pole_c1');
  await page.waitForFunction(() => location.hash.includes('cart_pole_c1'));
  await episode(page);
  for (const end = Date.now() + 60_000; (await kept(page)).length < 2;) assert.ok(Date.now() < end);
  await page.click('#kept-here summary');
  await page.waitForFunction(() => document.querySelectorAll('#kept-here-runs li').length === 2);
  assert.match((await page.textContent('#kept-here-note')) ?? '', /2 runs \(.*\) and 0 maps are kept in this browser, nowhere else/);
  await page.click('#kept-here-runs li:last-child button:text-is("Continue")');
  await page.waitForFunction(() => !location.hash.includes('cart_pole_c1'));
  assert.equal(await page.inputValue('#task'), 'ball_pass_b1');
  await page.click('#kept-here-runs li:first-child button:text-is("Forget")');
  await page.waitForFunction(() => document.querySelectorAll('#kept-here-runs li').length === 1);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.click('#forget');
  await page.click('#forget-sure button[value=no]');
  assert.equal((await kept(page)).length, 1);
  await page.click('#forget');
  await page.click('#forget-sure button[value=forget]');
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('is forgotten'));
  assert.deepEqual(await kept(page), []);
  assert.deepEqual(await page.evaluate(() => caches.keys()), []);
  assert.deepEqual(problems, []);
  await context.close();
});

test('what goes out comes in again: checkpoint, automaton, description, formula, by their content', async () => {
  const { page, context, problems } = await visit(site, { hash: `#seed=3&${LIGHT}` });
  await episode(page);
  const steps = await number(page, 'n-steps');
  const saved = await checkpoint(page);
  const out = async (/** @type {string} */ id) => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(`#${id}`)]);
    return readFile(await download.path());
  };
  const description = await out('export-json');
  await page.click('#hoa-panel summary');
  const hoa = await out('hoa-save');
  await page.selectOption('#task', 'cart_pole_c1');
  await page.waitForFunction(() => location.hash.includes('cart_pole_c1'));
  await page.setInputFiles('#load', file('anything', description));
  await page.waitForFunction(() => /seed=3/.test(location.hash) && decodeURIComponent(location.hash).includes('learner.hidden'));
  assert.equal(await page.inputValue('#task'), 'ball_pass_b1');
  assert.equal(await number(page, 'n-steps'), 0, 'a description begins anew');
  await page.setInputFiles('#load', file('anything', saved));
  await page.waitForFunction((wanted) => document.getElementById('n-steps')?.textContent?.replaceAll(',', '') === String(wanted), steps);
  await page.setInputFiles('#load', file('anything', `/* mine */ ${hoa}`));
  await page.waitForFunction(() => /** @type {HTMLTextAreaElement} */ (document.getElementById('hoa')).value.startsWith('/* mine */'));
  await page.setInputFiles('#load', file('anything', 'F (r1 & X F r2)\n'));
  await page.waitForFunction(() => /** @type {HTMLInputElement} */ (document.getElementById('formula')).value === 'F (r1 & X F r2)');
  assert.deepEqual(problems, []);
  await context.close();
});

test('no room is said plainly, and training goes on', async () => {
  const { page, context, problems } = await visit(site, { hash: `#${LIGHT}` });
  await page.evaluate(() => {
    IDBObjectStore.prototype.put = () => {
      throw new DOMException('full', 'QuotaExceededError');
    };
  });
  await episode(page);
  await page.waitForFunction(() => /could not be kept on this machine: there is no room left/.test(document.getElementById('notices')?.textContent ?? ''));
  await episode(page);
  assert.deepEqual(problems, []);
  await context.close();
});

test('a browser that keeps nothing is told of, and loses nothing else', async () => {
  const context = await site.browser.newContext({ viewport: SIZES.wide });
  await context.addInitScript(() => Object.defineProperty(globalThis, 'indexedDB', { value: undefined }));
  const page = await context.newPage();
  await page.goto(`${site.url}#${LIGHT}`);
  await page.waitForSelector('#automaton svg .node.current');
  await episode(page);
  await page.click('#kept-here summary');
  await page.waitForFunction(() => /keeps nothing between visits/.test(document.getElementById('kept-here-note')?.textContent ?? ''));
  await page.waitForSelector('#kept-here-runs li');
  await context.close();
});

test('with the server gone the page is opened again, trains and paints maps', async () => {
  const other = await start();
  try {
    const { page, problems } = await visit(other, { hash: '#task=own_map' });
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
    await other.stop();
    await page.reload();
    await page.waitForSelector('#automaton svg .node.current');
    await page.waitForSelector('#curves canvas', { state: 'attached' });
    await page.click('#paint-map');
    await page.waitForSelector('#painter[open] .brush');
    await page.keyboard.press('Escape');
    await page.click('#train');
    await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 50);
    assert.deepEqual(problems.filter((p) => !p.includes('ERR_CONNECTION')), []);
  } finally {
    await other.close();
  }
});
