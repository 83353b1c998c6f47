// @ts-check
// Learning curves as small multiples with one cursor: average reward, total reward, rounds and success per episode.

import { brief, colour, element, setText } from '../dom.js';

/** @typedef {import('../protocol.js').Curves} CurveData */
/** @typedef {'average' | 'total' | 'rounds' | 'success' | 'critic'} Quantity */
/** @typedef {{ setData: (data: any) => void, setSize: (size: { width: number, height: number }) => void, redraw: () => void, destroy: () => void }} Plot */
/** @typedef {{ new (options: any, data: any, root: HTMLElement): Plot, sync: (key: string) => any }} PlotClass */

/** @type {readonly { quantity: Quantity, title: string, tint: string, unit: string }[]} */
const CHARTS = Object.freeze([
  { quantity: 'average', title: 'Average reward', tint: '--set-0', unit: 'per step' },
  { quantity: 'total', title: 'Total reward', tint: '--set-1', unit: 'per episode' },
  { quantity: 'rounds', title: 'Rounds', tint: '--set-2', unit: 'per episode' },
  { quantity: 'success', title: 'Success', tint: '--set-3', unit: 'share of episodes' },
]);
/** What stands in place of the curves before there are any. */
const EMPTY = 'Each automaton state has an actor and a critic of its own. Press Train and they learn from scratch, here in your browser: each finished episode adds a point to four curves, and the world beside shows the policy as it gets better.';
/** How many modules' losses are drawn. */
const LOSSES = 14;
/** Dashes that tell the lines of modules apart beside their colours. */
const DASHES = Object.freeze([[], [6, 3], [2, 2], [8, 3, 2, 3]]);

export class Curves {
  /**
   * @param {HTMLElement} root
   * @param {PlotClass} Plot
   */
  constructor(root, Plot) {
    this.root = root;
    this.note = element('p', { className: 'note' });
    /** @type {CurveData | null} */
    this.data = null;
    this.charts = CHARTS.map((chart) => {
      const value = element('span', { className: 'value' }, '–');
      const canvas = element('div', { className: 'plot', 'aria-hidden': 'true' });
      root.append(element('figure', { className: 'curve' },
        element('figcaption', {}, element('span', { className: 'name' }, chart.title), element('span', { className: 'unit' }, chart.unit), value), canvas));
      return { ...chart, value, canvas, plot: new Plot(options([{ stroke: () => colour(chart.tint) }]), [[], []], canvas) };
    });
    this.Plot = Plot;
    /** The critics' losses, a line for each module. @type {{ canvas: HTMLElement, plot: Plot, lines: number } | null} */
    this.losses = null;
    this.lossRoot = element('figure', { className: 'curve' });
    root.append(this.lossRoot, this.note);
    this.watcher = new ResizeObserver(() => this.fit());
    this.watcher.observe(root);
    root.classList.add('empty');
    setText(this.note, EMPTY);
    this.fit();
  }

  fit() {
    for (const { canvas, plot } of this.losses ? [...this.charts, this.losses] : this.charts) {
      const { width, height } = canvas.getBoundingClientRect();
      if (width > 0) plot.setSize({ width, height });
    }
  }

  retheme() {
    for (const { plot } of this.charts) plot.redraw();
    this.losses?.plot.redraw();
  }

  /** The losses of so many modules: a chart of its own for each number of lines. @param {number} modules @param {string[]} names */
  lossChart(modules, names) {
    const lines = Math.min(modules, LOSSES);
    if (this.losses?.lines === lines) return this.losses;
    this.losses?.plot.destroy();
    const canvas = element('div', { className: 'plot', 'aria-hidden': 'true' });
    const tints = Array.from({ length: lines }, (_, k) => ({ stroke: () => colour(`--set-${k % 6}`), dash: DASHES[Math.floor(k / 6) % DASHES.length] }));
    const key = tints.map((_, k) => element('span', { className: `key set-${k % 6}` }, names[k] ?? `module ${k}`));
    this.lossRoot.replaceChildren(element('figcaption', {}, element('span', { className: 'name' }, 'Critic loss'), element('span', { className: 'unit' }, 'per module')),
      canvas, element('p', { className: 'keys-row' }, ...key));
    this.losses = { canvas, lines, plot: new this.Plot(options(tints), [[], ...tints.map(() => [])], canvas) };
    this.fit();
    return this.losses;
  }

  /** @param {CurveData} data @param {string[]} [names]  what the modules are called */
  update(data, names = []) {
    this.data = data;
    const n = data.episode.length;
    if (data.modules.length > 0) {
      const { plot, lines } = this.lossChart(data.modules.length, names);
      plot.setData([data.episode, ...data.modules.slice(0, lines).map((curve) => Array.from(curve, (v) => (Number.isFinite(v) ? v : null)))]);
    } else this.losses?.plot.setData([[], ...Array.from({ length: this.losses.lines }, () => [])]);
    for (const { quantity, value, plot } of this.charts) {
      plot.setData([data.episode, data[quantity]]);
      setText(value, n > 0 ? brief(data[quantity][n - 1]) : '–');
    }
    this.root.classList.toggle('empty', n === 0);
    setText(this.note, n === 0 ? EMPTY : data.every > 1 ? `Each point is the mean of ${data.every} episodes.` : 'Each point is one episode.');
  }

  /** The curves as comma-separated values with a heading. */
  csv() {
    const data = this.data;
    if (!data) return '';
    const names = /** @type {const} */ (['episode', 'average', 'total', 'rounds', 'success', 'critic']);
    const modules = data.modules.map((_, m) => `critic_${m}`);
    const rows = Array.from(data.episode, (_, k) => [...names.map((name) => data[name][k]), ...data.modules.map((curve) => (Number.isFinite(curve[k]) ? curve[k] : ''))].join(','));
    return [[...names, ...modules].join(','), ...rows].join('\n') + '\n';
  }
}

/** The axes of every chart of the page. */
export function axes() {
  const axis = {
    stroke: () => colour('--ink-soft'),
    font: '11px "IBM Plex Sans Variable", system-ui, sans-serif',
    grid: { stroke: () => colour('--line'), width: 1 },
    ticks: { show: false },
    gap: 3,
  };
  return [
    { ...axis, size: 20, space: 60 },
    { ...axis, size: 52, space: 28, values: (/** @type {unknown} */ _, /** @type {number[]} */ ticks) => ticks.map(brief) },
  ];
}

/** @param {{ stroke: () => string, dash?: number[] }[]} lines */
function options(lines) {
  return {
    width: 300,
    height: 100,
    padding: [8, 8, 0, 0],
    legend: { show: false },
    cursor: { sync: { key: 'episodes' }, y: false, points: { size: 6 }, drag: { x: false, y: false } },
    scales: { x: { time: false }, y: { range: (/** @type {unknown} */ _, /** @type {number} */ low, /** @type {number} */ high) => span(low, high) } },
    series: [{}, ...lines.map((line) => ({ ...line, width: 1.75, points: { show: false }, spanGaps: true }))],
    axes: axes(),
  };
}

/** The range of the y axis: it holds 0 and is never empty. @param {number | null} low @param {number | null} high @returns {[number, number]} */
export function span(low, high) {
  const [a, b] = [Math.min(0, low ?? 0), Math.max(0, high ?? 0)];
  return a === b ? [0, 1] : [a - (b - a) * 0.04 * Number(a < 0), b + (b - a) * 0.06];
}
