// @ts-check
// Paints a cart with a pole on its track: bands on the ground, the lean that is still safe as a wedge, the force as an arrow.

import { isHazard, nameTag, projection } from './ground.js';

/** @typedef {import('../protocol.js').Scene} Scene */
/** @typedef {Extract<import('../protocol.js').Body, { kind: 'cart_pole' }>} Cart */
/** @typedef {import('./stage.js').Colours} Colours */

export class CartPole {
  /**
   * @param {Scene} scene
   * @param {Cart} cart
   * @param {import('../protocol.js').Proposition[]} propositions
   * @param {import('../protocol.js').Channel[]} channels
   */
  constructor(scene, cart, propositions, channels) {
    this.channels = channels;
    this.scene = scene;
    this.cart = cart;
    this.propositions = propositions;
    this.aspect = 1.35;
  }

  /** @type {import('./stage.js').Painter['backdrop']} */
  backdrop(context, width, height, scenery) {
    const { colours } = scenery;
    const to = projection(this.scene.ground, width, height);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, width, height);
    const [, floor] = to.point(0, 0);
    for (const region of this.scene.regions) this.band(context, to, region, floor, width, height, scenery);

    context.strokeStyle = colours.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(0, floor);
    context.lineTo(width, floor);
    context.stroke();
    if (scenery.value) this.slice(context, width, height, scenery.value, colours);
  }

  /** The box of the slice of values, in the top corner. @param {number} width @param {number} height @returns {[number, number, number, number]} */
  box(width, height) {
    const [w, h] = [Math.min(width * 0.36, 260), Math.min(height * 0.3, 160)];
    return [width - w - 12, 12, w, h];
  }

  /** The values over position and angle, with names of the axes. @param {CanvasRenderingContext2D} context @param {number} width @param {number} height @param {NonNullable<import('./stage.js').Scenery['value']>} value @param {Colours} colours */
  slice(context, width, height, value, colours) {
    const [left, top, w, h] = this.box(width, height);
    context.fillStyle = colours.surface;
    context.fillRect(left - 1, top - 1, w + 2, h + 20);
    context.drawImage(value.picture, left, top, w, h);
    context.strokeStyle = colours.soft;
    context.lineWidth = 1;
    context.strokeRect(left - 0.5, top - 0.5, w + 1, h + 1);
    const names = value.map.axes.map(({ channel }) => this.channels[channel].name);
    context.fillStyle = colours.ink;
    context.font = '11px "IBM Plex Sans Variable", system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillText(`${names[0]} across, ${names[1]} upwards`, left + w / 2, top + h + 10, w);
  }

  /** @type {import('./stage.js').Painter['paint']} */
  paint(context, width, height, moment, { colours, value }) {
    const to = projection(this.scene.ground, width, height);
    const [, floor] = to.point(0, 0);
    const x = moment.state[this.cart.position];
    const angle = moment.state[this.cart.angle];
    const [cx] = to.point(x, 0);
    const length = to.size(this.cart.pole_length);
    const [cartWidth, cartHeight] = [to.size(0.5), to.size(0.2)];
    const hinge = floor - cartHeight;

    this.wedge(context, cx, hinge, length, colours);
    // The tip of the pole over the last moments.
    const tips = moment.trail.tail(60);
    context.fillStyle = colours.accent;
    for (let k = 0; k < tips.length; k++) {
      const [tx] = to.point(tips.value(k, this.cart.position), 0);
      const lean = tips.value(k, this.cart.angle);
      context.globalAlpha = (0.35 * (k + 1)) / tips.length;
      context.beginPath();
      context.arc(tx + length * Math.sin(lean), hinge - length * Math.cos(lean), 1.6, 0, 2 * Math.PI);
      context.fill();
    }
    context.globalAlpha = 1;

    context.strokeStyle = colours.accent;
    context.lineWidth = Math.max(5, to.size(0.06));
    context.lineCap = 'round';
    context.beginPath();
    context.moveTo(cx, hinge);
    context.lineTo(cx + length * Math.sin(angle), hinge - length * Math.cos(angle));
    context.stroke();

    context.fillStyle = colours.ink;
    context.beginPath();
    context.roundRect(cx - cartWidth / 2, hinge, cartWidth, cartHeight - 4, 4);
    context.fill();
    for (const side of [-0.3, 0.3]) {
      context.beginPath();
      context.arc(cx + side * cartWidth, floor - 4, 4, 0, 2 * Math.PI);
      context.fill();
    }
    if (value) {
      const [left, top, w, h] = this.box(width, height);
      const [along, up] = value.map.axes.map(({ channel, low, high }) => Math.max(0, Math.min(1, (moment.state[channel] - low) / (high - low))));
      context.beginPath();
      context.arc(left + along * w, top + (1 - up) * h, 4, 0, 2 * Math.PI);
      context.fillStyle = '#fff';
      context.fill();
      context.strokeStyle = '#000';
      context.lineWidth = 1.5;
      context.stroke();
    }
    this.force(context, cx, hinge + cartHeight / 2 - 2, cartWidth, moment.action[0] ?? 0, colours);
  }

  /** @param {CanvasRenderingContext2D} context @param {import('./ground.js').Projection} to @param {import('../protocol.js').Region} region @param {number} floor @param {number} width @param {number} height @param {import('./stage.js').Scenery} scenery */
  band(context, to, region, floor, width, height, { holds: held, layers, colours }) {
    const { shape } = region;
    if (shape.kind !== 'band' || shape.channel !== this.cart.position) return;
    const name = this.propositions[region.proposition].name;
    const left = Math.max(0, to.point(shape.low, 0)[0]);
    const right = Math.min(width, to.point(shape.high, 0)[0]);
    if (right <= left) return;
    const hazard = isHazard(this.scene, this.propositions, region.proposition);
    if (!layers.has(hazard ? 'unsafe' : 'labels')) return;
    const holds = held(region.proposition);
    const tint = hazard ? colours.unsafe : colours.regions[region.proposition % colours.regions.length];
    context.fillStyle = tint;
    context.globalAlpha = hazard ? 0.14 : holds ? 0.34 : 0.12;
    context.fillRect(left, 0, right - left, floor);
    context.globalAlpha = 1;
    context.fillRect(left, floor, right - left, holds && !hazard ? 10 : 6);
    nameTag(context, Math.max(32, Math.min(width - 32, (left + right) / 2)), Math.min(floor + 22, height - 10), name, colours);
  }

  /** The lean within which the pole is safe, where the scene says so. @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} length @param {Colours} colours */
  wedge(context, x, y, length, colours) {
    const limits = this.scene.regions.map((r) => r.shape).filter((s) => s.kind === 'band' && s.channel === this.cart.angle);
    const lean = Math.min(...limits.map((s) => (s.kind === 'band' ? Math.min(Math.abs(s.low), Math.abs(s.high)) : Infinity)));
    if (!Number.isFinite(lean)) return;
    context.setLineDash([3, 5]);
    context.strokeStyle = colours.unsafe;
    context.lineWidth = 1.2;
    context.beginPath();
    for (const side of [-1, 1]) {
      context.moveTo(x, y);
      context.lineTo(x + side * length * 1.08 * Math.sin(lean), y - length * 1.08 * Math.cos(lean));
    }
    context.stroke();
    context.setLineDash([]);
  }

  /** @param {CanvasRenderingContext2D} context @param {number} x @param {number} y @param {number} cartWidth @param {number} force  −1 … 1 @param {Colours} colours */
  force(context, x, y, cartWidth, force, colours) {
    const length = force * cartWidth * 1.2;
    if (Math.abs(length) < 2) return;
    const side = Math.sign(force);
    const start = x + (side * cartWidth) / 2 + side * 3;
    const end = start + length;
    context.strokeStyle = colours.soft;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(start, y);
    context.lineTo(end, y);
    context.moveTo(end - side * 5, y - 4);
    context.lineTo(end, y);
    context.lineTo(end - side * 5, y + 4);
    context.stroke();
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height @returns {[number, number]} */
  pointer(x, y, width, height) {
    return projection(this.scene.ground, width, height).back(x, y);
  }
}
