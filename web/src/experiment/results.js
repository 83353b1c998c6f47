// @ts-check
// The table of finished runs, for reading and as comma-separated values.

import { brief, byId, count, element } from '../dom.js';
import { percent } from '../views/details.js';

/** @typedef {import('./run.js').Run} Run */
/** @typedef {{ task: string, formula: string, preset: string, changes: string, variant: string, seed: number, steps: number, best: number, episodes: number, seconds: number, successes: number, runs: number, low: number, high: number, rounds: number, sinks: number }} Result */

/** @type {readonly (keyof Result)[]} */
const COLUMNS = Object.freeze(['task', 'formula', 'preset', 'changes', 'variant', 'seed', 'steps', 'best', 'episodes', 'seconds', 'successes', 'runs', 'low', 'high', 'rounds', 'sinks']);
/** How many results are kept. */
const MOST = 500;

/** A value as a field of comma-separated values. @param {string | number} value */
export const field = (value) => (typeof value === 'number' ? String(value) : /[",\n]/.test(value) || /^[=+@-]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value);

export class Results {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    /** @type {Result[]} */
    this.list = [];
    this.show();
  }

  /** @param {Run} run @param {import('../state.js').State} state */
  add(run, state) {
    const { description, progress } = run;
    if (!description || !progress) return;
    this.list = [...this.list, {
      task: description.task.name, formula: description.formula.text, preset: description.task.preset,
      changes: Object.entries(state.set).map(([key, value]) => `${key}=${value}`).join('; '), variant: run.variant.name, seed: run.seed,
      steps: run.steps, best: run.best?.step ?? run.steps, episodes: run.episodes, seconds: Math.round(run.seconds * 10) / 10, successes: progress.successes, runs: progress.runs,
      low: progress.low, high: progress.high, rounds: progress.rounds_mean, sinks: progress.sink_rate,
    }].slice(-MOST);
    this.show();
  }

  clear() {
    this.list = [];
    this.show();
  }

  csv() {
    return [COLUMNS.join(','), ...this.list.map((result) => COLUMNS.map((column) => field(result[column])).join(','))].join('\n') + '\n';
  }

  show() {
    byId('results-panel', HTMLElement).hidden = this.list.length === 0;
    const heads = ['variant', 'task', 'preset', 'seed', 'steps', 'best after', 'episodes', 'time', 'success', '95 % interval', 'rounds', 'in a sink'];
    const row = (/** @type {Result} */ r) => [
      r.variant, r.task, r.preset + (r.changes ? ' *' : ''), String(r.seed), count(r.steps), count(r.best), count(r.episodes), `${brief(r.seconds)} s`, `${r.successes}/${r.runs}`,
      `${percent(r.low)} to ${percent(r.high)}`, brief(r.rounds), percent(r.sinks),
    ];
    this.root.replaceChildren(element('table', {},
      element('thead', {}, element('tr', {}, ...heads.map((head) => element('th', { scope: 'col' }, head)))),
      element('tbody', {}, ...[...this.list].reverse().map((r) => element('tr', { title: r.changes }, ...row(r).map((cell) => element('td', {}, cell)))))));
  }
}
