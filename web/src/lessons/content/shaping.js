// @ts-check
// Lesson 7: shaping: what it pays, and what it cannot pay for.

import { word } from '../model.js';

const PAPER = '{ kind = "paper", weight = 1.0 }';
const FAR = { 'training.start': '"initial"', 'learner.exploration.hold_probability': '0.0' };

/** @type {import('../model.js').Lesson} */
export const shaping = {
  name: 'shaping',
  title: 'Shaping on and off',
  aim: 'Work out the reward of a step with shaping, and say what shaping cannot do.',
  minutes: 8,
  hide: ['spec', 'compare', 'details'],
  words: [
    'For `F (r1 & F r2)` the reward comes when the whole task is done, and not before. *Shaping* adds a potential: Φ is 1 − r_F while the automaton is in a state not yet visited in this round (those in T_Φ), else 0. A step from x to x′ then pays R(x′) + γ(x′)·Φ(x′) − Φ(x).',
    'Here r_F = 0.9 and γ_F = 0.99. The box “Reward of this step” below the automaton shows the three terms.',
  ],
  steps: [
    {
      ask: 'Without shaping. The word visits region 1, then region 2. Is the visit to region 1 paid?',
      choices: ['Yes', 'No'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', preset: 'fast', set: { 'product.shaping': '{ kind = "none" }' } }, word: word('- r1 - r2 (-)') },
      bears: ({ rewards }) => (rewards[1] > 0 ? 0 : 1),
      key: 1,
      why: 'Half of the task is done, and the learner hears nothing of it until region 2 is reached as well.',
    },
    {
      ask: 'With shaping, the same word. What does the visit to region 1 pay?',
      choices: ['0', '0.099', '0.1', '0.9'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', preset: 'fast', set: { 'product.shaping': PAPER } }, word: word('- r1 - r2 (-)') },
      bears: ({ rewards }) => [0, 0.099, 0.1, 0.9].findIndex((value) => Math.abs(rewards[1] - value) < 5e-5),
      key: 1,
      why: 'R(x′) = 0, Φ(x′) = 1 − r_F = 0.1 because q1 is visited for the first time, Φ(x) = 0: that makes γ_F · 0.1 = 0.099. The next step pays nothing more, for q1 has left T_Φ.',
    },
    {
      ask: 'A hard start: the ball always begins at its home, and exploration is plain noise (no held actions). Region 1 is hardly ever found by chance. Does shaping rescue the learner within 15 000 steps?',
      choices: ['Yes, nearly all of 50 runs succeed', 'Partly', 'No, none or nearly none'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b2', preset: 'fast', set: { 'product.shaping': PAPER, ...FAR }, watch: 'policy', speed: 4 }, steps: 15000 },
      bears: ({ successes, runs }) => (successes >= 0.8 * runs ? 0 : successes > 0.2 * runs ? 1 : 2),
      key: 2,
      why: 'Shaping of this kind pays for the first visit of an automaton state. It shortens the way to the reward, but it cannot point to a region that was never visited: finding it is a matter of exploration.',
    },
    {
      ask: 'The mend: starts anywhere and held exploratory actions, at most 30 000 steps.',
      choices: ['Nearly all of 50 runs succeed', 'Some do', 'None or nearly none'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b2', preset: 'fast', watch: 'policy', speed: 4 }, steps: 30000 },
      bears: ({ successes, runs }) => (successes >= 0.8 * runs ? 0 : successes > 0.2 * runs ? 1 : 2),
      key: 0,
      why: 'Held actions carry the ball far, and starts all over the arena make the first visits likely. On a task as short as this, exploration matters more than shaping.',
    },
  ],
};
