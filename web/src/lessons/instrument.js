// @ts-check
// The page's instrument in a lesson's hands: opened in a state, read words with, trained, evaluated, watched.

import { RUNS, automatonOutcome, episodeOutcome, instrumentState, trainOutcome, wordOutcome } from './experiments.js';
import { tryAll } from './places.js';

/** @typedef {import('../app.js').App} App */
/** @typedef {import('../state.js').State} State */
/** @typedef {import('./model.js').Experiment} Experiment */
/** @typedef {import('./model.js').Outcome} Outcome */
/** @typedef {import('./word_bench.js').WordBench} WordBench */
/** @typedef {import('./places_bench.js').PlacesBench} PlacesBench */

/** What another run takes away from one that is going on. */
export class Superseded extends Error {}

/** How long a policy that comes with the page may take to load, in milliseconds. */
const PATIENCE = 15_000;

/** The next frame of the screen; of a page that is not seen, which has none, a moment later. */
const nextFrame = () => new Promise((resolve) => {
  requestAnimationFrame(resolve);
  setTimeout(resolve, 250);
});

/** What of a state makes another session. @param {State} state */
const session = ({ task, formula, hoa, seed, preset, set }) => JSON.stringify([task, formula, hoa, seed, preset, set]);

export class Instrument {
  /**
   * @param {App} app
   * @param {{ word: WordBench, places: PlacesBench }} benches
   * @param {number | null} seed   the teacher's seed
   */
  constructor(app, benches, seed) {
    this.app = app;
    this.benches = benches;
    this.seed = seed;
    /** @type {readonly string[]} */
    this.hide = [];
    /** Each run has a number; a later one supersedes it. */
    this.turn = 0;
    this.finished = false;
    /** Steps to the first perfect evaluation of the training that finished. @type {number | null} */
    this.perfect = null;
    app.signals.on('finished', (perfect) => {
      this.finished = true;
      this.perfect = perfect;
    });
  }

  /** Whether the open session has not been trained. */
  get fresh() {
    return (this.app.theatre.live?.counter('step') ?? 0) === 0;
  }

  /** Ends what is going on. */
  stop() {
    this.turn++;
    if (this.app.training) this.app.toggleTraining();
  }

  /** @param {number} turn */
  keep(turn) {
    if (turn !== this.turn) throw new Superseded('another run has begun');
  }

  /**
   * Opens the instrument in a state; the description of what stands then.
   * @param {Partial<State>} part
   * @param {boolean} [anew]   also where the same session stands, trained as it is
   */
  async open(part, anew = false) {
    const { app } = this;
    const next = instrumentState(part, this.hide, this.seed);
    const same = app.description !== null && this.fresh && session(next) === session(app.state);
    if (same && !anew) {
      app.change(next);
      app.theatre.watch(next.watch);
    } else if (!(await app.open(next))) throw new Error('The instrument could not be set up; the reason stands above.');
    if (!app.description) throw new Error('nothing is open');
    return app.description;
  }

  /** Sets up an experiment without running it. @param {Experiment | { state: Partial<State> }} experiment */
  async setUp(experiment) {
    this.stop();
    const turn = this.turn;
    const kind = 'kind' in experiment ? experiment.kind : 'trial';
    const { word, places } = this.benches;
    const description = await this.open(experiment.state);
    this.keep(turn);
    this.app.theatre.held = kind === 'word' || kind === 'policies' || kind === 'automaton';
    places.show(kind === 'policies' ? description : null);
    word.show('kind' in experiment && experiment.kind === 'word' ? { description, word: experiment.word } : null);
    if (kind === 'automaton') word.still(description);
    document.body.classList.toggle('without-world', this.app.theatre.held);
    return description;
  }

  /**
   * Runs an experiment to its outcome.
   * @param {Experiment} experiment
   * @param {(done: number, of: number, words: string) => void} progress
   * @returns {Promise<Outcome>}
   */
  async run(experiment, progress) {
    const description = await this.setUp(experiment);
    const turn = this.turn;
    const { app } = this;
    const ask = (/** @type {import('../protocol.js').Command} */ command) => app.client.ask(command);
    switch (experiment.kind) {
      case 'word': {
        const { word, formulas = [] } = experiment;
        const reading = await ask({ kind: 'read_word', word });
        const others = await Promise.all(formulas.map(async (formula) => ({ formula, holds: await ask({ kind: 'judge_word', formula, word }) })));
        await this.benches.word.play(reading, () => turn === this.turn);
        this.keep(turn);
        return wordOutcome(description, reading, word.letters.length, others);
      }
      case 'automaton':
        return automatonOutcome(description);
      case 'policies': {
        const { told, tried } = await tryAll(ask, description);
        await this.benches.places.play(told, tried, () => turn === this.turn);
        this.keep(turn);
        const satisfying = tried.filter((t) => t.satisfied).length;
        const words = `${satisfying === 0 ? 'None' : satisfying} of the ${tried.length} deterministic policies ${satisfying === 1 ? 'satisfies' : 'satisfy'} the formula.`;
        return { ...automatonOutcome(description), policies: tried.length, satisfying, words };
      }
      case 'train':
        return this.train(experiment, turn, progress);
      case 'episode':
        return this.watch(experiment, turn, progress);
    }
  }

  /** @param {import('./model.js').TrainExperiment} experiment @param {number} turn @param {(done: number, of: number, words: string) => void} progress */
  async train({ state, steps }, turn, progress) {
    const { app } = this;
    if (!this.fresh) await this.open(state, true);
    this.keep(turn);
    const { generation } = app;
    this.finished = false;
    if (!app.training) app.toggleTraining();
    let made = 0;
    while (!this.finished && made < steps) {
      await nextFrame();
      this.keep(turn);
      if (app.generation !== generation) throw new Superseded('another task was opened');
      made = app.theatre.live?.counter('step') ?? 0;
      progress(Math.min(made, steps), steps, `${app.training ? 'training' : 'paused'}, ${made.toLocaleString('en')} of at most ${steps.toLocaleString('en')} steps`);
    }
    if (app.training) app.toggleTraining();
    const perfect = this.finished ? this.perfect : null;
    progress(steps, steps, `playing ${RUNS} runs`);
    const evaluation = await app.client.ask({ kind: 'evaluate', runs: RUNS });
    this.keep(turn);
    if (!evaluation) throw new Superseded('the runs were broken off');
    // What is seen next is what was learned.
    app.theatre.nextEpisode();
    return trainOutcome(made, perfect, evaluation);
  }

  /** @param {import('./model.js').EpisodeExperiment} experiment @param {number} turn @param {(done: number, of: number, words: string) => void} progress */
  async watch({ state }, turn, progress) {
    const { theatre } = this.app;
    const wanted = state.watch === 'trained' ? 'shipped' : 'present';
    const since = performance.now();
    while (!(theatre.player.episode && theatre.player.of === wanted)) {
      await nextFrame();
      this.keep(turn);
      if (performance.now() - since > PATIENCE) throw new Error(wanted === 'shipped' ? 'The trained policy could not be loaded.' : 'The episode does not begin.');
    }
    const { episode } = theatre.player;
    theatre.player.position = 0;
    theatre.setPlaying(true);
    while (theatre.player.episode === episode && !theatre.player.finished) {
      await nextFrame();
      this.keep(turn);
      progress(theatre.player.row, theatre.player.last, `step ${theatre.player.row} of ${theatre.player.last}`);
    }
    if (!this.app.description) throw new Error('nothing is open');
    theatre.setPlaying(false);
    return episodeOutcome(this.app.description, episode);
  }
}
