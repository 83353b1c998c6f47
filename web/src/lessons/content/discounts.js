// @ts-check
// Lesson 8: the two discounts r_F and γ_F.

import { word } from '../model.js';

/** @type {import('../model.js').Lesson} */
export const discounts = {
  name: 'discounts',
  title: 'The discounts r_F and γ_F',
  aim: 'Foresee what a learner does when γ_F is too small.',
  minutes: 7,
  hide: ['spec', 'compare', 'details'],
  words: [
    'A visit of an accepting set in T pays 1 − r_F and discounts all that follows by r_F. Every other step pays nothing and discounts by γ_F. So the return is at most 1, however long the run: (1 − r_F)(1 + r_F + r_F² + …) = 1.',
    'A reward k steps away is worth γ_Fᵏ of itself. As γ_F and r_F go to 1 (γ_F faster), the value of a policy becomes the probability that it satisfies the task; the paper takes r_F = 0.99, γ_F = 0.9999. The fast preset has 0.9 and 0.99.',
  ],
  steps: [
    {
      ask: 'r_F = 0.9. What does the discount γ(x′) become in a step that visits an accepting set of T?',
      choices: ['0.1', '0.9', '0.99', '1'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b1', preset: 'fast' }, word: word('(r1 - r2 -)') },
      bears: ({ discounts: [first] }) => [0.1, 0.9, 0.99, 1].findIndex((value) => Math.abs(first - value) < 1e-6),
      key: 1,
      why: 'It pays 1 − r_F = 0.1 and discounts by r_F = 0.9; the steps between discount by 0.99. Look at “reward” and “discount” below the automaton as the word is read.',
    },
    {
      ask: 'The regions are some 60 steps apart. With γ_F = 0.9 a visit there is worth 0.1 · 0.9⁶⁰ ≈ 0.0002 from here; with γ_F = 0.99 it is 0.055. Train with γ_F = 0.9 for 20 000 steps: how many of 50 runs satisfy the task, both regions visited and the ball still in the arena?',
      choices: ['None or nearly none', 'About half', 'All or nearly all'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b1', preset: 'fast', set: { 'product.discount': '0.9' }, watch: 'policy', speed: 4 }, steps: 20000 },
      bears: ({ successes, runs }) => (successes <= 0.2 * runs ? 0 : successes >= 0.8 * runs ? 2 : 1),
      key: 0,
      why: 'Such a learner looks some ten steps ahead. It may fling the ball through a region or two, but it does not see the edge of the arena coming, nor the way to the next region: what lies there is worth next to nothing from here.',
    },
    {
      ask: 'And with γ_F = 0.99, at most 30 000 steps?',
      choices: ['None or nearly none', 'About half', 'All or nearly all'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b1', preset: 'fast', set: { 'product.discount': '0.99' }, watch: 'policy', speed: 4 }, steps: 30000 },
      bears: ({ successes, runs }) => (successes <= 0.2 * runs ? 0 : successes >= 0.8 * runs ? 2 : 1),
      key: 2,
      why: 'Now the reward is felt from far away. Much closer to 1 is not simply better: all policies then look nearly alike after few steps, and learning takes longer.',
    },
  ],
};
