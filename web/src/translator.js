// @ts-check
// Asks the translating worker. Only the newest question counts: one that takes long is given up when the next comes.

/** @typedef {import('./protocol.js').Comparison} Comparison */
/** @typedef {import('./protocol.js').Located} Located */
/** @typedef {import('../pkg/ltl_rover.js').TranslationFacts} TranslationFacts */
/** @typedef {{ task: string, map: string | null }} Environment */
/**
 * @template T
 * @typedef {{ ok: true, facts: T } | { ok: false, error: Located }} Verdict
 */

/** How long a question may have been worked at before the next one ends the worker, in milliseconds. */
const PATIENCE = 250;

/** The least of a Worker that is needed. */
/** @typedef {{ postMessage(message: unknown): void, terminate(): void, onmessage: ((event: MessageEvent) => void) | null, onerror: ((event: ErrorEvent) => void) | null }} Port */

export class TranslatorClient {
  /** @param {() => Port} start  starts a worker @param {() => number} [now] */
  constructor(start, now = () => performance.now()) {
    this.start = start;
    this.now = now;
    /** @type {Port | null} */
    this.worker = null;
    this.next = 1;
    /** The question that is worked at. @type {{ id: number, since: number, resolve: (verdict: any) => void } | null} */
    this.asked = null;
    /** The question that waits. @type {{ question: object, resolve: (verdict: any) => void } | null} */
    this.waits = null;
  }

  /** Starts the worker, to be ready. */
  warm() {
    if (this.worker) return this.worker;
    const worker = this.start();
    worker.onmessage = ({ data }) => this.hear(data);
    worker.onerror = () => this.restart();
    this.worker = worker;
    return worker;
  }

  /**
   * The automaton of a formula, its class and what is doubtful; `null` if another question came in between.
   * @param {Environment} environment
   * @param {string} formula
   * @returns {Promise<Verdict<TranslationFacts> | null>}
   */
  translate(environment, formula) {
    return this.ask({ ...environment, formula, hoa: null });
  }

  /**
   * An automaton held against a formula; `null` if another question came in between.
   * @param {Environment} environment
   * @param {string} formula
   * @param {string} hoa
   * @returns {Promise<Verdict<Comparison> | null>}
   */
  compare(environment, formula, hoa) {
    return this.ask({ ...environment, formula, hoa });
  }

  /** @param {object} question @returns {Promise<any>} */
  ask(question) {
    return new Promise((resolve) => {
      this.waits?.resolve(null);
      this.waits = { question, resolve };
      if (this.asked && this.now() - this.asked.since > PATIENCE) this.restart();
      this.send();
    });
  }

  /** Gives up the question that is worked at, if the next one still waits after a while. */
  send() {
    if (!this.waits) return;
    if (this.asked) {
      const { id } = this.asked;
      setTimeout(() => {
        if (this.asked?.id === id && this.waits) this.restart();
        this.send();
      }, PATIENCE);
      return;
    }
    const { question, resolve } = this.waits;
    this.waits = null;
    const id = this.next++;
    this.asked = { id, since: this.now(), resolve };
    this.warm().postMessage({ id, ...question });
  }

  /** @param {{ id: number, verdict: unknown }} reply */
  hear({ id, verdict }) {
    if (id !== this.asked?.id) return;
    const { resolve } = this.asked;
    this.asked = null;
    // Of a question that another one has followed nobody wants the answer.
    resolve(this.waits ? null : verdict);
    this.send();
  }

  restart() {
    this.worker?.terminate();
    this.worker = null;
    this.asked?.resolve(null);
    this.asked = null;
    this.send();
  }
}
