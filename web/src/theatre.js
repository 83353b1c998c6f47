// @ts-check
// The theatre: what the stage and the views linked to it show at each moment, be it an episode that is played, training as it comes,
// or a run that the user drives.

import { byId, count, element, setText } from './dom.js';
import { Player, Recorder, happenings } from './player.js';
import { END, Frame } from './protocol.js';
import { Automaton } from './views/automaton.js';
import { Driver } from './views/drive.js';
import { Frontier } from './views/frontier.js';
import { Reward } from './views/reward.js';
import { Stage } from './views/stage.js';
import { Timeline } from './views/timeline.js';
import { loadViz } from './vendor.js';

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
   */
  constructor(ask) {
    this.ask = ask;
    const any = (/** @type {string} */ id) => byId(id, HTMLElement);
    const button = (/** @type {string} */ id) => byId(id, HTMLButtonElement);
    this.canvas = byId('stage', HTMLCanvasElement);
    this.note = any('stage-note');
    this.clock = any('clock');
    this.scrub = byId('scrub', HTMLInputElement);
    this.buttons = { play: button('play'), previous: button('previous'), following: button('following') };
    this.automatonRoot = any('automaton');
    this.automaton = new Automaton(this.automatonRoot, any('automaton-now'), loadViz);
    this.frontier = new Frontier(any('frontier'), any('unvisited'), any('jumps'));
    this.reward = new Reward({
      accepting: any('r-accepting'), reached: any('r-reached'), left: any('r-left'), sum: any('r-sum'),
      discount: any('r-discount'), words: any('r-words'), total: any('r-total'),
    });
    this.timeline = new Timeline(byId('timeline', HTMLCanvasElement), (row) => this.seek(row));
    this.driver = new Driver(this.canvas);
    this.buttons.play.addEventListener('click', () => this.togglePlay());
    this.buttons.previous.addEventListener('click', () => this.jump(-1));
    this.buttons.following.addEventListener('click', () => this.jump(1));
    this.scrub.addEventListener('input', () => this.seek(Number(this.scrub.value)));

    /** @type {Description | null} */
    this.description = null;
    this.generation = 0;
    /** @type {State['watch']} */
    this.mode = 'policy';
    this.speed = 1;
    /** Whether the trained policy of the open task is loaded. */
    this.trained = false;
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
    this.episodeIndex = 0;
    this.asking = false;
    this.driving = false;
    this.restedSince = 0;
    this.shownRow = -1;
    this.lastPaint = 0;
    this.lastTimeline = 0;
  }

  /** Shows another session. @param {number} generation @param {Description} description */
  open(generation, description) {
    const { playing } = this.player;
    this.generation = generation;
    this.description = description;
    this.live = null;
    this.reader = new Frame(description.layout);
    this.trained = false;
    this.player = new Player(description.environment.dt);
    this.player.playing = playing;
    this.recorder = new Recorder();
    this.list = [];
    this.episodeIndex = 0;
    this.asking = false;
    this.driving = false;
    this.shownRow = -1;
    this.stage?.close();
    this.stage = new Stage(this.canvas, description);
    this.frontier.show(description.automaton);
    this.reward.show(description.automaton);
    this.timeline.show(description);
    byId('automaton-panel', HTMLElement).classList.toggle('unshaped', !description.shaping);
    this.automaton.show(description.automaton).then(() => this.refresh()).catch((error) => {
      this.automatonRoot.replaceChildren(element('p', { className: 'note' }, `The automaton could not be drawn: ${error}`));
    });
  }

  /** Shows nothing any more, until another session is there. */
  close() {
    this.description = null;
  }

  retheme() {
    this.stage?.retheme();
    this.timeline.retheme();
  }

  /** Shows the present moment again, on views that were made anew. */
  refresh() {
    this.shownRow = -1;
    this.liveIsNew = this.live !== null;
  }

  /** A frame of training. @param {number} generation @param {Float32Array} data */
  hear(generation, data) {
    if (!this.description || generation !== this.generation) return;
    this.live ??= new Frame(this.description.layout);
    this.live.at(data, 0);
    this.liveIsNew = true;
    if (this.mode === 'training') this.recorder.add(this.live);
  }

  /** Whose episodes the stage plays; `null` where it shows training or driving. */
  get playing() {
    if (this.mode === 'trained') return this.trained ? 'shipped' : 'present';
    return this.mode === 'policy' ? 'present' : null;
  }

  /** Chooses what is shown. @param {State['watch']} mode */
  watch(mode) {
    this.mode = mode;
    this.say('');
    const { play, previous, following } = this.buttons;
    previous.disabled = following.disabled = this.scrub.disabled = !this.playing;
    play.disabled = mode === 'training';
    this.driver.activate(false);
    this.frontier.jumps(null, () => {});
    this.recorder = new Recorder();
    if (mode === 'drive') this.beginDrive();
    else if (mode === 'training') this.liveIsNew = this.live !== null;
    else if (this.player.episode && this.player.of === this.playing) this.take(this.player.episode);
    else this.nextEpisode();
  }

  /** Paints this moment; the page calls it once for every frame of the screen. @param {number} now  in milliseconds */
  paint(now) {
    const seconds = Math.min((now - this.lastPaint) / 1000, 0.25);
    this.lastPaint = now;
    if (!this.description) return;
    if (this.playing) this.paintEpisode(now, seconds);
    else if (this.mode === 'drive') this.driveOn(seconds);
    else if (this.liveIsNew && this.live) this.paintLive(now, this.live);
    this.liveIsNew = false;
  }

  // --- episodes -------------------------------------------------------------------------------------------------------------

  /** Asks for the next episode of the policy that is watched. @returns {Promise<void>} */
  async nextEpisode() {
    const of = this.playing;
    if (this.asking || !of || !this.description) return;
    this.asking = true;
    const answer = await this.ask({ kind: 'rollout', index: this.episodeIndex++, of });
    if (!answer || answer.generation !== this.generation) return;
    this.asking = false;
    if (of !== this.playing) return this.nextEpisode();
    this.player.load(answer.episode);
    this.player.of = of;
    this.restedSince = 0;
    this.take(answer.episode);
  }

  /** @param {Episode} episode */
  take(episode) {
    if (!this.description) return;
    this.list = happenings(this.description.layout, episode);
    this.timeline.load(episode, this.list);
    this.scrub.max = String(episode.rows - 1);
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
      if (now - this.restedSince > PAUSE) this.nextEpisode();
    }
    stage.replay(player.episode, player.row, player.fraction);
    if (player.row === this.shownRow) return;
    this.shownRow = player.row;
    this.show(reader.at(player.episode.data, player.row));
    this.timeline.update(player.row);
    this.scrub.value = String(player.row);
    this.scrub.setAttribute('aria-valuetext', `step ${player.row} of ${player.last}`);
    setText(this.clock, `${player.row}/${player.last}`);
    this.say(player.of === 'shipped' ? 'A trained policy' : reader.counter('step') === 0 ? 'The policy before any training' : '');
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
    if (this.mode === 'drive' && !this.driver.active) {
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
    this.buttons.play.classList.toggle('paused', !playing);
    this.buttons.play.setAttribute('aria-label', playing ? 'Pause playback' : 'Play');
  }

  // --- training and driving ---------------------------------------------------------------------------------------------------

  /** @param {number} now @param {Frame} live */
  paintLive(now, live) {
    this.stage?.live(live);
    this.show(live);
    setText(this.clock, `step ${live.number('episode_step')}`);
    if (now - this.lastTimeline < REDRAW) return;
    this.lastTimeline = now;
    const episode = this.recorder.episode(live.length);
    if (!episode || !this.description) return;
    this.timeline.load(episode, happenings(this.description.layout, episode));
    this.timeline.update(episode.rows - 1);
  }

  async beginDrive() {
    const answer = await this.ask({ kind: 'begin_drive', index: this.episodeIndex++ });
    if (!answer || answer.generation !== this.generation || this.mode !== 'drive') return;
    this.recorder = new Recorder();
    this.stage?.forget();
    this.driver.activate(true);
    this.setPlaying(true);
    this.driving = false;
    this.say('Push with the arrow keys, or press on the picture');
    this.takeDriven(answer.data);
  }

  /** @param {number} seconds */
  driveOn(seconds) {
    const { player, driver, description, stage } = this;
    if (!description || !stage || this.driving || !driver.active || !player.playing) return;
    if (driver.tick(seconds, player.rowsPerSecond * Math.min(this.speed, 1))) this.driveStep(driver.control(description, stage), null);
  }

  /** @param {number[]} control @param {number | null} jump */
  async driveStep(control, jump) {
    this.driving = true;
    const answer = await this.ask({ kind: 'drive', control, jump });
    this.driving = false;
    if (answer && answer.generation === this.generation && this.mode === 'drive') this.takeDriven(answer.data);
  }

  /** @param {Float32Array} data */
  takeDriven(data) {
    const frame = /** @type {Frame} */ (this.reader).at(data, 0);
    this.recorder.add(frame);
    this.paintLive(performance.now(), frame);
    const still = this.description?.environment.action.map(() => 0) ?? [];
    this.frontier.jumps(frame, (target) => this.driveStep(still, target));
    if (frame.number('episode_step') > 0) this.say('');
    const end = frame.number('end');
    if (end === END.running) return;
    this.driver.activate(false);
    const what = end === END.terminated ? 'The run has ended' : 'Time is up';
    this.say(`${what} after ${count(frame.number('episode_step'))} steps, ${count(frame.number('rounds'))} rounds. Space starts again.`);
  }

  // --- views ------------------------------------------------------------------------------------------------------------------

  /** @param {Frame} frame */
  show(frame) {
    this.automaton.update(frame);
    this.frontier.update(frame);
    this.reward.update(frame);
  }

  /** Says something on the stage. @param {string} text */
  say(text) {
    this.note.hidden = text === '';
    setText(this.note, text);
  }
}
