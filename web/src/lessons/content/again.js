// @ts-check
// Lesson 2: once, again and again, and for ever from some step on.

import { PLAIN, which, word } from '../model.js';

/** @type {import('../model.js').Lesson} */
export const again = {
  name: 'f-and-gf',
  title: 'F against GF',
  aim: 'Tell “at least once” from “again and again” and from “from some step on for ever”.',
  minutes: 5,
  hide: [...PLAIN],
  words: [
    '`F r1` asks for one visit. `G F r1` asks, at *every* step, for a visit still to come: infinitely many. `F G r1` asks for a step from which on region 1 is never left again.',
    'A robot that patrols has a task of the form `G F …`: it is never done. A task of the form `F …` can be done and forgotten.',
  ],
  steps: [
    {
      ask: 'Region 1 is visited twice, and then never again. Which formulas hold?',
      choices: ['Only F r1', 'F r1 and G F r1', 'All three: F r1, G F r1, F G r1', 'None'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: 'G F r1' }, word: word('- r1 - r1 - (-)'), formulas: ['F r1', 'F G r1'] },
      bears: ({ truths: [gf, f, fg] }) => which([f, gf, fg], [[true, false, false], [true, true, false], [true, true, true], [false, false, false]]),
      key: 0,
      why: 'Twice is finitely often, and so is a million times. After the last visit `F r1` is false, and `G F r1` wants it true at every step.',
    },
    {
      ask: 'Region 1 at every second step, for ever. Which formulas hold?',
      choices: ['Only F r1', 'F r1 and G F r1', 'All three: F r1, G F r1, F G r1', 'Only G F r1'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: 'G F r1' }, word: word('(r1 -)'), formulas: ['F r1', 'F G r1'] },
      bears: ({ truths: [gf, f, fg] }) => which([f, gf, fg], [[true, false, false], [true, true, false], [true, true, true], [false, true, false]]),
      key: 1,
      why: 'There is always a next visit, so `G F r1` holds, and with it `F r1`. But region 1 is left again and again, so there is no step from which on it holds for ever.',
    },
    {
      ask: 'A trained policy for `G F r1 & G F r2` now plays the 200 steps of an episode. How often will it have visited both regions (a *round*) in the end?',
      choices: ['Never', 'Once: then the task is done', 'Twice or more'],
      experiment: { kind: 'episode', state: { task: 'ball_pass_b1', watch: 'trained', speed: 8 } },
      bears: ({ rounds }) => Math.min(rounds, 2),
      key: 2,
      why: 'The reward comes anew with each round, so a policy that went round once has every reason to go on. No finite episode proves `G F …`: what can be measured is how many rounds are closed in the time there is.',
    },
  ],
};
