// @ts-check
// Paints a rover on a map: the picture where there is one, regions and unsafe ground over it, the trail of this run.

import { drawRegion, drawTrail, projection } from './ground.js';

/** @typedef {import('../protocol.js').Scene} Scene */
/** @typedef {Extract<import('../protocol.js').Body, { kind: 'rover' }>} Rover */

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
      this.picture.src = `assets/${encodeURIComponent(scene.picture)}`;
    }
  }

  /** @type {import('./stage.js').Painter['paint']} */
  paint(context, width, height, moment, colours) {
    const to = projection(this.scene.ground, width, height);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, width, height);
    if (this.picture?.complete && this.picture.naturalWidth > 0) context.drawImage(this.picture, 0, 0, width, height);
    for (const region of this.scene.regions) {
      drawRegion(context, to, region, this.propositions[region.proposition].name, moment.holds(region.proposition), colours);
    }
    const [cx, cy] = this.rover.position;
    drawTrail(context, moment.trail.map((s) => to.point(s[cx], s[cy])), colours.accent);
    const [x, y] = to.point(moment.state[cx], moment.state[cy]);
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.fillStyle = colours.accent;
    context.fill();
    context.lineWidth = 2;
    context.strokeStyle = colours.surface;
    context.stroke();
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height @returns {[number, number]} */
  pointer(x, y, width, height) {
    return projection(this.scene.ground, width, height).back(x, y);
  }
}
