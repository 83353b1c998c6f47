// @ts-check
// The easel: a canvas on which labels are painted with pointer, touch or keys, over the map's picture.

import { colour } from '../dom.js';
import { colourVariable } from '../palette.js';

/** @typedef {import('./canvas.js').LabelCanvas} LabelCanvas */
/** @typedef {import('./canvas.js').Brush} Brush */

/** How much of the ground is seen through a label, of 255. */
const OPACITY = 150;
/** How far the arrow keys move the brush, and with Shift, in shares of the longer side. */
const [NEAR, FAR] = [1 / 120, 1 / 15];

export class Easel {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {{ brush: () => Brush & { radius: number }, painted: () => void, moved: (words: string) => void }} owner
   *   `painted` after each stroke; `moved` with what lies under the brush when keys moved it
   */
  constructor(canvas, owner) {
    this.canvas = canvas;
    this.owner = owner;
    this.tiles = document.createElement('canvas');
    /** @type {LabelCanvas | null} */
    this.labels = null;
    /** @type {HTMLImageElement | null} */
    this.picture = null;
    /** Where the brush is, in cells. @type {[number, number] | null} */
    this.at = null;
    /** The pointer that paints. @type {number | null} */
    this.pointer = null;
    this.held = false;
    this.waiting = false;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    for (const kind of /** @type {const} */ (['pointerup', 'pointercancel'])) canvas.addEventListener(kind, (event) => this.up(event));
    canvas.addEventListener('pointerleave', () => this.leave());
    canvas.addEventListener('blur', () => this.letGo());
    canvas.addEventListener('keydown', (event) => this.key(event));
    canvas.addEventListener('keyup', (event) => {
      if (event.key === ' ') this.letGo();
    });
    this.watcher = new ResizeObserver(() => this.soon());
    this.watcher.observe(canvas);
  }

  /** Shows a map. @param {LabelCanvas} labels @param {string | null} address  of its picture @param {[number, number]} size */
  show(labels, address, size) {
    this.labels = labels;
    this.at = null;
    this.tiles.width = labels.columns;
    this.tiles.height = labels.rows;
    this.canvas.style.aspectRatio = `${size[0]} / ${size[1]}`;
    this.picture = null;
    if (address) {
      const picture = new Image();
      picture.onload = () => this.soon();
      picture.src = address;
      this.picture = picture;
    }
    this.refresh();
  }

  /** Paints the cells of a rectangle anew, or all. @param {[number, number, number, number]} [rectangle] */
  refresh(rectangle) {
    const { labels } = this;
    if (!labels) return;
    const [left, top, columns, rows] = rectangle ?? [0, 0, labels.columns, labels.rows];
    const image = new ImageData(columns, rows);
    const tints = labels.labels.map((_, k) => rgb(k === labels.hazard ? '--unsafe' : colourVariable(k)));
    let at = 0;
    for (let row = top; row < top + rows; row++) {
      for (let column = left; column < left + columns; column++, at += 4) {
        const mask = labels.masks[row * labels.columns + column];
        if (mask === 0) continue;
        // Labels that overlap alternate in stripes; unsafe ground is striped by itself.
        const several = [];
        for (let k = 0; k < tints.length; k++) if ((mask >>> k) & 1) several.push(k);
        const label = several[((column + row) >> 1) % several.length];
        const [r, g, b] = tints[label];
        image.data.set([r, g, b, label === labels.hazard && ((column + row) >> 1) % 3 === 0 ? 235 : OPACITY], at);
      }
    }
    this.tiles.getContext('2d')?.putImageData(image, left, top);
    this.soon();
  }

  soon() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.repaint();
    });
  }

  repaint() {
    const { canvas, labels, tiles } = this;
    const context = canvas.getContext('2d');
    const box = canvas.getBoundingClientRect();
    if (!context || !labels || box.width === 0) return;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(box.width * scale), Math.round(box.height * scale)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.fillStyle = colour('--stage');
    context.fillRect(0, 0, box.width, box.height);
    if (this.picture?.complete && this.picture.naturalWidth > 0) {
      context.imageSmoothingEnabled = true;
      context.drawImage(this.picture, 0, 0, box.width, box.height);
    }
    context.imageSmoothingEnabled = false;
    context.drawImage(tiles, 0, 0, box.width, box.height);
    const [sx, sy] = [box.width / labels.columns, box.height / labels.rows];
    for (const { name, column, row } of names(labels)) {
      tag(context, column * sx, row * sy, name);
    }
    if (!this.at) return;
    context.beginPath();
    context.ellipse(this.at[0] * sx, this.at[1] * sy, Math.max(4, this.owner.brush().radius * sx), Math.max(4, this.owner.brush().radius * sy), 0, 0, 2 * Math.PI);
    for (const [tint, thick] of /** @type {[string, number][]} */ ([[colour('--surface'), 4], [colour('--ink'), 1.75]])) {
      context.strokeStyle = tint;
      context.lineWidth = thick;
      context.stroke();
    }
  }

  // --- pointer and touch ----------------------------------------------------------------------------------------------------

  /** @param {PointerEvent} event @returns {[number, number]} */
  cell(event) {
    const box = this.canvas.getBoundingClientRect();
    const { columns, rows } = /** @type {LabelCanvas} */ (this.labels);
    return [((event.clientX - box.left) / box.width) * columns, ((event.clientY - box.top) / box.height) * rows];
  }

  /** @param {[number, number]} to */
  draw(to) {
    if (!this.labels) return;
    const { radius, ...brush } = this.owner.brush();
    this.refresh(this.labels.line(this.at ?? to, to, radius, brush));
    this.at = to;
  }

  /** @param {PointerEvent} event */
  down(event) {
    if (!this.labels || this.pointer !== null || event.button !== 0) return;
    this.pointer = event.pointerId;
    this.canvas.setPointerCapture(event.pointerId);
    this.labels.begin();
    this.at = null;
    this.draw(this.cell(event));
  }

  /** @param {PointerEvent} event */
  move(event) {
    if (!this.labels || (this.pointer !== null && this.pointer !== event.pointerId)) return;
    if (this.pointer === null) {
      this.at = this.cell(event);
      return this.soon();
    }
    for (const one of event.getCoalescedEvents?.() ?? [event]) this.draw(this.cell(one));
    this.draw(this.cell(event));
  }

  /** @param {PointerEvent} event */
  up(event) {
    if (this.pointer !== event.pointerId) return;
    this.pointer = null;
    this.labels?.end();
    this.owner.painted();
  }

  leave() {
    if (this.pointer !== null || document.activeElement === this.canvas) return;
    this.at = null;
    this.soon();
  }

  // --- keys ------------------------------------------------------------------------------------------------------------------

  /** @param {KeyboardEvent} event */
  key(event) {
    const { labels } = this;
    if (!labels || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = Math.max(1, Math.round(Math.max(labels.columns, labels.rows) * (event.shiftKey ? FAR : NEAR)));
    const steps = /** @type {Record<string, [number, number]>} */ ({ ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] });
    const from = this.at ?? [labels.columns / 2, labels.rows / 2];
    if (event.key === ' ' || event.key === 'Enter') {
      event.preventDefault();
      if (event.repeat) return;
      labels.begin();
      this.at = null;
      this.draw([from[0], from[1]]);
      this.held = event.key === ' ';
      if (!this.held) labels.end();
      this.owner.painted();
      return this.say();
    }
    const by = steps[event.key];
    if (!by) return;
    event.preventDefault();
    /** @type {[number, number]} */
    const to = [Math.max(0.5, Math.min(labels.columns - 0.5, from[0] + by[0])), Math.max(0.5, Math.min(labels.rows - 0.5, from[1] + by[1]))];
    if (this.held) this.draw(to);
    this.at = to;
    this.soon();
    this.say();
  }

  letGo() {
    if (!this.held) return;
    this.held = false;
    this.labels?.end();
    this.owner.painted();
  }

  /** Says what lies under the brush. */
  say() {
    const { labels, at } = this;
    if (!labels || !at) return;
    const [column, row] = [Math.floor(at[0]), Math.floor(at[1])];
    this.owner.moved(`Column ${column + 1} of ${labels.columns}, row ${row + 1} of ${labels.rows}: ${labels.at(column, row).join(', ') || 'free'}`);
  }
}

/** @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {string} name */
function tag(context, x, y, name) {
  context.font = '500 13px "IBM Plex Mono", ui-monospace, monospace';
  // The whole name stands on the canvas.
  const { width, height } = context.canvas.getBoundingClientRect();
  const half = context.measureText(name).width / 2 + 3;
  [x, y] = [Math.max(half, Math.min(width - half, x)), Math.max(11, Math.min(height - 11, y))];
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.lineWidth = 4;
  context.lineJoin = 'round';
  context.strokeStyle = colour('--surface');
  context.strokeText(name, x, y);
  context.fillStyle = colour('--ink');
  context.fillText(name, x, y);
}

/** Where the names of labels stand: in the middle of the longest run of each. @param {LabelCanvas} labels */
function names(labels) {
  const best = labels.labels.map(({ name }) => ({ name, column: 0, row: 0, length: 0 }));
  for (let row = 0; row < labels.rows; row++) {
    for (let from = 0; from < labels.columns;) {
      const mask = labels.masks[row * labels.columns + from];
      let to = from + 1;
      while (to < labels.columns && labels.masks[row * labels.columns + to] === mask) to++;
      for (let k = 0, rest = mask; rest; k++, rest >>>= 1) {
        if (rest & 1 && to - from > best[k].length) Object.assign(best[k], { column: (from + to) / 2, row: row + 0.5, length: to - from });
      }
      from = to;
    }
  }
  return best.filter(({ length }) => length > 0);
}

/** The red, green and blue of a colour of the stylesheet. @param {string} variable @returns {[number, number, number]} */
function rgb(variable) {
  const probe = document.createElement('canvas');
  probe.width = probe.height = 1;
  const context = probe.getContext('2d');
  if (!context) return [128, 128, 128];
  context.fillStyle = colour(variable);
  context.fillRect(0, 0, 1, 1);
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  return [r, g, b];
}
