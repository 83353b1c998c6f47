// @ts-check
// Lesson 10: ε-moves: a promise that the policy makes.

import { PLAIN, word } from '../model.js';

/** Two islands and a boat, with the formula of the paper's Fig. 9. */
export const ISLANDS = `title = "Islands: stay at one of two for ever"
description = "The boat begins at island a. It chooses an island to stay at by an ε-move, which has to be made while it can be kept."

[environment]
name = "islands"
current = "none"

[specification]
ltl = "a & X (F G a | F G b)"

[evaluation]
max_steps = 200

[presets.fast]
product = { accepting_discount = 0.9, discount = 0.99, shaping = { kind = "none" } }
learner = { n_step = 10, reward_scale = 10.0, counterfactual = { samples = 1 } }
`;

/** Its automaton: wait in q1, or promise to stay at one of the islands. */
export const PROMISE = `HOA: v1
name: "a & X (F G a | F G b)"
States: 5
Start: 0
AP: 2 "a" "b"
acc-name: Buchi
Acceptance: 1 Inf(0)
--BODY--
State: 0 "begins at a"
[0] 1
[!0] 4
State: 1 "no promise yet"
[t] 1
2
3
State: 2 "a for ever" {0}
[0] 2
[!0] 4
State: 3 "b for ever" {0}
[1] 3
[!1] 4
State: 4 "promise broken"
[t] 4
--END--
`;

const OWN = Object.freeze({ task: ISLANDS, hoa: PROMISE });

/** @type {import('../model.js').Lesson} */
export const jumps = {
  name: 'epsilon-moves',
  title: 'ε-moves',
  aim: 'Say what an ε-move promises, and what a broken promise costs.',
  minutes: 6,
  hide: [...PLAIN],
  words: [
    'A boat and two islands: `a & X (F G a | F G b)`. It begins at island a, and from *some* step on it stays at one island for ever. That this step has come cannot be read off the past. So the automaton waits in q1, and at any moment it may jump along an *ε-move* (dashed): no time passes and no letter is read.',
    'A jump is a promise: “from now on island b for ever”. Only the states behind the jumps are accepting, and a letter that breaks the promise leads into the sink. In the product the ε-moves are actions like any other: the policy chooses them.',
  ],
  steps: [
    {
      ask: 'The boat leaves island a, reaches island b at step 2 and stays. The run never jumps. Is it accepting?',
      choices: ['Yes, the formula holds on this word', 'No'],
      experiment: { kind: 'word', state: OWN, word: word('a - b (b)') },
      bears: ({ runAccepting }) => (runAccepting ? 0 : 1),
      key: 1,
      why: 'The word satisfies the formula and another run accepts it, but this one waits in q1 for ever and is never paid. Somebody has to make the promise.',
    },
    {
      ask: 'The same word. The run promises island b before step 1, while the boat is still on its way. And now?',
      choices: ['It is accepting', 'It ends in the sink', 'Neither'],
      experiment: { kind: 'word', state: OWN, word: word('a - b (b)', [[1, 3]]) },
      bears: ({ runAccepting, sinks }) => (runAccepting ? 0 : sinks.some(Boolean) ? 1 : 2),
      key: 1,
      why: 'At step 1 the boat is at neither island: the promise is broken at once, and there is no way back, though the word itself is a good one. Too early is too late.',
    },
    {
      ask: 'The run promises island b just before step 2. And now?',
      choices: ['It is accepting', 'It ends in the sink', 'Neither'],
      experiment: { kind: 'word', state: OWN, word: word('a - b (b)', [[2, 3]]) },
      bears: ({ runAccepting, sinks }) => (runAccepting ? 0 : sinks.some(Boolean) ? 1 : 2),
      key: 0,
      why: 'From step 2 on b always holds. Jumping later would do as well; each step of waiting only puts the reward off. That is what a learner finds out by its values.',
    },
    {
      try: 'Steer the boat with the arrow keys, and make a promise with the buttons that appear below the frontier. Can you keep it? Can you leave the island then?',
      button: 'Drive',
      state: { ...OWN, watch: 'drive', speed: 0.5 },
    },
  ],
};
