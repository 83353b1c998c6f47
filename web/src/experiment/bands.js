// @ts-check
// Curves of several seeds as one line with a band: smoothed, brought onto common places, mean, least and greatest.

/** @typedef {{ x: number[], mean: (number | null)[], low: (number | null)[], high: (number | null)[] }} Band */

/** The part of a curve that is averaged around each point. */
const WINDOW = 0.04;

/**
 * The mean over a window around each entry; entries that are no number are left out.
 * @param {ArrayLike<number>} values
 * @param {number} [part]  width of the window, as a part of the curve
 */
export function smooth(values, part = WINDOW) {
  const reach = Math.max(0, Math.floor((values.length * part) / 2));
  return Array.from(values, (_, k) => {
    let [sum, n] = [0, 0];
    for (let j = Math.max(0, k - reach); j <= Math.min(values.length - 1, k + reach); j++) {
      if (Number.isFinite(values[j])) {
        sum += values[j];
        n++;
      }
    }
    return n > 0 ? sum / n : Number.NaN;
  });
}

/**
 * The value of a curve at `x`, between its points by straight lines; before its first point that point's; `null` after its last.
 * @param {ArrayLike<number>} xs  rising
 * @param {ArrayLike<number>} ys
 * @param {number} x
 */
export function at(xs, ys, x) {
  const n = xs.length;
  if (n === 0 || x > xs[n - 1]) return null;
  if (x <= xs[0]) return ys[0];
  let [low, high] = [0, n - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle;
    else high = middle;
  }
  const share = (x - xs[low]) / (xs[high] - xs[low]);
  return ys[low] + (ys[high] - ys[low]) * share;
}

/**
 * Several curves as one. Where some have ended, the band is of those that go on.
 * @param {{ x: ArrayLike<number>, y: ArrayLike<number> }[]} curves
 * @param {number[]} places
 * @returns {Band}
 */
export function band(curves, places) {
  /** @type {Band} */
  const out = { x: places, mean: [], low: [], high: [] };
  const smoothed = curves.map(({ x, y }) => ({ x, y: smooth(y) }));
  for (const place of places) {
    const values = smoothed.map(({ x, y }) => at(x, y, place)).filter((v) => v !== null && Number.isFinite(v)).map(Number);
    out.mean.push(values.length > 0 ? values.reduce((a, b) => a + b, 0) / values.length : null);
    out.low.push(values.length > 0 ? Math.min(...values) : null);
    out.high.push(values.length > 0 ? Math.max(...values) : null);
  }
  return out;
}

/** `count` places from 1 to the end of the longest curve. @param {ArrayLike<number>[]} xs @param {number} [count] */
export function places(xs, count = 120) {
  const last = Math.max(1, ...xs.map((x) => (x.length > 0 ? x[x.length - 1] : 1)));
  return Array.from({ length: Math.min(count, Math.ceil(last)) }, (_, k, all = Math.min(count, Math.ceil(last))) => (all === 1 ? 1 : 1 + ((last - 1) * k) / (all - 1)));
}
