// @ts-check
// The "break it" gallery: four parts of the method, each taken out, beside the reason for it and the mended version.

import { word } from '../model.js';

/**
 * One side of a card: what is opened, how long it trains, and a word whose payments show the point, if one does.
 * @typedef {{ label: string, state: Partial<import('../../state.js').State>, steps: number, word?: import('../../protocol.js').Word }} Arm
 */
/**
 * @typedef {object} Break
 * @property {string} name
 * @property {string} title
 * @property {string} why       what the part is for
 * @property {string} observed  what comes of taking it out, as far as it was measured here
 * @property {Arm} broken
 * @property {Arm} mended
 */

const B1 = Object.freeze({ task: 'ball_pass_b1', preset: 'fast', watch: /** @type {const} */ ('policy'), speed: 4 });

/** @type {Break[]} */
const ALL = [
  {
    name: 'frontier-off',
    title: 'The frontier off',
    why: 'Without T the policy sees only the place and the automaton state. Back on free ground it cannot tell which region it comes from, and no deterministic policy visits both for ever.',
    observed: 'The ball settles at one region, or hovers. One run of 150 in three seeds came through both regions once, carried by its start; with the frontier nearly all went round.',
    broken: { label: 'Standard product', state: { ...B1, set: { 'product.frontier': '"standard"' } }, steps: 20000 },
    mended: { label: 'EP-MDP', state: { ...B1 }, steps: 30000 },
  },
  {
    name: 'printed-frontier',
    title: 'The frontier rule as printed',
    why: 'Equation 1 of the paper, to the letter, leaves T empty after a round; the next visit fills it again but is not paid. From the second round on F₁ pays never again, and with a single accepting set nothing is ever paid twice.',
    observed: 'Of the four visits in a word the printed rule pays one, the refilling rule all. Trained on `G F r1` for 16 000 steps, the printed version went to region 1 some 5 to 8 times a run, for want of a reason to return, and often lost the ball; the refilling one 20 to 160 times. On `G F r1 & G F r2` the printed rule still learns, since F₂ goes on paying once a round.',
    broken: { label: 'Printed rule', state: { ...B1, formula: 'G F r1', set: { 'product.frontier': '"printed"' } }, steps: 16000, word: word('r1 - r1 - r1 - (r1 -)') },
    mended: { label: 'Refilling rule', state: { ...B1, formula: 'G F r1' }, steps: 16000, word: word('r1 - r1 - r1 - (r1 -)') },
  },
  {
    name: 'sparse-reward',
    title: 'Sparse reward',
    why: 'The reward lies behind a visit that is hardly ever made by chance: the ball starts at its home every time, gravity pulls, and plain noise pushes it to and fro on the spot. Starts anywhere and held exploratory actions bring the first visits.',
    observed: 'No run succeeded in any of three seeds; with starts anywhere and held actions nearly all did.',
    broken: { label: 'Start at home, plain noise', state: { ...B1, set: { 'training.start': '"initial"', 'learner.exploration.hold_probability': '0.0' } }, steps: 20000 },
    mended: { label: 'Starts anywhere, held actions', state: { ...B1 }, steps: 30000 },
  },
  {
    name: 'one-network',
    title: 'One network for all states',
    why: 'One actor and one critic serve every automaton state, with q and T as further inputs (the paper’s “standard DDPG”). What is learned in one state can disturb what was learned in another; separate modules cannot disturb each other.',
    observed: 'It does not break here. With the returns of ten steps and the counterfactual samples of the fast preset one network learned this task in every seed, and was perfect sooner than the separate modules. The paper reports otherwise for its own recipe. A task with two regions is small; do not take this card for a proof of either.',
    broken: { label: 'One network', state: { ...B1, set: { 'learner.modules': '"one"' } }, steps: 30000 },
    mended: { label: 'A module per state', state: { ...B1 }, steps: 30000 },
  },
];

/** The cards in their order. @type {readonly Break[]} */
export const BREAKS = Object.freeze(ALL);
