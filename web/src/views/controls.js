// @ts-check
// Training's buttons and counters, the seed, and the switch of what the stage shows.

import { count, element, setText } from '../dom.js';
import { PACES, SPEEDS } from '../state.js';

/** @typedef {import('../protocol.js').Frame} Frame */
/** @typedef {import('../state.js').State} State */

/**
 * @typedef {object} ControlPlaces
 * @property {HTMLButtonElement} train
 * @property {HTMLButtonElement} step
 * @property {HTMLButtonElement} episode
 * @property {HTMLSelectElement} pace
 * @property {HTMLElement} rate
 * @property {HTMLElement} steps
 * @property {HTMLElement} episodes
 * @property {HTMLElement} updates
 * @property {HTMLInputElement} seed
 * @property {HTMLButtonElement} reset
 * @property {HTMLButtonElement} newSeed
 * @property {HTMLElement} watch
 * @property {HTMLSelectElement} speed
 */
/**
 * @typedef {object} ControlActions
 * @property {() => void} train    starts or pauses
 * @property {() => void} step
 * @property {() => void} episode
 * @property {(pace: number) => void} pace
 * @property {(seed: number) => void} restart
 * @property {(watch: State['watch']) => void} watch
 * @property {(speed: number) => void} speed
 */

/** @type {readonly { value: State['watch'], label: string, title: string }[]} */
const WATCHES = Object.freeze([
  { value: 'trained', label: 'Trained', title: 'Greedy episodes of the trained policy that comes with the page' },
  { value: 'policy', label: 'Policy', title: 'Greedy episodes of the policy as it is now' },
  { value: 'best', label: 'Best', title: 'Greedy episodes of the best policy that the evaluations of this training have seen' },
  { value: 'training', label: 'Training', title: 'The steps of training as they happen, exploration and all' },
  { value: 'drive', label: 'Drive', title: 'You choose the actions, the automaton follows' },
]);

/** @param {number} speed */
export const speedLabel = (speed) => `${speed < 1 ? `1/${1 / speed}` : speed}×`;
/** @param {number} pace */
export const paceLabel = (pace) => (pace === 0 ? 'full speed' : `${count(pace)} steps/s`);

export class Controls {
  /**
   * @param {ControlPlaces} places
   * @param {ControlActions} actions
   */
  constructor(places, actions) {
    this.places = places;
    const { train, step, episode, pace, seed, reset, newSeed, watch, speed } = places;
    speed.replaceChildren(...SPEEDS.map((s) => element('option', { value: String(s) }, speedLabel(s))));
    pace.replaceChildren(...PACES.map((p) => element('option', { value: String(p) }, paceLabel(p))));
    train.addEventListener('click', actions.train);
    step.addEventListener('click', actions.step);
    episode.addEventListener('click', actions.episode);
    pace.addEventListener('change', () => actions.pace(Number(pace.value)));
    speed.addEventListener('change', () => actions.speed(Number(speed.value)));
    seed.addEventListener('change', () => {
      if (seed.validity.valid && seed.value !== '') actions.restart(Number(seed.value));
      else seed.reportValidity();
    });
    reset.addEventListener('click', () => actions.restart(Number(seed.value)));
    newSeed.addEventListener('click', () => actions.restart(freshSeed(Number(seed.value))));
    for (const { value, label, title } of WATCHES) {
      const input = element('input', { type: 'radio', name: 'watch', value, className: 'unseen' });
      input.addEventListener('change', () => actions.watch(value));
      watch.append(element('label', { title }, input, label));
    }
  }

  /**
   * Shows the state's choices.
   * @param {State} state
   * @param {{ trained: boolean, best: boolean }} there  whether there is a trained policy to watch, and a best one
   */
  show(state, there) {
    const { places } = this;
    places.seed.value = String(state.seed);
    places.speed.value = String(state.speed);
    places.pace.value = String(state.pace);
    const missing = (/** @type {string} */ value) => (value === 'trained' && !there.trained) || (value === 'best' && !there.best);
    const shown = missing(state.watch) ? 'policy' : state.watch;
    for (const input of places.watch.querySelectorAll('input')) {
      input.checked = input.value === shown;
      const label = input.closest('label');
      if (label) label.hidden = missing(input.value);
    }
  }

  /** @param {boolean} training */
  training(training) {
    setText(this.places.train, training ? 'Pause' : 'Train');
    this.places.train.setAttribute('aria-pressed', String(training));
  }

  /** @param {number} rate */
  rate(rate) {
    setText(this.places.rate, count(rate));
  }

  /** @param {Frame} frame */
  update(frame) {
    setText(this.places.steps, count(frame.counter('step')));
    setText(this.places.episodes, count(frame.counter('episode')));
    setText(this.places.updates, count(frame.counter('updates')));
  }
}

/** A seed that is easy to say and not the present one. @param {number} present */
export function freshSeed(present) {
  const [drawn] = crypto.getRandomValues(new Uint32Array(1));
  const seed = drawn % 9999;
  return seed === present ? seed + 1 : seed;
}
