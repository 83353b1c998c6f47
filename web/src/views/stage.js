// @ts-check
// The stage: a sharp canvas in the page's colours, on which the painter for the scene's body draws. What seldom changes (ground, regions,
// values, earlier runs) is kept as a picture.

import { colour } from '../dom.js';
import { Frame } from '../protocol.js';
import { Tail, Track } from '../track.js';
import { BallPass } from './ball_pass.js';
import { CartPole } from './cart_pole.js';
import { RoverMap } from './rover_map.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Episode} Episode */
/** @typedef {import('../protocol.js').ValueMap} ValueMap */

/** What can be shown or not. @typedef {'labels' | 'unsafe' | 'paths' | 'value'} Layer */
/** What moves: the state (one number a channel), the states before it, the action. @typedef {{ state: ArrayLike<number>, trail: Track, action: ArrayLike<number> }} Moment */
/**
 * What stands still behind it.
 * @typedef {object} Scenery
 * @property {(proposition: number) => boolean} holds
 * @property {ReadonlySet<string>} layers
 * @property {Track[]} earlier   runs before this one, the latest last
 * @property {{ map: ValueMap, picture: HTMLCanvasElement } | null} value
 * @property {Colours} colours
 */
/** @typedef {Record<'paper' | 'ink' | 'soft' | 'line' | 'accent' | 'unsafe' | 'surface', string> & { regions: string[] }} Colours */
/**
 * @typedef {object} Painter
 * @property {number} aspect  width over height
 * @property {(context: CanvasRenderingContext2D, width: number, height: number, scenery: Scenery) => void} backdrop
 * @property {(context: CanvasRenderingContext2D, width: number, height: number, moment: Moment, scenery: Scenery) => void} paint
 * @property {(x: number, y: number, width: number, height: number) => [number, number]} pointer  scene coordinates of a point of the canvas
 * @property {(again: () => void) => void} [whenLoaded]  calls back when a picture has come
 */

/** @param {Description} description @returns {Painter} */
function painterFor(description) {
  const { scene, propositions } = description.environment;
  switch (scene.body.kind) {
    case 'ball':
      return new BallPass(scene, scene.body, propositions);
    case 'cart_pole':
      return new CartPole(scene, scene.body, propositions, description.environment.state);
    case 'rover':
      return new RoverMap(scene, scene.body, propositions);
  }
}

/** @returns {Colours} */
export function themeColours() {
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
    this.channels = description.environment.state.length;
    this.tail = new Tail(this.channels);
    this.tailEpisode = -1;
    this.scratch = new Frame(description.layout);
    /** The letter of the moment shown, 16 bits a number. @type {number[]} */
    this.letter = [0, 0, 0, 0];
    /** @type {Scenery} */
    this.scenery = {
      holds: (p) => ((this.letter[p >> 4] >> (p & 15)) & 1) === 1, layers: new Set(), earlier: [], value: null, colours: themeColours(),
    };
    this.behind = document.createElement('canvas');
    this.stale = true;
    this.width = 0;
    this.height = 0;
    /** @type {Moment | null} */
    this.shown = null;
    this.scale = 1;
    canvas.style.aspectRatio = String(this.painter.aspect);
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(canvas);
    this.painter.whenLoaded?.(() => this.refresh());
    // Names that were drawn before their font had come.
    document.fonts.ready.then(() => this.refresh());
    this.resize();
    canvas.setAttribute('aria-label', `${description.task.title}: the environment, drawn`);
  }

  close() {
    this.watcher.disconnect();
  }

  /** Forgets the trail, for another run. */
  forget() {
    this.tail.clear();
  }

  /** Takes over the colours of the present theme. */
  retheme() {
    this.scenery.colours = themeColours();
    this.refresh();
  }

  /** Changes what stands behind. @param {Partial<Scenery>} part */
  set(part) {
    Object.assign(this.scenery, part);
    this.refresh();
  }

  refresh() {
    this.stale = true;
    this.repaint();
  }

  resize() {
    const box = this.canvas.getBoundingClientRect();
    this.scale = Math.min(window.devicePixelRatio || 1, 3);
    this.width = box.width;
    this.height = box.height;
    for (const canvas of [this.canvas, this.behind]) {
      canvas.width = Math.max(1, Math.round(box.width * this.scale));
      canvas.height = Math.max(1, Math.round(box.height * this.scale));
      canvas.getContext('2d')?.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    }
    this.refresh();
  }

  /**
   * Shows row `row` of an episode, `fraction` of the way to the next.
   * @param {Episode} episode
   * @param {number} row
   * @param {number} fraction
   */
  replay(episode, row, fraction) {
    const frame = this.scratch.at(episode.data, row);
    const state = frame.numbers('state').slice(0, this.channels);
    if (fraction > 0 && row + 1 < episode.rows) {
      const next = new Track(episode.data, frame.length, frame.field('state').offset, row + 1, 1);
      for (let c = 0; c < this.channels; c++) state[c] += (next.value(0, c) - state[c]) * fraction;
    }
    this.show(frame, state, this.track(episode, row + 1));
  }

  /** The first `rows` states of an episode. @param {Episode} episode @param {number} [rows] */
  track(episode, rows = episode.rows) {
    return new Track(episode.data, this.scratch.length, this.scratch.field('state').offset, 0, rows);
  }

  /**
   * Shows a frame as it comes, with the frames of the same episode before it as its trail.
   * @param {Frame} frame
   */
  live(frame) {
    const episode = frame.counter('episode');
    if (episode !== this.tailEpisode) this.tail.clear();
    this.tailEpisode = episode;
    const state = frame.numbers('state').slice(0, this.channels);
    this.tail.push(state);
    this.show(frame, state, this.tail.track());
  }

  /**
   * @param {Frame} frame
   * @param {Float32Array} state
   * @param {Track} trail
   */
  show(frame, state, trail) {
    const letter = frame.numbers('letter');
    if (letter.some((part, k) => part !== this.letter[k])) {
      this.letter = Array.from(letter);
      this.stale = true;
    }
    this.shown = { state, trail, action: frame.numbers('action').slice() };
    this.repaint();
  }

  repaint() {
    const context = this.canvas.getContext('2d');
    if (!context || !this.shown || this.width === 0) return;
    if (this.stale) {
      const behind = this.behind.getContext('2d');
      if (!behind) return;
      behind.clearRect(0, 0, this.width, this.height);
      this.painter.backdrop(behind, this.width, this.height, this.scenery);
      this.stale = false;
    }
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.behind, 0, 0);
    context.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    this.painter.paint(context, this.width, this.height, this.shown, this.scenery);
  }
}
