// @ts-check
// The value map: what the critic of a module thinks of each place, for the state and frontier of this moment or for chosen ones.

import { brief, byId, element, setText } from './dom.js';
import { colourClass, setName, shapeIcon, stateName } from './palette.js';
import { STEPS, extent, picture, scaleColour } from './views/value_picture.js';

/** @typedef {import('./app.js').App} App */

/** About how many points the grid has. */
const POINTS = 3600;
/** How often the values are asked for anew while training, in milliseconds. */
const AGAIN = 700;

export class Values {
  /** @param {App} app */
  constructor(app) {
    this.app = app;
    this.panel = byId('value-panel', HTMLElement);
    this.state = byId('value-state', HTMLSelectElement);
    this.sets = byId('value-sets', HTMLElement);
    this.follow = byId('value-follow', HTMLInputElement);
    this.legend = byId('value-legend', HTMLElement);
    this.said = byId('value-said', HTMLElement);
    /** The embedded state asked about: q, and T as bits. */
    this.at = { q: 0, frontier: 0 };
    /** What the picture on the stage is of. */
    this.shown = '';
    this.asked = 0;
    this.asking = false;
    this.state.addEventListener('change', () => this.pick({ q: Number(this.state.value) }));
    this.follow.addEventListener('change', () => this.request());
    app.signals.on('opened', () => this.open());
    app.signals.on('state', () => this.toggle());
    app.signals.on('watch', () => this.request());
    app.signals.on('moment', (frame) => {
      if (!this.on || !this.follow.checked) return;
      const frontier = frame.number('frontier', 0) + frame.number('frontier', 1) * 65536;
      const q = frame.number('q');
      if (q === this.at.q && frontier === this.at.frontier) return;
      this.at = { q, frontier };
      this.request();
    });
    app.signals.on('telemetry', () => {
      if (this.on && performance.now() - this.asked > AGAIN) this.request();
    });
    this.legend.replaceChildren(...Array.from({ length: STEPS }, (_, k) => {
      const step = element('i');
      step.style.background = `rgb(${scaleColour(k / (STEPS - 1)).join(' ')})`;
      return step;
    }));
  }

  get on() {
    return this.app.description !== null && this.app.state.layers.includes('value');
  }

  open() {
    const { description } = this.app;
    if (!description) return;
    this.shown = '';
    const { automaton } = description;
    this.at = { q: automaton.initial, frontier: 2 ** automaton.sets - 1 };
    this.state.replaceChildren(...automaton.states.filter((s) => !s.sink && s.reachable).map((s) => element('option', { value: String(s.id) }, stateName(s.id) + (s.name ? ` (${s.name})` : ''))));
    this.sets.replaceChildren(...Array.from({ length: automaton.sets }, (_, k) => {
      const box = element('input', { type: 'checkbox', className: 'unseen', value: String(k) });
      box.addEventListener('change', () => this.pick({ frontier: this.at.frontier + (box.checked ? 2 ** k : -(2 ** k)) }));
      return element('label', { className: `chip ${colourClass(k)}` }, box, shapeIcon(k), setName(k));
    }));
    this.toggle();
  }

  toggle() {
    this.panel.hidden = !this.on;
    if (this.on) this.request();
    else if (this.shown !== '') {
      this.shown = '';
      this.app.theatre.stage?.set({ value: null });
    }
  }

  /** Chooses a state or frontier; what is chosen no longer follows. @param {Partial<Values['at']>} part */
  pick(part) {
    this.follow.checked = false;
    this.at = { ...this.at, ...part };
    this.request();
  }

  /** Asks for the values; one question at a time, the newest last. */
  async request() {
    this.showChoice();
    const { theatre, description, generation } = this.app;
    if (!this.on || this.asking || !description || !theatre.stage) return;
    this.asking = true;
    this.asked = performance.now();
    const { at } = this;
    const aspect = theatre.stage.painter.aspect;
    const rows = Math.max(8, Math.round(Math.sqrt(POINTS / aspect)));
    const columns = Math.round(POINTS / rows);
    const of = theatre.playing ?? 'present';
    const answer = await this.app.client.ask({ kind: 'value_map', request: { ...at, columns, rows }, of }).catch(() => null);
    this.asking = false;
    if (!this.on || generation !== this.app.generation) return;
    if (answer?.generation === generation) {
      const { map } = answer;
      const [low, high] = extent(map.values);
      this.shown = JSON.stringify(at);
      theatre.stage.set({ value: { map, picture: picture(map) } });
      setText(this.said, `V from ${brief(low)} to ${brief(high)}, ${map.module === null ? 'the best of the modules of T' : `module ${description.modules[map.module]}`}${of === 'shipped' ? ' of the trained policy' : of === 'best' ? ' of the best policy' : ''}`);
    } else {
      theatre.stage.set({ value: null });
      setText(this.said, 'Nothing is chosen in this state: no module is in charge of it.');
    }
    if (at !== this.at) this.request();
  }

  showChoice() {
    this.state.value = String(this.at.q);
    this.sets.querySelectorAll('input').forEach((box, k) => {
      box.checked = Math.floor(this.at.frontier / 2 ** k) % 2 === 1;
      box.parentElement?.classList.toggle('waits', box.checked);
    });
  }
}

/** @param {App} app */
export function wireValues(app) {
  app.values = new Values(app);
}
