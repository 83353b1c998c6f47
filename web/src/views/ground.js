// @ts-check
// What the painters share: from the scene's units to the canvas, regions with colour, pattern and name, trails that fade.

import { shapePath } from '../palette.js';

/** @typedef {import('../protocol.js').Ground} Ground */
/** @typedef {import('../protocol.js').Region} Region */
/** @typedef {import('./stage.js').Colours} Colours */
/** @typedef {ReturnType<typeof projection>} Projection */

/** @param {string} name */
export const isUnsafe = (name) => name === 'unsafe';

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
 * @param {Region} region  a disc or a polygon
 */
export function trace(context, to, region) {
  const { shape } = region;
  context.beginPath();
  if (shape.kind === 'disc') {
    const [x, y] = to.point(...shape.centre);
    context.arc(x, y, to.size(shape.radius), 0, 2 * Math.PI);
  } else if (shape.kind === 'polygon') {
    shape.points.forEach(([x, y], k) => (k ? context.lineTo(...to.point(x, y)) : context.moveTo(...to.point(x, y))));
    context.closePath();
  }
}

/** @param {Region} region @returns {[number, number]} */
export function middle(region) {
  const { shape } = region;
  if (shape.kind === 'disc') return shape.centre;
  if (shape.kind === 'polygon') {
    const sum = shape.points.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
    return [sum[0] / shape.points.length, sum[1] / shape.points.length];
  }
  return [(shape.low + shape.high) / 2, 0];
}

/**
 * A region: outlined and named, filled while its proposition holds; hatched where it is unsafe.
 * @param {CanvasRenderingContext2D} context
 * @param {Projection} to
 * @param {Region} region
 * @param {string} name
 * @param {boolean} holds
 * @param {Colours} colours
 */
export function drawRegion(context, to, region, name, holds, colours) {
  const tint = isUnsafe(name) ? colours.unsafe : colours.regions[region.proposition % colours.regions.length];
  trace(context, to, region);
  context.fillStyle = tint;
  context.globalAlpha = holds ? 0.5 : 0.16;
  context.fill();
  context.globalAlpha = 1;
  if (isUnsafe(name)) hatch(context, tint);
  context.lineWidth = holds ? 3 : 1.5;
  context.strokeStyle = tint;
  context.stroke();
  if (isUnsafe(name)) return;
  const [x, y] = to.point(...middle(region));
  const below = region.shape.kind === 'disc' ? to.size(region.shape.radius) + 14 : 0;
  nameTag(context, x, y + below, name, colours);
}

/** @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {string} name @param {Colours} colours */
export function nameTag(context, x, y, name, colours) {
  context.font = '500 13px "IBM Plex Mono", ui-monospace, monospace';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.lineWidth = 4;
  context.lineJoin = 'round';
  context.strokeStyle = colours.paper;
  context.strokeText(name, x, y);
  context.fillStyle = colours.ink;
  context.fillText(name, x, y);
}

/** Slanted lines inside the path that was traced last. @param {CanvasRenderingContext2D} context @param {string} tint */
export function hatch(context, tint) {
  context.save();
  context.clip();
  context.strokeStyle = tint;
  context.lineWidth = 1;
  context.globalAlpha = 0.5;
  const { width, height } = context.canvas;
  context.beginPath();
  for (let x = -height; x < width; x += 9) {
    context.moveTo(x, height);
    context.lineTo(x + height, 0);
  }
  context.stroke();
  context.restore();
}

/**
 * A trail that fades towards its past.
 * @param {CanvasRenderingContext2D} context
 * @param {[number, number][]} points
 * @param {string} tint
 */
export function drawTrail(context, points, tint) {
  const pieces = 24;
  context.strokeStyle = tint;
  context.lineCap = 'round';
  context.lineJoin = 'round';
  for (let piece = 0; piece < pieces; piece++) {
    const from = Math.floor((piece * (points.length - 1)) / pieces);
    const to = Math.floor(((piece + 1) * (points.length - 1)) / pieces);
    if (to <= from) continue;
    context.globalAlpha = 0.06 + (0.6 * (piece + 1)) / pieces;
    context.lineWidth = 1 + (2 * (piece + 1)) / pieces;
    context.beginPath();
    context.moveTo(...points[from]);
    for (let k = from + 1; k <= to; k++) context.lineTo(...points[k]);
    context.stroke();
  }
  context.globalAlpha = 1;
}

/** The shape of a set, filled, as a path of the canvas. @param {CanvasRenderingContext2D} context @param {number} set @param {number} x @param {number} y @param {number} radius */
export function fillShape(context, set, x, y, radius) {
  const path = new Path2D();
  path.addPath(new Path2D(shapePath(set)), new DOMMatrix([radius, 0, 0, radius, x, y]));
  context.fill(path);
}
