// @ts-check
// Lesson 9: safety, sinks, and why safety alone is not enough.

import { PLAIN, word } from '../model.js';

/** @type {import('../model.js').Lesson} */
export const safety = {
  name: 'safety',
  title: 'Safety and sinks',
  aim: 'Tell “never” from “eventually”, and read a sink.',
  minutes: 6,
  hide: [...PLAIN],
  words: [
    'A cart with a pole: `G F green & G F yellow & G !unsafe`. `unsafe` holds when the pole leans more than 12° or the cart leaves its track. `G !unsafe` is a *safety* formula: one bad step breaks it for good. `G F green` is *liveness*: no finite time can break it.',
    'The automaton goes to a *sink* (dashed) when the formula can no longer be satisfied. There the discount is 0: nothing that follows counts, and the episode ends.',
  ],
  steps: [
    {
      ask: 'A word visits green and yellow, is unsafe once, and then visits green and yellow for ever. Does the formula hold?',
      choices: ['Yes, the visits go on for ever', 'No'],
      experiment: { kind: 'word', state: { task: 'cart_pole_c1' }, word: word('green yellow unsafe (green yellow)') },
      bears: ({ truths }) => (truths[0] ? 0 : 1),
      key: 1,
      why: 'The third letter leads into the sink, and no edge leads out of it. What is visited later is neither counted nor paid.',
    },
    {
      ask: 'Green and yellow once each, then standing still in between, safe for ever. Does the formula hold?',
      choices: ['Yes, nothing bad happens', 'No'],
      experiment: { kind: 'word', state: { task: 'cart_pole_c1' }, word: word('green - yellow - (-)') },
      bears: ({ truths }) => (truths[0] ? 0 : 1),
      key: 1,
      why: 'Safe is not enough: the visits stop. Yet no sink is reached, for at every step the visits could still be taken up again. Only a sink says “too late”.',
    },
    {
      ask: 'A policy *before* any training now steers the cart. How does its episode end?',
      choices: ['At the time limit of 200 steps', 'Earlier, in the sink'],
      experiment: { kind: 'episode', state: { task: 'cart_pole_c1', watch: 'policy', speed: 1 } },
      bears: ({ ended }) => (ended ? 1 : 0),
      key: 1,
      why: 'The pole falls within a second. The end by the time limit is something else: the run is cut there, not over, and values are carried on past it.',
    },
    {
      try: 'Hold the pole up yourself with the arrow keys and try to reach a band. Slow motion helps.',
      button: 'Drive',
      state: { task: 'cart_pole_c1', watch: 'drive', speed: 0.25 },
    },
  ],
};
