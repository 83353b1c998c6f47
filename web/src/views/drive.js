// @ts-check
// Driving by hand: keys and pointer become a control, one number in [-1, 1] per action channel, sent as often as the environment steps.

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('./stage.js').Stage} Stage */

/** A pointer this part of the ground's width away from the body pushes with full force. */
const REACH = 0.2;

/** The direction each key pushes in: x to the right, y upwards on the screen. @type {Record<string, [number, number]>} */
const KEYS = Object.freeze({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], a: [-1, 0], d: [1, 0], w: [0, 1], s: [0, -1] });

/** @param {number} x */
const unit = (x) => Math.max(-1, Math.min(1, x));

/**
 * The control of a push `(x, y)`, x to the right and y upwards on the screen, for an environment with this scene.
 * @param {[number, number]} push
 * @param {Description['environment']} environment
 */
export function controlOf([x, y], environment) {
  const up = environment.scene.ground.y_axis === 'up' ? 1 : -1;
  const control = [unit(x), unit(up * y)].slice(0, environment.action.length);
  while (control.length < environment.action.length) control.push(0);
  return control;
}

export class Driver {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    /** @type {Set<string>} */
    this.keys = new Set();
    /** Where the pointer presses, on the canvas; `null` while it does not. @type {[number, number] | null} */
    this.pressed = null;
    this.active = false;
    this.due = 0;
    const place = (/** @type {PointerEvent} */ event) => {
      const box = canvas.getBoundingClientRect();
      this.pressed = [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener('pointerdown', (event) => {
      if (!this.active) return;
      canvas.setPointerCapture(event.pointerId);
      place(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (this.pressed) place(event);
    });
    for (const kind of /** @type {const} */ (['pointerup', 'pointercancel'])) canvas.addEventListener(kind, () => (this.pressed = null));
    window.addEventListener('keyup', (event) => this.keys.delete(event.key));
    window.addEventListener('blur', () => this.keys.clear());
  }

  /** @param {boolean} active */
  activate(active) {
    this.active = active;
    this.keys.clear();
    this.pressed = null;
    this.due = 0;
    // A finger on the stage steers while driving, and scrolls otherwise.
    this.canvas.style.touchAction = active ? 'none' : '';
  }

  /** Takes a key if it steers. @param {string} key */
  press(key) {
    if (!this.active || !KEYS[key]) return false;
    this.keys.add(key);
    return true;
  }

  /** Whether a key or the pointer pushes now. */
  get pushes() {
    return this.keys.size > 0 || this.pressed !== null;
  }

  /**
   * The control of this moment.
   * @param {Description} description
   * @param {Stage} stage
   */
  control(description, stage) {
    /** @type {[number, number]} */
    const push = [0, 0];
    for (const key of this.keys) {
      push[0] += KEYS[key][0];
      push[1] += KEYS[key][1];
    }
    if (this.pressed && stage.shown) {
      const { ground, body } = description.environment.scene;
      const [x, y] = stage.painter.pointer(...this.pressed, stage.width, stage.height);
      const { state } = stage.shown;
      const reach = REACH * (ground.x[1] - ground.x[0]);
      const up = ground.y_axis === 'up' ? 1 : -1;
      if (body.kind === 'cart_pole') push[0] += (x - state[body.position]) / reach;
      else {
        push[0] += (x - state[body.position[0]]) / reach;
        push[1] += (up * (y - state[body.position[1]])) / reach;
      }
    }
    return controlOf(push, description.environment);
  }

  /**
   * Whether a step is due after `seconds` more; at most one at a time, so that a slow machine slows the world, not the hand.
   * @param {number} seconds
   * @param {number} rowsPerSecond
   */
  tick(seconds, rowsPerSecond) {
    this.due = Math.min(this.due + seconds * rowsPerSecond, 1.5);
    if (this.due < 1) return false;
    this.due -= 1;
    return true;
  }
}
