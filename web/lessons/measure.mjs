// @ts-check
// Measures every training that the lessons and the gallery speak of, as the page runs it, and writes web/src/lessons/measured.js.
// usage: node lessons/measure.mjs [NAME…]     names such as frontier/3 or one-network/broken; none: all (a quarter of an hour)

import { readFile, writeFile } from 'node:fs/promises';
import init, { Session } from '../pkg/ltl_rover.js';
import { BREAKS } from '../src/lessons/content/breaks.js';
import { LESSONS } from '../src/lessons/content/index.js';
import { RUNS, instrumentState } from '../src/lessons/experiments.js';
import { isQuestion } from '../src/lessons/model.js';

const SEEDS = [1, 2, 3];
const SLICE = 250;
const FILE = new URL('../src/lessons/measured.js', import.meta.url);

await init({ module_or_path: await readFile(new URL('../pkg/ltl_rover_bg.wasm', import.meta.url)) });

/** @type {{ name: string, state: Partial<import('../src/state.js').State>, steps: number }[]} */
const arms = [];
for (const { name, steps } of LESSONS) {
  steps.forEach((step, k) => {
    if (isQuestion(step) && step.experiment.kind === 'train') arms.push({ name: `${name}/${k + 1}`, state: step.experiment.state, steps: step.experiment.steps });
  });
}
for (const { name, broken, mended } of BREAKS) {
  for (const [kind, { state, steps }] of /** @type {const} */ ([['broken', broken], ['mended', mended]])) arms.push({ name: `${name}/${kind}`, state, steps });
}

/** @param {Partial<import('../src/state.js').State>} part @param {number} limit @param {number} seed */
function run(part, limit, seed) {
  const { task, formula, hoa, preset, set } = instrumentState(part, [], seed);
  const session = Session.open({ task, formula: formula || null, hoa: hoa || null, seed: BigInt(seed), preset: preset || null, overrides: set });
  let steps = 0;
  while (steps < limit && !session.finished) steps += session.advance(Math.min(SLICE, limit - steps));
  session.begin_evaluation(RUNS);
  while (session.advance_evaluation(1000));
  const evaluation = session.evaluation();
  const settings = session.describe().settings;
  const perfect = session.first_perfect_step ?? null;
  session.free();
  if (!evaluation) throw new Error('an evaluation was begun');
  return { steps, perfect, successes: evaluation.successes, rounds: Number(evaluation.rounds_mean.toFixed(2)), settings };
}

const { MEASURED } = await import(FILE.href).catch(() => ({ MEASURED: {} }));
/** @type {Record<string, any>} */
const known = { ...MEASURED };
/** @type {Map<string, any>} */
const made = new Map();
const wanted = process.argv.slice(2);
for (const { name, state, steps } of arms) {
  if (wanted.length > 0 && !wanted.includes(name)) continue;
  const { watch: _w, speed: _s, ...rest } = state;
  const key = JSON.stringify([rest, steps]);
  if (!made.has(key)) {
    const runs = SEEDS.map((seed) => run(state, steps, seed));
    made.set(key, {
      steps, runs: RUNS, seeds: SEEDS, successes: runs.map((r) => r.successes), rounds: runs.map((r) => r.rounds), perfect: runs.map((r) => r.perfect),
      settings: runs[0].settings.filter((s) => /^(product|training)\.|modules|n_step|hold|noise|counterfactual/.test(s.key)).map((s) => `${s.key} = ${s.value}`),
    });
  }
  known[name] = made.get(key);
  console.log(name, JSON.stringify({ ...known[name], settings: undefined }));
  const order = Object.fromEntries(arms.filter((a) => a.name in known).map((a) => [a.name, known[a.name]]));
  await writeFile(FILE, `// @ts-check
// What the trainings of the lessons and the gallery came to: written by lessons/measure.mjs, one entry an experiment, one number a seed.

/**
 * @typedef {object} Measurement
 * @property {number} steps        the most steps of training; it ends earlier when an evaluation is perfect
 * @property {number} runs         runs after the training
 * @property {number[]} seeds
 * @property {number[]} successes  of those runs, per seed
 * @property {number[]} rounds     mean rounds a run, per seed
 * @property {(number | null)[]} perfect   steps to the first perfect evaluation, per seed
 * @property {string[]} settings   the settings in force that matter
 */

/** @type {Record<string, Measurement>} */
export const MEASURED = ${JSON.stringify(order, null, 2).replace(/\[\n\s+([\d.,\snul]+?)\n\s+\]/g, (_, inner) => `[${inner.replace(/\s+/g, ' ')}]`)};
`);
}
