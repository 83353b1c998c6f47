// @ts-check
// The truth of each proposition over the episode, the automaton's state beneath, rounds as ticks; dragging moves through it.

import { colour } from '../dom.js';
import { colourVariable, stateName } from '../palette.js';
import { Frame } from '../protocol.js';
import { fillShape, isHazard } from './ground.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Episode} Episode */
/** @typedef {import('../player.js').Happening} Happening */

const ROW = 16;
const GAP = 4;
const TOP = 14;
const LEFT = 58;

/**
 * Runs of equal values, for drawing: `[first, end)` of each run in which `value(row)` is the same.
 * @template T
 * @param {number} rows
 * @param {(row: number) => T} value
 * @returns {{ first: number, end: number, value: T }[]}
 */
export function runs(rows, value) {
  /** @type {{ first: number, end: number, value: T }[]} */
  const found = [];
  for (let row = 0; row < rows; row++) {
    const v = value(row);
    const last = found[found.length - 1];
    if (last && last.value === v) last.end = row + 1;
    else found.push({ first: row, end: row + 1, value: v });
  }
  return found;
}

export class Timeline {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {(row: number) => void} seek
   */
  constructor(canvas, seek) {
    this.canvas = canvas;
    /** @type {Description | null} */
    this.description = null;
    /** @type {Episode | null} */
    this.episode = null;
    /** @type {Happening[]} */
    this.list = [];
    this.row = 0;
    this.still = document.createElement('canvas');
    this.watcher = new ResizeObserver(() => this.lay());
    this.watcher.observe(canvas);
    /** @param {PointerEvent} event */
    const go = (event) => {
      if (!this.episode) return;
      const box = canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - LEFT) / (box.width - LEFT);
      seek(Math.round(Math.max(0, Math.min(1, part)) * (this.episode.rows - 1)));
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) go(event);
    });
  }

  /** @param {Description} description */
  show(description) {
    this.description = description;
    this.episode = null;
    this.canvas.style.height = `${TOP + (description.environment.propositions.length + 1) * (ROW + GAP)}px`;
    this.lay();
  }

  /**
   * @param {Episode | null} episode
   * @param {Happening[]} list
   */
  load(episode, list) {
    this.episode = episode;
    this.list = list;
    this.lay();
  }

  retheme() {
    this.lay();
  }

  /** Draws all that does not move onto a canvas of its own. */
  lay() {
    const box = this.canvas.getBoundingClientRect();
    const scale = Math.min(window.devicePixelRatio || 1, 3);
    for (const canvas of [this.canvas, this.still]) {
      canvas.width = Math.max(1, Math.round(box.width * scale));
      canvas.height = Math.max(1, Math.round(box.height * scale));
    }
    const context = this.still.getContext('2d');
    if (!context || !this.description || box.width === 0) return;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, box.width, box.height);
    const { propositions, scene } = this.description.environment;
    const episode = this.episode;
    const frame = new Frame(this.description.layout);
    const x = (/** @type {number} */ row) => LEFT + (row / Math.max(1, (episode?.rows ?? 1))) * (box.width - LEFT);
    context.font = '12px "IBM Plex Mono", ui-monospace, monospace';
    context.textBaseline = 'middle';
    const line = (/** @type {number} */ k) => TOP + k * (ROW + GAP);
    propositions.forEach((proposition, p) => {
      const y = line(p);
      context.fillStyle = colour('--ink-soft');
      context.textAlign = 'left';
      context.fillText(proposition.name, 0, y + ROW / 2, LEFT - 6);
      context.fillStyle = colour('--track');
      context.fillRect(LEFT, y, box.width - LEFT, ROW);
      if (!episode) return;
      context.fillStyle = colour(isHazard(scene, propositions, p) ? '--unsafe' : colourVariable(p));
      for (const run of runs(episode.rows, (row) => frame.at(episode.data, row).bit('letter', p))) {
        if (run.value) context.fillRect(x(run.first), y, Math.max(1.5, x(run.end) - x(run.first)), ROW);
      }
    });
    const y = line(propositions.length);
    context.fillStyle = colour('--ink-soft');
    context.fillText('state', 0, y + ROW / 2);
    if (episode) {
      runs(episode.rows, (row) => frame.at(episode.data, row).number('q')).forEach((run, k) => {
        const [from, to] = [x(run.first), x(run.end)];
        context.fillStyle = colour(k % 2 ? '--track-strong' : '--track');
        context.fillRect(from, y, to - from, ROW);
        if (to - from > 24) {
          context.fillStyle = colour('--ink');
          context.fillText(stateName(run.value), from + 4, y + ROW / 2);
        }
      });
      for (const { row, kind } of this.list) this.tick(context, x(row), kind, row, frame, line(propositions.length + 1));
    }
    this.paint();
  }

  /** @param {CanvasRenderingContext2D} context @param {number} x @param {Happening['kind']} kind @param {number} row @param {Frame} frame @param {number} bottom */
  tick(context, x, kind, row, frame, bottom) {
    if (!this.episode || kind === 'move') return;
    frame.at(this.episode.data, row);
    if (kind === 'end') {
      context.fillStyle = colour('--unsafe');
      context.fillRect(x - 1, 0, 2, bottom);
      return;
    }
    const sets = this.description?.automaton.sets ?? 0;
    for (let set = 0, seen = 0; set < sets; set++) {
      if (!frame.bit('fresh', set)) continue;
      context.fillStyle = colour(colourVariable(set));
      fillShape(context, set, x, 6 + 3 * seen++, 4.5);
    }
    if (kind === 'round') {
      context.fillStyle = colour('--ink');
      context.fillRect(x - 0.75, TOP - 2, 1.5, bottom - TOP);
    }
  }

  /** @param {number} row */
  update(row) {
    this.row = row;
    this.paint();
  }

  paint() {
    const context = this.canvas.getContext('2d');
    if (!context) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.still, 0, 0);
    if (!this.episode) return;
    const scale = Math.min(window.devicePixelRatio || 1, 3);
    const left = LEFT * scale;
    const x = left + ((this.row + 0.5) / Math.max(1, this.episode.rows)) * (this.canvas.width - left);
    context.fillStyle = colour('--accent');
    context.fillRect(x - scale, 0, 2 * scale, this.canvas.height);
  }
}
