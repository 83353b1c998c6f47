// @ts-check
// What is compared: the paper's method and its two baselines, each a change of the same recipe.

/** @typedef {{ key: string, name: string, explanation: string, overrides: Record<string, string>, tint: string, dash: number[] }} Variant */

/** @type {Variant[]} */
const list = [
  {
    key: 'ep_mdp', name: 'EP-MDP', tint: '--set-0', dash: [],
    explanation: 'One module for each automaton state, and a frontier that says which accepting sets are still missing.', overrides: {},
  },
  {
    key: 'standard_product', name: 'Standard product', tint: '--set-1', dash: [7, 4],
    explanation: 'No frontier: every visit to an accepting set pays. Nothing tells the policy which set comes next.', overrides: { 'product.frontier': '"standard"' },
  },
  {
    key: 'standard_ddpg', name: 'Standard DDPG', tint: '--set-3', dash: [2, 3],
    explanation: 'One actor and critic for all automaton states, which see the state as part of their input.', overrides: { 'learner.modules': '"one"' },
  },
];

export const VARIANTS = Object.freeze(list);
