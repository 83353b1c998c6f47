// @ts-check
// Lesson 3: until with and without the promise that the second operand comes.

import { PLAIN, which, word } from '../model.js';

/** @type {import('../model.js').Lesson} */
export const until = {
  name: 'until',
  title: 'Weak and strong until',
  aim: 'Choose between U and W, and foresee what a learner makes of each.',
  minutes: 5,
  hide: [...PLAIN],
  words: [
    '`!r2 U r1`: not region 2 until region 1, *and region 1 does come*. `!r2 W r1` (weak until): the same, or never region 2 at all.',
    '`φ W ψ` is `(φ U ψ) | G φ`. A *sink* of the automaton (dashed) is a state from which nothing can be accepted any more.',
  ],
  steps: [
    {
      ask: 'The ball hovers for ever and visits nothing. Which of `!r2 U r1` and `!r2 W r1` hold?',
      choices: ['Both', 'Only the strong one, U', 'Only the weak one, W', 'Neither'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: '!r2 U r1' }, word: word('- (-)'), formulas: ['!r2 W r1'] },
      bears: ({ truths }) => which(truths, [[true, true], [true, false], [false, true], [false, false]]),
      key: 2,
      why: '`U` promises that region 1 comes; here it never does. `W` is content with waiting.',
    },
    {
      ask: 'First region 1, and from then on region 2 again and again. Which hold?',
      choices: ['Both', 'Only the strong one, U', 'Only the weak one, W', 'Neither'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: '!r2 U r1' }, word: word('- r1 (r2 -)'), formulas: ['!r2 W r1'] },
      bears: ({ truths }) => which(truths, [[true, true], [true, false], [false, true], [false, false]]),
      key: 0,
      why: 'Once region 1 has been visited, neither formula asks for anything more: region 2 is free.',
    },
    {
      ask: 'A learner is paid when accepting sets are visited. Under `!r2 W r1`, are steps paid in which the ball visits nothing?',
      choices: ['No, there is nothing to be paid for', 'Yes, every one of them'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: '!r2 W r1' }, word: word('- - (-)') },
      bears: ({ paid }) => (paid.every((p) => p > 0) ? 1 : 0),
      key: 1,
      why: 'Waiting satisfies the weak formula, so it is accepting from the first step on, and a learner has no reason to look for region 1. If region 1 is wanted, write `U`.',
    },
  ],
};
