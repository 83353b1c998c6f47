// @ts-check
// Nothing is lost: the open run is kept on this machine every so often, when it rests and when the page is hidden, and offered again
// after a reload. A worker that broke goes on from what was kept last.

import { byId, count, element, setText } from '../dom.js';
import { notice } from '../keeping.js';
import { digest } from '../maps/shelf.js';
import { Cadence } from './cadence.js';
import { NoRoom } from './store.js';

/** @typedef {import('../app.js').App} App */
/** @typedef {import('./store.js').KeptRun} KeptRun */
/** @typedef {import('./store.js').Store} Store */

/** More samples than this are not kept: their checkpoint would be too large to be written while one waits. */
const MAX_SAMPLES = 1_000_000;
/** The largest checkpoint that is kept, in bytes. */
const MAX_SIZE = 64 << 20;
/** How long a run rests before it is kept, in milliseconds. */
const REST = 300;

/** @param {number} when @param {number} now */
export function ago(when, now) {
  const minutes = Math.round((now - when) / 60_000);
  if (minutes < 1) return 'just now';
  if (minutes < 60) return `${minutes} min ago`;
  const hours = Math.round(minutes / 60);
  if (hours < 24) return `${hours} h ago`;
  const days = Math.round(hours / 24);
  return `${days} ${days === 1 ? 'day' : 'days'} ago`;
}

/** @param {number} bytes */
export const megabytes = (bytes) => `${bytes < 1e6 ? '< 1' : Math.round(bytes / 1e6)} MB`;

export class Keeper {
  /** @param {App} app @param {Store} store */
  constructor(app, store) {
    this.app = app;
    this.store = store;
    this.cadence = new Cadence();
    this.key = '';
    this.steps = 0;
    this.samples = 0;
    /** The keeping that goes on. @type {Promise<void> | null} */
    this.going = null;
    /** Whether it was said that there is no room. */
    this.complained = false;
    this.timer = 0;
    /** Whether nothing is kept: the runs of a lesson are not the user's own. */
    this.idle = false;
    /** Called when what is kept has changed. */
    this.changed = () => {};
    app.signals.on('opened', (description) => {
      const { preset } = description.task;
      this.key = digest(JSON.stringify({ ...description.request, preset }));
      this.steps = 0;
      this.samples = 0;
      clearTimeout(this.timer);
      this.cadence.begin(this.steps);
    });
    const used = byId('memory', HTMLElement);
    app.signals.on('telemetry', ({ modules, steps, memory }) => {
      setText(used, `${Math.round(memory / 1e6)} MB`);
      this.samples = modules.reduce((sum, module) => sum + module.replay, 0);
      this.steps = steps;
      if (!app.training) return rest();
      clearTimeout(this.timer);
      if (this.cadence.due(performance.now(), steps)) this.keep();
    });
    const rest = () => {
      clearTimeout(this.timer);
      if (this.cadence.news(this.steps)) this.timer = window.setTimeout(() => this.keep(), REST);
    };
    // The last telemetry of a training that ends by itself comes before its end.
    app.signals.on('training', (training) => {
      if (!training) rest();
    });
    const now = () => {
      if (this.cadence.news(this.steps)) this.keep();
    };
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'hidden') now();
    });
    window.addEventListener('pagehide', now);
  }

  /** Keeps the open run as it stands. A keeping that goes on is not disturbed. */
  keep() {
    clearTimeout(this.timer);
    this.going ??= this.keepNow().catch((error) => this.complain(error)).finally(() => (this.going = null));
    return this.going;
  }

  async keepNow() {
    const { app, key, cadence } = this;
    const { description, state } = app;
    if (this.idle || !description || this.steps === 0) return;
    const began = performance.now();
    let exact = this.samples <= MAX_SAMPLES;
    let kept = await app.client.ask({ kind: 'keep', form: exact ? 'whole' : 'small' });
    if (exact && kept.bytes.length > MAX_SIZE) {
      exact = false;
      kept = await app.client.ask({ kind: 'keep', form: 'small' });
    }
    if (this.key !== key || kept.generation !== app.generation) return;
    const { watch, speed, pace, hide } = state;
    /** @type {KeptRun} */
    const run = {
      key, when: Date.now(), title: description.task.title, formula: description.formula.text, seed: description.seed,
      steps: kept.steps, size: kept.bytes.length, exact, view: { watch, speed, pace, hide },
    };
    await this.store.putRun(run, kept.bytes);
    cadence.kept(began, performance.now(), kept.steps);
    this.complained = false;
    this.changed();
  }

  /** @param {unknown} error */
  complain(error) {
    // The next attempt waits its turn, and what has been said is not said again.
    this.cadence.kept(0, performance.now(), this.steps);
    if (this.complained || !(error instanceof NoRoom || error instanceof DOMException)) return;
    this.complained = true;
    notice(`This run could not be kept on this machine: ${error.message}. Save a checkpoint to a file to be sure of it.`, true);
  }

  /** The last checkpoint of the open run. */
  async last() {
    await this.going;
    return this.store.checkpoint(this.key).catch(() => null);
  }

  /** Opens a kept run where it was; whether it stands. @param {KeptRun} run */
  async resume(run) {
    const bytes = await this.store.checkpoint(run.key);
    if (!bytes) {
      notice('This run is not kept any more.', true);
      return false;
    }
    if (!(await this.app.restore(bytes, run.view))) return false;
    this.steps = run.steps;
    this.cadence.begin(run.steps);
    notice(run.exact
      ? `Training stands at ${count(run.steps)} steps, exactly where it was.`
      : `Training stands at ${count(run.steps)} steps. Its replays were too large to be kept and fill anew first.`);
    return true;
  }

  /** Offers the run that was kept last. */
  async offer() {
    const [run] = await this.store.runs().catch(() => []);
    if (!run || this.steps > 0) return;
    const line = element('div', { className: 'notice offer', id: 'offer' });
    const button = (/** @type {string} */ text, /** @type {() => void} */ act, className = '') => {
      const made = element('button', { type: 'button', className }, text);
      made.addEventListener('click', () => {
        line.remove();
        act();
      });
      return made;
    };
    line.append(
      element('span', {}, `Continue where you were: ${count(run.steps)} steps of “${run.title}”, seed ${run.seed}, ${ago(run.when, Date.now())}.`),
      button('Continue', () => this.resume(run), 'primary'),
      button('Not now', () => {}, 'quiet'),
    );
    byId('notices', HTMLElement).append(line);
    // Who begins something else has answered.
    this.app.signals.on('training', () => line.remove());
  }
}
