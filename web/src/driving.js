// @ts-check
// A run that the user drives: each push asks for a step of the environment, until the run ends.

import { count } from './dom.js';
import { END } from './protocol.js';
import { Recorder } from './player.js';
import { Driver } from './views/drive.js';

/** @typedef {import('./protocol.js').Frame} Frame */

export class Driving {
  /** @param {import('./theatre.js').Theatre} theatre  on whose stage it is shown */
  constructor(theatre) {
    this.theatre = theatre;
    this.driver = new Driver(theatre.canvas);
    /** Whether a step has been asked for, and not been answered yet. */
    this.asking = false;
  }

  /** Forgets a step that was asked for: it belongs to another session. */
  reset() {
    this.asking = false;
  }

  /** Begins a run at a start of the environment. */
  async begin() {
    const { theatre } = this;
    const answer = await theatre.ask({ kind: 'begin_drive', index: theatre.episodeIndex++ });
    if (!this.concerns(answer)) return;
    theatre.recorder = new Recorder();
    theatre.stage?.forget();
    this.driver.activate(true);
    theatre.setPlaying(true);
    this.asking = false;
    theatre.say('Push with the arrow keys, or press on the picture');
    this.take(answer.data);
  }

  /** Goes on, if it is time for a step. @param {number} seconds  wall time that went by */
  on(seconds) {
    const { driver } = this;
    const { player, description, stage, speed } = this.theatre;
    if (!description || !stage || this.asking || !driver.active || !player.playing) return;
    // Where time has no unit nothing moves by itself: the world waits for the hand.
    if (description.environment.dt === 0 && !driver.pushes) return;
    if (driver.tick(seconds, player.rowsPerSecond * Math.min(speed, 1))) this.step(driver.control(description, stage), null);
  }

  /** Asks for one step. @param {number[]} control @param {number | null} jump  the target of an ε-jump instead */
  async step(control, jump) {
    this.asking = true;
    const answer = await this.theatre.ask({ kind: 'drive', control, jump });
    this.asking = false;
    if (this.concerns(answer)) this.take(answer.data);
  }

  /** Whether an answer is of the session that is open, and the user still drives. @param {{ generation: number } | undefined} answer */
  concerns(answer) {
    return answer !== undefined && answer.generation === this.theatre.generation && this.theatre.mode === 'drive';
  }

  /** Shows a step. @param {Float32Array} data */
  take(data) {
    const { theatre } = this;
    const frame = /** @type {Frame} */ (theatre.reader).at(data, 0);
    theatre.recorder.add(frame);
    theatre.paintLive(performance.now(), frame);
    const still = theatre.description?.environment.action.map(() => 0) ?? [];
    theatre.frontier.jumps(frame, (target) => this.step(still, target));
    if (frame.number('episode_step') > 0) theatre.say('');
    const end = frame.number('end');
    if (end === END.running) return;
    this.driver.activate(false);
    const what = end === END.terminated ? 'The run has ended' : 'Time is up';
    theatre.say(`${what} after ${count(frame.number('episode_step'))} steps, ${count(frame.number('rounds'))} rounds. Space starts again.`);
  }
}
