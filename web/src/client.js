// @ts-check
// The page's side of the worker: commands out as promises, frames in as callbacks, a fresh worker when one breaks.

/** @typedef {import('./protocol.js').Command} Command */
/** @typedef {import('./protocol.js').Reply} Reply */
/** @typedef {import('./protocol.js').Located} Located */

/** A command that the worker refused. */
export class Refused extends Error {
  /** @param {Located} where */
  constructor(where) {
    super(where.message);
    this.name = 'Refused';
    this.where = where;
  }
}

/**
 * @typedef {object} Listeners
 * @property {(reply: Extract<Reply, { kind: 'frame' }>) => void} frame
 * @property {(reply: Extract<Reply, { kind: 'telemetry' }>) => void} telemetry
 * @property {(reply: Extract<Reply, { kind: 'evaluation' }>) => void} evaluation
 * @property {(reply: Extract<Reply, { kind: 'finished' }>) => void} finished
 * @property {(reply: Extract<Reply, { kind: 'halted' }>) => void} [halted]
 * @property {(message: string) => void} broken
 */

/** The least of a Worker that the client needs. */
/** @typedef {{ postMessage(message: unknown, transfer?: Transferable[]): void, terminate(): void, onmessage: ((event: MessageEvent) => void) | null, onerror: ((event: ErrorEvent) => void) | null }} Port */

export class Client {
  /**
   * @param {() => Port} start  starts a worker
   * @param {Listeners} listeners
   */
  constructor(start, listeners) {
    this.start = start;
    this.listeners = listeners;
    this.next = 1;
    /** @type {Map<number, { resolve: (value: any) => void, reject: (error: Error) => void }>} */
    this.pending = new Map();
    /** @type {Port | null} */
    this.worker = null;
    /** Answers with the built-in tasks once the worker stands. */
    this.ready = this.restart();
  }

  /**
   * Ends the worker, if there is one, and starts another.
   * @returns {Promise<import('./protocol.js').TaskEntry[]>}
   */
  restart() {
    this.worker?.terminate();
    for (const { reject } of this.pending.values()) reject(new Error('the worker was restarted'));
    this.pending.clear();
    const worker = this.start();
    this.worker = worker;
    this.ready = new Promise((resolve, reject) => {
      worker.onerror = (event) => {
        const message = event.message || 'the worker could not be started';
        reject(new Error(message));
        this.broke(message);
      };
      worker.onmessage = (event) => {
        const reply = /** @type {Reply} */ (event.data);
        if (reply.kind === 'ready') resolve(reply.tasks);
        else if (reply.kind === 'broken') {
          reject(new Error(reply.message));
          this.broke(reply.message);
        } else this.hear(reply);
      };
    });
    // Whoever awaits it hears of a failure; nobody has to.
    this.ready.catch(() => {});
    return this.ready;
  }

  /** Ends the worker for good. */
  close() {
    this.worker?.terminate();
    this.worker = null;
    for (const { reject } of this.pending.values()) reject(new Error('the worker was ended'));
    this.pending.clear();
  }

  /** @param {string} message */
  broke(message) {
    for (const { reject } of this.pending.values()) reject(new Error(message));
    this.pending.clear();
    this.listeners.broken(message);
  }

  /** @param {Reply} reply */
  hear(reply) {
    switch (reply.kind) {
      case 'done':
        this.pending.get(reply.id)?.resolve(reply.value);
        this.pending.delete(reply.id);
        break;
      case 'failed':
        this.pending.get(reply.id)?.reject(new Refused(reply.error));
        this.pending.delete(reply.id);
        break;
      case 'frame':
        this.listeners.frame(reply);
        break;
      case 'telemetry':
        this.listeners.telemetry(reply);
        break;
      case 'evaluation':
        this.listeners.evaluation(reply);
        break;
      case 'finished':
        this.listeners.finished(reply);
        break;
      case 'halted':
        this.listeners.halted?.(reply);
        break;
    }
  }

  /**
   * Sends a command; resolves with its value.
   * @param {Command} command
   * @returns {Promise<any>}
   */
  ask(command) {
    return new Promise((resolve, reject) => {
      if (!this.worker) return reject(new Error('there is no worker'));
      const id = this.next++;
      this.pending.set(id, { resolve, reject });
      this.worker.postMessage({ id, command });
    });
  }
}
