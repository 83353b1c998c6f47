// @ts-check
// The stage: a sharp canvas in the page's colours, on which the painter for the scene's body draws.

import { colour } from '../dom.js';
import { Frame } from '../protocol.js';
import { BallPass } from './ball_pass.js';
import { CartPole } from './cart_pole.js';
import { RoverMap } from './rover_map.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Episode} Episode */

/**
 * What a painter gets: the state (one number a channel), and which propositions hold.
 * @typedef {{ state: ArrayLike<number>, holds: (proposition: number) => boolean, trail: ArrayLike<number>[], action: ArrayLike<number> }} Moment
 */
/** @typedef {Record<'paper' | 'ink' | 'soft' | 'line' | 'accent' | 'unsafe' | 'surface', string> & { regions: string[] }} Colours */
/**
 * @typedef {object} Painter
 * @property {number} aspect  width over height
 * @property {(context: CanvasRenderingContext2D, width: number, height: number, moment: Moment, colours: Colours) => void} paint
 * @property {((x: number, y: number, width: number, height: number) => [number, number]) | undefined} [pointer]  scene coordinates of a point of the canvas
 */

/** How many earlier states the trail has. */
const TRAIL = 240;

/** @param {Description} description @returns {Painter} */
function painterFor(description) {
  const { scene, propositions } = description.environment;
  switch (scene.body.kind) {
    case 'ball':
      return new BallPass(scene, scene.body, propositions);
    case 'cart_pole':
      return new CartPole(scene, scene.body, propositions);
    case 'rover':
      return new RoverMap(scene, scene.body, propositions);
  }
}

/** @returns {Colours} */
function themeColours() {
  const one = (/** @type {string} */ name) => colour(`--${name}`);
  return {
    paper: one('stage'), ink: one('ink'), soft: one('ink-soft'), line: one('line'), accent: one('accent'), unsafe: one('unsafe'), surface: one('surface'),
    regions: [0, 1, 2, 3, 4, 5].map((k) => one(`set-${k}`)),
  };
}

export class Stage {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Description} description
   */
  constructor(canvas, description) {
    this.canvas = canvas;
    this.description = description;
    this.painter = painterFor(description);
    this.colours = themeColours();
    this.channels = description.environment.state.length;
    /** @type {Float32Array[]} */
    this.recent = [];
    this.recentEpisode = -1;
    this.scratch = new Frame(description.layout);
    this.width = 0;
    this.height = 0;
    /** @type {Moment | null} */
    this.shown = null;
    canvas.style.aspectRatio = String(this.painter.aspect);
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(canvas);
    this.resize();
    canvas.setAttribute('aria-label', `${description.task.title}: the environment, drawn`);
  }

  close() {
    this.watcher.disconnect();
  }

  /** Forgets the trail, for another run. */
  forget() {
    this.recent = [];
  }

  /** Takes over the colours of the present theme. */
  retheme() {
    this.colours = themeColours();
    this.repaint();
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    const scale = Math.min(window.devicePixelRatio || 1, 3);
    this.width = box.width;
    this.height = box.height;
    this.canvas.width = Math.max(1, Math.round(box.width * scale));
    this.canvas.height = Math.max(1, Math.round(box.height * scale));
    this.canvas.getContext('2d')?.setTransform(scale, 0, 0, scale, 0, 0);
    this.repaint();
  }

  /**
   * Shows row `row` of an episode, `fraction` of the way to the next.
   * @param {Episode} episode
   * @param {number} row
   * @param {number} fraction
   */
  replay(episode, row, fraction) {
    const { length } = this.description.layout;
    const offset = this.scratch.field('state').offset;
    const stateAt = (/** @type {number} */ r) => episode.data.subarray(r * length + offset, r * length + offset + this.channels);
    const trail = [];
    for (let r = Math.max(0, row - TRAIL); r <= row; r++) trail.push(stateAt(r));
    let state = stateAt(row);
    if (fraction > 0 && row + 1 < episode.rows) {
      const [from, to] = [state, stateAt(row + 1)];
      state = Float32Array.from(from, (value, k) => value + (to[k] - value) * fraction);
      trail.push(state);
    }
    this.scratch.at(episode.data, row);
    this.show(this.scratch, state, trail);
  }

  /**
   * Shows a frame as it comes, with the frames of the same episode before it as its trail.
   * @param {Frame} frame
   */
  live(frame) {
    const episode = frame.counter('episode');
    if (episode !== this.recentEpisode) this.recent = [];
    this.recentEpisode = episode;
    const state = frame.numbers('state').slice(0, this.channels);
    this.recent.push(state);
    if (this.recent.length > TRAIL) this.recent.shift();
    this.show(frame, state, this.recent);
  }

  /**
   * @param {Frame} frame
   * @param {Float32Array} state
   * @param {Float32Array[]} trail
   */
  show(frame, state, trail) {
    const letter = Array.from(frame.numbers('letter'));
    this.shown = {
      state,
      trail,
      holds: (p) => ((letter[p >> 4] >> (p & 15)) & 1) === 1,
      action: frame.numbers('action').slice(),
    };
    this.repaint();
  }

  repaint() {
    const context = this.canvas.getContext('2d');
    if (!context || !this.shown || this.width === 0) return;
    context.clearRect(0, 0, this.width, this.height);
    this.painter.paint(context, this.width, this.height, this.shown, this.colours);
  }
}
