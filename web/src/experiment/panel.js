// @ts-check
// The experiment: variants of the open task side by side, several seeds each, in workers of their own; what came out stands in a table.

import { brief, byId, count, element, forgetColours, offer, setText } from '../dom.js';
import { notice } from '../keeping.js';
import { Player } from '../player.js';
import { loadPlot } from '../vendor.js';
import { percent } from '../views/details.js';
import { Stage } from '../views/stage.js';
import { ExperimentCharts } from './charts.js';
import { Results } from './results.js';
import { Run } from './run.js';
import { VARIANTS } from './variants.js';

/** @typedef {import('../app.js').App} App */
/** @typedef {import('./variants.js').Variant} Variant */

/** The runs of the evaluation after training. */
const EVALUATION = 200;
/** How often the charts are drawn anew, in milliseconds. */
const REDRAW = 400;
/** How many runs go on at once at most, beside what the machine has. */
const MOST_AT_ONCE = 6;
/** Playback speed of the small stages, in multiples of the environment's own time. */
const SPEED = 4;

/** One variant's column: a small stage with greedy episodes of its first seed, and how its runs stand. */
class Column {
  /** @param {Variant} variant @param {Run[]} runs */
  constructor(variant, runs) {
    this.variant = variant;
    this.runs = runs;
    this.canvas = element('canvas', { role: 'img', className: 'small-stage' });
    this.said = element('p', { className: 'note' });
    this.verdict = element('p', { className: 'verdict small' }, '–');
    this.bars = element('div', { className: 'seeds' });
    const swatch = element('i', { className: 'swatch' });
    swatch.style.borderTop = `3px ${variant.dash.length === 0 ? 'solid' : variant.dash[0] > 4 ? 'dashed' : 'dotted'} var(${variant.tint})`;
    this.root = element('article', { className: 'variant' },
      element('h3', { title: variant.explanation }, swatch, variant.name), this.canvas, this.verdict, this.said, this.bars);
    this.fills = runs.map((run) => {
      const fill = element('i');
      fill.style.background = `var(${variant.tint})`;
      this.bars.append(element('span', { className: 'seed-bar', title: `seed ${run.seed}` }, fill));
      return fill;
    });
    /** @type {Stage | null} */
    this.stage = null;
    this.player = new Player(0);
    this.index = 0;
  }

  /** @param {number} seconds @param {string[]} layers */
  paint(seconds, layers) {
    const [first] = this.runs;
    if (!first.description) return;
    if (!this.stage) {
      this.stage = new Stage(this.canvas, first.description);
      this.stage.set({ layers: new Set(layers.filter((layer) => layer !== 'value')) });
      this.canvas.setAttribute('aria-label', `${this.variant.name}: greedy episodes of seed ${first.seed}`);
      this.player = new Player(first.description.environment.dt);
      this.player.speed = SPEED;
    }
    if (!this.player.episode || this.player.finished) this.next(first);
    this.player.tick(seconds);
    if (this.player.episode) this.stage.replay(this.player.episode, this.player.row, this.player.fraction);
  }

  /** @param {Run} run */
  async next(run) {
    const episode = await run.rollout(this.index);
    if (episode) {
      this.index++;
      this.player.load(episode);
    } else if (run.over && this.player.episode) this.player.seek(0);
  }

  update() {
    this.runs.forEach((run, k) => {
      this.fills[k].style.width = `${Math.min(100, (100 * run.steps) / run.wanted)}%`;
      this.fills[k].parentElement?.classList.toggle('done', run.stand === 'finished');
      this.fills[k].parentElement?.classList.toggle('failed', run.stand === 'failed');
    });
    const failed = this.runs.find((run) => run.stand === 'failed');
    const busy = this.runs.find((run) => run.stand === 'training') ?? this.runs.find((run) => run.stand === 'evaluating');
    const done = this.runs.filter((run) => run.stand === 'finished').length;
    setText(this.said, failed ? failed.problem : busy
      ? `seed ${busy.seed}: ${busy.stand === 'training' ? `${count(busy.steps)} of ${count(busy.wanted)} steps` : 'evaluation'}`
      : done === this.runs.length ? `${done} ${done === 1 ? 'seed' : 'seeds'} finished` : 'waiting');
    const judged = this.runs.filter((run) => run.progress && run.progress.runs > 0);
    if (judged.length === 0) return setText(this.verdict, '–');
    if (judged.length === 1) {
      const [{ progress }] = judged;
      if (progress) setText(this.verdict, `${progress.successes} of ${progress.runs} succeed, ${percent(progress.low)} to ${percent(progress.high)}`);
      return;
    }
    // Seeds are not pooled: each stands for itself.
    const shares = judged.map(({ progress }) => (progress ? progress.successes / progress.runs : 0)).sort((a, b) => a - b);
    setText(this.verdict, `${judged.length} seeds: ${percent(shares[0])} to ${percent(shares[shares.length - 1])} succeed, median ${percent(shares[shares.length >> 1])}`);
  }

  close() {
    this.stage?.close();
    for (const run of this.runs) run.close();
  }
}

export class Experiment {
  /** @param {App} app */
  constructor(app) {
    this.app = app;
    this.root = byId('variants', HTMLElement);
    this.go = byId('experiment-run', HTMLButtonElement);
    this.seeds = byId('experiment-seeds', HTMLSelectElement);
    this.steps = byId('experiment-steps', HTMLSelectElement);
    this.note = byId('experiment-note', HTMLElement);
    this.results = new Results(byId('results', HTMLElement));
    /** @type {Column[]} */
    this.columns = [];
    /** @type {ExperimentCharts | null} */
    this.charts = null;
    this.stale = false;
    this.drawn = 0;
    this.last = 0;
    this.running = false;
    const choice = byId('experiment-variants', HTMLElement);
    this.boxes = VARIANTS.map((variant) => {
      const box = element('input', { type: 'checkbox', className: 'unseen', value: variant.key, checked: true });
      choice.append(element('label', { title: variant.explanation }, box, variant.name));
      return box;
    });
    this.go.addEventListener('click', () => (this.running ? this.stop() : this.start()));
    byId('results-csv', HTMLButtonElement).addEventListener('click', () => offer('experiments.csv', this.results.csv(), 'text/csv'));
    byId('results-clear', HTMLButtonElement).addEventListener('click', () => this.results.clear());
    app.signals.on('theme', () => this.retheme());
  }

  get runs() {
    return this.columns.flatMap((column) => column.runs);
  }

  async start() {
    const { state, description } = this.app;
    const chosen = VARIANTS.filter((_, k) => this.boxes[k].checked);
    if (!description || chosen.length === 0) return notice('Choose at least one variant.', true);
    // The main session rests meanwhile: the machine's cores are few.
    if (this.app.training) this.app.toggleTraining();
    const request = await this.app.requestOf(state);
    const { seed } = request;
    const steps = Number(this.steps.value);
    const seeds = Array.from({ length: Number(this.seeds.value) }, (_, k) => seed + k);
    this.close();
    this.running = true;
    this.columns = chosen.map((variant) => new Column(variant, seeds.map((s) => new Run(variant, { ...request, seed: s }, steps, EVALUATION, () => (this.stale = true)))));
    this.root.replaceChildren(...this.columns.map((column) => column.root));
    const chartRoot = byId('experiment-curves', HTMLElement);
    chartRoot.replaceChildren();
    byId('experiment-body', HTMLElement).hidden = false;
    this.showButton();
    const Plot = await loadPlot();
    if (!this.running) return;
    this.charts = new ExperimentCharts(chartRoot, Plot, chosen);
    requestAnimationFrame((now) => this.paint(now));
    await this.playAll(Math.min(MOST_AT_ONCE, Math.max(chosen.length, navigator.hardwareConcurrency || 2)));
    if (!this.running) return;
    this.running = false;
    this.update();
    this.showButton();
    const failed = this.runs.filter((run) => run.stand === 'failed');
    if (failed.length > 0) notice(`${failed.length} of ${this.runs.length} runs failed: ${failed[0].problem}`, true);
  }

  /** Plays all runs, so many at once, the first seed of each variant first. @param {number} atOnce */
  async playAll(atOnce) {
    const longest = Math.max(...this.columns.map((column) => column.runs.length));
    const queue = Array.from({ length: longest }, (_, k) => this.columns.map((column) => column.runs[k])).flat();
    const { columns } = this;
    const worker = async () => {
      for (let run = queue.shift(); run && this.running && columns === this.columns; run = queue.shift()) {
        await run.play();
        if (run.stand === 'finished') this.results.add(run, this.app.state);
        // The first seed's policy stays to be watched; the others' workers go.
        if (!columns.some((column) => column.runs[0] === run)) run.close();
      }
    };
    await Promise.all(Array.from({ length: atOnce }, worker));
  }

  stop() {
    this.running = false;
    for (const run of this.runs) if (!run.over) run.fail('stopped');
    this.stale = true;
    this.showButton();
  }

  close() {
    for (const column of this.columns) column.close();
    this.columns = [];
    this.charts?.close();
    this.charts = null;
  }

  showButton() {
    setText(this.go, this.running ? 'Stop' : 'Run side by side');
    this.go.classList.toggle('primary', !this.running);
  }

  /** @param {number} now */
  paint(now) {
    if (this.columns.length === 0) return;
    requestAnimationFrame((next) => this.paint(next));
    const seconds = Math.min((now - this.last) / 1000, 0.25);
    this.last = now;
    const box = this.root.getBoundingClientRect();
    if (box.bottom > 0 && box.top < window.innerHeight && !document.hidden) for (const column of this.columns) column.paint(seconds, this.app.state.layers);
    if (!this.stale || now - this.drawn < REDRAW) return;
    this.stale = false;
    this.drawn = now;
    this.update();
  }

  /** Tells how all runs stand. */
  update() {
    for (const column of this.columns) column.update();
    this.charts?.update(this.runs);
    const steps = this.runs.reduce((sum, run) => sum + run.steps, 0);
    const wanted = this.runs.reduce((sum, run) => sum + run.wanted, 0);
    setText(this.note, this.running ? `${brief(Math.floor((100 * steps) / Math.max(1, wanted)))} % of ${count(wanted)} steps` : '');
  }

  retheme() {
    forgetColours();
    for (const column of this.columns) column.stage?.retheme();
    this.charts?.retheme();
  }
}

/** @param {App} app */
export function wireExperiment(app) {
  app.experiment = new Experiment(app);
}
