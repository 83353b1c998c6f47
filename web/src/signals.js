// @ts-check
// How parts of the page hear of each other: named signals of the app, each with its value.

/**
 * The signals and what comes with each.
 * @typedef {object} Signal
 * @property {import('./protocol.js').Description} opened   another session stands
 * @property {import('./state.js').State} state             the state that a link carries has changed
 * @property {boolean} training                             training has begun or stopped
 * @property {Extract<import('./protocol.js').Reply, { kind: 'telemetry' }>} telemetry   curves and statistics, four times a second while training
 * @property {import('./protocol.js').EvaluationProgress} evaluation   an evaluation fills
 * @property {number | null} finished                       the recipe is at its end: the steps to the first perfect evaluation, if there was one
 * @property {import('./protocol.js').Frame} moment         another moment is shown; the frame is read at once, it does not last
 * @property {import('./protocol.js').Episode} episode      a replay has begun
 * @property {import('./state.js').State['watch']} watch    what the stage shows has changed
 * @property {'light' | 'dark' | 'system'} theme            the colours have changed
 */

export class Signals {
  constructor() {
    /** @type {Map<string, ((value: any) => void)[]>} */
    this.listeners = new Map();
  }

  /**
   * Calls `hear` with every value of signal `name` from now on.
   * @template {keyof Signal} K
   * @param {K} name
   * @param {(value: Signal[K]) => void} hear
   */
  on(name, hear) {
    const list = this.listeners.get(name) ?? [];
    list.push(hear);
    this.listeners.set(name, list);
  }

  /**
   * @template {keyof Signal} K
   * @param {K} name
   * @param {Signal[K]} value
   */
  tell(name, value) {
    for (const hear of this.listeners.get(name) ?? []) hear(value);
  }
}
