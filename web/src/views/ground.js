// @ts-check
// What the painters share: from the scene's units to the canvas, regions with colour, pattern and name, trails that fade.

import { shapePath } from '../palette.js';

/** @typedef {import('../protocol.js').Ground} Ground */
/** @typedef {import('../protocol.js').Scene} Scene */
/** @typedef {import('../protocol.js').Region} Region */
/** @typedef {import('../track.js').Track} Track */
/** @typedef {import('./stage.js').Colours} Colours */
/** @typedef {import('./stage.js').Scenery} Scenery */
/** @typedef {ReturnType<typeof projection>} Projection */

const DARK = '#1d0f08';
/** Of a proposition with more regions than this the name stands once, in their middle. */
const NAMED_EACH = 1;
/** How many earlier runs are drawn, the oldest faintest. */
export const EARLIER = 6;

/** Whether a proposition says what is to be avoided: the scene's hazard, or one that is called so. @param {Scene} scene @param {import('../protocol.js').Proposition[]} propositions @param {number} p */
export const isHazard = (scene, propositions, p) => p === scene.hazard || propositions[p]?.name === 'unsafe';

/**
 * The map from the ground to a canvas of this size; the ground is fitted and centred.
 * @param {Ground} ground
 * @param {number} width
 * @param {number} height
 */
export function projection(ground, width, height) {
  const [spanX, spanY] = [ground.x[1] - ground.x[0], ground.y[1] - ground.y[0]];
  const scale = Math.min(width / spanX, height / spanY);
  const [left, top] = [(width - spanX * scale) / 2, (height - spanY * scale) / 2];
  const up = ground.y_axis === 'up';
  return {
    /** @param {number} x @param {number} y @returns {[number, number]} */
    point: (x, y) => [left + (x - ground.x[0]) * scale, top + (up ? ground.y[1] - y : y - ground.y[0]) * scale],
    /** @param {number} length */
    size: (length) => length * scale,
    /** @param {number} px @param {number} py @returns {[number, number]} */
    back: (px, py) => [ground.x[0] + (px - left) / scale, up ? ground.y[1] - (py - top) / scale : ground.y[0] + (py - top) / scale],
  };
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Projection} to
 * @param {Region} region
 * @param {Ground} ground
 */
export function trace(context, to, region, ground) {
  const { shape } = region;
  context.beginPath();
  if (shape.kind === 'disc') {
    const [x, y] = to.point(...shape.centre);
    context.arc(x, y, to.size(shape.radius), 0, 2 * Math.PI);
  } else if (shape.kind === 'polygon') {
    shape.points.forEach(([x, y], k) => (k ? context.lineTo(...to.point(x, y)) : context.moveTo(...to.point(x, y))));
    context.closePath();
  } else if (shape.kind === 'cells') {
    // A grid begins in the top-left corner.
    const [wide, high] = shape.cell;
    const [left, top] = to.point(ground.x[0], ground.y_axis === 'up' ? ground.y[1] : ground.y[0]);
    for (const [row, column, count] of shape.runs) {
      context.rect(left + to.size(column * wide), top + to.size(row * high), to.size(count * wide), to.size(high));
    }
  }
}

/** The middle of a region; of a band across the ground the middle of its channel. @param {Region} region @param {Ground} [ground] @returns {[number, number]} */
export function middle(region, ground) {
  const { shape } = region;
  if (shape.kind === 'disc') return shape.centre;
  if (shape.kind === 'polygon') return mean(shape.points);
  if (shape.kind === 'band') return [(shape.low + shape.high) / 2, 0];
  const [wide, high] = shape.cell;
  const [x, y] = mean(shape.runs.map(([row, column, count]) => [(column + count / 2) * wide, (row + 0.5) * high]));
  if (!ground) return [x, y];
  return [ground.x[0] + x, ground.y_axis === 'up' ? ground.y[1] - y : ground.y[0] + y];
}

/** @param {[number, number][]} points @returns {[number, number]} */
function mean(points) {
  const sum = points.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
  return [sum[0] / Math.max(1, points.length), sum[1] / Math.max(1, points.length)];
}

/**
 * The regions of a scene: each outlined, filled while its proposition holds, hatched where it is the hazard; and the names.
 * @param {CanvasRenderingContext2D} context
 * @param {Projection} to
 * @param {Scene} scene
 * @param {import('../protocol.js').Proposition[]} propositions
 * @param {Scenery & { busy?: boolean }} scenery  busy: the ground behind has colours of its own
 */
export function drawRegions(context, to, scene, propositions, scenery) {
  const { colours, layers } = scenery;
  for (const region of scene.regions) {
    const hazard = isHazard(scene, propositions, region.proposition);
    if (!layers.has(hazard ? 'unsafe' : 'labels')) continue;
    const holds = scenery.holds(region.proposition);
    // On a ground with colours of its own the hazard is dark, in every theme.
    const tint = hazard ? (scenery.busy ? DARK : colours.unsafe) : colours.regions[region.proposition % colours.regions.length];
    trace(context, to, region, scene.ground);
    context.fillStyle = tint;
    context.globalAlpha = holds ? 0.6 : scenery.busy ? 0.34 : 0.18;
    context.fill('evenodd');
    context.globalAlpha = 1;
    // A border of the paper's colour under the line, where the ground is not paper.
    if (scenery.busy && !hazard) {
      context.lineWidth = 4.5;
      context.strokeStyle = colours.surface;
      context.stroke();
    }
    context.lineWidth = holds ? 3 : 1.5;
    context.strokeStyle = tint;
    if (region.shape.kind !== 'cells') context.stroke();
    // Last: it takes the path.
    if (hazard) hatch(context, tint);
  }
  if (layers.has('labels')) drawNames(context, to, scene, propositions, colours);
}

/** @param {CanvasRenderingContext2D} context @param {Projection} to @param {Scene} scene @param {import('../protocol.js').Proposition[]} propositions @param {Colours} colours */
function drawNames(context, to, scene, propositions, colours) {
  propositions.forEach(({ name }, p) => {
    if (isHazard(scene, propositions, p)) return;
    const regions = scene.regions.filter((region) => region.proposition === p);
    if (regions.length === 0) return;
    const places = regions.length > NAMED_EACH ? [mean(regions.map((r) => middle(r, scene.ground)))] : regions.map((r) => middle(r, scene.ground));
    for (const [x, y] of places) {
      const radius = regions.length === 1 && regions[0].shape.kind === 'disc' ? to.size(regions[0].shape.radius) : 0;
      const [px, py] = to.point(x, y);
      // Above the disc where there is no room below.
      const below = py + radius + 24 < context.canvas.clientHeight || context.canvas.clientHeight === 0;
      const side = radius > 0 ? (below ? radius + 14 : -radius - 14) : 0;
      nameTag(context, px, py + side, name, colours);
    }
  });
}

/** A name on a tag of its own, to be read on any ground. @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {string} name @param {Colours} colours */
export function nameTag(context, x, y, name, colours) {
  context.font = '500 12px "IBM Plex Mono", ui-monospace, monospace';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  const width = context.measureText(name).width + 10;
  context.beginPath();
  context.roundRect(x - width / 2, y - 9, width, 18, 5);
  context.fillStyle = colours.surface;
  context.globalAlpha = 0.88;
  context.fill();
  context.globalAlpha = 1;
  context.fillStyle = colours.ink;
  context.fillText(name, x, y + 0.5);
}

/** Slanted lines inside the path that was traced last. @param {CanvasRenderingContext2D} context @param {string} tint */
export function hatch(context, tint) {
  context.save();
  context.clip('evenodd');
  context.strokeStyle = tint;
  context.lineWidth = 1;
  context.globalAlpha = 0.55;
  const { width, height } = context.canvas;
  context.beginPath();
  for (let x = -height; x < width; x += 8) {
    context.moveTo(x, height);
    context.lineTo(x + height, 0);
  }
  context.stroke();
  context.restore();
}

/**
 * A trail that fades towards its past.
 * @param {CanvasRenderingContext2D} context
 * @param {number} count
 * @param {(k: number) => [number, number]} point
 * @param {string} tint
 * @param {string | null} [casing]  the colour of a border around it, for grounds of any colour
 */
export function drawTrail(context, count, point, tint, casing = null) {
  if (count < 2) return;
  context.lineCap = 'round';
  context.lineJoin = 'round';
  if (casing) {
    context.strokeStyle = casing;
    context.globalAlpha = 0.55;
    context.lineWidth = 4.5;
    line(context, 0, count - 1, point);
  }
  const pieces = Math.min(24, count - 1);
  context.strokeStyle = tint;
  for (let piece = 0; piece < pieces; piece++) {
    const from = Math.floor((piece * (count - 1)) / pieces);
    const to = Math.floor(((piece + 1) * (count - 1)) / pieces);
    const age = (piece + 1) / pieces;
    context.globalAlpha = casing ? 0.35 + 0.65 * age : 0.06 + 0.74 * age;
    context.lineWidth = 1 + 2 * age;
    line(context, from, to, point);
  }
  context.globalAlpha = 1;
}

/** @param {CanvasRenderingContext2D} context @param {number} from @param {number} to @param {(k: number) => [number, number]} point */
function line(context, from, to, point) {
  context.beginPath();
  context.moveTo(...point(from));
  for (let k = from + 1; k <= to; k++) context.lineTo(...point(k));
  context.stroke();
}

/**
 * The runs before this one, the latest strongest.
 * @param {CanvasRenderingContext2D} context
 * @param {Projection} to
 * @param {Track[]} runs  the latest last
 * @param {[number, number]} channels
 * @param {string} tint
 */
export function drawEarlier(context, to, runs, [cx, cy], tint) {
  context.strokeStyle = tint;
  context.lineWidth = 1;
  context.lineJoin = 'round';
  runs.slice(-EARLIER).forEach((run, k, kept) => {
    context.globalAlpha = 0.08 + (0.22 * (k + 1)) / kept.length;
    line(context, 0, run.length - 1, (j) => to.point(run.value(j, cx), run.value(j, cy)));
  });
  context.globalAlpha = 1;
}

/** The shape of a set, filled, as a path of the canvas. @param {CanvasRenderingContext2D} context @param {number} set @param {number} x @param {number} y @param {number} radius */
export function fillShape(context, set, x, y, radius) {
  const path = new Path2D();
  path.addPath(new Path2D(shapePath(set)), new DOMMatrix([radius, 0, 0, radius, x, y]));
  context.fill(path);
}
