// @ts-check
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Cadence, LONGEST, SHORTEST } from '../../src/keep/cadence.js';
import { ago } from '../../src/keep/keeper.js';
import { recognise } from '../../src/keep/recognise.js';
import { MAX_BYTES, MAX_MAPS, MAX_RUNS, Store, evicted } from '../../src/keep/store.js';

/** @typedef {import('../../src/keep/store.js').KeptRun} KeptRun */

const run = (/** @type {string} */ key, /** @type {Partial<KeptRun>} */ more = {}) => /** @type {KeptRun} */ ({
  key, when: 0, title: key, formula: '', seed: 1, steps: 100, size: 1000, exact: true, view: {}, ...more,
});

test('what is kept stays within its bounds, the oldest goes first', () => {
  const many = Array.from({ length: MAX_RUNS }, (_, k) => run(`r${k}`, { when: 100 - k }));
  assert.deepEqual(evicted(many, 'new', 1), [`r${MAX_RUNS - 1}`]);
  assert.deepEqual(evicted(many, 'r3', 1), [], 'a run takes the place of its older self');
  const large = Array.from({ length: 4 }, (_, k) => run(`r${k}`, { when: k, size: MAX_BYTES / 4 }));
  assert.deepEqual(evicted(large, 'new', MAX_BYTES / 2), ['r0', 'r1']);
  assert.deepEqual(evicted(large, 'new', MAX_BYTES), ['r0', 'r1', 'r2', 'r3']);
});

test('a run is only given up for one that has gone further', async () => {
  const store = new Store(); // there is no database here: it keeps in memory
  assert.equal(await store.lasts(), false);
  const bytes = (/** @type {number} */ n) => Uint8Array.of(n);
  assert.equal(await store.putRun(run('a', { steps: 200, when: 1 }), bytes(1)), true);
  assert.equal(await store.putRun(run('a', { steps: 150, when: 2, view: { speed: 4 } }), bytes(2)), false);
  assert.deepEqual(await store.checkpoint('a'), bytes(1));
  assert.deepEqual((await store.runs()).map(({ steps, when, view }) => [steps, when, view]), [[200, 2, { speed: 4 }]]);
  await store.putRun(run('a', { steps: 200, exact: false }), bytes(3));
  assert.deepEqual(await store.checkpoint('a'), bytes(1), 'one that goes on exactly is worth more');
  await store.putRun(run('a', { steps: 300, when: 3 }), bytes(4));
  assert.deepEqual(await store.checkpoint('a'), bytes(4));
  for (let k = 0; k < 2 * MAX_RUNS; k++) await store.putRun(run(`b${k}`, { when: 10 + k }), bytes(k));
  assert.equal((await store.runs()).length, MAX_RUNS);
  assert.equal(await store.checkpoint('a'), null, 'checkpoints go with their runs');
  for (let k = 0; k < MAX_MAPS; k++) await store.putNamedMap(`m${k}`, '{}');
  await store.putNamedMap('m0', '{"new": 1}');
  await assert.rejects(store.putNamedMap('one more', '{}'), /forget one/);
  for (let k = 0; k < 2 * MAX_MAPS; k++) await store.putMap(`kept.${k}`, '{}');
  assert.equal(await store.getMap('kept.0'), null);
  await store.forget();
  assert.deepEqual([await store.runs(), await store.maps(), await store.checkpoint('b9')], [[], [], null]);
});

test('keeping takes no more than a fortieth of the time', () => {
  const cadence = new Cadence();
  cadence.begin(0);
  let [kept, spent] = [0, 0];
  const cost = 700;
  for (let now = 0; now < 3_600_000; now += 250) {
    if (!cadence.due(now, now)) continue;
    cadence.kept(now, now + cost, now);
    kept++;
    spent += cost;
  }
  assert.ok(kept > 60 && spent < 3_600_000 / 40, `${kept} times`);
  const slow = new Cadence();
  slow.kept(0, 60_000, 1);
  assert.equal(slow.interval, LONGEST);
  assert.equal(new Cadence().interval, SHORTEST);
  assert.ok(!slow.due(1e9, 1), 'nothing new, nothing to keep');
});

test('files are recognised by their content', () => {
  const text = (/** @type {string} */ t) => recognise(new TextEncoder().encode(t));
  assert.equal(text('HOA: v1\nStates: 1').kind, 'hoa');
  assert.equal(text('/* a remark */ /* HOA */\n HOA: v1').kind, 'hoa');
  assert.equal(text('{"name": "m", "labels": []}').kind, 'map');
  assert.deepEqual(text('{"layout": {}, "request": {"task": "x"}}'), { kind: 'description', request: { task: 'x' } });
  assert.equal(text('title = "t"\n[environment]\nname = "rover"\n[specification]\nltl = "F a"').kind, 'task');
  assert.deepEqual(text(' G F a & G !b \n'), { kind: 'formula', text: 'G F a & G !b' });
  const record = new Uint8Array(80);
  record[0] = 64;
  record[8] = 0x7b;
  assert.equal(recognise(record).kind, 'checkpoint');
  for (const odd of ['', '/* never\nclosed', '{', '{"a": 1}', '[1]\n[2]\n', 'two\nlines']) assert.equal(text(odd).kind, 'unknown', odd);
  assert.equal(recognise(Uint8Array.of(0xff, 0xfe, 0, 1, 2)).kind, 'unknown');
  assert.equal(recognise(new Uint8Array(5 << 20).fill(32)).kind, 'unknown');
});

test('time is told in round words', () => {
  const at = (/** @type {number} */ minutes) => ago(0, minutes * 60_000);
  assert.deepEqual([0, 1, 59, 60, 60 * 23, 60 * 24, 60 * 24 * 9].map(at), ['just now', '1 min ago', '59 min ago', '1 h ago', '23 h ago', '1 day ago', '9 days ago']);
});
