// @ts-check
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LabelCanvas, MAX_LABELS } from '../../src/maps/canvas.js';
import { measure, pictureAddress } from '../../src/maps/picture.js';
import { NoMap, Shelf, digest, inLink, pack, unpack } from '../../src/maps/shelf.js';

const label = (/** @type {string} */ name) => ({ name, meaning: `the rover is in ${name}` });
const canvas = () => new LabelCanvas(12, 8, [label('a'), label('b'), label('unsafe')], 2);
/** Random numbers that come out the same each time. @param {number} seed */
const numbers = (seed) => () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;

test('a stroke paints exactly the cells whose centres are near its line, and the cells under its ends', () => {
  const random = numbers(7);
  for (let k = 0; k < 200; k++) {
    const made = canvas();
    const [x0, y0, x1, y1] = [random() * 12, random() * 8, random() * 12, random() * 8];
    const radius = 0.1 + random() * 4;
    made.line([x0, y0], [x1, y1], radius, { label: 0, together: false });
    for (let row = 0; row < 8; row++) {
      for (let column = 0; column < 12; column++) {
        let nearest = Infinity;
        for (let t = 0; t <= 1; t += 1 / 512) nearest = Math.min(nearest, Math.hypot(column + 0.5 - x0 - t * (x1 - x0), row + 0.5 - y0 - t * (y1 - y0)));
        const end = [[x0, y0], [x1, y1]].some(([x, y]) => Math.floor(x) === column && Math.floor(y) === row);
        const painted = made.at(column, row).includes('a');
        // The nearest of 513 points is a hair farther than the nearest of all.
        if (Math.abs(nearest - radius) > 0.02) assert.equal(painted, end || nearest < radius, `(${column}, ${row}), nearest ${nearest}, radius ${radius}`);
      }
    }
  }
});

test('labels take each other’s place, or overlap where that is wanted, and unsafe ground hides all', () => {
  const made = canvas();
  const paint = (/** @type {number | null} */ label, together = false) => made.line([1.5, 1.5], [1.5, 1.5], 0.1, { label, together });
  paint(0);
  paint(1);
  assert.deepEqual(made.at(1, 1), ['b']);
  paint(0, true);
  assert.deepEqual(made.at(1, 1), ['a', 'b']);
  paint(2, true);
  assert.deepEqual(made.at(1, 1), ['unsafe']);
  paint(1, true);
  assert.deepEqual(made.at(1, 1), ['b'], 'painted over unsafe ground, a label takes its place');
  paint(null);
  assert.deepEqual(made.at(1, 1), []);
});

test('undo and redo go through any history, as if each state had been kept', () => {
  const random = numbers(3);
  const made = canvas();
  const state = () => JSON.stringify([made.labels.map((l) => l.name), made.hazard, [...made.masks]]);
  const history = [state()];
  for (let k = 0; k < 60; k++) {
    const before = state();
    const act = Math.floor(random() * 12);
    if (act === 0) made.add(`new${k}`, random() < 0.3);
    else if (act === 1) made.clear();
    else if (act === 2 && made.labels.length > 1) made.remove(Math.floor(random() * made.labels.length));
    else made.line([random() * 12, random() * 8], [random() * 12, random() * 8], random() * 3, { label: random() < 0.2 ? null : Math.floor(random() * made.labels.length), together: random() < 0.5 });
    if (state() !== before) history.push(state());
    else if (made.past.length === history.length) history.push(state());
  }
  for (let k = history.length - 2; k >= 0; k--) {
    assert.ok(made.undo());
    assert.equal(state(), history[k]);
  }
  assert.equal(made.undo(), false);
  for (let k = 1; k < history.length; k++) {
    assert.ok(made.redo());
    assert.equal(state(), history[k]);
  }
  assert.equal(made.redo(), false);
});

test('what can be undone is bounded', () => {
  const remembered = (/** @type {LabelCanvas} */ made) => made.past.reduce((sum, c) => sum + c.places.length, 0);
  const small = new LabelCanvas(10, 10, [label('a'), label('b')], -1);
  for (let k = 0; k < 300; k++) small.line([5, 5], [5, 5], 3, { label: k % 2, together: false });
  assert.equal(small.past.length, 100);
  const large = new LabelCanvas(1000, 1000, [label('a'), label('b')], -1);
  for (let k = 0; k < 6; k++) large.line([500, 500], [500, 500], 710, { label: k % 2, together: false });
  assert.deepEqual([large.past.length, remembered(large)], [4, 4e6]);
});

test('names of labels are judged', () => {
  const made = canvas();
  for (const name of ['', '   ', 'a', 'x'.repeat(41), 'with "quotes"', 'two\nlines', 'back\\slash']) assert.equal(typeof made.add(name), 'string', name);
  assert.equal(made.add(' goal '), 3);
  while (made.labels.length < MAX_LABELS) made.add(`l${made.labels.length}`);
  assert.match(String(made.add('more')), /at most/);
  assert.throws(() => new LabelCanvas(2000, 2000, [], -1), /by hand/);
});

test('a map file says what was painted', () => {
  const made = canvas();
  made.line([2, 2], [9, 5], 1.5, { label: 0, together: false });
  made.line([5, 1], [5, 7], 1, { label: 1, together: true });
  made.line([11, 0], [11, 7], 0.6, { label: 2, together: false });
  const map = JSON.parse(made.toJson({ name: 'm', unit: 'm', size: [24, 16], reach: 1, picture: null }));
  assert.equal(map.hazard, 'unsafe');
  /** @type {string[][]} */
  const cells = map.grid.runs.flatMap((/** @type {[number, number]} */ [letter, n]) => Array(n).fill(map.grid.letters[letter]));
  assert.equal(cells.length, 96);
  cells.forEach((names, k) => assert.deepEqual(names, made.at(k % 12, Math.floor(k / 12))));
});

test('pictures are measured by their first bytes', () => {
  const hex = (/** @type {string} */ text) => Uint8Array.from(text.match(/../g) ?? [], (h) => parseInt(h, 16));
  assert.deepEqual(measure(hex('89504e470d0a1a0a0000000d49484452000001400000 00f0'.replaceAll(' ', ''))), { type: 'image/png', width: 320, height: 240 });
  assert.deepEqual(measure(hex('ffd8ffe000044a46ffc000110800f00140030122')), { type: 'image/jpeg', width: 320, height: 240 });
  const riff = '52494646000000005745425056503858 0a000000 00000000 3f0100 ef0000'.replaceAll(' ', '');
  assert.deepEqual(measure(hex(riff)), { type: 'image/webp', width: 320, height: 240 });
  for (const text of ['', '89504e47', 'ffd8', 'ffd8ffe0ffff', 'ffd8000000000000000000', '474946383961', '3c737667']) assert.equal(measure(hex(text)), null, text);
  const random = numbers(11);
  for (let k = 0; k < 2000; k++) {
    const bytes = Uint8Array.from({ length: Math.floor(random() * 60) }, () => Math.floor(random() * 256));
    if (random() < 0.5) bytes.set([0xff, 0xd8, 0xff].slice(0, bytes.length));
    measure(bytes); // never throws, never hangs
  }
});

test('a picture comes from the map itself or from the page, never from elsewhere', () => {
  assert.equal(pictureAddress('data:image/webp;base64,AAAA'), 'data:image/webp;base64,AAAA');
  assert.equal(pictureAddress('melas.webp'), 'assets/melas.webp');
  for (const picture of ['https://example.org/x.png', '//example.org/x', '../../x', 'data:text/html;base64,AAAA', 'data:image/svg+xml;base64,AAAA', 'javascript:1']) {
    assert.match(pictureAddress(picture), /^assets\/[^/:]*$/, picture);
  }
});

test('a map goes into a link and comes back; a large one is kept under its key', async () => {
  /** @type {Map<string, string>} */
  const kept = new Map();
  const store = { putMap: async (/** @type {string} */ key, /** @type {string} */ text) => kept.set(key, text), getMap: async (/** @type {string} */ key) => kept.get(key) ?? null };
  const small = JSON.stringify({ name: 'ö □', runs: Array(200).fill([1, 20]) });
  const key = await new Shelf(store).keyOf(small);
  assert.ok(inLink(key) && /^[A-Za-z0-9_-]+$/.test(key) && key.length < small.length / 4);
  assert.equal(await new Shelf(store).textOf(key), small, 'whoever gets the link needs nothing else');
  assert.equal(kept.size, 0);
  const random = numbers(5);
  const large = Array.from({ length: 30_000 }, () => String.fromCharCode(33 + random() * 90)).join('');
  const long = await new Shelf(store).keyOf(large);
  assert.ok(!inLink(long) && long.length < 30);
  assert.equal(await new Shelf(store).textOf(long), large);
  kept.clear();
  for (const wrong of [long, 'AAAA', 'not a map', key.slice(0, -4), 'kept.', '-']) {
    await assert.rejects(new Shelf(store).textOf(wrong), NoMap, wrong);
  }
});

test('a small link that grows without end is given up', async () => {
  const bomb = await pack(' '.repeat(8 << 20));
  assert.ok(bomb.length < 12_000);
  await assert.rejects(unpack(bomb), /longer/);
});

test('digests tell texts apart', () => {
  const seen = new Set(Array.from({ length: 5000 }, (_, k) => digest(`map ${k}`)));
  assert.equal(seen.size, 5000);
});
