// @ts-check
// Lesson 1: what a formula of linear temporal logic says about an infinite word.

import { PLAIN, which, word } from '../model.js';

/** @type {import('../model.js').Lesson} */
export const reading = {
  name: 'reading-ltl',
  title: 'Reading LTL',
  aim: 'Say of a short formula and a word whether the formula holds.',
  minutes: 6,
  hide: [...PLAIN],
  words: [
    'A formula of linear temporal logic (LTL) speaks about an infinite *word*: step after step, the propositions that hold. Here `r1` means “the ball is in region 1”, `r2` “in region 2”. A word that goes on for ever is written with an end that repeats.',
    '`r1` speaks of the first step. `X r1` (next): of the step after it. `F r1` (eventually): at this step or a later one. `G r1` (always): at this step and every later one. `&`, `|`, `!` and `->` are as ever, and bind weaker than `X`, `F` and `G`.',
  ],
  steps: [
    {
      ask: '`F (r1 & F r2)`. The ball visits region 2, then region 1, and then nothing any more. Does the formula hold?',
      choices: ['Yes, both regions were visited', 'No'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2' }, word: word('r2 - r1 - (-)') },
      bears: ({ truths }) => (truths[0] ? 0 : 1),
      key: 1,
      why: 'The inner `F r2` is asked at the step where `r1` holds, and speaks of that step and the later ones. The visit to region 2 lies in the past, which these operators never look at. `F r1 & F r2` would hold.',
    },
    {
      ask: 'Region 1 is visited at the very first step and never again. Which of `F r1` and `X F r1` hold?',
      choices: ['Both', 'Only F r1', 'Only X F r1', 'Neither'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: 'F r1' }, word: word('r1 - (-)'), formulas: ['X F r1'] },
      bears: ({ truths }) => which(truths, [[true, true], [true, false], [false, true], [false, false]]),
      key: 1,
      why: '“Eventually” includes now. `X` first goes one step on, and from there region 1 is not visited again.',
    },
    {
      ask: '`G r1 -> F r2`. Region 1 is visited once, region 2 never. Does the formula hold?',
      choices: ['Yes', 'No, the visit to region 1 was not followed by one to region 2'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2', formula: 'G r1 -> F r2' }, word: word('- r1 - (-)'), formulas: ['G (r1 -> F r2)'] },
      bears: ({ truths }) => (truths[0] ? 0 : 1),
      key: 0,
      why: '`->` binds weaker than `G`, so this reads `(G r1) -> (F r2)`: *if* the ball is always in region 1, then … It is not, so nothing is promised. “Every visit to 1 is followed by one to 2” is `G (r1 -> F r2)`, which is false on this word.',
    },
  ],
};
