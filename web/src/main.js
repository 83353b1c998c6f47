// @ts-check
// Wires the parts: one worker, one state, one clock; every view reads the same frame.

import { Client, Refused } from './client.js';
import { byId, count, element, forgetColours, offer, setText } from './dom.js';
import { Player, Recorder, happenings } from './player.js';
import { END, Frame } from './protocol.js';
import { initialState, readHash, writeHash } from './state.js';
import { Automaton } from './views/automaton.js';
import { Controls } from './views/controls.js';
import { Curves } from './views/curves.js';
import { Driver } from './views/drive.js';
import { Evaluation, Modules, Settings } from './views/details.js';
import { Frontier } from './views/frontier.js';
import { Reward } from './views/reward.js';
import { Spec } from './views/spec.js';
import { Stage } from './views/stage.js';
import { Timeline } from './views/timeline.js';
import { loadPlot, loadViz } from './vendor.js';

/** @typedef {import('./protocol.js').Description} Description */
/** @typedef {import('./protocol.js').Episode} Episode */
/** @typedef {import('./state.js').State} State */

/** How long the last moment of an episode stands before the next episode, in milliseconds. */
const PAUSE = 900;
/** The largest checkpoint that is read, in bytes. */
const MAX_CHECKPOINT = 400_000_000;

const $ = {
  button: (/** @type {string} */ id) => byId(id, HTMLButtonElement),
  select: (/** @type {string} */ id) => byId(id, HTMLSelectElement),
  input: (/** @type {string} */ id) => byId(id, HTMLInputElement),
  any: (/** @type {string} */ id) => byId(id, HTMLElement),
  canvas: (/** @type {string} */ id) => byId(id, HTMLCanvasElement),
};

class App {
  constructor() {
    const { state, problems } = readHash(location.hash);
    /** @type {State} */
    this.state = state;
    /** @type {Description | null} */
    this.description = null;
    this.generation = 0;
    this.training = false;
    /** The newest frame of training. @type {Frame | null} */
    this.live = null;
    this.liveIsNew = false;
    this.player = new Player(0);
    this.recorder = new Recorder();
    /** @type {import('./player.js').Happening[]} */
    this.list = [];
    this.episodeIndex = 0;
    this.asking = false;
    this.restedSince = 0;
    this.shownRow = -1;
    this.lastPaint = 0;
    this.lastTimeline = 0;
    /** @type {Stage | null} */
    this.stage = null;
    /** @type {Frame | null} */
    this.view = null;

    this.client = new Client(() => new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }), {
      frame: ({ generation, data }) => this.hearFrame(generation, data),
      telemetry: (reply) => {
        if (reply.generation !== this.generation) return;
        this.training = reply.training;
        this.controls.training(reply.training);
        this.controls.rate(reply.rate);
        this.curves?.update(reply.curves);
        this.modules.update(reply.modules);
      },
      evaluation: ({ generation, progress }) => {
        if (generation === this.generation) this.evaluation.update(progress);
      },
      finished: ({ generation, first_perfect_step }) => {
        if (generation !== this.generation) return;
        this.notice(first_perfect_step === null
          ? 'Training has used up the budget of its recipe. Press Train to go on.'
          : `Learned: every run of the evaluation after ${count(first_perfect_step)} steps satisfies the task. Press Train to go on.`);
      },
      broken: (message) => this.mend(message),
    });

    this.spec = this.makeSpec();
    this.controls = this.makeControls();
    this.automaton = new Automaton($.any('automaton'), $.any('automaton-now'), loadViz);
    this.frontier = new Frontier($.any('frontier'), $.any('unvisited'), $.any('jumps'));
    this.reward = new Reward({
      accepting: $.any('r-accepting'), reached: $.any('r-reached'), left: $.any('r-left'), sum: $.any('r-sum'),
      discount: $.any('r-discount'), words: $.any('r-words'), total: $.any('r-total'),
    });
    this.driver = new Driver($.canvas('stage'));
    this.driving = false;
    this.timeline = new Timeline($.canvas('timeline'), (row) => this.seek(row));
    this.modules = new Modules($.any('modules'));
    this.settings = new Settings($.any('settings'), (key, value) => this.override(key, value));
    this.evaluation = new Evaluation($.any('evaluation'));
    /** @type {Curves | null} */
    this.curves = null;
    /** Whether the trained policy of this task is loaded. */
    this.trained = false;
    /** The tasks with a trained policy. @type {string[]} */
    this.policies = [];
    this.wire();
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.setPlaying(false);
    this.controls.show(this.state, this.trained);
    this.hide();
    for (const { property, message } of problems) this.notice(`The link’s “${property}” ${message}.`, true);
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
        chooseTask: (task) => this.open({ ...this.state, task, formula: '', hoa: '', preset: '', set: {} }),
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

  wire() {
    $.button('play').addEventListener('click', () => this.togglePlay());
    $.button('previous').addEventListener('click', () => this.jump(-1));
    $.button('following').addEventListener('click', () => this.jump(1));
    $.input('scrub').addEventListener('input', () => this.seek(Number($.input('scrub').value)));
    $.button('evaluate').addEventListener('click', () => this.ask({ kind: 'evaluate', runs: 200 }));
    $.button('settings-own').addEventListener('click', () => this.open({ ...this.state, set: {} }));
    $.button('save').addEventListener('click', () => this.save('whole'));
    $.button('save-policy').addEventListener('click', () => this.save('policy'));
    $.input('load').addEventListener('change', () => this.load());
    $.button('share').addEventListener('click', () => this.share());
    $.button('theme').addEventListener('click', () => this.nextTheme());
    $.button('export-png').addEventListener('click', () => $.canvas('stage').toBlob((blob) => blob && offer(`${this.state.task}.png`, blob, 'image/png')));
    $.button('export-svg').addEventListener('click', () => {
      const svg = $.any('automaton').querySelector('svg');
      if (svg) offer(`${this.state.task}.svg`, new XMLSerializer().serializeToString(svg), 'image/svg+xml');
    });
    $.button('export-csv').addEventListener('click', () => offer(`${this.state.task}-curves.csv`, this.curves?.csv() ?? '', 'text/csv'));
    $.button('export-json').addEventListener('click', () => offer(`${this.state.task}.json`, JSON.stringify(this.description, null, 2), 'application/json'));
    const help = byId('help', HTMLDialogElement);
    $.button('help-open').addEventListener('click', () => help.showModal());
    $.button('help-close').addEventListener('click', () => help.close());
    window.addEventListener('hashchange', () => this.followHash());
    window.addEventListener('keydown', (event) => this.key(event));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.retheme());
  }

  /** Begins: the worker, the task of the link, the first episode; then the libraries that can wait. */
  async start() {
    requestAnimationFrame((now) => this.paint(now));
    const listed = fetch('policies.json').then((r) => r.json()).catch(() => []);
    try {
      const tasks = await this.client.ready;
      this.policies = await listed;
      this.spec.offer(tasks);
      if (!tasks.some((t) => t.name === this.state.task)) {
        this.notice(`The link’s “task” ${this.state.task} is unknown; known are ${tasks.map((t) => t.name).join(', ')}.`, true);
        this.state = { ...initialState(), seed: this.state.seed };
      }
    } catch (error) {
      return; // `broken` has said why
    }
    await this.open(this.state, true);
    this.curves = new Curves($.any('curves'), await loadPlot());
    if (this.description) this.ask({ kind: 'pause' });
  }

  /**
   * Opens a task. A refusal is shown at the field that caused it and the present session stays.
   * @param {State} next
   * @param {boolean} [first]  whether nothing is open yet: a refusal then falls back to the task as it is shipped
   */
  async open(next, first = false) {
    try {
      const { generation, description } = await this.client.ask({
        kind: 'open',
        request: {
          task: next.task, formula: next.formula || null, hoa: next.hoa || null, seed: next.seed, preset: next.preset || null, overrides: next.set,
        },
      });
      this.state = next;
      this.opened(generation, description);
    } catch (error) {
      this.refused(error, next);
      if (first) {
        await this.open({ ...initialState(), task: next.task, seed: next.seed });
        if (next.formula && error instanceof Refused) {
          await this.spec.putFormula(next.formula);
          this.refused(error, next);
        }
      }
    }
  }

  /** @param {unknown} error @param {State} next */
  refused(error, next) {
    if (!(error instanceof Refused)) return;
    const { where } = error;
    if (where.field === 'formula' && next.formula) this.spec.refuse(where);
    else if (where.field === 'hoa' && next.hoa) this.spec.refuseHoa(where);
    else this.notice(error.message + (where.hint ? ` (${where.hint})` : ''), true);
  }

  /** @param {number} generation @param {Description} description */
  opened(generation, description) {
    this.generation = generation;
    this.description = description;
    this.training = false;
    this.trained = false;
    this.live = null;
    this.view = new Frame(description.layout);
    const { playing } = this.player;
    this.player = new Player(description.environment.dt);
    this.player.playing = playing;
    this.recorder = new Recorder();
    this.list = [];
    this.episodeIndex = 0;
    this.asking = false;
    this.shownRow = -1;
    this.stage?.close();
    this.stage = new Stage($.canvas('stage'), description);
    this.spec.show(description);
    this.controls.show(this.state, this.trained);
    this.controls.training(false);
    this.controls.rate(0);
    this.frontier.show(description.automaton);
    this.reward.show(description.automaton);
    this.timeline.show(description);
    this.settings.show(description.settings, this.state.set);
    setText($.any('settings-note'), Object.keys(this.state.set).length > 0 ? 'changed by you' : 'change one to start anew');
    $.button('settings-own').hidden = Object.keys(this.state.set).length === 0;
    this.evaluation.clear();
    this.automaton.show(description.automaton).then(() => this.refresh()).catch((error) => $.any('automaton').replaceChildren(element('p', { className: 'note' }, `The automaton could not be drawn: ${error}`)));
    setText($.any('stage-title'), description.task.title);
    this.writeHash();
    this.loadTrained().then(() => {
      if (generation !== this.generation) return;
      this.controls.show(this.state, this.trained);
      this.watch(this.state.watch);
      this.nextEpisode();
    });
  }

  /** Loads the trained policy of the open task, if one comes with the page and the task is as it is shipped. */
  async loadTrained() {
    const { task, formula, hoa } = this.state;
    if (formula || hoa || !this.policies.includes(task)) return;
    try {
      const answer = await fetch(`assets/policies/${task}.safetensors`);
      if (!answer.ok) return;
      const { generation, fits } = await this.client.ask({ kind: 'load_policy', bytes: new Uint8Array(await answer.arrayBuffer()) });
      if (generation === this.generation) this.trained = fits;
    } catch {
      // Without it the page shows the present policy.
    }
  }

  /** Whether the stage plays episodes, and whose. */
  get playing() {
    const { watch } = this.state;
    if (watch === 'trained') return this.trained ? 'shipped' : 'present';
    return watch === 'policy' ? 'present' : null;
  }

  /** @param {import('./protocol.js').Command} command */
  async ask(command) {
    try {
      return await this.client.ask(command);
    } catch (error) {
      this.refused(error, this.state);
      return undefined;
    }
  }

  /** @param {number} generation @param {Float32Array} data */
  hearFrame(generation, data) {
    // The first frame of a session may come before its description.
    if (!this.description || generation !== this.generation || data.length !== this.description.layout.length) return;
    this.live ??= new Frame(this.description.layout);
    this.live.at(data, 0);
    this.liveIsNew = true;
    if (this.state.watch === 'training') this.recorder.add(this.live);
  }

  // --- playback ---------------------------------------------------------------------------------------------------------

  /** Asks for the next episode of whose policy is watched. @returns {Promise<void>} */
  async nextEpisode() {
    const of = this.playing;
    if (this.asking || !of) return;
    this.asking = true;
    const index = this.episodeIndex++;
    const answer = await this.ask({ kind: 'rollout', index, of });
    if (!answer || answer.generation !== this.generation) return;
    this.asking = false;
    if (of !== this.playing) return this.nextEpisode();
    this.player.load(answer.episode);
    this.player.of = of;
    this.restedSince = 0;
    this.takeEpisode(answer.episode);
  }

  /** @param {Episode} episode */
  takeEpisode(episode) {
    if (!this.description) return;
    this.list = happenings(this.description.layout, episode);
    this.timeline.load(episode, this.list);
    $.input('scrub').max = String(episode.rows - 1);
    this.shownRow = -1;
  }

  /** @param {number} now */
  paint(now) {
    requestAnimationFrame((t) => this.paint(t));
    const seconds = Math.min((now - this.lastPaint) / 1000, 0.25);
    this.lastPaint = now;
    if (!this.description || !this.view) return;
    if (this.live && this.liveIsNew) this.controls.update(this.live);
    if (this.playing) this.paintEpisode(now, seconds);
    else if (this.state.watch === 'drive') this.driveOn(seconds);
    else if (this.liveIsNew && this.live) this.paintLive(now, this.live);
    this.liveIsNew = false;
  }

  // --- driving ------------------------------------------------------------------------------------------------------------

  async beginDrive() {
    const answer = await this.ask({ kind: 'begin_drive', index: this.episodeIndex++ });
    if (!answer || answer.generation !== this.generation || !this.view) return;
    this.recorder = new Recorder();
    this.stage?.forget();
    this.driver.activate(true);
    this.setPlaying(true);
    this.driving = false;
    this.stageNote('Push with the arrow keys, or press on the picture');
    this.takeDriven(answer.data);
  }

  /** @param {number} seconds */
  driveOn(seconds) {
    const { player, driver, description, stage } = this;
    if (!description || !stage || this.driving || !driver.active || !player.playing) return;
    if (driver.tick(seconds, player.rowsPerSecond * Math.min(this.state.speed, 1))) this.driveStep(driver.control(description, stage), null);
  }

  /** @param {number[]} control @param {number | null} jump */
  async driveStep(control, jump) {
    this.driving = true;
    const answer = await this.ask({ kind: 'drive', control, jump });
    this.driving = false;
    if (answer && answer.generation === this.generation && this.state.watch === 'drive') this.takeDriven(answer.data);
  }

  /** @param {Float32Array} data */
  takeDriven(data) {
    const frame = /** @type {Frame} */ (this.view).at(data, 0);
    this.recorder.add(frame);
    this.paintLive(performance.now(), frame);
    this.frontier.jumps(frame, (target) => this.driveStep(this.description?.environment.action.map(() => 0) ?? [], target));
    const end = frame.number('end');
    if (frame.number('episode_step') > 0) this.stageNote('');
    if (end === END.running) return;
    this.driver.activate(false);
    const rounds = count(frame.number('rounds'));
    this.stageNote(`${end === END.terminated ? 'The run has ended' : 'Time is up'} after ${count(frame.number('episode_step'))} steps, ${rounds} rounds. Space starts again.`);
  }

  /** @param {number} now @param {number} seconds */
  paintEpisode(now, seconds) {
    const { player, view, stage } = this;
    if (!player.episode || !view || !stage) return;
    player.speed = this.state.speed;
    player.tick(seconds);
    if (player.finished && player.playing) {
      this.restedSince ||= now;
      if (now - this.restedSince > PAUSE) this.nextEpisode();
    }
    stage.replay(player.episode, player.row, player.fraction);
    if (player.row === this.shownRow) return;
    this.shownRow = player.row;
    view.at(player.episode.data, player.row);
    this.showFrame(view);
    this.timeline.update(player.row);
    const scrub = $.input('scrub');
    scrub.value = String(player.row);
    scrub.setAttribute('aria-valuetext', `step ${player.row} of ${player.last}`);
    setText($.any('clock'), `${player.row}/${player.last}`);
    const steps = view.counter('step');
    this.stageNote(this.playing === 'shipped' ? 'A trained policy' : steps === 0 ? 'The policy before any training' : '');
  }

  /** @param {number} now @param {Frame} live */
  paintLive(now, live) {
    this.stage?.live(live);
    this.showFrame(live);
    if (now - this.lastTimeline < 90) return;
    this.lastTimeline = now;
    const episode = this.recorder.episode(live.length);
    if (!episode || !this.description) return;
    this.timeline.load(episode, happenings(this.description.layout, episode));
    this.timeline.update(episode.rows - 1);
    setText($.any('clock'), `step ${live.number('episode_step')}`);
  }

  /** Shows the present moment again, on views that were made anew. */
  refresh() {
    this.shownRow = -1;
    this.liveIsNew = this.live !== null;
  }

  /** @param {Frame} frame */
  showFrame(frame) {
    this.automaton.update(frame);
    this.frontier.update(frame);
    this.reward.update(frame);
  }

  /** @param {string} text */
  stageNote(text) {
    const note = $.any('stage-note');
    note.hidden = text === '';
    setText(note, text);
  }

  /** @param {number} row */
  seek(row) {
    if (!this.playing) return;
    this.setPlaying(false);
    this.player.seek(row);
  }

  /** @param {-1 | 1} direction */
  jump(direction) {
    if (!this.playing) return;
    this.setPlaying(false);
    this.player.jump(this.list, direction);
  }

  togglePlay() {
    if (this.state.watch === 'drive' && !this.driver.active) {
      this.beginDrive();
      return;
    }
    if (this.player.finished) this.player.position = 0;
    this.setPlaying(!this.player.playing);
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    this.player.playing = playing;
    this.restedSince = 0;
    const play = $.button('play');
    play.classList.toggle('paused', !playing);
    play.setAttribute('aria-label', playing ? 'Pause playback' : 'Play');
  }

  /** @param {State['watch']} watch */
  watch(watch) {
    this.change({ watch });
    this.stageNote('');
    for (const id of ['previous', 'following']) $.button(id).disabled = !this.playing;
    $.input('scrub').disabled = !this.playing;
    this.driver.activate(false);
    this.frontier.jumps(null, () => {});
    this.recorder = new Recorder();
    if (this.playing && this.player.episode && this.player.of === this.playing) this.takeEpisode(this.player.episode);
    else if (this.playing) this.nextEpisode();
    else if (watch === 'drive') this.beginDrive();
    else this.liveIsNew = this.live !== null;
    $.button('play').disabled = watch === 'training';
  }

  // --- training ---------------------------------------------------------------------------------------------------------

  toggleTraining() {
    this.training = !this.training;
    if (this.training && this.state.watch === 'trained') this.watch('policy');
    this.controls.training(this.training);
    if (!this.training) this.controls.rate(0);
    this.ask(this.training ? { kind: 'train', pace: this.state.pace } : { kind: 'pause' });
  }

  /** @param {'step' | 'episode'} kind */
  async single(kind) {
    this.training = false;
    this.controls.training(false);
    if (this.state.watch !== 'training') this.watch('training');
    await this.ask({ kind });
  }

  /** Opens the task anew with another value of a hyper-parameter; the value that is refused goes back. @param {string} key @param {string} value */
  async override(key, value) {
    await this.open({ ...this.state, set: { ...this.state.set, [key]: value } });
    if (this.description && this.state.set[key] !== value) this.settings.show(this.description.settings, this.state.set);
  }

  // --- keeping ------------------------------------------------------------------------------------------------------------

  /** @param {'whole' | 'policy'} form */
  async save(form) {
    /** @type {Uint8Array | undefined} */
    const bytes = await this.ask({ kind: 'save', form });
    if (bytes) offer(`${this.state.task}-seed${this.state.seed}${form === 'policy' ? '-policy' : ''}.safetensors`, /** @type {Uint8Array<ArrayBuffer>} */ (bytes), 'application/octet-stream');
  }

  async load() {
    const input = $.input('load');
    const file = input.files?.[0];
    input.value = '';
    if (!file) return;
    if (file.size > MAX_CHECKPOINT) return this.notice(`${file.name} is larger than ${MAX_CHECKPOINT / 1e6} MB.`, true);
    const bytes = new Uint8Array(await file.arrayBuffer());
    const answer = await this.ask({ kind: 'restore', bytes });
    if (!answer) return;
    const { generation, description } = answer;
    this.state = { ...this.state, task: description.task.name, seed: description.seed, preset: description.task.preset, formula: '', hoa: '', set: {} };
    this.opened(generation, description);
    this.notice(`${file.name} is open.`);
  }

  async share() {
    this.writeHash();
    try {
      await navigator.clipboard.writeText(location.href);
      this.notice('The link to this task, seed and view is copied.');
    } catch {
      this.notice(`Copy the address of this page: ${location.href}`);
    }
  }

  /** @param {Partial<State>} part */
  change(part) {
    this.state = { ...this.state, ...part };
    this.controls.show(this.state, this.trained);
    this.writeHash();
  }

  writeHash() {
    const hash = writeHash(this.state);
    if (hash !== location.hash) history.replaceState(null, '', hash || location.pathname + location.search);
  }

  followHash() {
    const { state, problems } = readHash(location.hash);
    for (const { property, message } of problems) this.notice(`The link’s “${property}” ${message}.`, true);
    this.open(state);
  }

  hide() {
    for (const panel of ['spec', 'training', 'automaton', 'details']) $.any(`${panel}-panel`).hidden = this.state.hide.includes(panel);
    $.any('curves').hidden = this.state.hide.includes('curves');
  }

  // --- the rest -----------------------------------------------------------------------------------------------------------

  /** @param {string} text @param {boolean} [problem] */
  notice(text, problem = false) {
    const close = element('button', { type: 'button', className: 'quiet' }, 'Dismiss');
    const line = element('div', { className: problem ? 'notice problem' : 'notice' }, element('span', {}, text), close);
    close.addEventListener('click', () => line.remove());
    const root = $.any('notices');
    root.append(line);
    while (root.children.length > 4) root.firstElementChild?.remove();
    if (!problem) setTimeout(() => line.remove(), 6000);
  }

  /** A worker that broke is replaced, and the task opened anew. @param {string} message */
  async mend(message) {
    this.notice(`The computation stopped: ${message}. It was started again with the same task and seed.`, true);
    if (this.description === null) return;
    this.description = null;
    await this.client.restart().catch(() => {});
    await this.open(this.state, true);
  }

  nextTheme() {
    const root = document.documentElement;
    const order = ['system', 'light', 'dark'];
    const next = order[(order.indexOf(root.dataset.theme ?? 'system') + 1) % order.length];
    if (next === 'system') delete root.dataset.theme;
    else root.dataset.theme = next;
    $.button('theme').setAttribute('aria-label', `Theme: ${next === 'system' ? 'as the system' : next}`);
    this.retheme();
  }

  retheme() {
    forgetColours();
    this.stage?.retheme();
    this.timeline.retheme();
    this.curves?.retheme();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    if (target.matches('input:not([type=radio], [type=range]), select, textarea')) return;
    if (this.driver.press(event.key)) return event.preventDefault();
    if (event.key === ' ' && target.matches('button, summary, label')) return;
    if (event.key.startsWith('Arrow') && target.matches('input')) return;
    /** @type {Record<string, () => void>} */
    const keys = {
      ' ': () => this.togglePlay(),
      t: () => this.toggleTraining(),
      s: () => this.single('step'),
      e: () => this.single('episode'),
      ',': () => this.jump(-1),
      '.': () => this.jump(1),
      ArrowLeft: () => this.seek(this.player.row - 1),
      ArrowRight: () => this.seek(this.player.row + 1),
      r: () => this.controls.places.reset.click(),
      n: () => this.controls.places.newSeed.click(),
      1: () => this.watch('trained'),
      2: () => this.watch('policy'),
      3: () => this.watch('training'),
      4: () => this.watch('drive'),
      '?': () => $.button('help-open').click(),
    };
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

if (typeof WebAssembly !== 'object' || typeof Worker !== 'function') {
  byId('notices', HTMLElement).append(element('p', { className: 'notice problem' }, 'This browser has no WebAssembly or no workers; the page cannot compute anything here.'));
} else {
  new App().start();
  if ('serviceWorker' in navigator) navigator.serviceWorker.register('service_worker.js').catch(() => {});
}
