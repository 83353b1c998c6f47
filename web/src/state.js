// @ts-check
// The page's state that a link carries: one table of properties, read from and written to the URL hash.

import { MAX_IN_LINK } from './maps/shelf.js';

/**
 * @typedef {object} State
 * @property {string} task      name of a built-in task, or the text of a task file
 * @property {string} formula   LTL formula in place of the task's; empty: the task's own
 * @property {string} hoa       automaton in place of the task's; empty: the task's own
 * @property {string} map       key of a map of one's own; empty: the task's own
 * @property {string} preset    empty: the task's first
 * @property {number} seed
 * @property {Record<string, string>} set   overrides of the task file, dotted key → TOML value
 * @property {'trained' | 'policy' | 'best' | 'training' | 'drive'} watch   what the stage shows
 * @property {number} speed     playback, multiples of the environment's own time
 * @property {number} pace      training, steps a second; 0: as fast as possible
 * @property {string[]} layers  what is drawn over the ground
 * @property {string[]} hide    panels that are not shown
 */

/** @typedef {{ property: string, message: string }} Problem */

/** Playback speeds on offer. */
export const SPEEDS = Object.freeze([0.125, 0.25, 0.5, 1, 2, 4, 8, 16, 64]);
/** Training paces on offer, steps a second; 0 is as fast as possible. */
export const PACES = Object.freeze([5, 20, 100, 1000, 0]);
/** Panels that a link may hide. */
export const PANELS = Object.freeze(['spec', 'training', 'automaton', 'curves', 'compare', 'details']);
/** What can be drawn over the ground. */
export const LAYERS = Object.freeze(['labels', 'unsafe', 'paths', 'value']);

/** The longest automaton that a link carries, in characters. */
export const MAX_HOA_IN_LINK = 6000;

/**
 * A property: its default, how its text is read (a string is what is wrong with it), how it is written.
 * @template T
 * @typedef {{ initial: T, read: (text: string) => { value: T } | string, write: (value: T) => string }} Property
 */

/**
 * @param {string} initial
 * @param {number} longest
 * @param {RegExp} [pattern]
 * @returns {Property<string>}
 */
const text = (initial, longest, pattern) => ({
  initial,
  read: (s) => {
    if (s.length > longest) return `has ${s.length} characters; at most ${longest} are allowed`;
    if (pattern && !pattern.test(s)) return 'has characters that a name does not have';
    return { value: s };
  },
  write: (value) => value,
});

/**
 * @param {number} initial
 * @param {number} highest
 * @returns {Property<number>}
 */
const whole = (initial, highest) => ({
  initial,
  read: (s) => {
    const value = Number(s);
    return /^\d{1,16}$/.test(s) && value <= highest ? { value } : `is not a whole number from 0 to ${highest}`;
  },
  write: String,
});

/**
 * @template {string | number} T
 * @param {T} initial
 * @param {readonly T[]} choices
 * @returns {Property<T>}
 */
const choice = (initial, choices) => ({
  initial,
  read: (s) => {
    const value = choices.find((c) => String(c) === s);
    return value === undefined ? `is none of ${choices.join(', ')}` : { value };
  },
  write: String,
});

/** @type {Property<Record<string, string>>} */
const settings = {
  initial: {},
  read: (s) => {
    if (s.length > 2000) return 'is longer than 2000 characters';
    /** @type {Record<string, string>} */
    const value = {};
    for (const part of s.split(';').filter(Boolean)) {
      const at = part.indexOf('=');
      const key = part.slice(0, at).trim();
      if (at < 1 || !/^[a-z_][a-z0-9_.]*$/.test(key)) return `"${part.slice(0, 40)}" is not of the form key=value`;
      value[key] = part.slice(at + 1).trim();
    }
    return { value };
  },
  write: (value) => Object.entries(value).map(([k, v]) => `${k}=${v}`).join(';'),
};

/**
 * @param {readonly string[]} initial
 * @param {readonly string[]} known
 * @returns {Property<string[]>}
 */
const list = (initial, known) => ({
  initial: [...initial],
  read: (s) => {
    const value = s.split(',').filter(Boolean);
    const wrong = value.find((p) => !known.includes(p));
    return wrong === undefined ? { value: known.filter((p) => value.includes(p)) } : `"${wrong.slice(0, 40)}" is none of ${known.join(', ')}`;
  },
  write: (value) => value.join(','),
});

/** @type {{ [K in keyof State]: Property<State[K]> }} */
export const PROPERTIES = {
  task: text('melas', MAX_HOA_IN_LINK, /^([a-z0-9_]{1,64}|[^]*\n[^]*)$/),
  formula: text('', 2000),
  hoa: text('', MAX_HOA_IN_LINK),
  map: text('', MAX_IN_LINK, /^[A-Za-z0-9._-]*$/),
  preset: text('', 64, /^[a-z0-9_-]*$/),
  seed: whole(1, Number.MAX_SAFE_INTEGER),
  set: settings,
  watch: /** @type {Property<State['watch']>} */ (choice('trained', ['trained', 'policy', 'best', 'training', 'drive'])),
  speed: choice(2, SPEEDS),
  pace: choice(0, PACES),
  layers: list(['labels', 'unsafe', 'paths'], LAYERS),
  hide: list([], PANELS),
};

const KEYS = /** @type {(keyof State)[]} */ (Object.keys(PROPERTIES));

/** @returns {State} */
export function initialState() {
  return /** @type {State} */ (Object.fromEntries(KEYS.map((key) => [key, structuredClone(PROPERTIES[key].initial)])));
}

/**
 * Reads a URL hash. A property that is wrong keeps its default and is reported.
 * @param {string} hash
 * @returns {{ state: State, problems: Problem[] }}
 */
export function readHash(hash) {
  const state = initialState();
  /** @type {Problem[]} */
  const problems = [];
  if (hash.length > 20000) return { state, problems: [{ property: 'link', message: 'is longer than 20000 characters; nothing of it was used' }] };
  /** @type {Set<string>} */
  const seen = new Set();
  for (const [key, value] of new URLSearchParams(hash.replace(/^#/, ''))) {
    const known = KEYS.find((k) => k === key);
    if (!known) {
      if (problems.length < 8) problems.push({ property: key.slice(0, 40), message: `is unknown; known are ${KEYS.join(', ')}` });
    } else if (seen.has(key)) {
      problems.push({ property: key, message: 'is given twice; the first was used' });
    } else {
      seen.add(key);
      const result = PROPERTIES[known].read(value);
      if (typeof result === 'string') problems.push({ property: key, message: result });
      else Object.assign(state, { [known]: result.value });
    }
  }
  return { state, problems };
}

/**
 * The hash for `state`: only what differs from the defaults, in the table's order.
 * @param {State} state
 */
export function writeHash(state) {
  const out = new URLSearchParams();
  for (const key of KEYS) {
    const property = /** @type {Property<any>} */ (PROPERTIES[key]);
    const written = property.write(state[key]);
    if (written !== property.write(property.initial) && written.length <= (key === 'map' ? MAX_IN_LINK : MAX_HOA_IN_LINK)) out.set(key, written);
  }
  const search = out.toString();
  return search ? `#${search}` : '';
}
