// @ts-check
// States one after the other, read in place: what a trail is drawn from.

/** A stretch of an array of rows; nothing is copied. */
export class Track {
  /**
   * @param {Float32Array} data
   * @param {number} stride  numbers a row
   * @param {number} offset  where the state begins in a row
   * @param {number} first   the first row
   * @param {number} length  how many rows
   */
  constructor(data, stride, offset, first, length) {
    this.data = data;
    this.stride = stride;
    this.offset = offset;
    this.first = first;
    this.length = length;
  }

  /** Channel `channel` of the `k`-th state. @param {number} k @param {number} channel */
  value(k, channel) {
    return this.data[(this.first + k) * this.stride + this.offset + channel];
  }

  /** The last `length` of these states. @param {number} length */
  tail(length) {
    const kept = Math.min(length, this.length);
    return new Track(this.data, this.stride, this.offset, this.first + this.length - kept, kept);
  }
}

/** The most states that are kept of a run that goes on. */
const LONGEST = 20_000;

/** States as they come. */
export class Tail {
  /** @param {number} channels */
  constructor(channels) {
    this.channels = channels;
    this.data = new Float32Array(256 * channels);
    this.count = 0;
  }

  clear() {
    this.count = 0;
  }

  /** @param {ArrayLike<number>} state */
  push(state) {
    if (this.count === LONGEST) {
      this.data.copyWithin(0, (LONGEST / 10) * this.channels);
      this.count -= LONGEST / 10;
    }
    if ((this.count + 1) * this.channels > this.data.length) {
      const larger = new Float32Array(this.data.length * 2);
      larger.set(this.data);
      this.data = larger;
    }
    this.data.set(state, this.count * this.channels);
    this.count++;
  }

  track() {
    return new Track(this.data, this.channels, 0, 0, this.count);
  }

  /** The states so far, as a track of their own that does not change any more. */
  copy() {
    return new Track(this.data.slice(0, this.count * this.channels), this.channels, 0, 0, this.count);
  }
}
