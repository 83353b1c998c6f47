// @ts-check
// When a run is kept: every so often while it trains, and never so often that keeping takes more than a fortieth of the time.

/** The shortest and the longest time between two checkpoints of a run that goes on, in milliseconds. */
export const SHORTEST = 5_000;
export const LONGEST = 300_000;
/** How many times as long as keeping takes there is none. */
const SHARE = 40;

export class Cadence {
  constructor() {
    this.last = -Infinity;
    this.took = 0;
    this.steps = 0;
  }

  /** Another run. @param {number} steps  that are kept of it already */
  begin(steps) {
    this.last = -Infinity;
    this.steps = steps;
  }

  get interval() {
    return Math.max(SHORTEST, Math.min(LONGEST, this.took * SHARE));
  }

  /** Whether there is something new. @param {number} steps */
  news(steps) {
    return steps > 0 && steps !== this.steps;
  }

  /** Whether a run that goes on is due. @param {number} now @param {number} steps */
  due(now, steps) {
    if (this.last === -Infinity) this.last = now;
    return this.news(steps) && now - this.last >= this.interval;
  }

  /** Something was kept. @param {number} began @param {number} ended @param {number} steps */
  kept(began, ended, steps) {
    this.took = ended - began;
    this.last = ended;
    this.steps = steps;
  }
}
