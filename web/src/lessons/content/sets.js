// @ts-check
// Lesson 6: several accepting sets against one: the memory in the frontier, or in the states.

import { word } from '../model.js';

/** `G F r1 & G F r2` with one accepting set: its states take the regions in turn. */
export const ONE_SET = `HOA: v1
name: "G F r1 & G F r2"
States: 3
Start: 0
AP: 2 "r1" "r2"
acc-name: Buchi
Acceptance: 1 Inf(0)
properties: trans-labels explicit-labels state-acc deterministic complete
--BODY--
State: 0 "r1 is next"
[!0] 0
[0] 1
State: 1 "r2 is next"
[!1] 1
[1] 2
State: 2 "round closed" {0}
[!0] 0
[0] 1
--END--
`;

/** @type {import('../model.js').Lesson} */
export const sets = {
  name: 'accepting-sets',
  title: 'Accepting sets against one set',
  aim: 'Say where the memory of a round lives: in the frontier, or in the states.',
  minutes: 7,
  hide: ['spec', 'compare', 'details'],
  words: [
    'A *generalised* Büchi automaton has several accepting sets; each must be visited again and again, in whatever order. An ordinary Büchi automaton has one. Any task can be written either way.',
    'With several sets the automaton stays small and the frontier T keeps the round. With one set the states themselves count: region 1 is next, region 2 is next, round closed.',
  ],
  steps: [
    {
      ask: 'Two sets. A word visits region 1, region 1 again, then region 2. Which visits are paid?',
      choices: ['All three', 'The first to region 1, and the one to region 2', 'Only the one to region 2'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b1' }, word: word('r1 - r1 - r2 - (-)') },
      bears: ({ paid }) => which([paid[0] > 0, paid[2] > 0, paid[4] > 0]),
      key: 1,
      why: 'F₁ leaves the frontier with the first visit; the second finds it gone. The visit to region 2 empties T, the round is closed, and T is filled again.',
    },
    {
      ask: 'One set, states that take the regions in turn. The word visits region 2, then region 1, and then nothing. What is paid?',
      choices: ['Both visits', 'Only the visit to region 1', 'Nothing'],
      experiment: { kind: 'word', state: { task: 'ball_pass_b1', hoa: ONE_SET }, word: word('r2 - r1 - (-)') },
      bears: ({ paid }) => (paid[0] > 0 && paid[2] > 0 ? 0 : paid[2] > 0 ? 1 : 2),
      key: 2,
      why: 'Region 2 came out of turn and was not noticed. With two sets both visits would have been paid and a round closed: any order will do there.',
    },
    {
      ask: 'The automaton with one set on the *standard* product, without a frontier, which failed with two sets. At most 30 000 steps of training: how many of 50 runs satisfy the task now?',
      choices: ['None or nearly none', 'About half', 'All or nearly all'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b1', preset: 'fast', hoa: ONE_SET, set: { 'product.frontier': '"standard"' }, watch: 'policy', speed: 4 }, steps: 30000 },
      bears: ({ successes, runs }) => (successes <= 0.2 * runs ? 0 : successes >= 0.8 * runs ? 2 : 1),
      key: 2,
      why: 'Here q itself says which region is next, so the policy has the memory it needs. The price: the reward comes once a round instead of once a set, the order is fixed, and with twelve regions there would be thirteen states to learn in turn.',
    },
  ],
};

/** @param {boolean[]} paid */
function which(paid) {
  return [[true, true, true], [true, false, true], [false, false, true]].findIndex((row) => row.every((value, k) => value === paid[k]));
}
