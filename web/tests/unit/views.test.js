// @ts-check
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { brief, count } from '../../src/dom.js';
import { setName, shapeName, shapePath, stateName } from '../../src/palette.js';
import { Player, Recorder, happenings } from '../../src/player.js';
import { Frame } from '../../src/protocol.js';
import { inWords, toDot } from '../../src/views/automaton.js';
import { freshSeed, paceLabel, speedLabel } from '../../src/views/controls.js';
import { span } from '../../src/views/curves.js';
import { percent } from '../../src/views/details.js';
import { middle, projection } from '../../src/views/ground.js';
import { rewardSentence } from '../../src/views/reward.js';
import { errorLine, pieces } from '../../src/views/spec.js';
import { runs } from '../../src/views/timeline.js';
import { Session, layout } from '../mock/ltl_rover.js';

const session = Session.open({ task: 'ball_pass_b1', seed: 1n });
const episode = session.rollout(0n);
const graph = session.describe().automaton;

test('the player keeps time: rows a second follow dt and speed', () => {
  const player = new Player(0.05);
  player.load(episode);
  player.speed = 2;
  player.tick(0.5);
  assert.equal(player.row, 20);
  assert.ok(Math.abs(player.fraction) < 1e-9);
  player.tick(0.01);
  assert.ok(Math.abs(player.fraction - 0.4) < 1e-6);
  player.playing = false;
  player.tick(5);
  assert.equal(player.row, 20);
  player.seek(1e9);
  assert.equal(player.row, episode.rows - 1);
  assert.ok(player.finished);
  player.seek(-5);
  assert.equal(player.row, 0);
});

test('an environment without a unit of time plays at 30 rows a second', () => {
  assert.equal(new Player(0).rowsPerSecond, 60);
});

test('happenings are visits, rounds and moves, in order, and jumping goes from one to the next', () => {
  const list = happenings(layout(), episode);
  assert.deepEqual(list.filter((h) => h.kind === 'round').map((h) => h.row), [120]);
  assert.ok(list.some((h) => h.row === 60 && h.kind === 'visit'));
  assert.deepEqual(list.map((h) => h.row), [...list.map((h) => h.row)].sort((a, b) => a - b));
  const player = new Player(0.05);
  player.load(episode);
  player.jump(list, 1);
  assert.equal(player.row, list[0].row);
  player.jump(list, -1);
  assert.equal(player.row, 0);
  player.seek(239);
  player.jump(list, 1);
  assert.equal(player.row, 239);
});

test('the recorder keeps one episode and copies what it is given', () => {
  const recorder = new Recorder();
  const frame = new Frame(layout());
  for (const row of [3, 4, 5]) recorder.add(frame.at(episode.data, row));
  const seen = recorder.episode(frame.length);
  assert.equal(seen?.rows, 3);
  assert.equal(frame.at(/** @type {any} */ (seen).data, 2).number('episode_step'), 5);
  const other = frame.at(episode.data, 0).data.slice(0, frame.length);
  other[frame.field('episode').offset] = 7;
  recorder.add(frame.at(other, 0));
  assert.equal(recorder.episode(frame.length)?.rows, 1);
});

test('the graph in DOT quotes what it is given and keeps ids, sets and sinks apart', () => {
  const flags = { deterministic: true, reachable: true };
  const dot = toDot({
    propositions: ['a'], initial: 0, sets: 2,
    states: [{ id: 0, name: 'say "G"\\', sink: false, marks: [0], ...flags }, { id: 1, name: '', sink: true, marks: [], ...flags }, { id: 2, name: '', sink: false, marks: [], ...flags, reachable: false }],
    edges: [
      { from: 0, to: 1, kind: 'letter', label: '!"x" | true & a', marks: [] }, { from: 1, to: 0, kind: 'letter', label: 'true', marks: [0, 1] },
      { from: 0, to: 0, kind: 'epsilon', label: 'ε', marks: [0] }, { from: 2, to: 0, kind: 'letter', label: 'a', marks: [] },
    ],
  }, 'LR');
  assert.match(dot, /tooltip="say \\"G\\"\\\\"/);
  assert.match(dot, /0 \[id="q0", class="state accepting".*doublecircle/);
  assert.match(dot, /1 \[id="q1", class="state sink"/);
  assert.match(dot, /label=" ¬\\"x\\" ∨\ntrue ∧ a "/);
  assert.match(dot, /1 -> 0 \[id="e1".*label=" ⊤ ● "/, 'the set that the state carries is not repeated on the edge');
  assert.match(dot, /0 -> 0 \[id="e2", class="epsilon", label=" ε ", style=dashed/);
  assert.doesNotMatch(dot, /^2 /m, 'what cannot be reached is not drawn');
});

test('the graph in words names the shapes of the sets', () => {
  assert.equal(inWords(graph), 'Automaton with 2 states, 4 edges and 2 accepting sets: F₁ a circle, F₂ a square');
});

test('a reward is told in words', () => {
  const frame = new Frame(layout());
  const at = (/** @type {number} */ row) => rewardSentence(frame.at(episode.data, row), 2);
  assert.match(at(1), /no reward/);
  assert.match(at(60), /^F₂ was in the frontier/);
  assert.match(at(120), /F₁.*round is closed/);
});

test('marks in the mirror follow the text, also past its end', () => {
  assert.deepEqual(pieces('a @ b', [{ start: 2, end: 3, gentle: false }]), [{ text: 'a ', mark: 'none' }, { text: '@', mark: 'firm' }, { text: ' b', mark: 'none' }]);
  assert.deepEqual(pieces('a &', [{ start: 3, end: 3, gentle: false }]), [{ text: 'a &', mark: 'none' }, { text: ' ', mark: 'firm' }]);
  assert.deepEqual(pieces('abcd', [{ start: 2, end: 4, gentle: true }, { start: 0, end: 3, gentle: false }]).map((p) => p.text).join(''), 'abcd');
  assert.deepEqual(pieces('', []), []);
});

test('an error line says where', () => {
  const error = { message: 'no', hint: '', field: '', start: 0, end: 1, line: 3, column: 7 };
  assert.equal(errorLine(error, true), 'line 3, column 7: no');
  assert.equal(errorLine(error, false), 'column 7: no');
  assert.equal(errorLine({ ...error, line: 0, column: 0 }, true), 'no');
});

test('projection there and back, with y up and y down', () => {
  for (const y_axis of /** @type {const} */ (['up', 'down'])) {
    const to = projection({ x: [-2, 4], y: [0, 3], unit: 'm', y_axis }, 600, 400);
    const [px, py] = to.point(1, 2);
    const [x, y] = to.back(px, py);
    assert.ok(Math.abs(x - 1) < 1e-9 && Math.abs(y - 2) < 1e-9);
    assert.equal(to.point(0, 3)[1] < to.point(0, 0)[1], y_axis === 'up');
    assert.equal(to.size(6), 600);
  }
});

test('the middle of a region', () => {
  assert.deepEqual(middle({ proposition: 0, name: '', margin: 0, shape: { kind: 'disc', centre: [3, 4], radius: 1 } }), [3, 4]);
  assert.deepEqual(middle({ proposition: 0, name: '', margin: 0, shape: { kind: 'polygon', points: [[0, 0], [2, 0], [2, 2], [0, 2]] } }), [1, 1]);
});

test('runs of equal values cover every row once', () => {
  assert.deepEqual(runs(5, (row) => row > 1), [{ first: 0, end: 2, value: false }, { first: 2, end: 5, value: true }]);
  assert.deepEqual(runs(0, () => 1), []);
});

test('numbers for reading', () => {
  assert.equal(brief(0), '0');
  assert.equal(brief(-0.012345), '−0.0123');
  assert.equal(brief(0.00019), '0.00019');
  assert.equal(brief(12345.6), '12,346');
  assert.equal(brief(Number.NaN), '–');
  assert.equal(count(1234567), '1,234,567');
  assert.equal(percent(0.98173), '98.2 %');
  assert.equal(speedLabel(0.25), '1/4×');
  assert.equal(paceLabel(0), 'full speed');
  assert.deepEqual(span(2, 2), [0, 2.12]);
  assert.deepEqual(span(null, null), [0, 1]);
});

test('sets and states have names that differ, and a shape each', () => {
  assert.deepEqual([setName(0), setName(11), stateName(13)], ['F₁', 'F₁₂', 'q₁₃']);
  assert.equal(new Set(Array.from({ length: 8 }, (_, k) => shapePath(k))).size, 8);
  assert.equal(shapeName(9), 'square');
  for (let k = 0; k < 50; k++) assert.notEqual(freshSeed(5), 5);
});
