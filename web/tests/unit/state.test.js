// @ts-check
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MAX_HOA_IN_LINK, PROPERTIES, initialState, readHash, writeHash } from '../../src/state.js';

test('the default state needs no hash, and an empty hash gives it', () => {
  assert.equal(writeHash(initialState()), '');
  assert.deepEqual(readHash(''), { state: initialState(), problems: [] });
});

test('every property comes back from the hash as it was written', () => {
  /** @type {import('../../src/state.js').State} */
  const state = {
    task: 'cart_pole_c1', formula: 'G F green & G !unsafe | "a=b" & ✓', hoa: 'HOA: v1\nStates: 1\n--BODY--\n', map: 'kept.0123-_', preset: 'paper', seed: Number.MAX_SAFE_INTEGER,
    set: { 'algorithm.n_step': '5', 'reward.r_f': '0.9' }, watch: 'training', speed: 0.25, pace: 20, layers: ['labels', 'value'], hide: ['spec', 'curves'],
  };
  for (const key of Object.keys(PROPERTIES)) assert.notDeepEqual(Reflect.get(state, key), Reflect.get(initialState(), key), `${key} is tested with another value than its default`);
  assert.deepEqual(readHash(writeHash(state)), { state, problems: [] });
});

/** Hostile or broken hashes, and the property whose problem is reported. @type {[string, string][]} */
const WRONG = [
  ['#seed=-1', 'seed'], ['#seed=1e9', 'seed'], ['#seed=9007199254740992', 'seed'], ['#seed=', 'seed'], ['#seed=0x10', 'seed'],
  ['#task=<script>', 'task'], [`#task=${'a'.repeat(65)}`, 'task'], [`#formula=${'a'.repeat(2001)}`, 'formula'], [`#hoa=${'a'.repeat(MAX_HOA_IN_LINK + 1)}`, 'hoa'],
  ['#watch=everything', 'watch'], ['#speed=3', 'speed'], ['#pace=-5', 'pace'], ['#hide=spec,world', 'hide'], ['#set=__proto__', 'set'], ['#set=a.b;c=1', 'set'],
  ['#nonsense=1', 'nonsense'], ['#seed=1&seed=2', 'seed'], [`#${'x'.repeat(20001)}`, 'link'],
];
for (const [hash, property] of WRONG) {
  test(`a wrong link is reported and the default kept: ${hash.slice(0, 40)}`, () => {
    const { state, problems } = readHash(hash);
    assert.equal(problems.length, 1);
    assert.equal(problems[0].property, property);
    assert.ok(problems[0].message.length > 10);
    if (hash !== '#seed=1&seed=2') assert.deepEqual(state, initialState());
  });
}

test('a prototype key of overrides stays a plain key or is refused', () => {
  const { state, problems } = readHash('#set=__proto__=1');
  assert.equal(Object.getPrototypeOf(state.set), Object.prototype);
  assert.ok(problems.length === 1 || Object.keys(state.set).length <= 1);
});

test('random text never throws and never yields a value outside the table', () => {
  let seed = 12345;
  const next = () => (seed = (seed * 1103515245 + 12345) & 0x7fffffff);
  const letters = '#&=%;,.<>"\'aseedtaskspeedwatch0123456789é€\u0000';
  for (let k = 0; k < 2000; k++) {
    const text = Array.from({ length: next() % 60 }, () => letters[next() % letters.length]).join('');
    const { state } = readHash(`#${text}`);
    assert.ok(Number.isSafeInteger(state.seed) && state.seed >= 0);
    assert.ok(['trained', 'policy', 'best', 'training', 'drive'].includes(state.watch));
    assert.deepEqual(readHash(writeHash(state)).state, state);
  }
});
