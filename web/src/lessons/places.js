// @ts-check
// A world of three places for the argument of Fig. 4: free ground, region 1, region 2. A deterministic policy chooses, for each frontier
// that it can see on free ground, which region to go to; what comes of it is read off the core's automaton and frontier.

import { Frame } from '../protocol.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Word} Word */
/** @typedef {import('../protocol.js').WordReading} WordReading */
/** @typedef {import('./experiments.js').Ask} Ask */

/** The frontiers that a policy may meet on free ground, as bits of the sets. */
export const FRONTIERS = Object.freeze([0b11, 0b10, 0b01]);
/** @typedef {'r1' | 'r2'} Choice */
/** @typedef {Record<number, Choice>} Policy   for each frontier that is told apart, where to go */

/** No run is longer: three places, three automaton states, four frontiers. */
const LONGEST = 40;

/**
 * The frontiers between which this product can tell.
 * @param {Description} description
 * @returns {readonly number[]}
 */
export function frontiers(description) {
  const rule = description.settings.find((s) => s.key === 'product.frontier')?.value;
  return rule?.includes('standard') ? [0b11] : FRONTIERS;
}

/** Every policy. @param {readonly number[]} told @returns {Policy[]} */
export function policies(told) {
  return Array.from({ length: 2 ** told.length }, (_, code) =>
    Object.fromEntries(told.map((t, k) => [t, /** @type {Choice} */ ((code >> k) & 1 ? 'r2' : 'r1')])));
}

/**
 * The word that a policy makes, from free ground on: letters are added until place, q and T come again.
 * @param {Ask} ask
 * @param {Description} description
 * @param {Policy} policy
 * @returns {Promise<Word>}
 */
export async function wordOf(ask, description, policy) {
  const frame = new Frame(description.layout);
  /** @type {string[][]} */
  const letters = [[]];
  /** @type {Map<string, number>} */
  const seen = new Map();
  while (letters.length < LONGEST) {
    /** @type {WordReading} */
    const reading = await ask({ kind: 'read_word', word: { letters, back: letters.length - 1 } });
    frame.at(reading.data, letters.length);
    const here = letters[letters.length - 1].join();
    const [q, t] = [frame.number('q'), frame.number('frontier')];
    const key = `${here} ${q} ${t}`;
    const before = seen.get(key);
    if (before !== undefined) return { letters, back: before + 1 };
    seen.set(key, letters.length - 1);
    letters.push(here === '' ? [policy[t] ?? policy[0b11]] : []);
  }
  throw new Error('the run does not come back to where it was');
}

/**
 * All policies with their words and whether these satisfy the formula.
 * @param {Ask} ask
 * @param {Description} description
 */
export async function tryAll(ask, description) {
  const told = frontiers(description);
  const tried = [];
  for (const policy of policies(told)) {
    const word = await wordOf(ask, description, policy);
    /** @type {WordReading} */
    const reading = await ask({ kind: 'read_word', word });
    tried.push({ policy, word, satisfied: reading.satisfied });
  }
  return { told, tried };
}

/** The sets of a frontier in words: `{F₁, F₂}`. @param {number} t */
export const frontierName = (t) => `{${[0, 1].filter((k) => (t >> k) & 1).map((k) => `F${'₁₂'[k]}`).join(', ')}}`;
