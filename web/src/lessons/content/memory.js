// @ts-check
// Lesson 4: what the states of an automaton remember, and what they forget.

import { PLAIN, word } from '../model.js';

/** `F r1 & F r2`, a state for each thing that may still be to be done. */
export const EITHER_ORDER = `HOA: v1
name: "F r1 & F r2"
States: 4
Start: 0
AP: 2 "r1" "r2"
acc-name: Buchi
Acceptance: 1 Inf(0)
properties: trans-labels explicit-labels state-acc deterministic complete terminal
--BODY--
State: 0 "both to come"
[!0&!1] 0
[0&!1] 1
[!0&1] 2
[0&1] 3
State: 1 "r2 to come"
[!1] 1
[1] 3
State: 2 "r1 to come"
[!0] 2
[0] 3
State: 3 "done" {0}
[t] 3
--END--
`;

/** @type {import('../model.js').Lesson} */
export const memory = {
  name: 'memory',
  title: 'What a state remembers',
  aim: 'Read a state of the automaton as “what is still to be done”.',
  minutes: 5,
  hide: [...PLAIN],
  words: [
    'The automaton reads one letter a step: the propositions that hold there. Its state is all that is remembered of the past, and it remembers just as much as the task needs.',
    'That is why the learner has one *module* per state, an actor and a critic of its own: the same place in the world asks for different actions when different things are still to be done.',
  ],
  steps: [
    {
      ask: '`F (r1 & F r2)`: q0 “r1 to come”, q1 “r2 to come”, q2 “done”. The word visits region 2, then region 1. Which state is the automaton in then?',
      choices: ['q0', 'q1', 'q2'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b2' }, word: word('r2 - r1 - (-)') },
      bears: ({ states }) => states[3],
      key: 1,
      why: 'The early visit to region 2 left no trace: it is of no use to this task, so no state stands for it.',
    },
    {
      ask: '`F r1 & F r2` takes the visits in either order. `F (r1 & F r2)` needs three states. How many does `F r1 & F r2` need?',
      choices: ['Two', 'Three', 'Four', 'Five'],
      experiment: { kind: 'automaton', state: { task: 'ball_pass_b2', formula: 'F r1 & F r2', hoa: EITHER_ORDER } },
      bears: ({ automatonStates }) => automatonStates - 2,
      key: 2,
      why: 'Nothing yet, only region 1, only region 2, both. Each is a different “what is still to be done”. With n regions in any order it would be 2ⁿ.',
    },
    {
      try: 'Take the wheel: steer the ball with the arrow keys (or press on the picture) to region 2, then 1, then 2, and watch which of your visits the automaton takes notice of.',
      button: 'Drive',
      state: { task: 'ball_pass_b2', watch: 'drive', speed: 1 },
    },
  ],
};
