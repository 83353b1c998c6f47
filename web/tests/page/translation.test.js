// @ts-check
// Part 5: a formula is translated while it is typed; propositions are completed; an automaton is held against the formula.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { SIZES, inaccessible, start, visit } from './browser.js';

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`typing at ${SIZES[size].width} px: the automaton is drawn as a preview, class and size are said, Escape goes back, Use trains on it`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1' });
    const own = await page.getAttribute('#automaton svg', 'aria-label');
    await page.click('#formula');
    await page.fill('#formula', 'F (r1 & X F r2)');
    await page.waitForSelector('#automaton.preview svg');
    assert.notEqual(await page.getAttribute('#automaton svg', 'aria-label'), own);
    await page.waitForFunction(() => /guarantee/.test(document.getElementById('formula-facts')?.textContent ?? ''));
    assert.match((await page.textContent('#formula-facts')) ?? '', /\d+ states?.*1 accepting set/);
    assert.ok(await page.isVisible('#automaton-preview'));
    assert.deepEqual(await inaccessible(page, '#spec-panel, #automaton-panel'), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= SIZES[size].width);
    await page.focus('#formula');
    await page.keyboard.press('Escape');
    await page.waitForSelector('#automaton:not(.preview) svg .node.current');
    assert.equal(await page.getAttribute('#automaton svg', 'aria-label'), own);
    await page.fill('#formula', 'F (r1 & X F r2)');
    await page.waitForSelector('#automaton.preview svg');
    await page.click('#formula-apply');
    await page.waitForFunction(() => location.hash.includes('formula='));
    await page.waitForSelector('#automaton:not(.preview) svg .node.current');
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test('what nothing or everything satisfies is said before training, and what the environment does not have', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1' });
  const says = async (/** @type {string} */ formula, /** @type {string} */ words) => {
    await page.fill('#formula', formula);
    await page.waitForFunction((wanted) => new RegExp(wanted).test(document.getElementById('formula-facts')?.textContent ?? ''), words);
  };
  await page.focus('#formula');
  await says('G r1 & F !r1', 'nothing can satisfy');
  await says('G r1 | F !r1', 'everything satisfies');
  await says('G F r9', 'no proposition `r9`');
  // The regions do not overlap.
  await says('F (r1 & r2)', 'no path in this environment satisfies');
  await page.fill('#formula', 'G F (r1 &');
  await page.waitForSelector('#formula[aria-invalid=true]');
  await page.waitForFunction(() => document.getElementById('formula-facts')?.textContent === '');
  assert.deepEqual(problems, []);
  await context.close();
});

test('a preview that is ready before the automaton of the open task waits for it', async () => {
  // No service worker: it would answer in place of the route.
  const context = await site.browser.newContext({ viewport: SIZES.wide, serviceWorkers: 'block' });
  const page = await context.newPage();
  let release = () => {};
  const held = new Promise((resolve) => (release = () => resolve(undefined)));
  await page.route('**/drawings/*', (route) => held.then(() => route.continue()));
  // The formula is refused, so the task's own stands, and what the field holds is previewed.
  await page.goto(`${site.url}#task=cart_pole_c1&formula=G+F+nowhere`);
  await page.waitForFunction(() => /no proposition/.test(document.getElementById('formula-facts')?.textContent ?? ''));
  release();
  await page.waitForSelector('#automaton.preview svg .node');
  await page.focus('#formula');
  await page.keyboard.press('Escape');
  await page.waitForSelector('#automaton:not(.preview) svg .node.current');
  await context.close();
});

test('propositions are completed from a list with their meaning, by keys, and put in by a click', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=cart_pole_c1' });
  await page.fill('#formula', '');
  await page.focus('#formula');
  await page.keyboard.type('G F gr');
  await page.waitForSelector('#completions li');
  assert.equal(await page.getAttribute('#formula', 'aria-expanded'), 'true');
  assert.match((await page.textContent('#completions li')) ?? '', /^green.+/);
  await page.keyboard.press('ArrowDown');
  assert.equal(await page.getAttribute('#formula', 'aria-activedescendant'), 'completion-0');
  assert.deepEqual(await inaccessible(page, '.formula-field'), []);
  await page.keyboard.press('Enter');
  assert.equal(await page.inputValue('#formula'), 'G F green');
  assert.ok(await page.isHidden('#completions'));
  await page.keyboard.type(' & G !');
  await page.keyboard.press('Control+Space');
  await page.waitForSelector('#completions li');
  await page.keyboard.press('Escape');
  assert.ok(await page.isHidden('#completions'), 'Escape closes the list and leaves the formula');
  assert.equal(await page.inputValue('#formula'), 'G F green & G !');
  await page.click('#propositions button:has-text("unsafe")');
  assert.equal(await page.inputValue('#formula'), 'G F green & G !unsafe');
  assert.deepEqual(problems, []);
  await context.close();
});

test('an automaton that is pasted is equal to the formula, or a word shows where they differ', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1' });
  await page.click('#hoa-panel summary');
  const own = await page.inputValue('#hoa');
  await page.fill('#hoa', `${own}\n`);
  await page.waitForFunction(() => /Equal to the formula on all [\d,]+ words/.test(document.getElementById('hoa-compared')?.textContent ?? ''));
  await page.fill('#hoa', 'HOA: v1 States: 2 Start: 0 AP: 1 "r1" acc-name: Buchi Acceptance: 1 Inf(0) --BODY-- State: 0 [!0] 0 [0] 1 State: 1 [t] 1 {0} --END--');
  await page.waitForFunction(() => /Different from the formula.*accepts it, the formula is false/.test(document.getElementById('hoa-compared')?.textContent ?? ''));
  assert.ok(await page.locator('#hoa-compared .letter').count() >= 1);
  assert.equal(await page.locator('#hoa-compared .cycle').count(), 1);
  assert.deepEqual(problems, []);
  await context.close();
});
