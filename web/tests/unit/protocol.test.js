// @ts-check
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Client, Refused } from '../../src/client.js';
import { Frame, LAYOUT_VERSION, located } from '../../src/protocol.js';

/** @type {import('../../src/protocol.js').Layout} */
const LAYOUT = { version: LAYOUT_VERSION, length: 7, fields: [{ name: 'step', offset: 0, length: 2 }, { name: 'letter', offset: 2, length: 4 }, { name: 'q', offset: 6, length: 1 }] };

test('a frame reads counters, bits and numbers of any row in place', () => {
  const data = new Float32Array(14);
  data.set([5, 2, 0b101, 1 << 15, 0, 0, 3], 7);
  const frame = new Frame(LAYOUT).at(data, 1);
  assert.equal(frame.counter('step'), 2 * 2 ** 24 + 5);
  assert.deepEqual([0, 1, 2, 31, 32].map((bit) => frame.bit('letter', bit)), [true, false, true, true, false]);
  assert.equal(frame.number('q'), 3);
  assert.deepEqual([...frame.numbers('letter')], [5, 32768, 0, 0]);
  assert.equal(frame.at(data, 0).number('q'), 0);
});

test('a frame refuses what is not there', () => {
  const frame = new Frame(LAYOUT);
  assert.throws(() => frame.number('speed'), /no field speed/);
  assert.throws(() => frame.number('q', 1), RangeError);
  assert.throws(() => frame.at(new Float32Array(7), 1), RangeError);
  assert.throws(() => new Frame({ ...LAYOUT, version: LAYOUT_VERSION + 1 }), /Reload the page/);
});

test('an error of any kind becomes a located one', () => {
  assert.deepEqual(located({ message: 'no', start: 3, end: 4 }), { message: 'no', hint: '', field: '', start: 3, end: 4, line: 0, column: 0 });
  assert.equal(located('plain').message, 'plain');
  assert.equal(located(new Error('thrown')).message, 'thrown');
});

/** A worker that the test plays. */
class Puppet {
  constructor() {
    /** @type {any[]} */
    this.heard = [];
    /** @type {((event: MessageEvent) => void) | null} */
    this.onmessage = null;
    /** @type {((event: ErrorEvent) => void) | null} */
    this.onerror = null;
    this.ended = false;
  }
  /** @param {unknown} message */
  postMessage(message) {
    this.heard.push(message);
  }
  terminate() {
    this.ended = true;
  }
  /** @param {unknown} data */
  say(data) {
    this.onmessage?.(/** @type {MessageEvent} */ ({ data }));
  }
}

function stage() {
  /** @type {Puppet[]} */
  const puppets = [];
  /** @type {any[]} */
  const told = [];
  const client = new Client(
    () => {
      const puppet = new Puppet();
      puppets.push(puppet);
      return puppet;
    },
    { frame: (r) => told.push(r), telemetry: (r) => told.push(r), evaluation: (r) => told.push(r), finished: (r) => told.push(r), halted: (r) => told.push(r), broken: (m) => told.push(m) },
  );
  return { client, puppets, told };
}

test('each command gets its own answer, in any order', async () => {
  const { client, puppets } = stage();
  const [one, two] = [client.ask({ kind: 'step' }), client.ask({ kind: 'pause' })];
  assert.deepEqual(puppets[0].heard.map((m) => m.command.kind), ['step', 'pause']);
  puppets[0].say({ kind: 'done', id: 2, value: 'second' });
  puppets[0].say({ kind: 'done', id: 1, value: 'first' });
  assert.deepEqual(await Promise.all([one, two]), ['first', 'second']);
  assert.equal(client.pending.size, 0);
});

test('a refusal carries its place', async () => {
  const { client, puppets } = stage();
  const asked = client.ask({ kind: 'check_formula', text: 'a &' });
  puppets[0].say({ kind: 'failed', id: 1, error: { message: 'a formula is missing', hint: '', field: 'formula', start: 3, end: 3, line: 1, column: 4 } });
  await assert.rejects(asked, (error) => error instanceof Refused && error.where.start === 3 && error.message === 'a formula is missing');
});

test('a broken worker fails what was asked of it, and another one takes over', async () => {
  const { client, puppets, told } = stage();
  const asked = client.ask({ kind: 'step' });
  puppets[0].say({ kind: 'broken', message: 'out of memory' });
  await assert.rejects(asked, /out of memory/);
  assert.deepEqual(told, ['out of memory']);
  const ready = client.restart();
  assert.ok(puppets[0].ended);
  puppets[1].say({ kind: 'ready', tasks: [] });
  assert.deepEqual(await ready, []);
  const again = client.ask({ kind: 'pause' });
  puppets[1].say({ kind: 'done', id: 2, value: null });
  assert.equal(await again, null);
});

test('frames and telemetry reach the listeners', () => {
  const { puppets, told } = stage();
  puppets[0].say({ kind: 'frame', generation: 1, data: new Float32Array(1) });
  puppets[0].say({ kind: 'evaluation', generation: 1, progress: {} });
  assert.deepEqual(told.map((r) => r.kind), ['frame', 'evaluation']);
});
