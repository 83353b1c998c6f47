// @ts-check
// Paints a rover on a map: the picture where there is one, regions and unsafe ground over it, the way so far.

import { drawEarlier, drawRegions, drawTrail, projection } from './ground.js';
import { pictureAddress } from '../maps/picture.js';
import { drawValues } from './value_picture.js';

/** @typedef {import('../protocol.js').Scene} Scene */
/** @typedef {Extract<import('../protocol.js').Body, { kind: 'rover' }>} Rover */

/** The way on a picture: light with a dark border, to be seen on any ground. */
const WAY = Object.freeze({ line: '#fff6e6', casing: '#1a0f08' });

export class RoverMap {
  /**
   * @param {Scene} scene
   * @param {Rover} rover
   * @param {import('../protocol.js').Proposition[]} propositions
   */
  constructor(scene, rover, propositions) {
    this.scene = scene;
    this.rover = rover;
    this.propositions = propositions;
    const { x, y } = scene.ground;
    this.aspect = (x[1] - x[0]) / (y[1] - y[0]);
    /** @type {HTMLImageElement | null} */
    this.picture = null;
    if (scene.picture) {
      this.picture = new Image();
      this.picture.src = pictureAddress(scene.picture);
    }
  }

  /** @param {() => void} again */
  whenLoaded(again) {
    this.picture?.addEventListener('load', again, { once: true });
  }

  get pictured() {
    return this.picture !== null && this.picture.complete && this.picture.naturalWidth > 0;
  }

  /** @type {import('./stage.js').Painter['backdrop']} */
  backdrop(context, width, height, scenery) {
    const { colours, layers } = scenery;
    const to = projection(this.scene.ground, width, height);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, width, height);
    if (this.picture && this.pictured) context.drawImage(this.picture, 0, 0, width, height);
    if (scenery.value) drawValues(context, to, scenery.value, this.scene.ground, colours, this.pictured ? 0.72 : 0.9);
    drawRegions(context, to, this.scene, this.propositions, { ...scenery, busy: this.pictured || scenery.value !== null });
    if (layers.has('paths')) drawEarlier(context, to, scenery.earlier, this.rover.position, this.pictured ? WAY.line : colours.accent);
    this.scaleBar(context, to, width, height);
  }

  /** @type {import('./stage.js').Painter['paint']} */
  paint(context, width, height, moment, { colours }) {
    const to = projection(this.scene.ground, width, height);
    const [cx, cy] = this.rover.position;
    const { trail, state, action } = moment;
    const way = this.pictured ? WAY : { line: colours.accent, casing: null };
    drawTrail(context, trail.length, (k) => to.point(trail.value(k, cx), trail.value(k, cy)), way.line, way.casing);
    const [x, y] = to.point(state[cx], state[cy]);
    this.body(context, x, y, action, colours);
  }

  /** A disc with a nose in the direction of the last command. @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {ArrayLike<number>} action @param {import('./stage.js').Colours} colours */
  body(context, x, y, action, colours) {
    const length = Math.hypot(action[0] ?? 0, action[1] ?? 0);
    context.lineJoin = 'round';
    context.beginPath();
    if (length > 1e-6) {
      const down = this.scene.ground.y_axis === 'up' ? -1 : 1;
      const turn = Math.atan2(down * action[1], action[0]);
      context.arc(x, y, 7, turn + 0.6, turn - 0.6 + 2 * Math.PI);
      context.lineTo(x + 13 * Math.cos(turn), y + 13 * Math.sin(turn));
      context.closePath();
    } else context.arc(x, y, 7, 0, 2 * Math.PI);
    context.lineWidth = 4;
    context.strokeStyle = this.pictured ? WAY.casing : colours.paper;
    context.stroke();
    context.lineWidth = 2;
    context.strokeStyle = this.pictured ? WAY.line : colours.paper;
    context.stroke();
    context.fillStyle = this.pictured ? '#d4501c' : colours.accent;
    context.fill();
  }

  /** A round length on the ground, drawn to scale. @param {CanvasRenderingContext2D} context @param {import('./ground.js').Projection} to @param {number} width @param {number} height */
  scaleBar(context, to, width, height) {
    const { x, unit } = this.scene.ground;
    const wanted = (x[1] - x[0]) / 5;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map((digit) => digit * power).find((l) => l <= wanted) ?? power;
    const [right, bottom] = [width - 10, height - 10];
    const left = right - to.size(length);
    const [ink, halo] = this.pictured ? [WAY.line, WAY.casing] : ['#777', 'transparent'];
    context.font = '500 11px "IBM Plex Sans Variable", system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'alphabetic';
    for (const [tint, thick] of /** @type {[string, number][]} */ ([[halo, 4], [ink, 2]])) {
      context.strokeStyle = tint;
      context.lineWidth = thick;
      context.beginPath();
      context.moveTo(left, bottom - 4);
      context.lineTo(left, bottom);
      context.lineTo(right, bottom);
      context.lineTo(right, bottom - 4);
      context.stroke();
      context.lineWidth = 3;
      if (tint === halo) context.strokeText(`${length} ${unit}`, right, bottom - 8);
    }
    context.fillStyle = ink;
    context.fillText(`${length} ${unit}`, right, bottom - 8);
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height @returns {[number, number]} */
  pointer(x, y, width, height) {
    return projection(this.scene.ground, width, height).back(x, y);
  }
}
