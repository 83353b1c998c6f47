// @ts-check
// The playback clock over one episode: which row is shown, how far towards the next, and where something happened.

import { END, Frame } from './protocol.js';

/** @typedef {import('./protocol.js').Layout} Layout */
/** @typedef {import('./protocol.js').Episode} Episode */
/** @typedef {{ row: number, kind: 'round' | 'visit' | 'move' | 'sink' | 'end' }} Happening */

/**
 * Rows at which the automaton moved, an accepting set was visited for the frontier, a round closed or the episode ended.
 * @param {Layout} layout
 * @param {Episode} episode
 * @returns {Happening[]}
 */
export function happenings(layout, episode) {
  const frame = new Frame(layout);
  /** @type {Happening[]} */
  const found = [];
  let before = -1;
  for (let row = 0; row < episode.rows; row++) {
    frame.at(episode.data, row);
    const q = frame.number('q');
    if (frame.number('closes_round') === 1) found.push({ row, kind: 'round' });
    else if (frame.number('fresh', 0) + frame.number('fresh', 1) > 0) found.push({ row, kind: 'visit' });
    else if (row > 0 && q !== before) found.push({ row, kind: 'move' });
    else if (frame.number('end') === END.terminated) found.push({ row, kind: 'end' });
    before = q;
  }
  return found;
}

/** Plays an episode; knows no DOM and no wall clock: the page tells it how many seconds went by. */
export class Player {
  /** @param {number} dt  simulated seconds between rows; 0 where time has no unit */
  constructor(dt) {
    this.rowsPerSecond = dt > 0 ? 1 / dt : 60;
    /** @type {Episode | null} */
    this.episode = null;
    /** Whose episode it is, or one that was kept. @type {import('./protocol.js').Whose | 'kept'} */
    this.of = 'present';
    /** Of the best policy: after how many steps of training. */
    this.after = 0;
    /** Position in rows; the whole part is the row shown. */
    this.position = 0;
    this.playing = true;
    this.speed = 1;
  }

  /** @param {Episode} episode */
  load(episode) {
    this.episode = episode;
    this.position = 0;
  }

  get last() {
    return this.episode ? this.episode.rows - 1 : 0;
  }

  get row() {
    return Math.min(Math.floor(this.position), this.last);
  }

  /** How far from this row to the next, 0 … 1. */
  get fraction() {
    return this.row >= this.last ? 0 : this.position - this.row;
  }

  get finished() {
    return this.episode !== null && this.position >= this.last;
  }

  /** @param {number} seconds  wall time that went by */
  tick(seconds) {
    if (this.playing && this.episode) this.position = Math.min(this.position + seconds * this.speed * this.rowsPerSecond, this.last);
  }

  /** @param {number} row */
  seek(row) {
    this.position = Math.max(0, Math.min(Math.round(row), this.last));
  }

  /**
   * Goes to the nearest happening before (−1) or after (+1) the present row, else to the end on that side.
   * @param {Happening[]} list
   * @param {-1 | 1} direction
   */
  jump(list, direction) {
    const rows = list.map((h) => h.row).filter((r) => (direction > 0 ? r > this.row : r < this.row));
    this.seek(direction > 0 ? Math.min(this.last, ...rows) : Math.max(0, ...rows));
  }
}

/** The longest episode that is recorded, in frames; of a longer one the last frames are kept. */
const LONGEST = 10_000;

/** Collects the frames of the episode that training is in, as far as the page sees them. */
export class Recorder {
  constructor() {
    this.number = -1;
    /** @type {Float32Array[]} */
    this.frames = [];
  }

  /** @param {Frame} frame */
  add(frame) {
    const number = frame.counter('episode');
    if (number !== this.number) this.frames = [];
    this.number = number;
    this.frames.push(frame.data.slice(frame.base, frame.base + frame.length));
    if (this.frames.length > LONGEST) this.frames.splice(0, LONGEST / 10);
  }

  /**
   * What was seen of the episode; `null` while it is nothing.
   * @param {number} length  numbers a frame
   * @returns {Episode | null}
   */
  episode(length) {
    if (this.frames.length === 0) return null;
    const data = new Float32Array(this.frames.length * length);
    this.frames.forEach((frame, k) => data.set(frame, k * length));
    return { rows: this.frames.length, data, rounds: 0, success: false };
  }
}
