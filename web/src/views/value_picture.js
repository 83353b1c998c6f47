// @ts-check
// Values as a picture: steps of one colour scale from low to high, which grey printers and colour-blind eyes keep in order, with the
// policy's directions as small strokes.

/** @typedef {import('../protocol.js').ValueMap} ValueMap */
/** @typedef {import('./ground.js').Projection} Projection */

/** The scale from low to high: cividis, thinned. */
const SCALE = Object.freeze(['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838']);
/** How many steps the values are drawn in: their borders read as lines of equal value. */
export const STEPS = 14;

/** The colour at part `t` of the scale. @param {number} t  0 … 1 @returns {[number, number, number]} */
export function scaleColour(t) {
  const at = Math.max(0, Math.min(1, Number.isFinite(t) ? t : 0)) * (SCALE.length - 1);
  const k = Math.min(Math.floor(at), SCALE.length - 2);
  const [a, b] = [SCALE[k], SCALE[k + 1]].map((hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  return /** @type {[number, number, number]} */ (a.map((value, i) => Math.round(value + (b[i] - value) * (at - k))));
}

/** The least and the greatest value. @param {Float32Array} values @returns {[number, number]} */
export function extent(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 0];
}

/** A picture with one pixel a point, the greatest second channel on top. @param {ValueMap} map */
export function picture(map) {
  const canvas = document.createElement('canvas');
  canvas.width = map.columns;
  canvas.height = map.rows;
  const context = canvas.getContext('2d');
  if (!context) return canvas;
  const image = context.createImageData(map.columns, map.rows);
  const [low, high] = extent(map.values);
  const width = high - low || 1;
  for (let row = 0; row < map.rows; row++) {
    for (let column = 0; column < map.columns; column++) {
      const t = (map.values[row * map.columns + column] - low) / width;
      const stepped = Math.min(STEPS - 1, Math.floor(t * STEPS)) / (STEPS - 1);
      image.data.set([...scaleColour(stepped), 255], ((map.rows - 1 - row) * map.columns + column) * 4);
    }
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/**
 * The values over the ground.
 * @param {CanvasRenderingContext2D} context
 * @param {Projection} to
 * @param {{ map: ValueMap, picture: HTMLCanvasElement }} value
 * @param {import('../protocol.js').Ground} ground
 * @param {import('./stage.js').Colours} colours
 * @param {number} strength
 */
export function drawValues(context, to, { map, picture: image }, ground, colours, strength) {
  const [x, y] = map.axes;
  const [a, b] = [to.point(x.low, y.low), to.point(x.high, y.high)];
  const [left, top, width, height] = [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.abs(b[0] - a[0]), Math.abs(b[1] - a[1])];
  const up = ground.y_axis === 'up';
  context.save();
  context.globalAlpha = strength;
  context.imageSmoothingEnabled = true;
  context.imageSmoothingQuality = 'high';
  context.translate(left, up ? top : top + height);
  context.scale(1, up ? 1 : -1);
  context.drawImage(image, 0, 0, width, height);
  context.restore();
  strokes(context, map, left, top, width, height, up);
}

/** About one stroke every this many pixels. */
const APART = 30;

/** What the policy does, on a coarse grid. @param {CanvasRenderingContext2D} context @param {ValueMap} map @param {number} left @param {number} top @param {number} width @param {number} height @param {boolean} up */
function strokes(context, map, left, top, width, height, up) {
  const channels = map.controls.length / (map.columns * map.rows);
  if (channels !== 2) return;
  const [across, down] = [Math.max(1, Math.round(width / APART)), Math.max(1, Math.round(height / APART))];
  const line = () => {
    context.beginPath();
    for (let j = 0; j < down; j++) {
      for (let i = 0; i < across; i++) {
        const [column, row] = [Math.floor(((i + 0.5) * map.columns) / across), Math.floor(((j + 0.5) * map.rows) / down)];
        const [u, v] = map.controls.subarray((row * map.columns + column) * 2, (row * map.columns + column) * 2 + 2);
        const length = Math.hypot(u, v);
        if (length < 0.05) continue;
        const reach = (APART * 0.36 * Math.min(1, length)) / length;
        const x = left + ((i + 0.5) * width) / across;
        const y = up ? top + height - ((j + 0.5) * height) / down : top + ((j + 0.5) * height) / down;
        const [dx, dy] = [u * reach, (up ? -v : v) * reach];
        context.moveTo(x - dx / 2, y - dy / 2);
        context.lineTo(x + dx / 2, y + dy / 2);
        // A head of two short strokes.
        context.moveTo(x + dx / 2 - 0.35 * dx + 0.22 * dy, y + dy / 2 - 0.35 * dy - 0.22 * dx);
        context.lineTo(x + dx / 2, y + dy / 2);
        context.lineTo(x + dx / 2 - 0.35 * dx - 0.22 * dy, y + dy / 2 - 0.35 * dy + 0.22 * dx);
      }
    }
    context.stroke();
  };
  context.lineCap = 'round';
  context.strokeStyle = 'rgb(0 0 0 / 55%)';
  context.lineWidth = 2.6;
  line();
  context.strokeStyle = 'rgb(255 255 255 / 90%)';
  context.lineWidth = 1.2;
  line();
}
