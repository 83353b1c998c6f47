// @ts-check
// What a lesson is made of: words to read, and questions that are answered, run and explained. Plain data; nothing here touches the page.

/** @typedef {import('../state.js').State} State */
/** @typedef {import('../protocol.js').Word} Word */

/**
 * What a question is about, and how the instrument answers it.
 * @typedef {{ kind: 'word', state: Partial<State>, word: Word, formulas?: string[] }} WordExperiment
 *   an infinite word, read by the automaton of `state`; `formulas` are judged on it besides
 * @typedef {{ kind: 'automaton', state: Partial<State> }} AutomatonExperiment   the automaton of `state`, looked at
 * @typedef {{ kind: 'policies', state: Partial<State> }} PoliciesExperiment     every deterministic policy of a world of three places
 * @typedef {{ kind: 'train', state: Partial<State>, steps: number }} TrainExperiment   training for so many steps or until it is perfect, then 50 runs
 * @typedef {{ kind: 'episode', state: Partial<State> }} EpisodeExperiment       one greedy episode of what `state` watches
 * @typedef {WordExperiment | AutomatonExperiment | PoliciesExperiment | TrainExperiment | EpisodeExperiment} Experiment
 */

/**
 * What came out of an experiment, as numbers that the sentences of a lesson are made of.
 * @typedef {object} Outcome
 * @property {boolean[]} truths       word: the formula of the instrument, then each of `formulas`
 * @property {boolean} runAccepting   word: whether the run with the word's own ε-jumps is accepting
 * @property {number[]} states        word: the automaton state after each letter, in order; jumps do not count
 * @property {number[]} paid          word: R(x′) of each letter
 * @property {number[]} rewards       word: R′, shaping included, of each letter
 * @property {number[]} discounts     word: γ(x′) of each letter
 * @property {boolean[]} sinks        word: whether a sink is reached by each letter
 * @property {number} rounds          word: rounds closed when the run repeats itself; episode: rounds; training: mean of the runs
 * @property {number} automatonStates
 * @property {number} sets
 * @property {number} policies        policies: how many there are
 * @property {number} satisfying      policies: how many of them satisfy the formula
 * @property {number} steps           training: environment steps; episode: its steps
 * @property {number | null} perfect  training: steps to the first evaluation without a failure
 * @property {number} successes       training: of `runs`
 * @property {number} runs
 * @property {boolean} ended          episode: whether it ended in a sink or out of the world
 * @property {string} words           what was seen, in a sentence
 */

/**
 * A question: the student commits to a choice, runs the experiment, and reads which choice the outcome bears out.
 * @typedef {object} Question
 * @property {string} ask
 * @property {string[]} choices
 * @property {Experiment} experiment
 * @property {(outcome: Outcome) => number} bears   the position of the choice that the outcome bears out
 * @property {number} key       the position that is expected; where nothing is drawn at random, tests hold `bears` against it
 * @property {string} why       read after the run
 */

/**
 * Something to try without a question.
 * @typedef {{ try: string, button: string, state: Partial<State> }} Trial
 */

/**
 * @typedef {object} Lesson
 * @property {string} name      as in the address
 * @property {string} title
 * @property {string} aim       a sentence: what one can do afterwards
 * @property {number} minutes
 * @property {string[]} words   paragraphs; `…` is code, *…* is stressed
 * @property {(Question | Trial)[]} steps
 * @property {string[]} hide    panels that are of no use to it
 */

/** What no lesson needs to look at. */
export const PLAIN = Object.freeze(['spec', 'training', 'compare', 'details']);

/** @param {Question | Trial} step @returns {step is Question} */
export const isQuestion = (step) => 'ask' in step;

/**
 * A word in short: letters apart by blanks, `-` where nothing holds, `a+b` for both, the part that repeats in parentheses.
 * @param {string} text
 * @param {[number, number][]} [jumps]
 * @returns {Word}
 */
export function word(text, jumps) {
  const parts = text.trim().split(/\s+/);
  const back = parts.findIndex((part) => part.startsWith('('));
  if (back < 0 || !text.trim().endsWith(')')) throw new Error(`"${text}" has no part in parentheses at its end`);
  const letters = parts.map((part) => part.replace(/[()]/g, '')).map((part) => (part === '-' ? [] : part.split('+')));
  return jumps ? { letters, back, jumps } : { letters, back };
}

/**
 * A choice of "which of these hold": the position of the first entry of `table` that equals `truths`.
 * @param {boolean[]} truths
 * @param {boolean[][]} table
 */
export const which = (truths, table) => table.findIndex((row) => row.every((value, k) => value === truths[k]));
