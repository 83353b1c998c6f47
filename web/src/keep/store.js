// @ts-check
// What this machine keeps between visits: checkpoints of runs, maps by name, maps of links. In IndexedDB; in memory where that is refused.

/**
 * A kept run, without its checkpoint.
 * @typedef {object} KeptRun
 * @property {string} key      of the task, its changes and its seed: the same key is the same run
 * @property {number} when     milliseconds since 1970
 * @property {string} title
 * @property {string} formula
 * @property {number} seed
 * @property {number} steps
 * @property {number} size     of the checkpoint, in bytes
 * @property {boolean} exact   whether training goes on from it bit by bit; else its replays were left out
 * @property {Record<string, any>} view     what the page showed: watch, speed, pace, hide
 */

/** The most runs that are kept, and the most bytes of all of them. */
export const MAX_RUNS = 8;
export const MAX_BYTES = 256 << 20;
/** The most maps that are kept by name, and of links. */
export const MAX_MAPS = 50;

const NAME = 'ltl-rover';
const STORES = /** @type {const} */ (['runs', 'checkpoints', 'maps', 'links']);
/** @typedef {typeof STORES[number]} StoreName */

/** There is no room; the message says so to the user. */
export class NoRoom extends Error {}

/**
 * The runs that must go so that one of `size` bytes with key `key` fits: the oldest first.
 * @param {KeptRun[]} runs
 * @param {string} key
 * @param {number} size
 */
export function evicted(runs, key, size) {
  const others = runs.filter((run) => run.key !== key).sort((a, b) => a.when - b.when);
  /** @type {string[]} */
  const gone = [];
  let bytes = others.reduce((sum, run) => sum + run.size, size);
  while (others.length > 0 && (others.length >= MAX_RUNS || bytes > MAX_BYTES)) {
    const oldest = /** @type {KeptRun} */ (others.shift());
    bytes -= oldest.size;
    gone.push(oldest.key);
  }
  return gone;
}

/** @template T @param {IDBRequest<T>} request @returns {Promise<T>} */
const answer = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

/** @returns {Promise<IDBDatabase | null>} */
function open() {
  return new Promise((resolve) => {
    try {
      const request = indexedDB.open(NAME, 1);
      request.onupgradeneeded = () => STORES.forEach((store) => request.result.createObjectStore(store));
      request.onsuccess = () => {
        // Another tab that wants to forget everything must not wait for this one.
        request.result.onversionchange = () => request.result.close();
        resolve(request.result);
      };
      request.onerror = () => resolve(null);
      request.onblocked = () => resolve(null);
    } catch {
      resolve(null);
    }
  });
}

/** One object store inside a transaction. */
/** @typedef {{ get: (key: string) => Promise<any>, put: (key: string, value: any) => void, remove: (key: string) => void, keys: () => Promise<string[]>, all: () => Promise<any[]> }} Shelf */

export class Store {
  constructor() {
    /** What is kept where there is no database. @type {Map<string, any>} */
    this.memory = new Map();
    this.database = open();
  }

  /** Whether what is kept outlives this visit. */
  async lasts() {
    return (await this.database) !== null;
  }

  /**
   * Runs `work` in one transaction; resolves when it is complete.
   * @template T
   * @param {IDBTransactionMode} mode
   * @param {(at: (store: StoreName) => Shelf) => Promise<T>} work
   * @returns {Promise<T>}
   */
  async within(mode, work) {
    const database = await this.database;
    if (!database) return work((store) => this.inMemory(store));
    const transaction = database.transaction([...STORES], mode);
    const done = new Promise((resolve, reject) => {
      transaction.oncomplete = () => resolve(undefined);
      transaction.onabort = () => reject(transaction.error ?? new Error('the transaction was given up'));
    });
    const result = work((name) => {
      const store = transaction.objectStore(name);
      return {
        get: (key) => answer(store.get(key)),
        put: (key, value) => void store.put(value, key),
        remove: (key) => void store.delete(key),
        keys: async () => (await answer(store.getAllKeys())).map(String),
        all: () => answer(store.getAll()),
      };
    });
    try {
      const [value] = await Promise.all([result, done]);
      return value;
    } catch (error) {
      if (error instanceof DOMException && error.name === 'QuotaExceededError') throw new NoRoom('there is no room left for it on this machine');
      throw error;
    }
  }

  /** @param {StoreName} store @returns {Shelf} */
  inMemory(store) {
    const prefix = `${store}/`;
    const entries = () => [...this.memory.entries()].filter(([key]) => key.startsWith(prefix));
    return {
      get: async (key) => this.memory.get(prefix + key),
      put: (key, value) => void this.memory.set(prefix + key, value),
      remove: (key) => void this.memory.delete(prefix + key),
      keys: async () => entries().map(([key]) => key.slice(prefix.length)),
      all: async () => entries().map(([, value]) => value),
    };
  }

  // --- runs -----------------------------------------------------------------------------------------------------------------

  /** The kept runs, the newest first. @returns {Promise<KeptRun[]>} */
  async runs() {
    const runs = await this.within('readonly', (at) => at('runs').all());
    return runs.sort((a, b) => b.when - a.when);
  }

  /** @param {string} key @returns {Promise<Uint8Array<ArrayBuffer> | null>} */
  async checkpoint(key) {
    return (await this.within('readonly', (at) => at('checkpoints').get(key))) ?? null;
  }

  /**
   * Keeps a run in place of its older self, which is only given up for one that has gone further. Older runs go where there is no room.
   * @param {KeptRun} run
   * @param {Uint8Array} bytes
   * @returns {Promise<boolean>}  whether it was kept
   * @throws {NoRoom}
   */
  async putRun(run, bytes) {
    const attempt = (/** @type {boolean} */ alone) => this.within('readwrite', async (at) => {
      /** @type {KeptRun[]} */
      const runs = await at('runs').all();
      const older = runs.find(({ key }) => key === run.key);
      const further = !older || run.steps > older.steps || (run.steps === older.steps && run.exact && !older.exact);
      if (older && !further) {
        at('runs').put(run.key, { ...older, when: run.when, view: run.view });
        return false;
      }
      const gone = alone ? runs.map(({ key }) => key).filter((key) => key !== run.key) : evicted(runs, run.key, run.size);
      for (const key of gone) {
        at('runs').remove(key);
        at('checkpoints').remove(key);
      }
      at('runs').put(run.key, run);
      at('checkpoints').put(run.key, bytes);
      return true;
    });
    try {
      return await attempt(false);
    } catch (error) {
      if (!(error instanceof NoRoom)) throw error;
      return attempt(true);
    }
  }

  /** @param {string} key */
  removeRun(key) {
    return this.within('readwrite', async (at) => {
      at('runs').remove(key);
      at('checkpoints').remove(key);
    });
  }

  // --- maps -----------------------------------------------------------------------------------------------------------------

  /** Names of the kept maps, sorted. */
  async maps() {
    return (await this.within('readonly', (at) => at('maps').keys())).sort();
  }

  /** @param {string} name @returns {Promise<string | null>} */
  async namedMap(name) {
    return (await this.within('readonly', (at) => at('maps').get(name))) ?? null;
  }

  /** Keeps a map by name. @param {string} name @param {string} text @throws {Error} with a sentence for the user */
  putNamedMap(name, text) {
    return this.within('readwrite', async (at) => {
      const names = await at('maps').keys();
      if (!names.includes(name) && names.length >= MAX_MAPS) throw new Error(`${MAX_MAPS} maps are kept already; forget one first`);
      at('maps').put(name, text);
    });
  }

  /** @param {string} name */
  removeNamedMap(name) {
    return this.within('readwrite', async (at) => at('maps').remove(name));
  }

  /** The map of a link. @param {string} key @returns {Promise<string | null>} */
  async getMap(key) {
    return (await this.within('readonly', (at) => at('links').get(key))) ?? null;
  }

  /** @param {string} key @param {string} text */
  putMap(key, text) {
    return this.within('readwrite', async (at) => {
      const keys = (await at('links').keys()).filter((old) => old !== key);
      for (const old of keys.slice(0, Math.max(0, keys.length - MAX_MAPS + 1))) at('links').remove(old);
      at('links').put(key, text);
    });
  }

  /** Forgets everything that is kept. */
  async forget() {
    this.memory.clear();
    const database = await this.database;
    if (!database) return;
    database.close();
    await answer(indexedDB.deleteDatabase(NAME)).catch(() => {});
    this.database = open();
  }
}
