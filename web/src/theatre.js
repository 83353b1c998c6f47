// @ts-check
// The theatre: what the stage and the views linked to it show at each moment, be it an episode that is played, training as it comes,
// or a run that the user drives.

import { byId, count, element, setText } from './dom.js';
import { Driving } from './driving.js';
import { Player, Recorder, happenings } from './player.js';
import { Frame } from './protocol.js';
import { Transport } from './transport.js';
import { draw } from './vendor.js';
import { Automaton } from './views/automaton.js';
import { Frontier } from './views/frontier.js';
import { EARLIER } from './views/ground.js';
import { Reward } from './views/reward.js';
import { Stage } from './views/stage.js';
import { Timeline } from './views/timeline.js';

/** @typedef {import('./protocol.js').Command} Command */
/** @typedef {import('./protocol.js').Description} Description */
/** @typedef {import('./protocol.js').Episode} Episode */
/** @typedef {import('./state.js').State} State */

/** How long the last moment of an episode stands before the next episode, in milliseconds. */
const PAUSE = 900;
/** How often the timeline of a run that goes on is drawn anew, in milliseconds. */
const REDRAW = 90;

export class Theatre {
  /**
   * @param {(command: Command) => Promise<any>} ask  resolves with `undefined` where a command was refused, which has been told then
   * @param {import('./signals.js').Signals} signals
   */
  constructor(ask, signals) {
    this.ask = ask;
    this.signals = signals;
    const any = (/** @type {string} */ id) => byId(id, HTMLElement);
    this.canvas = byId('stage', HTMLCanvasElement);
    this.note = any('stage-note');
    this.transport = new Transport({
      play: () => this.togglePlay(), seek: (row) => this.seek(row), step: (rows) => this.seek(this.player.row + rows),
      jump: (direction) => this.jump(direction), next: () => this.another(),
    });
    this.automatonRoot = any('automaton');
    this.automaton = new Automaton(this.automatonRoot, any('automaton-now'), draw);
    this.frontier = new Frontier(any('frontier'), any('unvisited'), any('jumps'));
    this.reward = new Reward({
      accepting: any('r-accepting'), reached: any('r-reached'), left: any('r-left'), sum: any('r-sum'),
      discount: any('r-discount'), words: any('r-words'), total: any('r-total'),
    });
    this.timeline = new Timeline(byId('timeline', HTMLCanvasElement), (row) => this.seek(row));
    this.drive = new Driving(this);
    this.canvas.addEventListener('click', (event) => this.startAt(event.offsetX, event.offsetY));

    /** @type {Description | null} */
    this.description = null;
    this.generation = 0;
    /** @type {State['watch']} */
    this.mode = 'policy';
    this.speed = 1;
    /** What is drawn over the ground. @type {ReadonlySet<string>} */
    this.layers = new Set();
    /** Whether the trained policy of the open task is loaded. */
    this.trained = false;
    /** The best policy so far of the open session. @type {import('./protocol.js').BestPolicy | null} */
    this.best = null;
    /** The newest frame of training. @type {Frame | null} */
    this.live = null;
    this.liveIsNew = false;
    /** The reader of every other frame. @type {Frame | null} */
    this.reader = null;
    /** @type {Stage | null} */
    this.stage = null;
    this.player = new Player(0);
    this.recorder = new Recorder();
    /** @type {import('./player.js').Happening[]} */
    this.list = [];
    /** Runs before this one, the latest last. @type {import('./track.js').Track[]} */
    this.earlier = [];
    this.episodeIndex = 0;
    this.asking = false;
    this.restedSince = 0;
    this.shownRow = -1;
    this.lastPaint = 0;
    this.lastTimeline = 0;
    this.moved = false;
    /** Whether somebody else shows moments, such as the letters of a word. */
    this.held = false;
  }

  /** Begins anew with the episodes. */
  reset() {
    this.episodeIndex = 0;
    this.asking = false;
    this.drive.reset();
    this.restedSince = 0;
    this.shownRow = -1;
  }

  /**
   * Shows another session.
   * @param {number} generation
   * @param {Description} description
   * @param {string | null} shippedTask  the task, where its automaton is the one that comes with the page
   */
  open(generation, description, shippedTask) {
    const { playing } = this.player;
    this.generation = generation;
    this.description = description;
    this.live = null;
    this.reader = new Frame(description.layout);
    this.trained = false;
    this.best = null;
    this.player = new Player(description.environment.dt);
    this.player.playing = playing;
    this.recorder = new Recorder();
    this.list = [];
    this.reset();
    this.stage?.close();
    this.stage = new Stage(this.canvas, description);
    this.stage.set({ layers: this.layers });
    this.forgetEarlier();
    this.frontier.show(description.automaton);
    this.reward.show(description.automaton);
    this.timeline.show(description);
    byId('automaton-panel', HTMLElement).classList.toggle('unshaped', !description.shaping);
    this.automaton.show(description.automaton, shippedTask).then(() => this.refresh()).catch((error) => {
      this.automatonRoot.replaceChildren(element('p', { className: 'note' }, `The automaton could not be drawn: ${error}`));
    });
  }

  /** Draws another automaton in place of the open one, which goes on unseen. @param {import('./protocol.js').AutomatonGraph} graph */
  preview(graph) {
    return this.automaton.preview(graph).catch(() => {});
  }

  endPreview() {
    if (this.automaton.endPreview()) this.refresh();
  }

  /** Shows nothing any more, until another session is there. */
  close() {
    this.description = null;
  }

  retheme() {
    this.stage?.retheme();
    this.timeline.retheme();
  }

  /** @param {string[]} layers */
  setLayers(layers) {
    if (layers.length === this.layers.size && layers.every((layer) => this.layers.has(layer))) return;
    this.layers = new Set(layers);
    this.stage?.set({ layers: this.layers });
  }

  /** Shows the present moment again, on views that were made anew. */
  refresh() {
    this.shownRow = -1;
    this.liveIsNew = this.live !== null;
    if (this.mode === 'drive' && this.reader && this.recorder.frames.length > 0) this.show(this.reader);
  }

  /** A frame of training. @param {number} generation @param {Float32Array} data */
  hear(generation, data) {
    if (!this.description || generation !== this.generation) return;
    this.live ??= new Frame(this.description.layout);
    this.live.at(data, 0);
    this.liveIsNew = true;
    if (this.mode === 'training') this.recorder.add(this.live);
  }

  /** Whose episodes the stage plays; `null` where it shows training or driving. @returns {import('./protocol.js').Whose | null} */
  get playing() {
    if (this.mode === 'trained') return this.trained ? 'shipped' : 'present';
    if (this.mode === 'best') return this.best ? 'best' : 'present';
    return this.mode === 'policy' ? 'present' : null;
  }

  /** What is seen now, as an episode to keep: the one that is played, or what was seen of the run that goes on. @returns {Episode | null} */
  get current() {
    if (this.playing) return this.player.episode;
    return this.description ? this.recorder.episode(this.description.layout.length) : null;
  }

  /** Chooses what is shown. @param {State['watch']} mode */
  watch(mode) {
    if (mode !== this.mode) this.forgetEarlier();
    this.mode = mode;
    this.say('');
    this.transport.enable(this.playing !== null, mode !== 'training', this.playing !== null || mode === 'drive');
    this.drive.driver.activate(false);
    this.frontier.jumps(null, () => {});
    this.recorder = new Recorder();
    this.signals.tell('watch', mode);
    if (mode === 'drive') this.drive.begin();
    else if (mode === 'training') this.liveIsNew = this.live !== null;
    else if (this.player.episode && this.player.of === this.playing) this.take(this.player.episode);
    else this.nextEpisode();
  }

  /** Paints this moment; the page calls it once for every frame of the screen. @param {number} now  in milliseconds */
  paint(now) {
    const seconds = Math.min((now - this.lastPaint) / 1000, 0.25);
    this.lastPaint = now;
    if (!this.description || this.held) return;
    if (this.playing) this.paintEpisode(now, seconds);
    else if (this.mode === 'drive') this.drive.on(seconds);
    else if (this.liveIsNew && this.live) this.paintLive(now, this.live);
    this.liveIsNew = false;
  }

  // --- episodes -------------------------------------------------------------------------------------------------------------

  /**
   * Asks for the next episode of the policy that is watched.
   * @param {number[]} [from]  the state that it begins in
   * @returns {Promise<void>}
   */
  async nextEpisode(from) {
    const of = this.playing;
    if (this.asking || !of || !this.description) return;
    this.asking = true;
    const answer = await this.ask({ kind: 'rollout', index: this.episodeIndex++, of, from });
    if (!answer || answer.generation !== this.generation) return;
    this.asking = false;
    if (of !== this.playing) return this.nextEpisode();
    this.begin(answer.episode, of);
    this.player.after = answer.after ?? 0;
  }

  /** Plays an episode from its start. @param {Episode} episode @param {import('./player.js').Player['of']} of */
  begin(episode, of) {
    if (this.player.episode && this.player.of === of && of !== 'kept') this.remember(this.player.episode);
    this.player.load(episode);
    this.player.of = of;
    this.restedSince = 0;
    this.take(episode);
    this.signals.tell('episode', episode);
  }

  /** Plays an episode that was kept, again and again, until another is asked for. @param {Episode} episode */
  replay(episode) {
    if (!this.playing) this.watch(this.trained ? 'trained' : 'policy');
    this.begin(episode, 'kept');
    this.setPlaying(true);
  }

  /** Another episode: of the policy that is watched, or of the user's own hand. */
  another() {
    if (this.mode === 'drive') this.drive.begin();
    else this.nextEpisode();
  }

  /** An episode from the place that was clicked. @param {number} px @param {number} py */
  startAt(px, py) {
    const { stage, description } = this;
    if (!stage || !description || !this.playing) return;
    const { scene, state } = description.environment;
    if (scene.body.kind === 'cart_pole') return;
    const from = state.map(({ low, high }) => (low + high) / 2);
    stage.painter.pointer(px, py, stage.width, stage.height).forEach((value, k) => {
      from[/** @type {[number, number]} */ (/** @type {any} */ (scene.body).position)[k]] = value;
    });
    this.nextEpisode(from);
    this.setPlaying(true);
  }

  /** Draws a run faintly behind those to come. @param {Episode} episode */
  remember(episode) {
    if (!this.stage) return;
    this.earlier = [...this.earlier, this.stage.track(episode)].slice(-EARLIER);
    this.stage.set({ earlier: this.earlier });
  }

  forgetEarlier() {
    this.earlier = [];
    this.stage?.set({ earlier: this.earlier });
  }

  /** @param {Episode} episode */
  take(episode) {
    if (!this.description) return;
    this.list = happenings(this.description.layout, episode);
    this.timeline.load(episode, this.list);
    this.transport.length(episode.rows - 1);
    this.shownRow = -1;
  }

  /** @param {number} now @param {number} seconds */
  paintEpisode(now, seconds) {
    const { player, reader, stage } = this;
    if (!player.episode || !reader || !stage) return;
    player.speed = this.speed;
    player.tick(seconds);
    if (player.finished && player.playing) {
      this.restedSince ||= now;
      if (now - this.restedSince > PAUSE) this.wentOut();
    }
    stage.replay(player.episode, player.row, player.fraction);
    if (player.row === this.shownRow) return;
    if (!this.moved && this.shownRow >= 0) {
      this.moved = true;
      performance.mark('first-movement');
    }
    this.shownRow = player.row;
    this.show(reader.at(player.episode.data, player.row));
    this.timeline.update(player.row);
    this.transport.at(player.row, player.last);
    const { of } = player;
    this.say(of === 'kept' ? 'A kept episode' : of === 'shipped' ? 'A trained policy'
      : of === 'best' ? `The best policy so far, after ${count(player.after)} steps` : reader.counter('step') === 0 ? 'The policy before any training' : '');
  }

  /** An episode was played to its end, and stood there for a moment. */
  wentOut() {
    this.restedSince = 0;
    if (this.player.of === 'kept') this.player.seek(0);
    else this.nextEpisode();
  }

  /** @param {number} row */
  seek(row) {
    if (!this.playing) return;
    this.setPlaying(false);
    this.player.seek(row);
  }

  /** To the event before or after. @param {-1 | 1} direction */
  jump(direction) {
    if (!this.playing) return;
    this.setPlaying(false);
    this.player.jump(this.list, direction);
  }

  togglePlay() {
    if (this.mode === 'training') return;
    if (this.mode === 'drive' && !this.drive.driver.active) {
      this.drive.begin();
      return;
    }
    if (this.player.finished) this.player.position = 0;
    this.setPlaying(!this.player.playing);
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    this.player.playing = playing;
    this.restedSince = 0;
    this.transport.playing(playing);
  }

  // --- training and other runs that go on -------------------------------------------------------------------------------------

  /** @param {number} now @param {Frame} live */
  paintLive(now, live) {
    const { stage } = this;
    if (stage && live.counter('episode') !== stage.tailEpisode && stage.tail.count > 1 && stage.tailEpisode >= 0) {
      this.earlier = [...this.earlier, stage.tail.copy()].slice(-EARLIER);
      stage.set({ earlier: this.earlier });
    }
    stage?.live(live);
    this.show(live);
    this.transport.live(live.number('episode_step'));
    if (now - this.lastTimeline < REDRAW) return;
    this.lastTimeline = now;
    const episode = this.recorder.episode(live.length);
    if (!episode || !this.description) return;
    this.timeline.load(episode, happenings(this.description.layout, episode));
    this.timeline.update(episode.rows - 1);
  }

  // --- views ------------------------------------------------------------------------------------------------------------------

  /** @param {Frame} frame */
  show(frame) {
    this.automaton.update(frame);
    this.frontier.update(frame);
    this.reward.update(frame);
    this.signals.tell('moment', frame);
  }

  /** Says something on the stage. @param {string} text */
  say(text) {
    this.note.hidden = text === '';
    setText(this.note, text);
  }
}
