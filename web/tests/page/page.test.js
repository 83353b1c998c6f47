// @ts-check
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { SIZES, firstNumber, inaccessible, number, start, visit } from './browser.js';

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  for (const colours of /** @type {const} */ (['light', 'dark'])) {
    test(`the page stands at ${SIZES[size].width} px in ${colours}: nothing overflows, nothing fails, axe finds nothing`, async () => {
      const { page, context, problems } = await visit(site, { size, colours });
      await page.click('#hoa-panel summary');
      await page.waitForSelector('#curves canvas', { state: 'attached' });
      const width = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= SIZES[size].width, `the page is ${width} px wide`);
      assert.deepEqual(await inaccessible(page), []);
      await page.click('#help-open');
      assert.deepEqual(await inaccessible(page, '#help'), []);
      await page.keyboard.press('Escape');
      // The pointer rests on the button that it has pressed.
      await page.click('#train');
      await page.waitForSelector('#train[aria-pressed=true]:hover', { state: 'attached' });
      assert.deepEqual(await inaccessible(page, '#train'), []);
      assert.deepEqual(problems, []);
      await context.close();
    });
  }
}

test('a wrong formula is shown at its place while typing, and a right one with all its parentheses', async () => {
  const { page, context, problems } = await visit(site);
  await page.fill('#formula', 'G F r1 & & r2');
  await page.waitForSelector('#formula[aria-invalid=true]');
  assert.match((await page.textContent('#formula-said')) ?? '', /^column 10: /);
  const mark = await page.$eval('#formula-mirror mark', (m) => m.previousSibling?.textContent?.length);
  assert.equal(mark, 9);
  const [place, field] = await Promise.all([page.locator('#formula-mirror mark').boundingBox(), page.locator('#formula').boundingBox()]);
  assert.ok(place && field && place.x > field.x && place.x < field.x + 200 && place.y >= field.y && place.y < field.y + field.height, 'the mark lies under the text of the field');
  assert.equal(await page.isDisabled('#formula-apply'), true);
  await page.fill('#formula', '□ ◇r1 → r2 U x');
  await page.waitForSelector('#formula:not([aria-invalid])');
  assert.match((await page.textContent('#formula-said')) ?? '', /^read as \(□\(◇r1\)\) → \(r2 U x\)$/);
  assert.match((await page.textContent('#formula-words')) ?? '', /no proposition `x`/);
  assert.deepEqual(problems, []);
  await context.close();
});

test('an automaton file is read, refused at its place, dropped and used', async () => {
  const { page, context, problems } = await visit(site);
  await page.click('#hoa-panel summary');
  const own = await page.inputValue('#hoa');
  assert.match(own, /^HOA: v1/);
  await page.fill('#hoa', own.replace('--BODY--', '--BUDDY--'));
  await page.waitForSelector('#hoa[aria-invalid=true]');
  assert.match((await page.textContent('#hoa-said')) ?? '', /^line \d+, column \d+: /);
  const dropped = own.replace(/\n--BODY--/, '\n/* the same, dropped */\n--BODY--');
  const file = await page.evaluateHandle((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], 'dropped.hoa'));
    return data;
  }, dropped);
  await page.dispatchEvent('#hoa-panel', 'drop', { dataTransfer: file });
  await page.waitForSelector('#hoa:not([aria-invalid])');
  assert.match((await page.textContent('#hoa-said')) ?? '', /\d+ states, 2 accepting sets, propositions r1, r2/);
  await page.click('#hoa-apply');
  await page.waitForFunction(() => location.hash.includes('hoa='));
  assert.match(await page.inputValue('#hoa'), /the same, dropped/);
  assert.deepEqual(problems, []);
  await context.close();
});

test('a formula of one’s own becomes an automaton and is trained on', async () => {
  const { page, context, problems } = await visit(site);
  const before = await page.getAttribute('#automaton svg', 'aria-label');
  await page.fill('#formula', 'F (r2 & X F r1)');
  await page.waitForSelector('#formula-apply:not([disabled])');
  await page.press('#formula', 'Enter');
  await page.waitForFunction(() => location.hash.includes('formula='));
  await page.waitForFunction((old) => document.querySelector('#automaton svg')?.getAttribute('aria-label') !== old, before);
  assert.match(await page.inputValue('#hoa'), /^HOA: v1/);
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-episodes')?.textContent?.replaceAll(',', '')) > 2);
  await page.fill('#formula', 'G F r1 & G F nowhere');
  await page.press('#formula', 'Enter');
  await page.waitForSelector('#formula[aria-invalid=true]');
  assert.match((await page.textContent('#formula-said')) ?? '', /nowhere/);
  assert.deepEqual(problems, []);
  await context.close();
});

test('a hyper-parameter is changed, undone, and refused with a reason', async () => {
  const { page, context, problems } = await visit(site);
  await page.fill('input[aria-label="learner.n_step"]', '3');
  await page.press('input[aria-label="learner.n_step"]', 'Enter');
  await page.waitForFunction(() => decodeURIComponent(location.hash).includes('learner.n_step=3'));
  assert.equal(await page.inputValue('input[aria-label="learner.n_step"]'), '3');
  await page.fill('input[aria-label="learner.tau"]', '7');
  await page.press('input[aria-label="learner.tau"]', 'Enter');
  await page.waitForSelector('.notice.problem');
  assert.match((await page.textContent('.notice.problem')) ?? '', /tau/);
  await page.click('#settings-own');
  await page.waitForFunction(() => !location.hash.includes('n_step'));
  assert.deepEqual(problems, []);
  await context.close();
});

test('φ_B1 is learned in the page: at least one round in greedy episodes, within the steps that are enough natively', async () => {
  const { page, context, problems } = await visit(site, { hash: '#seed=1' });
  const began = Date.now();
  await page.click('#train');
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('Press Train to go on'), undefined, { timeout: 600_000 });
  const notice = await page.textContent('#notices');
  const seconds = (Date.now() - began) / 1000;
  const steps = firstNumber(notice);
  console.log(`# learned after ${steps} steps in ${seconds.toFixed(1)} s in the page`);
  assert.match(notice ?? '', /Learned/);
  assert.ok(steps <= 60_000, `${steps} steps`);
  assert.equal(await page.textContent('#train'), 'Train');
  await page.click('#evaluate');
  await page.waitForFunction(() => document.querySelector('#evaluation .facts')?.textContent?.includes('200 of 200'), undefined, { timeout: 120_000 });
  const verdict = await page.textContent('#evaluation .verdict');
  console.log(`# ${verdict}`);
  assert.ok(firstNumber(verdict) >= 195, `${verdict}`);
  // The replay that is running now is of the learned policy: it closes a round.
  await page.click('label:has(input[value=policy])');
  await page.waitForFunction(() => {
    const words = document.getElementById('r-words')?.textContent ?? '';
    return words.includes('a round is closed');
  }, undefined, { timeout: 60_000, polling: 'raf' });
  assert.deepEqual(problems, []);
  await context.close();
});

test('training stands still at the recipe’s end, and the best policy of its evaluations can be watched, evaluated and kept', async () => {
  const { page, context, problems } = await visit(site, { hash: '#seed=2&set=learner.hidden=[8,8];learner.exploration.warm_up=50;training.steps=400;training.evaluate_every=150;training.evaluation_runs=5' });
  assert.ok(await page.isHidden('label:has(input[value=best])'), 'no policy has been evaluated yet');
  await page.click('#train');
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('Press Train to go on'));
  const notice = (await page.textContent('#notices')) ?? '';
  assert.match(notice, /Its best policy, after (150|300) steps, satisfied the task in \d of \d runs: watch it under Best/);
  const step = firstNumber(/after (150|300)/.exec(notice)?.[0] ?? '');
  assert.equal(await number(page, 'n-steps'), 400, 'not a step further');
  await page.keyboard.press('b');
  await page.waitForFunction((wanted) => document.getElementById('stage-note')?.textContent === `The best policy so far, after ${wanted} steps`, step);
  assert.ok(await page.isChecked('input[value=best]'));
  assert.match(await page.evaluate(() => location.hash), /watch=best/);
  await page.click('#keep');
  await page.waitForSelector('#kept li');
  assert.match((await page.textContent('#kept')) ?? '', new RegExp(`Best policy after ${step} steps`));
  await page.click('#evaluate');
  await page.waitForFunction(() => document.querySelector('#evaluation .facts')?.textContent?.includes('200 of 200'));
  // Opened again, what has come to its end goes on at once. Another policy may be the best then; the choice stays.
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  await page.setInputFiles('#load', await download.path());
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('is open'));
  await page.keyboard.press('b');
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 700);
  await page.click('#train');
  assert.ok(await page.isChecked('input[value=best]'));
  await page.reload();
  await page.waitForSelector('#automaton svg .node.current');
  assert.ok(await page.isChecked('input[value=policy]'), 'without a best policy the present one is shown');
  assert.deepEqual(problems, []);
  await context.close();
});

test('step, episode, pause, reset and seeds', async () => {
  const { page, context, problems } = await visit(site);
  await page.click('#step');
  await page.click('#step');
  await page.waitForFunction(() => document.getElementById('n-steps')?.textContent === '2');
  assert.ok(await page.isChecked('input[value=training]'), 'a single step shows training');
  await page.click('#episode');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent) > 2);
  const after = await number(page, 'n-steps');
  await page.keyboard.press('r');
  await page.waitForFunction(() => document.getElementById('n-steps')?.textContent === '0');
  await page.click('#step');
  await page.click('#step');
  await page.click('#episode');
  await page.waitForFunction((wanted) => document.getElementById('n-steps')?.textContent === String(wanted), after);
  await page.fill('#seed', '42');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => location.hash.includes('seed=42'));
  await page.click('#new-seed');
  await page.waitForFunction(() => !location.hash.includes('seed=42'));
  assert.deepEqual(problems, []);
  await context.close();
});

test('a checkpoint is saved, loaded and goes on where it was', async () => {
  const { page, context, problems } = await visit(site, { hash: '#seed=9' });
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 300);
  await page.click('#train');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  // What is saved comes after the pause, and after every frame before it.
  const [steps, episodes] = [await number(page, 'n-steps'), await number(page, 'n-episodes')];
  assert.equal(download.suggestedFilename(), 'ball_pass_b1-seed9.safetensors');
  const path = await download.path();
  await page.selectOption('#task', 'cart_pole_c1');
  await page.waitForFunction(() => location.hash.includes('cart_pole_c1'));
  await page.setInputFiles('#load', path);
  await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('is open'));
  assert.deepEqual([await number(page, 'n-steps'), await number(page, 'n-episodes')], [steps, episodes]);
  assert.equal(await page.inputValue('#seed'), '9');
  assert.equal(await page.inputValue('#task'), 'ball_pass_b1');
  await page.setInputFiles('#load', { name: 'wrong.safetensors', mimeType: 'application/octet-stream', buffer: Buffer.from('nothing\nof the kind') });
  await page.waitForSelector('.notice.problem');
  assert.equal(await number(page, 'n-steps'), steps, 'a wrong file changes nothing');
  assert.deepEqual(problems, []);
  await context.close();
});

test('a link restores the state; a hostile one is told and does no harm', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=cart_pole_c1&seed=5&watch=training&speed=4&preset=paper' });
  assert.equal(await page.inputValue('#task'), 'cart_pole_c1');
  assert.equal(await page.inputValue('#seed'), '5');
  assert.equal(await page.inputValue('#speed'), '4');
  assert.equal(await page.inputValue('#preset'), 'paper');
  assert.ok(await page.isChecked('input[value=training]'));
  await page.goto(`${site.url}#task=none_such&seed=-3&speed=7&what=%3Cscript%3E&formula=G+F+(`);
  await page.reload();
  await page.waitForSelector('#automaton svg .node.current');
  const notices = await page.textContent('#notices');
  for (const word of ['task', 'seed', 'speed', 'what']) assert.match(notices ?? '', new RegExp(`“${word}”`), notices ?? '');
  assert.equal(await page.inputValue('#task'), 'melas');
  await page.goto(`${site.url}#formula=G+F+(`);
  await page.reload();
  await page.waitForSelector('#formula[aria-invalid=true]');
  assert.equal(await page.inputValue('#formula'), 'G F (');
  assert.deepEqual(problems, []);
  await context.close();
});

test('offline after the first visit: the page, its libraries and training', async () => {
  const { page, context, problems } = await visit(site);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await context.setOffline(true);
  await page.reload();
  await page.waitForSelector('#automaton svg .node.current');
  await page.waitForSelector('#curves canvas', { state: 'attached' });
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 50);
  assert.deepEqual(problems.filter((p) => !p.includes('ERR_INTERNET_DISCONNECTED')), []);
  await context.close();
});

test('exports: curves as CSV, the automaton as SVG and HOA, the description as JSON, the picture as PNG', async () => {
  const { page, context, problems } = await visit(site);
  await page.click('#episode');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent) > 1);
  await page.click('#hoa-panel summary');
  /** @type {[string, RegExp][]} */
  const files = [['export-csv', /^episode,average,total,rounds,success,critic(,critic_\d+)+\n1,/], ['export-svg', /^<svg/], ['export-json', /^\{/], ['export-png', /PNG/], ['hoa-save', /^HOA: v1/]];
  for (const [id, wanted] of files) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.click(`#${id}`)]);
    assert.match(await readFile(await download.path(), 'latin1'), wanted, id);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test('reduced motion, and a page that may not be framed by what it loads: the policy of its content is strict', async () => {
  const { page, context, problems } = await visit(site, { motion: 'reduce' });
  const policy = await page.getAttribute('meta[http-equiv=Content-Security-Policy]', 'content');
  assert.match(policy ?? '', /default-src 'none'/);
  assert.doesNotMatch(policy ?? '', /unsafe-inline|'unsafe-eval'|https?:/);
  const blocked = await page.evaluate(() => {
    const script = document.createElement('script');
    script.textContent = 'globalThis.intruder = true';
    document.body.append(script);
    return /** @type {any} */ (globalThis).intruder === undefined;
  });
  assert.ok(blocked, 'inline scripts do not run');
  assert.ok(problems.every((p) => p.includes('Content Security Policy')));
  await context.close();
});
