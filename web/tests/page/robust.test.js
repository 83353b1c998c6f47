// @ts-check
// What goes wrong is said in its place and harms nothing: broken workers, hostile links and files, browsers that lack what is needed.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { SIZES, number, start, untilKept, visit } from './browser.js';
import { HOSTILE_FILES } from './files.js';

/** @typedef {import('playwright-core').Page} Page */
/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

const LIGHT = 'set=learner.hidden=[8,8];learner.exploration.warm_up=50;training.evaluate_every=0';

/** Makes the worker fail as a fault of the program would. @param {Page} page */
const breakWorker = (page) => page.workers()[0].evaluate(() => void setTimeout(() => {
  throw new Error('a fault for the test');
}));

/** @param {Page} page @param {string} text */
const told = (page, text) => page.waitForFunction((wanted) => document.getElementById('notices')?.textContent?.includes(wanted), text);

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`a worker that breaks is started again from the last checkpoint, at ${SIZES[size].width} px`, async () => {
    const { page, context } = await visit(site, { hash: `#${LIGHT}`, size });
    await page.click('#episode');
    await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 1);
    const steps = await number(page, 'n-steps');
    await untilKept(page, (k) => k === steps);
    await page.click('#train');
    await page.waitForFunction((old) => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > old, steps);
    await breakWorker(page);
    await told(page, 'It was started again');
    await page.waitForFunction(() => document.getElementById('train')?.textContent === 'Train');
    const after = await number(page, 'n-steps');
    const text = (await page.textContent('#notices')) ?? '';
    assert.match(text, /a fault for the test/);
    assert.match(text, /from the last checkpoint/);
    assert.ok(after >= steps, 'its steps are there');
    await page.click('#step');
    await page.waitForFunction((old) => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) === old + 1, after);
    await context.close();
  });
}

test('a worker that breaks again and again is given up with a word', async () => {
  const { page, context } = await visit(site, { hash: `#${LIGHT}` });
  for (let k = 0; k < 4; k++) {
    const worker = page.workers()[0];
    const gone = new Promise((resolve) => worker.once('close', resolve));
    await breakWorker(page);
    if (k < 3) {
      await gone;
      await page.waitForFunction(() => document.querySelectorAll('#notices .problem').length > 0);
      while (page.workers().length === 0) await new Promise((resolve) => setTimeout(resolve, 50));
      await page.waitForFunction((k) => (document.getElementById('notices')?.textContent?.match(/It was started again/g) ?? []).length > k, k);
    }
  }
  await told(page, 'Reload the page to try again');
  await context.close();
});

/** Links that mean harm, and a word of what is said of each. @type {[string, RegExp][]} */
const HOSTILE_LINKS = [
  ['#task=%3Cimg%20src=x%20onerror=alert(1)%3E', /“task”/],
  ['#task=../../etc/passwd', /“task”/],
  ['#task=no%0Atask', /Task file, line 1, column 3: key with no value/],
  ['#formula=' + '('.repeat(1999), /./],
  ['#formula=' + 'G'.repeat(1900) + ' a', /./],
  ['#hoa=' + encodeURIComponent('HOA: v1\nStates: 99999999999\n--BODY--\n--END--'), /./],
  ['#map=AAAA', /map/],
  ['#map=kept.0000000000000000', /kept on the machine where it was made/],
  ['#map=%00', /“map”/],
  ['#set=learner.replay=99999999999999999999', /replay/],
  ['#set=learner.hidden=[1000000,1000000]', /hidden/],
  ['#set=__proto__.x=1', /./],
  ['#seed=NaN&speed=Infinity&pace=-0&hide=constructor', /“speed”/],
  ['#' + 'x'.repeat(30_000), /longer/],
  ['#%E0%A4%A', /./],
  ['#preset=paper&task=cart_pole_c1&formula=G+F+nowhere', /nowhere/],
];

test('a hostile link is told of, and the page stands', async () => {
  const { page, context, problems } = await visit(site);
  for (const [link, wanted] of HOSTILE_LINKS) {
    await page.goto('about:blank');
    await page.goto(`${site.url}${link}`);
    // A formula that is refused but can be read is previewed.
    await page.waitForSelector('#automaton svg .node.current, #automaton.preview svg .node');
    const seen = () => page.evaluate(() => [...document.querySelectorAll('#notices, .said')].map((n) => n.textContent).join(' '));
    for (const end = Date.now() + 20_000; !wanted.test(await seen()) && Date.now() < end;) await new Promise((resolve) => setTimeout(resolve, 50));
    assert.match(await seen(), wanted, link.slice(0, 60));
    assert.equal(await page.evaluate(() => document.querySelector('img[src=x]')), null);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test('hostile files are refused, and the run stays', async () => {
  const { page, context, problems } = await visit(site, { hash: `#${LIGHT}` });
  await page.click('#step');
  await page.waitForFunction(() => document.getElementById('n-steps')?.textContent === '1');
  for (const [hostile, wanted] of HOSTILE_FILES) {
    await page.evaluate(() => document.getElementById('notices')?.replaceChildren());
    await page.setInputFiles('#load', hostile);
    await page.waitForSelector('#notices .problem');
    assert.match((await page.textContent('#notices')) ?? '', wanted, hostile.name);
    assert.equal(await number(page, 'n-steps'), 1, hostile.name);
  }
  assert.deepEqual(problems, []);
  await context.close();
});

for (const missing of ['WebAssembly', 'Worker']) {
  test(`without ${missing} a plain message says so`, async () => {
    const context = await site.browser.newContext({ viewport: SIZES.phone });
    await context.addInitScript((name) => Reflect.deleteProperty(globalThis, name), missing);
    const page = await context.newPage();
    /** @type {string[]} */
    const problems = [];
    page.on('pageerror', (error) => problems.push(String(error)));
    await page.goto(site.url);
    await page.waitForFunction(() => /no WebAssembly or no workers/.test(document.getElementById('notices')?.textContent ?? ''));
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test('live regions do not chatter while an episode plays and training goes on', async () => {
  const { page, context } = await visit(site, { hash: `#${LIGHT}` });
  await page.waitForSelector('#curves canvas', { state: 'attached' });
  await page.evaluate(() => {
    const heard = /** @type {string[]} */ ((/** @type {any} */ (globalThis)).heard = []);
    for (const region of document.querySelectorAll('[aria-live]:not([aria-live=off]), [role=status], [role=alert], [role=log], output')) {
      if (region.getAttribute('aria-live') === 'off') continue;
      new MutationObserver(() => heard.push(`${region.id}: ${region.textContent}`)).observe(region, { childList: true, subtree: true, characterData: true });
    }
  });
  const rows = await page.textContent('#clock');
  await page.waitForFunction((old) => document.getElementById('clock')?.textContent !== old, rows);
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 2000);
  const heard = await page.evaluate(() => /** @type {any} */ (globalThis).heard);
  assert.ok(heard.length <= 2, `announced: ${heard.slice(0, 5).join(' | ')} …`);
  await context.close();
});

test('from 360 px to 4K nothing overflows', async () => {
  const { page, context, problems } = await visit(site);
  for (const [width, height] of [[360, 640], [768, 1024], [1280, 800], [1920, 1080], [3840, 2160]]) {
    await page.setViewportSize({ width, height });
    await page.waitForFunction((w) => innerWidth === w, width);
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth, undefined, { timeout: 10_000 }).catch(() => assert.fail(`${width} px: the page is wider`));
    const stage = await page.locator('#stage').boundingBox();
    assert.ok(stage && stage.width > 200 && stage.height <= height, `${width} px: the stage is ${stage?.width} × ${stage?.height}`);
  }
  assert.deepEqual(problems, []);
  await context.close();
});
