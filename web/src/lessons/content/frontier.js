// @ts-check
// Lesson 5: why one deterministic policy needs the frontier; the argument of the paper's Fig. 4, failing and mended.

/** @type {import('../model.js').Lesson} */
export const frontier = {
  name: 'frontier',
  title: 'Why a policy needs the frontier',
  aim: 'Explain why no deterministic policy on the standard product satisfies `G F r1 & G F r2`, and what the frontier adds.',
  minutes: 10,
  hide: ['spec', 'compare', 'details'],
  words: [
    'A deterministic policy takes one action in each state it can tell apart. The *standard product* lets it see the place s and the automaton state q. The *embedded product* (EP-MDP) shows it the *frontier* T as well: the accepting sets still to be visited in this round.',
    'The argument (Fig. 4 of Cai et al. 2021) needs only three places: free ground, region 1, region 2. From free ground one action leads to either region; from a region one goes back. The automaton is in q0 on free ground, in q1 in region 1, in q2 in region 2.',
  ],
  steps: [
    {
      ask: 'Standard product. The only choice is where to go from (free ground, q0). How many of the deterministic policies satisfy `G F r1 & G F r2`?',
      choices: ['None of 2', '1 of 2', '2 of 2'],
      experiment: { kind: 'policies', state: { task: 'ball_pass_b1', set: { 'product.frontier': '"standard"' } } },
      bears: ({ satisfying }) => satisfying,
      key: 0,
      why: 'Back on free ground the policy stands in the same (s, q) as before, so it must choose as before, for ever. It can tell that it came back, but not from where.',
    },
    {
      ask: 'Embedded product. On free ground T may be {F₁, F₂}, {F₂} or {F₁}, so there are 2³ = 8 policies. How many satisfy the formula?',
      choices: ['None of 8', '2 of 8', '4 of 8', 'All 8'],
      experiment: { kind: 'policies', state: { task: 'ball_pass_b1' } },
      bears: ({ satisfying }) => [0, 2, 4, 8].indexOf(satisfying),
      key: 1,
      why: 'It is enough, and needed, to go to region 2 while T = {F₂} and to region 1 while T = {F₁}. Where to go first is free: that leaves two. T is the memory that was missing.',
    },
    {
      ask: 'The real thing. Modular DDPG learns on the standard product, 20 000 steps. How many of 50 runs will satisfy the task (both regions visited, the ball still in the arena)?',
      choices: ['None or nearly none', 'About half', 'All or nearly all'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b1', preset: 'fast', set: { 'product.frontier': '"standard"' }, watch: 'policy', speed: 4 }, steps: 20000 },
      bears: ({ successes, runs }) => (successes <= 0.2 * runs ? 0 : successes >= 0.8 * runs ? 2 : 1),
      key: 0,
      why: 'Every visit of any accepting set pays, so the ball settles at one region and collects there. More training would not help: the policy that is wanted does not exist. (A lucky start may carry the ball through both regions once; it does not go on.)',
    },
    {
      ask: 'The same learner with the frontier, at most 30 000 steps. And now?',
      choices: ['None or nearly none', 'About half', 'All or nearly all'],
      experiment: { kind: 'train', state: { task: 'ball_pass_b1', preset: 'fast', watch: 'policy', speed: 4 }, steps: 30000 },
      bears: ({ successes, runs }) => (successes <= 0.2 * runs ? 0 : successes >= 0.8 * runs ? 2 : 1),
      key: 2,
      why: 'Once region 1 has been visited, F₁ leaves T and pays nothing; only region 2 does. The same place now asks for another action, and the policy can see why.',
    },
  ],
};
