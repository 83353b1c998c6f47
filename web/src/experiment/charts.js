// @ts-check
// The curves of an experiment: each variant a line with a band over its seeds, told apart by colour and dashes.

import { element } from '../dom.js';
import { axes, span } from '../views/curves.js';
import { colour } from '../dom.js';
import { band, places } from './bands.js';

/** @typedef {import('./run.js').Run} Run */
/** @typedef {import('./variants.js').Variant} Variant */
/** @typedef {import('../views/curves.js').Plot} Plot */
/** @typedef {import('../views/curves.js').PlotClass} PlotClass */
/** @typedef {'average' | 'rounds' | 'success'} Quantity */

/** @type {readonly { quantity: Quantity, title: string, unit: string }[]} */
const CHARTS = Object.freeze([
  { quantity: 'success', title: 'Success', unit: 'share of episodes, exploring' },
  { quantity: 'rounds', title: 'Rounds', unit: 'per episode, exploring' },
  { quantity: 'average', title: 'Average reward', unit: 'per step' },
]);

export class ExperimentCharts {
  /**
   * @param {HTMLElement} root
   * @param {PlotClass} Plot
   * @param {readonly Variant[]} variants
   */
  constructor(root, Plot, variants) {
    this.variants = variants;
    this.charts = CHARTS.map((chart) => {
      const canvas = element('div', { className: 'plot tall', 'aria-hidden': 'true' });
      root.append(element('figure', { className: 'curve' },
        element('figcaption', {}, element('span', { className: 'name' }, chart.title), element('span', { className: 'unit' }, chart.unit)), canvas));
      return { ...chart, canvas, plot: new Plot(this.options(), [[], ...variants.flatMap(() => [[], [], []])], canvas) };
    });
    this.watcher = new ResizeObserver(() => this.fit());
    this.watcher.observe(root);
    this.fit();
  }

  close() {
    this.watcher.disconnect();
    for (const { plot } of this.charts) plot.destroy();
  }

  options() {
    const series = this.variants.flatMap(({ tint, dash }) => [
      { stroke: () => colour(tint), width: 2, dash, points: { show: false }, spanGaps: true },
      { stroke: 'transparent', width: 0, points: { show: false } },
      { stroke: 'transparent', width: 0, points: { show: false } },
    ]);
    const bands = this.variants.map(({ tint }, k) => ({ series: [3 * k + 3, 3 * k + 2], fill: () => faint(colour(tint)) }));
    return {
      width: 300, height: 150, padding: [8, 8, 0, 0], legend: { show: false }, series: [{}, ...series], bands,
      cursor: { sync: { key: 'experiment' }, y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { range: (/** @type {unknown} */ _, /** @type {number} */ low, /** @type {number} */ high) => span(low, high) } },
      axes: axes(),
    };
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

  /** @param {Run[]} runs */
  update(runs) {
    const drawn = runs.flatMap((run) => (run.curves && run.curves.episode.length > 0 ? [{ run, curves: run.curves }] : []));
    const at = places(drawn.map(({ curves }) => curves.episode));
    for (const { quantity, plot } of this.charts) {
      const bands = this.variants.map((variant) => band(drawn.filter(({ run }) => run.variant === variant).map(({ curves }) => ({ x: curves.episode, y: curves[quantity] })), at));
      plot.setData([at, ...bands.flatMap(({ mean, low, high }) => [mean, low, high])]);
    }
  }
}

/** The colour, mostly transparent. @param {string} rgb */
const faint = (rgb) => rgb.replace(/^rgb\((.*)\)$/, 'rgb($1 / 16%)').replaceAll(',', ' ');
