// @ts-check
// Paints a ball in an arena: regions as labelled discs, the ball with its trail and the push of the present action.

import { drawEarlier, drawRegions, drawTrail, projection } from './ground.js';
import { drawValues } from './value_picture.js';

/** @typedef {import('../protocol.js').Scene} Scene */
/** @typedef {Extract<import('../protocol.js').Body, { kind: 'ball' }>} Ball */
/** @typedef {import('./stage.js').Moment} Moment */
/** @typedef {import('./stage.js').Colours} Colours */

/** How many earlier states the trail has. */
const TRAIL = 240;

export class BallPass {
  /**
   * @param {Scene} scene
   * @param {Ball} ball
   * @param {import('../protocol.js').Proposition[]} propositions
   */
  constructor(scene, ball, propositions) {
    this.scene = scene;
    this.ball = ball;
    this.propositions = propositions;
    const { x, y } = scene.ground;
    this.aspect = (x[1] - x[0]) / (y[1] - y[0]);
  }

  /** @type {import('./stage.js').Painter['backdrop']} */
  backdrop(context, width, height, scenery) {
    const { colours, layers } = scenery;
    const to = projection(this.scene.ground, width, height);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, width, height);
    if (scenery.value) drawValues(context, to, scenery.value, this.scene.ground, colours, 0.9);
    else this.grid(context, width, height, colours);
    drawRegions(context, to, this.scene, this.propositions, { ...scenery, busy: scenery.value !== null });
    if (layers.has('paths')) drawEarlier(context, to, scenery.earlier, this.ball.position, colours.accent);
  }

  /** @type {import('./stage.js').Painter['paint']} */
  paint(context, width, height, moment, { colours, value }) {
    const to = projection(this.scene.ground, width, height);
    const [cx, cy] = this.ball.position;
    const trail = moment.trail.tail(TRAIL);
    drawTrail(context, trail.length, (k) => to.point(trail.value(k, cx), trail.value(k, cy)), colours.accent, value ? colours.paper : null);
    const [x, y] = to.point(moment.state[cx], moment.state[cy]);
    const radius = Math.max(to.size(this.ball.radius), 5);
    this.push(context, x, y, radius, moment.action, colours);
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = colours.accent;
    context.fill();
    context.lineWidth = 1.5;
    context.strokeStyle = colours.paper;
    context.stroke();
  }

  /** The acceleration that is commanded, as a line from the ball. @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} radius @param {ArrayLike<number>} action @param {Colours} colours */
  push(context, x, y, radius, action, colours) {
    if (action.length < 2) return;
    const reach = radius * 2.4;
    const flip = this.scene.ground.y_axis === 'up' ? -1 : 1;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + action[0] * reach, y + flip * action[1] * reach);
    context.lineWidth = 2;
    context.lineCap = 'round';
    context.strokeStyle = colours.ink;
    context.stroke();
  }

  /** @param {CanvasRenderingContext2D} context @param {number} width @param {number} height @param {Colours} colours */
  grid(context, width, height, colours) {
    context.strokeStyle = colours.line;
    context.lineWidth = 1;
    context.globalAlpha = 0.6;
    context.beginPath();
    for (let k = 1; k < 6; k++) {
      const [x, y] = [Math.round((k * width) / 6) + 0.5, Math.round((k * height) / 6) + 0.5];
      context.moveTo(x, 0);
      context.lineTo(x, height);
      context.moveTo(0, y);
      context.lineTo(width, y);
    }
    context.stroke();
    context.globalAlpha = 1;
    // A scale: the width of one cell, in words.
    const { x, unit } = this.scene.ground;
    context.fillStyle = colours.soft;
    context.font = '11px "IBM Plex Sans Variable", system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'alphabetic';
    context.fillText(`grid ${Math.round((x[1] - x[0]) / 6)} ${unit}`, width - 8, height - 8);
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height @returns {[number, number]} */
  pointer(x, y, width, height) {
    return projection(this.scene.ground, width, height).back(x, y);
  }
}
