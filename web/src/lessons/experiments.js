// @ts-check
// From what the instrument answers to the numbers of an outcome, and the sentence that says what was seen.

import { brief } from '../dom.js';
import { setName, stateName } from '../palette.js';
import { END, Frame } from '../protocol.js';
import { initialState } from '../state.js';

/** @typedef {import('../protocol.js').Command} Command */
/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').WordReading} WordReading */
/** @typedef {import('../state.js').State} State */
/** @typedef {import('./model.js').Experiment} Experiment */
/** @typedef {import('./model.js').Outcome} Outcome */
/** @typedef {(command: Command) => Promise<any>} Ask */

/** The runs after a training. */
export const RUNS = 50;

/** @type {Outcome} */
const NOTHING = Object.freeze({
  truths: [], runAccepting: false, states: [], paid: [], rewards: [], discounts: [], sinks: [], rounds: 0, automatonStates: 0, sets: 0, policies: 0, satisfying: 0,
  steps: 0, perfect: null, successes: 0, runs: 0, ended: false, words: '',
});

/**
 * The state of the instrument for an experiment or a trial of a lesson.
 * @param {Partial<State>} state
 * @param {readonly string[]} hide   panels hidden by the lesson
 * @param {number | null} seed       the teacher's seed
 * @returns {State}
 */
export function instrumentState(state, hide, seed) {
  return { ...initialState(), watch: 'policy', ...state, hide: [...hide], ...(seed === null ? {} : { seed }) };
}

/**
 * @param {Description} description
 * @param {WordReading} reading
 * @param {number} letters
 * @param {{ formula: string, holds: boolean }[]} others   further formulas judged on the word
 * @returns {Outcome}
 */
export function wordOutcome(description, reading, letters, others) {
  const frame = new Frame(description.layout);
  const rows = Array.from({ length: letters }, (_, k) => reading.positions.indexOf(k));
  const column = (/** @type {string} */ name) => rows.map((row) => frame.at(reading.data, row).number(name));
  const holds = (/** @type {boolean} */ yes) => (yes ? 'holds' : 'does not hold');
  const verdicts = [{ formula: description.formula.text, holds: reading.satisfied }, ...others];
  const words = verdicts.map((v) => `\`${v.formula}\` ${holds(v.holds)} on this word.`);
  const jumped = description.automaton.edges.some((edge) => edge.kind === 'epsilon');
  if (jumped) words.push(reading.run_accepting ? 'This run is accepting.' : 'This run is not accepting.');
  const [rewards, discounts] = [column('reward'), column('discount')];
  const list = (/** @type {number[]} */ numbers) => numbers.map((x) => (Math.abs(x) < 1e-9 ? '0' : brief(x))).join(', ');
  if (rewards.some((r) => Math.abs(r) > 1e-9)) words.push(`Its letters pay ${list(rewards)} and discount what follows by ${list(discounts)}.`);
  return {
    ...NOTHING,
    truths: verdicts.map((v) => v.holds),
    runAccepting: reading.run_accepting,
    states: column('q'),
    paid: column('accepting_reward'),
    rewards,
    discounts,
    sinks: column('q').map((q) => description.automaton.states[q].sink),
    rounds: frame.at(reading.data, reading.rows - 1).number('rounds'),
    automatonStates: description.automaton.states.length,
    sets: description.automaton.sets,
    words: words.join(' '),
  };
}

/** @param {Description} description @returns {Outcome} */
export function automatonOutcome({ automaton }) {
  const states = automaton.states.filter((s) => s.reachable);
  const sets = Array.from({ length: automaton.sets }, (_, k) => setName(k)).join(', ');
  const words = `The automaton has ${states.length} states (${states.map((s) => stateName(s.id)).join(', ')}) and ${automaton.sets === 1 ? 'one accepting set' : `the accepting sets ${sets}`}.`;
  return { ...NOTHING, automatonStates: states.length, sets: automaton.sets, words };
}

/**
 * What a training and the runs after it have shown.
 * @param {number} steps
 * @param {number | null} perfect
 * @param {import('../protocol.js').EvaluationProgress} evaluation
 * @returns {Outcome}
 */
export function trainOutcome(steps, perfect, { successes, runs, rounds_mean, sink_rate }) {
  const after = perfect === null ? `After ${steps.toLocaleString('en')} steps of training` : `Training was perfect in an evaluation after ${perfect.toLocaleString('en')} steps; then`;
  const words = `${after}, ${successes} of ${runs} runs satisfy the task, with ${rounds_mean.toFixed(1)} rounds a run on average.`
    + (sink_rate > 0 ? ` ${Math.round(100 * sink_rate)} % of the runs ended early, in a sink or out of the world.` : '');
  return { ...NOTHING, steps, perfect, successes, runs, rounds: rounds_mean, words };
}

/**
 * What an episode has shown.
 * @param {Description} description
 * @param {import('../protocol.js').Episode} episode
 * @returns {Outcome}
 */
export function episodeOutcome({ layout }, episode) {
  const frame = new Frame(layout).at(episode.data, episode.rows - 1);
  const ended = frame.number('end') === END.terminated;
  const steps = frame.number('episode_step');
  const words = `The episode ended after ${steps} steps, ${ended ? 'before its time' : 'at the time limit'}, with ${episode.rounds} ${episode.rounds === 1 ? 'round' : 'rounds'} closed.`;
  return { ...NOTHING, rounds: episode.rounds, ended, steps, words };
}
