// @ts-check
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { LESSONS } from '../../src/lessons/content/index.js';
import { isQuestion } from '../../src/lessons/model.js';
import { SIZES, inaccessible, start } from './browser.js';

/** @typedef {import('playwright-core').Page} Page */

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

/**
 * A page in a context of its own, still, so that words are read at once. `problems` collects what went wrong in it.
 * @param {keyof typeof SIZES} size
 * @param {'light' | 'dark'} [colours]
 */
async function blank(size, colours = 'light') {
  const context = await site.browser.newContext({ viewport: SIZES[size], colorScheme: colours, reducedMotion: 'reduce' });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  /** @type {string[]} */
  const problems = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') problems.push(message.text());
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  return { context, page, problems };
}

/** @param {Page} page @param {number} room */
async function fits(page, room) {
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(width <= room, `${page.url()} is ${width} px wide in ${room}`);
}

/** @param {Page} page @param {string} [root] */
async function clean(page, root) {
  assert.deepEqual(await inaccessible(page, root), []);
}

/** Waits until the present question is set up. @param {Page} page */
const ready = (page) => page.waitForSelector('#lesson-panel .step');

/** Answers the present question and runs it. @param {Page} page @param {number} choice */
async function answer(page, choice) {
  await page.check(`.choice >> nth=${choice} >> input`);
  await page.click('button.run');
  await page.waitForSelector('.result .came');
}

test('every lesson opens, one link away from the one before, and fits 1280, 390 and 360 px', async () => {
  const { context, page, problems } = await blank('wide');
  for (const [k, lesson] of LESSONS.entries()) {
    if (k === 0) await page.goto(`${site.url}?lesson=${lesson.name}`);
    else await page.click('.ways [rel=next]');
    await page.waitForFunction((title) => document.title.startsWith(title), lesson.title);
    await ready(page);
    assert.equal(await page.locator('.steps li').count(), lesson.steps.length);
    for (const width of [390, 360, 1280]) {
      await page.setViewportSize({ width, height: 800 });
      await fits(page, width);
    }
  }
  assert.deepEqual(problems, []);
  await context.close();
});

test('predict, run, explain: a wrong answer and a right one, kept over a reload, by keyboard alone', async () => {
  const { context, page, problems } = await blank('wide');
  await page.goto(`${site.url}?lesson=reading-ltl`);
  await ready(page);
  assert.equal(await page.isDisabled('button.run'), true, 'first one commits to an answer');
  await page.focus('.choice input');
  await page.keyboard.press('Space');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Enter');
  await page.waitForSelector('.result .came');
  const said = (await page.textContent('.result')) ?? '';
  assert.match(said, /It came out otherwise.*The run bears out: No\..*does not hold on this word.*Why\./s);
  assert.deepEqual(await page.locator('tr.states td').allTextContents(), ['q₀', 'q₀', 'q₁', 'q₁', 'q₁']);
  assert.equal(await page.locator('#automaton .node.current').count(), 1);
  // The word can be changed now: region 2 is visited in the end.
  await page.click('[aria-label="r2 at step 3"]');
  await page.waitForFunction(() => document.querySelector('.word-verdict.holds'));
  await page.reload();
  await page.waitForSelector('.steps button.done');
  await page.click('.steps li:first-child button');
  assert.match((await page.textContent('.result')) ?? '', /It came out otherwise/);
  await page.click('.steps li:nth-child(2) button');
  await answer(page, 1);
  assert.match((await page.textContent('.result')) ?? '', /As you said/);
  await clean(page);
  assert.deepEqual(problems, []);
  await context.close();
});

test('the frontier: all policies of three places, then a training that is told as it came out', async () => {
  const { context, page, problems } = await blank('phone', 'dark');
  await page.goto(`${site.url}?lesson=frontier&step=2&seed=4`);
  await ready(page);
  await answer(page, 1);
  assert.equal(await page.locator('.policies tbody tr').count(), 8);
  assert.equal(await page.locator('.policies tr.holds').count(), 2);
  await page.click('.policies tr.holds .reads');
  await page.waitForFunction(() => document.querySelector('.word-verdict.holds'));
  await fits(page, SIZES.phone.width);
  await clean(page);
  await page.click('.steps li:nth-child(3) button');
  await page.waitForFunction(() => location.hash.includes('standard') && location.hash.includes('seed=4'));
  await page.check('.choice >> nth=0 >> input');
  await page.click('button.run');
  await page.waitForFunction(() => /training, [\d,]+ of at most 20,000 steps/.test(document.querySelector('.run-progress')?.textContent ?? ''));
  // Another step supersedes the run, quietly.
  await page.click('.steps li:nth-child(1) button');
  await page.waitForSelector('#places-panel:not([hidden])');
  await page.waitForFunction(() => document.getElementById('train')?.getAttribute('aria-pressed') === 'false');
  await answer(page, 0);
  assert.match((await page.textContent('.result')) ?? '', /None of the 2 deterministic policies/);
  assert.deepEqual(problems, []);
  await context.close();
});

test('a teacher’s link hides, locks and fixes the seed; keys are no way round it', async () => {
  const { context, page, problems } = await blank('wide');
  await page.goto(`${site.url}?hide=files,share&lock=seed,task,hoa&seed=11`);
  await page.waitForSelector('#automaton svg .node.current');
  await page.waitForFunction(() => location.hash.includes('seed=11'));
  for (const selector of ['#save', '#share']) assert.equal(await page.isVisible(selector), false, selector);
  for (const selector of ['#seed', '#new-seed', '#task', '#hoa-own']) assert.equal(await page.isDisabled(selector), true, selector);
  assert.equal(await page.isEditable('#hoa'), false);
  assert.equal(await page.isDisabled('#preset'), false);
  await page.keyboard.press('n');
  await page.keyboard.press('r');
  await page.waitForTimeout(300);
  assert.equal(await page.inputValue('#seed'), '11');
  assert.match((await page.textContent('#notices')) ?? '', /Fixed by the link: seed, task, hoa/);
  assert.deepEqual(problems, []);
  await page.goto(`${site.url}?lesson=nonsense&lock=doors`);
  await page.waitForFunction(() => document.querySelectorAll('.notice.problem').length === 2);
  await context.close();
});

test('the menu, and the gallery with a word read broken and mended', async () => {
  const { context, page, problems } = await blank('wide', 'dark');
  await page.goto(site.url);
  await page.waitForSelector('#automaton svg .node.current');
  await page.click('#lessons-open');
  await page.waitForSelector('#lessons[open]');
  assert.equal(await page.locator('.lesson-list li').count(), LESSONS.length);
  await clean(page, '#lessons');
  await page.click('text=Break it: a gallery');
  await page.waitForSelector('#printed-frontier');
  await page.waitForSelector('#automaton svg .node.current');
  await page.click('text=Read a word: Printed rule');
  await page.waitForFunction(() => /Of 4 visits, 1 was paid/.test(document.querySelector('#printed-frontier .result')?.textContent ?? ''));
  await page.click('text=Read a word: Refilling rule');
  await page.waitForFunction(() => /Of 4 visits, 4 were paid/.test(document.querySelector('#printed-frontier .result')?.textContent ?? ''));
  await page.click('text=Train: One network');
  await page.waitForFunction(() => /training, [\d,]+ of/.test(document.querySelector('#one-network .run-progress')?.textContent ?? ''));
  await clean(page);
  assert.deepEqual(problems, []);
  await context.close();
});

test('worksheets print: every question, the automata drawn, the key on a page of its own', async () => {
  const { context, page, problems } = await blank('phone');
  await page.goto(`${site.url}?worksheet=memory`);
  await page.waitForSelector('main.sheets:not([aria-busy])');
  assert.equal(await page.locator('.sheet').count(), 1);
  await fits(page, SIZES.phone.width);
  await clean(page);
  await page.goto(`${site.url}?worksheet=all&key=1`);
  await page.waitForSelector('main.sheets:not([aria-busy])');
  assert.equal(await page.locator('.sheet').count(), 2 * LESSONS.length);
  const questions = LESSONS.flatMap((l) => l.steps).length;
  assert.equal(await page.locator('.sheet:not(.key) > .questions > li').count(), questions);
  assert.ok((await page.locator('.paper-graph svg').count()) >= LESSONS.length - 2);
  const states = await page.locator('.key .states td').allTextContents();
  assert.ok(states.length > 40 && states.every((text) => /^q[₀-₉]+$/.test(text)));
  const trained = LESSONS.flatMap((l) => l.steps).filter((s) => isQuestion(s) && s.experiment.kind === 'train').length;
  assert.equal(await page.locator('.key :text("Measured beforehand")').count(), trained);
  const paper = await page.pdf({ format: 'A4' });
  const pages = paper.toString('latin1').match(/\/Type\s*\/Page\b/g)?.length ?? 0;
  assert.ok(pages >= 2 * LESSONS.length, `${pages} pages`);
  assert.deepEqual(problems, []);
  await context.close();
});

test('every address in the teaching guide opens', async () => {
  const guide = await readFile(new URL('../../../docs/teaching.md', import.meta.url), 'utf8');
  const links = [...new Set(guide.match(/\?(?:lesson|worksheet|gallery|hide|lock|seed)=[^\s)`|"]*/g))];
  // Lessons, their steps and worksheets and the gallery are opened above.
  const special = links.filter((link) => /hide=|lock=|#/.test(link));
  assert.ok(special.length >= 4);
  const { context, page, problems } = await blank('wide');
  for (const link of special) {
    await page.goto('about:blank');
    await page.goto(site.url + link);
    await page.waitForSelector('#automaton svg .node');
    assert.equal(await page.locator('.notice.problem').count(), 0, link);
  }
  assert.deepEqual(problems, []);
  await context.close();
});
