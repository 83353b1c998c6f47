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
]);

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
      return { ...chart, value, canvas, plot: new Plot(options(chart.tint), [[], []], canvas) };
    });
    root.append(this.note);
    this.watcher = new ResizeObserver(() => this.fit());
    this.watcher.observe(root);
    this.fit();
  }

  fit() {
    for (const { canvas, plot } of this.charts) {
      const { width, height } = canvas.getBoundingClientRect();
      if (width > 0) plot.setSize({ width, height });
    }
  }

  retheme() {
    for (const { plot } of this.charts) plot.redraw();
  }

  /** @param {CurveData} data */
  update(data) {
    this.data = data;
    const n = data.episode.length;
    for (const { quantity, value, plot } of this.charts) {
      plot.setData([data.episode, data[quantity]]);
      setText(value, n > 0 ? brief(data[quantity][n - 1]) : '–');
    }
    setText(this.note, n === 0 ? 'Press Train: each finished episode adds a point.' : data.every > 1 ? `Each point is the mean of ${data.every} episodes.` : 'Each point is one episode.');
  }

  /** The curves as comma-separated values with a heading. */
  csv() {
    const data = this.data;
    if (!data) return '';
    const names = /** @type {const} */ (['episode', 'average', 'total', 'rounds', 'success', 'critic']);
    const rows = Array.from(data.episode, (_, k) => names.map((name) => data[name][k]).join(','));
    return [names.join(','), ...rows].join('\n') + '\n';
  }
}

/** @param {string} tint */
function options(tint) {
  const axis = {
    stroke: () => colour('--ink-soft'),
    font: '11px "IBM Plex Sans Variable", system-ui, sans-serif',
    grid: { stroke: () => colour('--line'), width: 1 },
    ticks: { show: false },
    gap: 3,
  };
  return {
    width: 300,
    height: 100,
    padding: [8, 8, 0, 0],
    legend: { show: false },
    cursor: { sync: { key: 'episodes' }, y: false, points: { size: 6 }, drag: { x: false, y: false } },
    scales: { x: { time: false }, y: { range: (/** @type {unknown} */ _, /** @type {number} */ low, /** @type {number} */ high) => span(low, high) } },
    series: [{}, { stroke: () => colour(tint), width: 1.75, points: { show: false } }],
    axes: [
      { ...axis, size: 20, space: 60 },
      { ...axis, size: 52, space: 28, values: (/** @type {unknown} */ _, /** @type {number[]} */ ticks) => ticks.map(brief) },
    ],
  };
}

/** The range of the y axis: it holds 0 and is never empty. @param {number | null} low @param {number | null} high @returns {[number, number]} */
export function span(low, high) {
  const [a, b] = [Math.min(0, low ?? 0), Math.max(0, high ?? 0)];
  return a === b ? [0, 1] : [a - (b - a) * 0.04 * Number(a < 0), b + (b - a) * 0.06];
}
