// @ts-check
// The transport: buttons, scrubber and clock of the playback.

import { byId, setText } from './dom.js';

/**
 * @typedef {object} TransportActions
 * @property {() => void} play
 * @property {(row: number) => void} seek
 * @property {(rows: number) => void} step      by so many rows
 * @property {(direction: -1 | 1) => void} jump to the event before or after
 * @property {() => void} next                  another episode
 */

export class Transport {
  /** @param {TransportActions} actions */
  constructor(actions) {
    const button = (/** @type {string} */ id) => byId(id, HTMLButtonElement);
    this.play = button('play');
    this.moves = ['previous', 'back', 'forward', 'following'].map(button);
    this.next = button('next-episode');
    this.scrub = byId('scrub', HTMLInputElement);
    this.clock = byId('clock', HTMLElement);
    this.play.addEventListener('click', actions.play);
    const acts = [() => actions.jump(-1), () => actions.step(-1), () => actions.step(1), () => actions.jump(1)];
    this.moves.forEach((move, k) => move.addEventListener('click', acts[k]));
    this.next.addEventListener('click', actions.next);
    this.scrub.addEventListener('input', () => actions.seek(Number(this.scrub.value)));
  }

  /** What can be done: move through an episode, play, ask for another. @param {boolean} through @param {boolean} play @param {boolean} next */
  enable(through, play, next) {
    for (const part of [...this.moves, this.scrub]) part.disabled = !through;
    this.play.disabled = !play;
    this.next.disabled = !next;
  }

  /** @param {boolean} playing */
  playing(playing) {
    this.play.classList.toggle('paused', !playing);
    this.play.setAttribute('aria-label', playing ? 'Pause playback' : 'Play');
  }

  /** @param {number} last */
  length(last) {
    this.scrub.max = String(last);
  }

  /** @param {number} row @param {number} last */
  at(row, last) {
    this.scrub.value = String(row);
    this.scrub.setAttribute('aria-valuetext', `step ${row} of ${last}`);
    setText(this.clock, `${row}/${last}`);
  }

  /** @param {number} step */
  live(step) {
    setText(this.clock, `step ${step}`);
  }
}
