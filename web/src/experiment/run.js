// @ts-check
// One run of an experiment: a worker of its own that trains for so many steps and is then evaluated.

import { Client } from '../client.js';
import { Frame } from '../protocol.js';

/** @typedef {import('../protocol.js').Curves} Curves */
/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Episode} Episode */
/** @typedef {import('../protocol.js').EvaluationProgress} EvaluationProgress */
/** @typedef {import('../protocol.js').OpenRequest} OpenRequest */
/** @typedef {import('./variants.js').Variant} Variant */

/**
 * @typedef {'waiting' | 'training' | 'evaluating' | 'finished' | 'failed'} Stand
 */

export class Run {
  /**
   * @param {Variant} variant
   * @param {OpenRequest} request  with the run's own seed; the variant's changes are added
   * @param {number} steps         environment steps of training
   * @param {number} evaluation    episodes of the evaluation after it
   * @param {() => void} changed   called when something is new
   */
  constructor(variant, request, steps, evaluation, changed) {
    this.variant = variant;
    this.request = { ...request, overrides: { ...request.overrides, ...variant.overrides } };
    this.wanted = steps;
    this.evaluation = evaluation;
    this.changed = changed;
    /** @type {Stand} */
    this.stand = 'waiting';
    this.problem = '';
    this.steps = 0;
    this.episodes = 0;
    /** How long the training took, in seconds. */
    this.seconds = 0;
    /** @type {Description | null} */
    this.description = null;
    /** @type {Curves | null} */
    this.curves = null;
    /** @type {EvaluationProgress | null} */
    this.progress = null;
    /** The best policy that the recipe's evaluations have seen: the one that is judged at the end. @type {import('../protocol.js').BestPolicy | null} */
    this.best = null;
    /** @type {Client | null} */
    this.client = null;
    this.generation = 0;
    this.asking = false;
  }

  get seed() {
    return this.request.seed;
  }

  get over() {
    return this.stand === 'finished' || this.stand === 'failed';
  }

  /** Trains and evaluates; resolves when the run is over, however it went. */
  async play() {
    this.stand = 'training';
    /** @type {Frame | null} */
    let frame = null;
    const client = new Client(() => new Worker(new URL('../worker.js', import.meta.url), { type: 'module' }), {
      frame: ({ data }) => {
        if (!frame) return;
        frame.at(data, 0);
        this.steps = frame.counter('step');
        this.episodes = frame.counter('episode');
      },
      telemetry: ({ curves, best }) => {
        this.curves = curves;
        this.best = best;
        this.changed();
      },
      evaluation: ({ progress }) => {
        this.progress = progress;
        this.changed();
      },
      finished: () => {},
      broken: (message) => this.fail(message),
    });
    this.client = client;
    try {
      await client.ready;
      const { generation, description } = await client.ask({ kind: 'open', request: this.request });
      this.generation = generation;
      this.description = description;
      frame = new Frame(description.layout);
      this.changed();
      const began = performance.now();
      await client.ask({ kind: 'train', pace: 0, until: this.wanted });
      this.seconds = (performance.now() - began) / 1000;
      if (this.over) return;
      this.stand = 'evaluating';
      this.changed();
      await client.ask({ kind: 'evaluate', runs: this.evaluation, of: 'best' });
      if (this.over) return;
      this.stand = 'finished';
    } catch (error) {
      if (!this.over) this.fail(error instanceof Error ? error.message : String(error));
    }
    this.changed();
  }

  /** A greedy episode of the run's policy as it is now, after its end of the best one; `null` where there is none to be had. @param {number} index @returns {Promise<Episode | null>} */
  async rollout(index) {
    if (!this.client || !this.description || this.asking || this.stand === 'failed') return null;
    this.asking = true;
    const answer = await this.client.ask({ kind: 'rollout', index, of: this.stand === 'finished' ? 'best' : 'present' }).catch(() => null);
    this.asking = false;
    return answer?.episode ?? null;
  }

  /** @param {string} message */
  fail(message) {
    this.stand = 'failed';
    this.problem = message;
    this.close();
    this.changed();
  }

  /** Ends the worker; what is known stays. */
  close() {
    this.client?.close();
    this.client = null;
  }
}
