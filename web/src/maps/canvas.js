// @ts-check
// Labels under a brush: a grid of cells, each with the set of labels that hold there; strokes, undo, and the map file they make.

/** @typedef {import('../protocol.js').MapFacts} MapFacts */
/** @typedef {{ name: string, meaning: string }} Label */
/** What a brush does: erase, or paint a label in place of the others or together with them. */
/** @typedef {{ label: number | null, together: boolean }} Brush */

/** The most labels that are painted by hand: a cell's set is a number of this many bits. */
export const MAX_LABELS = 30;
/** The longest name of a label. */
export const MAX_NAME = 40;
/** The most cells: as many as a picture of 1024 × 1024 pixels has. */
export const MAX_CELLS = 1 << 20;
/** The most steps that can be undone, and the most cells that they remember. */
const [MAX_UNDO, MAX_REMEMBERED] = [100, 1 << 22];

/** A change of cells, with what they were; `labels` if the list of labels changed too. */
/** @typedef {{ places: Uint32Array, before: Uint32Array, labels: Label[] | null, hazard: number }} Change */

export class LabelCanvas {
  /**
   * @param {number} columns
   * @param {number} rows
   * @param {Label[]} labels
   * @param {number} hazard   the label that holds alone wherever it holds; −1: none
   * @param {Uint32Array} [masks]   per cell, row by row, bit k for label k
   */
  constructor(columns, rows, labels, hazard, masks = new Uint32Array(columns * rows)) {
    if (labels.length > MAX_LABELS) throw new RangeError(`the map has ${labels.length} labels; up to ${MAX_LABELS} can be painted by hand`);
    if (columns * rows > MAX_CELLS) throw new RangeError(`the map has ${columns} × ${rows} cells; up to ${MAX_CELLS} can be painted by hand`);
    this.columns = columns;
    this.rows = rows;
    this.labels = labels;
    this.hazard = hazard;
    this.masks = masks;
    /** @type {Change[]} */
    this.past = [];
    /** @type {Change[]} */
    this.future = [];
    /** All cells as they were before the stroke that is going on. @type {Uint32Array | null} */
    this.stroke = null;
  }

  /** The canvas of a map that was read. @param {MapFacts} facts */
  static of(facts) {
    const letters = facts.letters.map((letter) => letter.reduce((mask, k) => mask | (1 << k), 0));
    const [columns, rows] = facts.cells;
    const labels = facts.labels.map(({ name, meaning }) => ({ name, meaning }));
    return new LabelCanvas(columns, rows, labels, facts.hazard ?? -1, Uint32Array.from(facts.indices, (k) => letters[k]));
  }

  /** Begins a stroke: what follows is undone as one. */
  begin() {
    this.stroke ??= this.masks.slice();
  }

  /**
   * Paints the cells whose centres are at most `radius` cells away from the line between two points; at least the cells under its ends.
   * @param {[number, number]} from   column and row, fractions allowed
   * @param {[number, number]} to
   * @param {number} radius
   * @param {Brush} brush
   * @returns {[number, number, number, number]}   the columns and rows that may have changed: first column, first row, columns, rows
   */
  line([x0, y0], [x1, y1], radius, brush) {
    const single = !this.stroke;
    this.begin();
    const [dx, dy] = [x1 - x0, y1 - y0];
    const squared = dx * dx + dy * dy;
    const clampColumn = (/** @type {number} */ c) => Math.max(0, Math.min(this.columns - 1, c));
    const clampRow = (/** @type {number} */ r) => Math.max(0, Math.min(this.rows - 1, r));
    const [left, right] = [clampColumn(Math.floor(Math.min(x0, x1) - radius)), clampColumn(Math.floor(Math.max(x0, x1) + radius))];
    const [top, bottom] = [clampRow(Math.floor(Math.min(y0, y1) - radius)), clampRow(Math.floor(Math.max(y0, y1) + radius))];
    for (let row = top; row <= bottom; row++) {
      for (let column = left; column <= right; column++) {
        const [px, py] = [column + 0.5 - x0, row + 0.5 - y0];
        const along = squared > 0 ? Math.max(0, Math.min(1, (px * dx + py * dy) / squared)) : 0;
        const [ex, ey] = [px - along * dx, py - along * dy];
        if (ex * ex + ey * ey <= radius * radius) this.put(row * this.columns + column, brush);
      }
    }
    for (const [x, y] of [[x0, y0], [x1, y1]]) {
      if (x >= 0 && y >= 0 && x < this.columns && y < this.rows) this.put(Math.floor(y) * this.columns + Math.floor(x), brush);
    }
    if (single) this.end();
    return [left, top, right - left + 1, bottom - top + 1];
  }

  /** @param {number} at @param {Brush} brush */
  put(at, { label, together }) {
    const old = this.masks[at];
    const only = label === null ? 0 : (1 << label) >>> 0;
    const alone = !together || label === null || label === this.hazard || (this.hazard >= 0 && (old >>> this.hazard) & 1);
    const next = alone ? only : (old | only) >>> 0;
    this.masks[at] = next;
  }

  /** Ends the stroke. */
  end() {
    const { stroke, masks } = this;
    this.stroke = null;
    if (!stroke) return;
    let count = 0;
    for (let at = 0; at < masks.length; at++) if (stroke[at] !== masks[at]) count++;
    if (count === 0) return;
    const places = new Uint32Array(count);
    for (let at = 0, k = 0; k < count; at++) if (stroke[at] !== masks[at]) places[k++] = at;
    this.remember({ places, before: places.map((at) => stroke[at]), labels: null, hazard: this.hazard });
  }

  /** @param {Change} change */
  remember(change) {
    this.past.push(change);
    this.future = [];
    let cells = this.past.reduce((sum, { places }) => sum + places.length, 0);
    while (this.past.length > MAX_UNDO || (cells > MAX_REMEMBERED && this.past.length > 1)) cells -= /** @type {Change} */ (this.past.shift()).places.length;
  }

  undo() {
    return this.swap(this.past, this.future);
  }

  redo() {
    return this.swap(this.future, this.past);
  }

  /** Takes the last change of `from` back and puts its contrary on `to`. @param {Change[]} from @param {Change[]} to */
  swap(from, to) {
    this.end();
    const change = from.pop();
    if (!change) return false;
    const contrary = { ...change, before: Uint32Array.from(change.places, (at) => this.masks[at]), labels: change.labels && this.labels, hazard: this.hazard };
    change.places.forEach((at, k) => (this.masks[at] = change.before[k]));
    if (change.labels) this.labels = change.labels;
    this.hazard = change.hazard;
    to.push(contrary);
    return true;
  }

  /**
   * Adds a label; its index, or what is wrong with the name.
   * @param {string} name
   * @param {boolean} [hazard]   whether it is the one that holds alone
   * @returns {number | string}
   */
  add(name, hazard = false) {
    const wanted = name.trim();
    if (wanted === '') return 'A label needs a name.';
    if (wanted.length > MAX_NAME) return `The name has ${wanted.length} characters; at most ${MAX_NAME} are allowed.`;
    if (/["\\\n\r\t]/.test(wanted)) return 'A name has no quotes and no line ends.';
    if (this.labels.some((label) => label.name === wanted)) return `There is a label ${wanted} already.`;
    if (this.labels.length >= MAX_LABELS) return `A map has at most ${MAX_LABELS} labels here.`;
    const meaning = hazard ? 'the rover is on unsafe ground' : `the rover is in ${wanted}`;
    this.remember({ places: new Uint32Array(), before: new Uint32Array(), labels: this.labels, hazard: this.hazard });
    this.labels = [...this.labels, { name: wanted, meaning }];
    if (hazard || (wanted === 'unsafe' && this.hazard < 0)) this.hazard = this.labels.length - 1;
    return this.labels.length - 1;
  }

  /** Removes a label everywhere. @param {number} label */
  remove(label) {
    this.end();
    const below = ((1 << label) - 1) >>> 0;
    const without = (/** @type {number} */ mask) => ((mask & below) | ((mask >>> 1) & ~below)) >>> 0;
    this.whole((mask) => without(mask), this.labels.filter((_, k) => k !== label),
      this.hazard === label ? -1 : this.hazard - Number(this.hazard > label));
  }

  /** Erases everything; the labels stay. */
  clear() {
    this.end();
    this.whole(() => 0, this.labels, this.hazard);
  }

  /** @param {(mask: number) => number} change @param {Label[]} labels @param {number} hazard */
  whole(change, labels, hazard) {
    const places = [];
    for (let at = 0; at < this.masks.length; at++) if (change(this.masks[at]) !== this.masks[at]) places.push(at);
    this.remember({ places: Uint32Array.from(places), before: Uint32Array.from(places, (at) => this.masks[at]), labels: this.labels, hazard: this.hazard });
    for (const at of places) this.masks[at] = change(this.masks[at]);
    this.labels = labels;
    this.hazard = hazard;
  }

  /** Cells per label. */
  areas() {
    const areas = this.labels.map(() => 0);
    for (const mask of this.masks) {
      for (let k = 0, rest = mask; rest; k++, rest >>>= 1) if (rest & 1) areas[k]++;
    }
    return areas;
  }

  /** The names of the labels of the cell at (column, row). @param {number} column @param {number} row */
  at(column, row) {
    const mask = this.masks[row * this.columns + column];
    return this.labels.filter((_, k) => (mask >>> k) & 1).map(({ name }) => name);
  }

  /**
   * The map as a map file (JSON).
   * @param {{ name: string, unit: string, size: [number, number], reach: number, picture: string | null }} frame
   */
  toJson({ name, unit, size: [width, height], reach, picture }) {
    /** @type {Map<number, number>} */
    const known = new Map([[0, 0]]);
    /** @type {[number, number][]} */
    const runs = [];
    for (const mask of this.masks) {
      const letter = known.get(mask) ?? known.size;
      known.set(mask, letter);
      const last = runs[runs.length - 1];
      if (last && last[0] === letter) last[1]++;
      else runs.push([letter, 1]);
    }
    const letters = [...known.keys()].map((mask) => this.labels.filter((_, k) => (mask >>> k) & 1).map((label) => label.name));
    return JSON.stringify({
      name, unit, width, height, reach,
      labels: this.labels,
      ...(this.hazard >= 0 ? { hazard: this.labels[this.hazard].name } : {}),
      ...(picture ? { picture } : {}),
      grid: { columns: this.columns, rows: this.rows, letters, runs },
    });
  }
}
