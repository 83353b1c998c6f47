// @ts-check
// Part 3: play, pause, single steps, events, another episode, episodes that are kept; and driving by hand.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { SIZES, start, visit } from './browser.js';

/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

/** The step that the clock shows. @param {import('playwright-core').Page} page */
const step = (page) => page.$eval('#clock', (clock) => Number(/\d+/.exec(clock.textContent ?? '')?.[0] ?? -1));
/** Waits for the clock to show step `n`. @param {import('playwright-core').Page} page @param {number} n */
const atStep = (page, n) => page.waitForFunction((wanted) => Number(/\d+/.exec(document.getElementById('clock')?.textContent ?? '')?.[0]) === wanted, n);

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`playback at ${SIZES[size].width} px: pause, single steps both ways, scrubber, events, another episode`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1' });
    await page.click('#play');
    await page.waitForSelector('#play.paused');
    await page.$eval('#scrub', (input) => {
      /** @type {HTMLInputElement} */ (input).value = '3';
      input.dispatchEvent(new Event('input'));
    });
    await atStep(page, 3);
    await page.click('#forward');
    await atStep(page, 4);
    await page.click('#back');
    await page.click('#back');
    await atStep(page, 2);
    await page.click('#following');
    await page.waitForFunction(() => Number(/\d+/.exec(document.getElementById('clock')?.textContent ?? '')?.[0]) > 2);
    const event = await step(page);
    await page.click('#following');
    await page.waitForFunction((before) => Number(/\d+/.exec(document.getElementById('clock')?.textContent ?? '')?.[0]) > before, event);
    await page.click('#previous');
    await atStep(page, event);
    await page.click('#play');
    await page.waitForFunction((before) => Number(/\d+/.exec(document.getElementById('clock')?.textContent ?? '')?.[0]) > before, event);
    await page.click('#play');
    await page.waitForSelector('#play.paused');
    await page.click('#next-episode');
    await atStep(page, 0);
    assert.deepEqual(problems, []);
    await context.close();
  });

  test(`episodes at ${SIZES[size].width} px are kept, named, chosen and deleted`, async () => {
    const { page, context, problems } = await visit(site, { size, hash: '#task=ball_pass_b1' });
    await page.click('#keep');
    await page.waitForSelector('#kept li');
    assert.match((await page.textContent('#kept li')) ?? '', /Trained policy · \d+ steps · \d+ rounds?/);
    await page.click('#keep');
    await page.waitForFunction(() => document.getElementById('notices')?.textContent?.includes('kept already'));
    await page.fill('#kept input', 'the good one');
    await page.press('#kept input', 'Enter');
    await page.waitForSelector('#kept button[aria-label="Play the good one"]');
    await page.click('#next-episode');
    await page.waitForFunction(() => /^[0-9]\//.test(document.getElementById('clock')?.textContent ?? ''));
    await page.click('#keep');
    await page.waitForFunction(() => document.querySelectorAll('#kept li').length === 2);
    await page.click('#kept button[aria-label="Play the good one"]');
    await page.waitForFunction(() => document.getElementById('stage-note')?.textContent === 'A kept episode');
    assert.equal(await page.$eval('#kept li', (row) => row.hasAttribute('data-chosen')), true);
    await page.click('#kept button[aria-label="Delete the good one"]');
    await page.waitForFunction(() => document.querySelectorAll('#kept li').length === 1);
    await page.click('label:has(input[value=policy])');
    await page.waitForFunction(() => document.getElementById('stage-note')?.textContent !== 'A kept episode');
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test('a click on the map begins an episode there, and the way before it stays faintly', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1' });
  await page.waitForFunction(() => /^[1-9]\d\//.test(document.getElementById('clock')?.textContent ?? ''));
  const box = await page.locator('#stage').boundingBox();
  assert.ok(box);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 4);
  await page.waitForFunction(() => /^\d\//.test(document.getElementById('clock')?.textContent ?? ''));
  assert.deepEqual(problems, []);
  await context.close();
});

test('driving the ball: the arrow keys push, the automaton follows, the run ends and begins again', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=ball_pass_b1&speed=1' });
  await page.click('label:has(input[value=drive])');
  await page.locator('#stage-panel').focus();
  await page.keyboard.down('ArrowRight');
  await page.waitForFunction(() => /^step [1-9]/.test(document.getElementById('clock')?.textContent ?? ''));
  await page.waitForFunction(() => document.getElementById('stage-note')?.textContent?.includes('The run has ended'));
  await page.keyboard.up('ArrowRight');
  await page.click('#keep');
  await page.waitForFunction(() => document.querySelector('#kept li')?.textContent?.includes('Driven by hand'));
  await page.locator('#stage-panel').focus();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => /^step [0-9]$/.test(document.getElementById('clock')?.textContent ?? ''));
  assert.deepEqual(problems, []);
  await context.close();
});

test('driving the rover: it stands until it is pushed, by keys, by a pressed pointer, by a finger', async () => {
  const { page, context, problems } = await visit(site, { size: 'phone', hash: '#task=melas&watch=drive&speed=1' });
  const picture = () => page.$eval('#stage', (canvas) => /** @type {HTMLCanvasElement} */ (canvas).toDataURL());
  const moved = (/** @type {number} */ from) => page.waitForFunction((before) => Number(/\d+/.exec(document.getElementById('clock')?.textContent ?? '')?.[0]) > before, from);
  await atStep(page, 0);
  const still = await picture();
  await page.locator('#stage-panel').focus();
  await page.keyboard.down('ArrowLeft');
  await moved(3);
  await page.keyboard.up('ArrowLeft');
  assert.notEqual(await picture(), still);
  // The hand is off: after the step that was under way nothing moves.
  await page.waitForFunction(() => {
    const seen = /** @type {{ text?: string | null, since?: number }} */ (globalThis);
    const text = document.getElementById('clock')?.textContent;
    if (seen.text !== text) Object.assign(seen, { text, since: performance.now() });
    return performance.now() - Number(seen.since) > 500;
  }, undefined, { polling: 50 });
  await page.locator('#stage').scrollIntoViewIfNeeded();
  const box = await page.locator('#stage').boundingBox();
  assert.ok(box);
  const before = await step(page);
  await page.mouse.move(box.x + 20, box.y + box.height / 2);
  await page.mouse.down();
  await moved(before + 3);
  await page.mouse.up();
  // A finger that stays: touch events through the browser's own protocol.
  const fingers = await page.context().newCDPSession(page);
  const later = await step(page);
  await fingers.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [{ x: box.x + box.width - 20, y: box.y + box.height / 2 }] });
  await moved(later + 3);
  await fingers.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  assert.deepEqual(problems, []);
  await context.close();
});

test('driving the cart: the keys push it aside', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=cart_pole_c1&watch=drive&speed=1' });
  await page.locator('#stage-panel').focus();
  await page.keyboard.down('ArrowRight');
  await page.waitForFunction(() => document.getElementById('stage-note')?.textContent?.includes('The run has ended'));
  await page.keyboard.up('ArrowRight');
  assert.deepEqual(problems, []);
  await context.close();
});
