// @ts-check
// Maps of one's own: painted with pointer, touch and keys, made of pictures and files, trained on, sent as links.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { SIZES, inaccessible, number, start, visit } from './browser.js';
import { HOSTILE_MAPS, file, flat, png, shaded } from './files.js';

/** @typedef {import('playwright-core').Page} Page */
/** @type {Awaited<ReturnType<typeof start>>} */
let site;
before(async () => {
  site = await start();
});
after(() => site?.close());

/** @param {Page} page */
async function paint(page) {
  await page.click('#paint-map');
  await page.waitForSelector('#painter[open] .brush');
}

/** The shares of the labels, as the editor shows them. @param {Page} page */
const shares = (page) => page.$$eval('#painter .brush', (rows) => Object.fromEntries(rows.map((row) => [row.querySelector('.mono')?.textContent ?? '', row.querySelector('.soft')?.textContent ?? ''])));

/** @param {Page} page @param {string} text */
const said = (page, text) => page.waitForFunction((wanted) => document.getElementById('map-said')?.textContent?.includes(wanted), text);

/** @param {Page} page */
async function use(page) {
  await page.click('#map-use');
  await page.waitForFunction(() => !document.querySelector('#painter[open]'));
  await page.waitForFunction(() => location.hash.includes('map='));
}

test('painted with the pointer, the map is trained on, and its link opens it elsewhere', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=own_map' });
  await paint(page);
  assert.deepEqual(Object.keys(await shares(page)).sort(), ['', 'camp', 'spring', 'unsafe']);
  await page.fill('#map-label', 'camp');
  await page.press('#map-label', 'Enter');
  await said(page, 'already');
  await page.fill('#map-label', 'lake');
  await page.press('#map-label', 'Enter');
  const box = await page.locator('.easel').boundingBox();
  assert.ok(box);
  await page.mouse.move(box.x + box.width * 0.4, box.y + box.height * 0.7);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height * 0.9, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => /lake\d+ %/.test(document.querySelector('.brushes')?.textContent ?? ''));
  await use(page);
  await page.fill('#formula', 'G F lake & G F camp & G !unsafe');
  await page.waitForSelector('#formula-apply:not([disabled])');
  await page.press('#formula', 'Enter');
  await page.waitForFunction(() => location.hash.includes('formula='));
  await page.click('#train');
  await page.waitForFunction(() => Number(document.getElementById('n-steps')?.textContent?.replaceAll(',', '')) > 200);
  const elsewhere = await visit(site, { hash: new URL(page.url()).hash });
  assert.equal(await elsewhere.page.inputValue('#formula'), 'G F lake & G F camp & G !unsafe');
  await paint(elsewhere.page);
  assert.match((await shares(elsewhere.page)).lake, /\d/);
  assert.deepEqual([...problems, ...elsewhere.problems], []);
  await Promise.all([context.close(), elsewhere.context.close()]);
});

test('painted with a finger on a phone: nothing overflows, axe finds nothing', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=own_map', size: 'phone' });
  await paint(page);
  const before = await shares(page);
  const box = await page.locator('.easel').boundingBox();
  assert.ok(box && box.width <= SIZES.phone.width);
  await page.locator('.brush', { hasText: 'Erase' }).locator('label').tap();
  const touch = await context.newCDPSession(page);
  const at = (/** @type {number} */ x, /** @type {number} */ y) => ({ touchPoints: [{ x: box.x + box.width * x, y: box.y + box.height * y }] });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', ...at(0.1, 0.7) });
  for (let k = 1; k <= 5; k++) await touch.send('Input.dispatchTouchEvent', { type: 'touchMove', ...at(0.1 + k * 0.04, 0.7) });
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await page.waitForFunction((old) => !document.querySelector('.brushes')?.textContent?.includes(`camp${old}`), before.camp);
  assert.deepEqual(await inaccessible(page, '#painter'), []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && (document.getElementById('painter')?.scrollWidth ?? 0) <= innerWidth));
  await use(page);
  assert.deepEqual(problems, []);
  await context.close();
});

test('painted with keys alone: labels, brush, undo and redo', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=own_map' });
  await page.focus('#paint-map');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#painter[open] .brush');
  await page.click('#painter button:text-is("Blank")');
  await page.keyboard.type('goal');
  await page.keyboard.press('Enter');
  await said(page, 'Paint where goal holds');
  await page.focus('.easel');
  await page.keyboard.press('Shift+ArrowLeft');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => /column \d+ of 180, row \d+ of 120: goal/i.test(document.querySelector('.easel-box [role=status]')?.textContent ?? ''));
  const spot = await shares(page);
  await page.keyboard.down(' ');
  for (let k = 0; k < 4; k++) await page.keyboard.press('Shift+ArrowRight');
  await page.keyboard.up(' ');
  await page.waitForFunction((old) => !document.querySelector('.brushes')?.textContent?.includes(`goal${old}`), spot.goal);
  await page.keyboard.press('Control+z');
  await page.waitForFunction((old) => document.querySelector('.brushes')?.textContent?.includes(`goal${old}`), spot.goal);
  await page.keyboard.press('Control+y');
  await page.waitForFunction((old) => !document.querySelector('.brushes')?.textContent?.includes(`goal${old}`), spot.goal);
  await use(page);
  assert.equal(await page.inputValue('#formula'), 'G F goal');
  assert.deepEqual(problems, []);
  await context.close();
});

for (const size of /** @type {const} */ (['wide', 'phone'])) {
  test(`a picture of one's own at ${SIZES[size].width} px: flat colours become labels, others a backdrop; map files go out and in`, async () => {
    const { page, context, problems } = await visit(site, { hash: '#task=own_map', size });
    await page.setInputFiles('#load', file('meadow.png', png(60, 40, flat), 'image/png'));
    await said(page, 'became 3 labels: green, blue, unsafe');
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#painter button:text-is("Save as file")')]);
    const saved = await readFile(await download.path());
    assert.equal(JSON.parse(saved.toString()).grid.columns, 60);
    await page.click('#painter button:text-is("Keep on this machine")');
    await said(page, 'meadow is kept');
    await page.setInputFiles('#map-file', file('photo.png', png(64, 48, shaded), 'image/png'));
    await said(page, 'is shown below');
    assert.deepEqual(await shares(page), { '': '' });
    await page.click('#map-use');
    await said(page, 'no label yet');
    await page.fill('#map-label', 'hill');
    await page.press('#map-label', 'Enter');
    await page.locator('.easel').click();
    await use(page);
    assert.equal(await page.inputValue('#formula'), 'G F hill');
    await paint(page);
    await page.click('.kept-maps button:text-is("meadow")');
    await page.waitForFunction(() => document.querySelector('.brushes')?.textContent?.includes('green'));
    await page.click('#painter button:text-is("Blank")');
    await page.setInputFiles('#map-file', file('again.json', saved));
    await said(page, 'again.json is open');
    assert.deepEqual(Object.keys(await shares(page)).sort(), ['', 'blue', 'green', 'unsafe']);
    await use(page);
    assert.equal(await page.inputValue('#formula'), 'G F green & G F blue & G !unsafe');
    assert.deepEqual(problems, []);
    await context.close();
  });
}

test('hostile pictures and map files are refused in the editor, which stays as it was', async () => {
  const { page, context, problems } = await visit(site, { hash: '#task=own_map' });
  await paint(page);
  const before = await shares(page);
  for (const [hostile, wanted] of HOSTILE_MAPS) {
    await page.setInputFiles('#map-file', hostile);
    await page.waitForFunction(() => document.getElementById('map-said')?.classList.contains('bad'));
    await page.waitForFunction((source) => new RegExp(source).test(document.getElementById('map-said')?.textContent ?? ''), wanted.source)
      .catch(async () => assert.match((await page.textContent('#map-said')) ?? '', wanted, hostile.name));
    assert.deepEqual(await shares(page), before, hostile.name);
  }
  await use(page);
  assert.equal(await number(page, 'n-steps'), 0);
  assert.deepEqual(problems, []);
  await context.close();
});
