// @ts-check
// Why this reward: the parts of the present step's reward as numbers and as a sentence.

import { brief, setText } from '../dom.js';
import { setName } from '../palette.js';
import { END } from '../protocol.js';

/** @typedef {import('../protocol.js').Frame} Frame */

/**
 * The step's reward in words.
 * @param {Frame} frame
 * @param {number} sets  how many accepting sets there are
 */
export function rewardSentence(frame, sets) {
  const fresh = Array.from({ length: sets }, (_, k) => k).filter((k) => frame.bit('fresh', k)).map(setName);
  /** @type {string[]} */
  const parts = [];
  if (frame.number('epsilon') >= 0) parts.push('The policy chose an ε-jump: no time passes.');
  if (fresh.length > 0) {
    parts.push(`${fresh.join(' and ')} was in the frontier and is visited: this pays.`);
    if (frame.number('closes_round') === 1) parts.push('All sets are visited: a round is closed and the frontier is refilled.');
  } else if (frame.number('accepting_reward') !== 0) parts.push('An accepting set is visited: this pays.');
  if (frame.number('sink_reward') !== 0) parts.push('Reaching a sink has a reward of its own.');
  if (frame.number('shaping_reached') > 0) parts.push('Shaping pays for an automaton state that is new in this round.');
  if (frame.number('shaping_left') < 0) parts.push('The shaping of the state that was left is given back.');
  if (frame.number('end') === END.terminated) parts.push('The run has ended: nothing can be earned from here.');
  if (parts.length === 0) parts.push('Nothing in the automaton changed: no reward.');
  return parts.join(' ');
}

export class Reward {
  /**
   * @param {{ accepting: HTMLElement, reached: HTMLElement, left: HTMLElement, sum: HTMLElement, discount: HTMLElement, words: HTMLElement, total: HTMLElement }} places
   */
  constructor(places) {
    this.places = places;
    this.sets = 0;
  }

  /** @param {import('../protocol.js').AutomatonGraph} graph */
  show(graph) {
    this.sets = graph.sets;
  }

  /** @param {Frame} frame */
  update(frame) {
    const { places } = this;
    setText(places.accepting, brief(frame.number('accepting_reward')));
    setText(places.reached, brief(frame.number('shaping_reached')));
    setText(places.left, brief(frame.number('shaping_left')));
    setText(places.sum, brief(frame.number('reward')));
    setText(places.discount, brief(frame.number('discount')));
    setText(places.total, brief(frame.number('return')));
    setText(places.words, rewardSentence(frame, this.sets));
  }
}
