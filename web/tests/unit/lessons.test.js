// @ts-check
// What the lessons claim, held against the core: every word is read, every automaton counted, every policy tried, every setting opened.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { before, test } from 'node:test';
import init, { Session, check_formula, judge_word } from '../../pkg/ltl_rover.js';
import { LOCKS, PARTS, readAddress } from '../../src/lessons/address.js';
import { LESSONS, lesson } from '../../src/lessons/content/index.js';
import { BREAKS } from '../../src/lessons/content/breaks.js';
import { automatonOutcome, episodeOutcome, instrumentState, wordOutcome } from '../../src/lessons/experiments.js';
import { MEASURED } from '../../src/lessons/measured.js';
import { isQuestion, word } from '../../src/lessons/model.js';
import { tryAll } from '../../src/lessons/places.js';
import { pieces } from '../../src/lessons/prose.js';
import { PANELS, readHash, writeHash } from '../../src/state.js';

const at = (/** @type {string} */ path) => new URL(path, import.meta.url);

before(async () => {
  await init({ module_or_path: await readFile(at('../../pkg/ltl_rover_bg.wasm')) });
});

/** @param {Partial<import('../../src/state.js').State>} part */
function open(part) {
  const { task, formula, hoa, seed, preset, set } = instrumentState(part, [], 1);
  return Session.open({ task, formula: formula || null, hoa: hoa || null, seed: BigInt(seed), preset: preset || null, overrides: set });
}

/** The outcome of a question, where nothing has to be trained for it. @param {import('../../src/lessons/model.js').Experiment} experiment */
async function outcome(experiment) {
  const session = open(experiment.state);
  const description = session.describe();
  switch (experiment.kind) {
    case 'word': {
      const others = (experiment.formulas ?? []).map((formula) => ({ formula, holds: judge_word(formula, experiment.word) }));
      return wordOutcome(description, session.read_word(experiment.word), experiment.word.letters.length, others);
    }
    case 'automaton':
      return automatonOutcome(description);
    case 'policies': {
      const { tried } = await tryAll(async (command) => command.kind === 'read_word' && session.read_word(command.word), description);
      return { ...automatonOutcome(description), policies: tried.length, satisfying: tried.filter((t) => t.satisfied).length };
    }
    case 'episode': {
      const trained = experiment.state.watch === 'trained';
      const policy = trained ? Session.restore(await readFile(at(`../../../assets/policies/${experiment.state.task}.safetensors`))) : session;
      return episodeOutcome(description, policy.rollout(0n));
    }
    case 'train':
      return null;
  }
}

for (const { name, title, steps, hide, words, aim } of LESSONS) {
  test(`lesson “${title}”: the core bears out every answer of its key`, async () => {
    assert.ok(steps.filter(isQuestion).length >= 2, 'a lesson asks');
    assert.ok(hide.every((panel) => PANELS.includes(panel)));
    assert.ok([...words, aim].join(' ').split(/\s+/).length < 190, 'one screen of words');
    for (const step of steps) {
      if (!isQuestion(step)) {
        assert.ok(open(step.state).describe().modules.length > 0);
        continue;
      }
      assert.ok(step.key >= 0 && step.key < step.choices.length, step.ask);
      const found = await outcome(step.experiment);
      if (found === null) assert.ok(open(step.experiment.state).advance(8) > 0, step.ask);
      else assert.equal(step.bears(found), step.key, `${name}: ${step.ask}\n${found.words}`);
    }
  });
}

test('truth and automaton agree on every word of the lessons, and each formula in the words can be read', async () => {
  for (const { words, steps } of LESSONS) {
    for (const step of steps.filter(isQuestion)) {
      if (step.experiment.kind !== 'word') continue;
      const { satisfied, accepted } = open(step.experiment.state).read_word(step.experiment.word);
      assert.equal(satisfied, accepted, step.ask);
    }
    const texts = [...words, ...steps.flatMap((step) => (isQuestion(step) ? [step.ask, step.why] : [step.try]))];
    for (const { text, kind } of texts.flatMap(pieces)) {
      if (kind === 'code' && !/…|φ|^(unsafe|&|\||!|->|[XFGUW])$/.test(text)) assert.equal(check_formula(text, []).ok, true, text);
    }
  }
});

test('a question after training is decided by its numbers, whichever way they come out', () => {
  for (const { steps } of LESSONS) {
    for (const step of steps.filter(isQuestion)) {
      if (step.experiment.kind !== 'train') continue;
      const from = (/** @type {number} */ successes) => step.bears({ ...automatonOutcomeOfNothing, successes, runs: 50 });
      assert.deepEqual([from(0), from(25), from(50)].sort(), [0, 1, 2], step.ask);
    }
  }
});
/** @type {import('../../src/lessons/model.js').Outcome} */
const automatonOutcomeOfNothing = { truths: [], runAccepting: false, states: [], paid: [], rewards: [], discounts: [], sinks: [], rounds: 0, automatonStates: 0, sets: 0, policies: 0, satisfying: 0, steps: 0, perfect: null, successes: 0, runs: 0, ended: false, words: '' };

test('what is said of a training is what was measured', () => {
  for (const { name, steps } of LESSONS) {
    steps.forEach((step, k) => {
      if (!isQuestion(step) || step.experiment.kind !== 'train') return;
      const measured = MEASURED[`${name}/${k + 1}`];
      assert.ok(measured, `${name}, step ${k + 1} has not been measured: node lessons/measure.mjs`);
      assert.equal(measured.steps, step.experiment.steps);
      const votes = measured.successes.map((successes) => step.bears({ ...automatonOutcomeOfNothing, successes, runs: measured.runs }));
      assert.ok(votes.filter((vote) => vote === step.key).length * 2 > votes.length, `${name}, step ${k + 1}: the key is what most seeds show`);
    });
  }
});

test('the gallery opens each break and its mend, and says what was measured of both', () => {
  assert.deepEqual(BREAKS.map((b) => b.name), ['frontier-off', 'printed-frontier', 'sparse-reward', 'one-network']);
  for (const { name, broken, mended } of BREAKS) {
    for (const [kind, arm] of /** @type {const} */ ([['broken', broken], ['mended', mended]])) {
      assert.ok(open(arm.state).advance(4) > 0);
      assert.equal(MEASURED[`${name}/${kind}`]?.steps, arm.steps, `${name}, ${kind} has not been measured: node lessons/measure.mjs`);
      const { state, problems } = readHash(writeHash(instrumentState(arm.state, [], 1)));
      assert.deepEqual(problems, []);
      assert.deepEqual(state.set, arm.state.set ?? {});
    }
  }
});

test('words in short are read as they are meant', () => {
  assert.deepEqual(word('- a (b+c -)'), { letters: [[], ['a'], ['b', 'c'], []], back: 2 });
  assert.deepEqual(word('(a)', [[0, 1]]), { letters: [['a']], back: 0, jumps: [[0, 1]] });
  assert.throws(() => word('a b'), /parentheses/);
});

test('an address is read, and what is wrong in it is told', () => {
  const { address, problems } = readAddress('?lesson=until&step=2&seed=7&hide=files,share&lock=seed,task&utm=x');
  assert.deepEqual(problems, []);
  assert.deepEqual([address.lesson, address.step, address.seed, address.hide, address.lock], ['until', 2, 7, ['files', 'share'], ['seed', 'task']]);
  assert.deepEqual(readAddress('?lock=all').address.lock, Object.keys(LOCKS));
  assert.deepEqual(readAddress('?worksheet=all&key=1').address, { ...readAddress('').address, worksheet: 'all', key: true });
  const bad = readAddress('?lesson=<b>&step=0&seed=-1&hide=toString&lock=x&key=2&worksheet=none');
  assert.deepEqual(bad.problems.map((p) => p.property), ['lesson', 'step', 'seed', 'hide', 'lock', 'key', 'worksheet']);
  assert.deepEqual(bad.address, readAddress('').address);
  assert.equal(readAddress(`?lesson=${'x'.repeat(3000)}`).problems.length, 1);
});

test('every part and lock of an address is in the page', async () => {
  const html = await readFile(at('../../index.html'), 'utf8');
  const made = ['lessons-open'];
  for (const selector of [...Object.values(PARTS), ...Object.values(LOCKS)]) {
    for (const id of selector.match(/#[a-z-]+/g) ?? []) assert.ok(html.includes(`id="${id.slice(1)}"`) || made.includes(id.slice(1)), `${selector} is in the page`);
  }
});

test('the teaching guide names every lesson and parameter, and every address in it can be read', async () => {
  const guide = await readFile(at('../../../docs/teaching.md'), 'utf8');
  const links = guide.match(/\?(?:lesson|worksheet|gallery|hide|lock|seed|step)[^\s)`|"]*/g) ?? [];
  assert.ok(links.length > 20);
  for (const link of links) {
    const url = new URL(link, 'http://localhost/');
    assert.deepEqual(readAddress(url.search).problems, [], link);
    assert.deepEqual(readHash(url.hash).problems, [], link);
  }
  for (const { name } of LESSONS) assert.ok(guide.includes(`?lesson=${name}`) && guide.includes(`?worksheet=${name}`), name);
  for (const name of [...Object.keys(PARTS), ...Object.keys(LOCKS)]) assert.ok(guide.includes(`\`${name}\``), `the guide names ${name}`);
  assert.equal(lesson('until')?.title, 'Weak and strong until');
});
