// @ts-check
// The app: one worker, one session, one state, one clock. What is shown of a moment is the theatre's business; parts that are wired to
// the app hear its signals.

import { Client, Refused } from './client.js';
import { startWorker } from './early.js';
import { byId, count, forgetColours, offer, setText } from './dom.js';
import { notice } from './keeping.js';
import { tellProblems } from './link.js';
import { NoMap } from './maps/shelf.js';
import { Policies } from './policies.js';
import { Signals } from './signals.js';
import { initialState } from './state.js';
import { Theatre } from './theatre.js';
import { loadPlot } from './vendor.js';
import { Controls } from './views/controls.js';
import { Curves } from './views/curves.js';
import { Evaluation, Modules, Settings } from './views/details.js';
import { Spec } from './views/spec.js';

/** @typedef {import('./protocol.js').Description} Description */
/** @typedef {import('./state.js').State} State */

/** The runs of an evaluation. */
const RUNS = 200;
/** How often within a minute a worker may break and be started again. */
const BREAKS = 3;

const $ = {
  button: (/** @type {string} */ id) => byId(id, HTMLButtonElement),
  select: (/** @type {string} */ id) => byId(id, HTMLSelectElement),
  input: (/** @type {string} */ id) => byId(id, HTMLInputElement),
  any: (/** @type {string} */ id) => byId(id, HTMLElement),
};

/** What the best policy of a training came to, as a sentence of a notice. @param {import('./protocol.js').BestPolicy | null} best */
const inWords = (best) => (best ? `Its best policy, after ${count(best.step)} steps, satisfied the task in ${count(best.successes)} of ${count(best.runs)} runs: watch it under Best. ` : '');

export class App {
  /** @param {State} state @param {import('./maps/shelf.js').Shelf} shelf  the maps that the state has keys of */
  constructor(state, shelf) {
    this.state = state;
    this.shelf = shelf;
    /** Gives the last checkpoint of the open run, for when its worker breaks. @type {() => Promise<Uint8Array | null>} */
    this.lastCheckpoint = async () => null;
    /** When workers broke, in milliseconds. @type {number[]} */
    this.breaks = [];
    this.signals = new Signals();
    /** @type {Description | null} */
    this.description = null;
    this.generation = 0;
    this.training = false;
    /** The tasks on offer. @type {import('./protocol.js').TaskEntry[]} */
    this.tasks = [];
    this.policies = new Policies();
    this.client = new Client(startWorker, this.listeners());
    this.theatre = new Theatre((command) => this.ask(command), this.signals);
    this.spec = this.makeSpec();
    this.controls = this.makeControls();
    this.modules = new Modules($.any('modules'));
    this.settings = new Settings($.any('settings'), (key, value) => this.override(key, value));
    this.evaluation = new Evaluation($.any('evaluation'));
    /** @type {Curves | null} */
    this.curves = null;
    /** The newest curves, for the plots when they are there. @type {import('./protocol.js').Curves | null} */
    this.points = null;
    /** @type {import('./kept.js').KeptEpisodes | null} */
    this.kept = null;
    /** @type {import('./values.js').Values | null} */
    this.values = null;
    /** @type {object | null} */
    this.translating = null;
    /** @type {import('./experiment/panel.js').Experiment | null} */
    this.experiment = null;
    const on = (/** @type {string} */ id, /** @type {() => void} */ act) => $.button(id).addEventListener('click', act);
    on('evaluate', () => this.evaluate());
    on('settings-own', () => this.open({ ...this.state, set: {} }));
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.theatre.setPlaying(false);
    this.showState();
  }

  /** @returns {import('./client.js').Listeners} */
  listeners() {
    return {
      frame: ({ generation, data }) => {
        this.theatre.hear(generation, data);
        if (this.theatre.live) this.controls.update(this.theatre.live);
      },
      telemetry: (reply) => {
        if (reply.generation !== this.generation) return;
        this.controls.rate(reply.rate);
        this.points = reply.curves;
        this.heardOfBest(reply.best);
        this.curves?.update(reply.curves, this.description?.modules);
        this.modules.update(reply.modules);
        this.signals.tell('telemetry', reply);
      },
      evaluation: ({ generation, progress }) => {
        if (generation !== this.generation) return;
        this.evaluation.update(progress);
        this.signals.tell('evaluation', progress);
      },
      finished: ({ generation, steps, first_perfect_step }) => {
        if (generation !== this.generation) return;
        this.setTraining(false);
        notice(first_perfect_step === steps
          ? `Learned: every run of the evaluation after ${count(steps)} steps satisfies the task. Press Train to go on.`
          : `Training has used up the budget of its recipe. ${inWords(this.theatre.best)}Press Train to go on.`);
        this.signals.tell('finished', first_perfect_step);
      },
      halted: ({ generation, message }) => {
        if (generation !== this.generation) return;
        this.setTraining(false);
        notice(`Training was stopped: ${message}.`, true);
      },
      broken: (message) => this.mend(message),
    };
  }

  makeSpec() {
    return new Spec(
      {
        task: $.select('task'), preset: $.select('preset'), formula: $.input('formula'), mirror: $.any('formula-mirror'), said: $.any('formula-said'),
        words: $.any('formula-words'), apply: $.button('formula-apply'), hoaPanel: byId('hoa-panel', HTMLDetailsElement), hoa: byId('hoa', HTMLTextAreaElement),
        hoaSaid: $.any('hoa-said'), hoaApply: $.button('hoa-apply'), hoaOwn: $.button('hoa-own'), hoaSave: $.button('hoa-save'), hoaFile: $.input('hoa-file'),
      },
      {
        checkFormula: (text) => this.client.ask({ kind: 'check_formula', text }),
        checkHoa: (text) => this.client.ask({ kind: 'check_hoa', text }),
        chooseTask: (task) => this.open({ ...this.state, task, formula: '', hoa: '', map: '', preset: '', set: {} }),
        choosePreset: (preset) => this.open({ ...this.state, preset }),
        useFormula: (formula) => this.open({ ...this.state, formula, hoa: '' }),
        useHoa: (hoa) => this.open({ ...this.state, hoa }),
        saveHoa: (hoa) => offer(`${this.state.task}.hoa`, hoa, 'text/plain'),
      },
    );
  }

  makeControls() {
    return new Controls(
      {
        train: $.button('train'), step: $.button('step'), episode: $.button('episode'), pace: $.select('pace'), rate: $.any('rate'), steps: $.any('n-steps'),
        episodes: $.any('n-episodes'), updates: $.any('n-updates'), seed: $.input('seed'), reset: $.button('reset'), newSeed: $.button('new-seed'),
        watch: $.any('watch'), speed: $.select('speed'),
      },
      {
        train: () => this.toggleTraining(),
        step: () => this.single('step'),
        episode: () => this.single('episode'),
        pace: (pace) => {
          this.change({ pace });
          if (this.training) this.ask({ kind: 'train', pace });
        },
        restart: (seed) => this.open({ ...this.state, seed }),
        watch: (watch) => this.watch(watch),
        speed: (speed) => this.change({ speed }),
      },
    );
  }

  /** Begins: the worker, the task of the link, the first episode; then the libraries that can wait. */
  async start() {
    const paint = (/** @type {number} */ now) => {
      this.theatre.paint(now);
      requestAnimationFrame(paint);
    };
    requestAnimationFrame(paint);
    this.policies.hasten(this.state.task);
    try {
      this.tasks = await this.client.ready;
      this.spec.offer(this.tasks);
      if (!this.state.task.includes('\n') && !this.tasks.some((t) => t.name === this.state.task)) {
        tellProblems([{ property: 'task', message: `${this.state.task} is unknown; known are ${this.tasks.map((t) => t.name).join(', ')}` }]);
        this.state = { ...initialState(), seed: this.state.seed };
      }
    } catch {
      return; // `broken` has said why
    }
    await this.open(this.state, true);
    this.curves = new Curves($.any('curves'), await loadPlot());
    if (this.points) this.curves.update(this.points, this.description?.modules);
  }

  // --- the session --------------------------------------------------------------------------------------------------------

  /** What a state asks the core to open. @param {State} state @returns {Promise<import('./protocol.js').OpenRequest>} */
  async requestOf({ task, formula, hoa, map, seed, preset, set }) {
    return { task, formula: formula || null, hoa: hoa || null, map: map ? await this.shelf.textOf(map) : null, seed, preset: preset || null, overrides: set };
  }

  /**
   * Opens a task; whether it stands. A refusal is shown at the field that caused it and the present session stays.
   * @param {State} next
   * @param {boolean} [first]  whether nothing is open yet: a refusal then falls back to the task as it is shipped
   * @param {(error: Error) => void} [tell]  what a refusal is told to; else it is shown
   */
  async open(next, first = false, tell) {
    const { task, formula, seed } = next;
    try {
      const request = await this.requestOf(next);
      const { generation, description } = await this.client.ask({ kind: 'open', request });
      this.state = next;
      this.opened(generation, description);
      return true;
    } catch (error) {
      if (first) await this.open({ ...initialState(), task: task.includes('\n') ? initialState().task : task, seed });
      // The formula of a link stands in the field before it is called wrong.
      if (formula && error instanceof Refused) await this.spec.putFormula(formula);
      if (tell && error instanceof Error) tell(error);
      else this.refused(error, next);
      return false;
    }
  }

  /** Opens a checkpoint; whether it stands. @param {Uint8Array} bytes @param {Partial<State>} [view]  what the page showed of it */
  async restore(bytes, view = { watch: 'policy' }) {
    const answer = await this.ask({ kind: 'restore', bytes });
    if (!answer) return false;
    const { generation, description } = answer;
    this.state = { ...this.state, ...view, ...(await this.stateOf(description.request)), preset: description.task.preset };
    this.opened(generation, description);
    return true;
  }

  /** The part of the state that a request stands for. @param {Record<string, any>} request  from outside: what is no text is left out */
  async stateOf({ task, formula, hoa, map, seed, preset, overrides }) {
    const text = (/** @type {unknown} */ value) => (typeof value === 'string' ? value : '');
    /** @type {Partial<State>} */
    const part = {
      task: text(task) || initialState().task, formula: text(formula), hoa: text(hoa), map: text(map) && (await this.shelf.keyOf(text(map))), preset: text(preset),
      seed: Number.isSafeInteger(seed) && seed >= 0 ? seed : 1,
      set: Object.fromEntries(Object.entries(overrides ?? {}).map(([key, value]) => [key, String(value)])),
    };
    return part;
  }

  /** @param {unknown} error @param {State} next */
  refused(error, next) {
    if (error instanceof NoMap) notice(error.message, true);
    // What a worker that broke leaves unanswered has been told already.
    if (!(error instanceof Refused)) return;
    const { where } = error;
    if (where.field === 'formula' && next.formula) this.spec.refuse(where);
    else if (where.field === 'hoa' && next.hoa) this.spec.refuseHoa(where);
    else {
      const place = where.field === 'task' && next.task.includes('\n') && where.line > 0 ? `Task file, line ${where.line}, column ${where.column}: ` : '';
      notice(place + error.message + (where.hint ? ` (${where.hint})` : ''), true);
    }
  }

  /** @param {number} generation @param {Description} description */
  opened(generation, description) {
    this.generation = generation;
    this.description = description;
    this.setTraining(false);
    this.controls.rate(0);
    this.theatre.open(generation, description, this.state.formula || this.state.hoa || this.state.map ? null : this.state.task);
    this.spec.show(description);
    this.settings.show(description.settings, this.state.set);
    const changed = Object.keys(this.state.set).length > 0;
    setText($.any('settings-note'), changed ? 'changed by you' : 'change one to start anew');
    $.button('settings-own').hidden = !changed;
    this.evaluation.clear();
    this.signals.tell('opened', description);
    this.loadTrained(generation).then((trained) => {
      if (generation !== this.generation) return;
      this.theatre.trained = trained;
      this.showState();
      this.theatre.watch(this.state.watch);
    });
  }

  /** Loads the trained policy of the open task, if one comes with the page and the task is as it is shipped. @param {number} mine */
  async loadTrained(mine) {
    const { task, formula, hoa, map } = this.state;
    if (formula || hoa || map) return false;
    try {
      const bytes = await this.policies.of(task);
      if (!bytes || mine !== this.generation) return false;
      const { generation, fits } = await this.client.ask({ kind: 'load_policy', bytes });
      return fits && generation === mine;
    } catch {
      return false; // without it the page shows the present policy
    }
  }

  /** Sends a command; a refusal is shown, and `undefined` returned. @param {import('./protocol.js').Command} command */
  async ask(command) {
    try {
      return await this.client.ask(command);
    } catch (error) {
      this.refused(error, this.state);
      return undefined;
    }
  }

  /** Opens the task anew with another value of a hyper-parameter; a value that is refused goes back. @param {string} key @param {string} value */
  async override(key, value) {
    await this.open({ ...this.state, set: { ...this.state.set, [key]: value } });
    if (this.description && this.state.set[key] !== value) this.settings.show(this.description.settings, this.state.set);
  }

  /** @param {import('./protocol.js').BestPolicy | null} best  the best policy of the open session */
  heardOfBest(best) {
    const { theatre } = this;
    const other = best?.step !== theatre.best?.step;
    theatre.best = best;
    if (other) this.showState();
  }

  /** A worker that broke is replaced, and the run goes on from its last checkpoint. @param {string} message */
  async mend(message) {
    const now = performance.now();
    this.breaks = [...this.breaks.filter((then) => now - then < 60_000), now];
    if (this.description === null || this.breaks.length > BREAKS) {
      return notice(`The computation stopped: ${message}. Reload the page to try again${this.description ? '; what was kept is offered then' : ''}.`, true);
    }
    this.description = null;
    this.setTraining(false);
    this.theatre.close();
    // A checkpoint on which a worker breaks twice is not tried a third time.
    const bytes = this.breaks.length < BREAKS ? await this.lastCheckpoint() : null;
    await this.client.restart().catch(() => {});
    if (bytes && (await this.restore(bytes, {}))) {
      notice(`The computation stopped: ${message}. It was started again from the last checkpoint of this run. Press Train to go on.`, true);
    } else {
      notice(`The computation stopped: ${message}. It was started again with the same task and seed.`, true);
      await this.open(this.state, true);
    }
  }

  // --- training -----------------------------------------------------------------------------------------------------------

  /** @param {boolean} training */
  setTraining(training) {
    const changed = training !== this.training;
    this.training = training;
    this.controls.training(training);
    if (changed) this.signals.tell('training', training);
  }

  toggleTraining() {
    this.setTraining(!this.training);
    if (this.training && this.state.watch === 'trained') this.watch('policy');
    if (!this.training) this.controls.rate(0);
    this.ask(this.training ? { kind: 'train', pace: this.state.pace } : { kind: 'pause' });
  }

  /** @param {'step' | 'episode'} kind */
  async single(kind) {
    this.setTraining(false);
    if (this.state.watch !== 'training') this.watch('training');
    await this.ask({ kind });
  }

  evaluate() {
    this.setTraining(false);
    return this.ask({ kind: 'evaluate', runs: RUNS, of: this.theatre.playing ?? 'present' });
  }

  // --- the state ----------------------------------------------------------------------------------------------------------

  /** @param {State['watch']} watch */
  watch(watch) {
    this.change({ watch });
    this.theatre.watch(watch);
  }

  /** Changes what needs no other session: watch, speed, pace, layers, hide. @param {Partial<State>} part */
  change(part) {
    this.state = { ...this.state, ...part };
    this.showState();
  }

  showState() {
    this.theatre.speed = this.state.speed;
    this.controls.show(this.state, { trained: this.theatre.trained, best: this.theatre.best !== null });
    this.signals.tell('state', this.state);
  }

  retheme() {
    forgetColours();
    this.theatre.retheme();
    this.curves?.retheme();
    const { theme } = document.documentElement.dataset;
    this.signals.tell('theme', theme === 'light' || theme === 'dark' ? theme : 'system');
  }
}
