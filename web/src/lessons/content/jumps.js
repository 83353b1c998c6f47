// @ts-check
// Lesson 10: ε-moves: a promise that the policy makes.

import { PLAIN, word } from '../model.js';

/** `F G r1 | F G r2`: wait in q0, or promise to stay in one of the regions. */
export const PROMISE = `HOA: v1
name: "F G r1 | F G r2"
States: 3
Start: 0
AP: 2 "r1" "r2"
acc-name: Buchi
Acceptance: 1 Inf(0)
--BODY--
State: 0 "no promise yet"
[t] 0
1
2
State: 1 "r1 for ever" {0}
[0] 1
State: 2 "r2 for ever" {0}
[1] 2
--END--
`;

const OWN = Object.freeze({ task: 'ball_pass_b1', formula: 'F G r1 | F G r2', hoa: PROMISE });

/** @type {import('../model.js').Lesson} */
export const jumps = {
  name: 'epsilon-moves',
  title: 'ε-moves',
  aim: 'Say what an ε-move promises, and what a broken promise costs.',
  minutes: 6,
  hide: [...PLAIN],
  words: [
    '`F G r1 | F G r2`: from some step on, the ball stays in one region for ever. *When* that step has come no automaton can see in the past. So it waits in q0, and at any moment it may jump along an *ε-move* (dashed): no time passes and no letter is read.',
    'A jump is a promise: “from now on region 1 for ever”. Only the states behind the jumps are accepting, and a letter that breaks the promise leads into the sink. In the product, the ε-moves are actions like any other: the policy chooses them.',
  ],
  steps: [
    {
      ask: 'The ball enters region 1 at step 1 and stays there. The run never jumps. Is it accepting?',
      choices: ['Yes, the formula holds on this word', 'No'],
      experiment: { kind: 'word', state: OWN, word: word('r2 r1 (r1)') },
      bears: ({ runAccepting }) => (runAccepting ? 0 : 1),
      key: 1,
      why: 'The word satisfies the formula and another run accepts it, but this one waits in q0 for ever and is never paid. Somebody has to make the promise.',
    },
    {
      ask: 'The same word. The run promises region 1 straight away, before the first letter. And now?',
      choices: ['It is accepting', 'It ends in the sink'],
      experiment: { kind: 'word', state: OWN, word: word('r2 r1 (r1)', [[0, 1]]) },
      bears: ({ runAccepting }) => (runAccepting ? 0 : 1),
      key: 1,
      why: 'The first letter is r2: the promise is broken at once, and there is no way back, though the word itself is a good one. Too early is too late.',
    },
    {
      ask: 'The run promises region 1 before the second letter (step 1). And now?',
      choices: ['It is accepting', 'It ends in the sink', 'Neither'],
      experiment: { kind: 'word', state: OWN, word: word('r2 r1 (r1)', [[1, 1]]) },
      bears: ({ runAccepting, sinks }) => (runAccepting ? 0 : sinks.some(Boolean) ? 1 : 2),
      key: 0,
      why: 'From here on region 1 always holds. Jumping later would do as well; each step of waiting only puts the reward off. That is what a learner finds out by its values.',
    },
    {
      try: 'Drive, and make the promise yourself with the buttons below the frontier. Then try to keep it: gravity is against you.',
      button: 'Drive',
      state: { ...OWN, watch: 'drive', speed: 0.5 },
    },
  ],
};
