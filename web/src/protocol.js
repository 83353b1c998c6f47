// @ts-check
// What crosses between page and worker: closed unions of commands and replies, and the reader of the flat frame.

/**
 * A task as the core lists it.
 * @typedef {{ name: string, title: string, environment: string, formula: string, presets: string[] }} TaskEntry
 */

/**
 * What to open: a built-in task by name or a whole task file, and what departs from it. `null` leaves the task's own.
 * @typedef {object} OpenRequest
 * @property {string} task       name of a built-in task, or the text of a task file
 * @property {string | null} formula   LTL formula in place of the task's
 * @property {string | null} hoa       automaton in HOA format in place of the task's
 * @property {string | null} map       map file (JSON) in place of a rover task's
 * @property {number} seed       0 … 2^53−1
 * @property {string | null} preset    name of a preset of the task
 * @property {Record<string, string>} overrides   dotted key of the task file → TOML value
 */

/** @typedef {{ name: string, offset: number, length: number }} Field */
/** @typedef {{ version: number, length: number, fields: Field[] }} Layout */
/** @typedef {{ name: string, unit: string, low: number, high: number }} Channel */
/** @typedef {{ name: string, meaning: string }} Proposition */
/** @typedef {{ id: number, name: string, sink: boolean, deterministic: boolean, reachable: boolean, marks: number[] }} AutomatonState */
/** @typedef {{ from: number, to: number, kind: 'letter' | 'epsilon', label: string, marks: number[] }} AutomatonEdge */
/** @typedef {{ propositions: string[], initial: number, sets: number, states: AutomatonState[], edges: AutomatonEdge[] }} AutomatonGraph */
/** @typedef {{ kind: 'disc', centre: [number, number], radius: number } | { kind: 'polygon', points: [number, number][] } | { kind: 'band', channel: number, low: number, high: number } | { kind: 'cells', cell: [number, number], runs: [number, number, number][] }} Shape */
/** @typedef {{ proposition: number, name: string, shape: Shape, margin: number }} Region */
/** @typedef {{ kind: 'ball', radius: number, position: [number, number], velocity: [number, number] } | { kind: 'cart_pole', position: number, angle: number, pole_length: number } | { kind: 'rover', position: [number, number], reach: number }} Body */
/** @typedef {{ x: [number, number], y: [number, number], unit: string, y_axis: 'up' | 'down' }} Ground */
/** @typedef {{ ground: Ground, regions: Region[], body: Body, hazard: number | null, picture: string | null }} Scene */
/** @typedef {{ message: string, start: number, end: number }} Warning */
/** @typedef {{ text: string, parenthesised: string, warnings: Warning[], propositions: string[] }} FormulaFacts */
/** @typedef {{ key: string, value: string }} Setting */

/**
 * Everything about an open session that does not change from step to step.
 * @typedef {object} Description
 * @property {{ name: string, title: string, description: string, preset: string, presets: string[], max_steps: number, text: string }} task
 * @property {FormulaFacts} formula
 * @property {{ name: string, dt: number, state: Channel[], action: Channel[], propositions: Proposition[], scene: Scene }} environment
 * @property {AutomatonGraph} automaton
 * @property {string} hoa
 * @property {boolean} shaping   whether visits are shaped: T_Φ means something then
 * @property {string[]} modules
 * @property {Setting[]} settings
 * @property {number} seed
 * @property {Layout} layout
 * @property {OpenRequest} request   what opens the same task anew
 */

/** @typedef {{ message: string, hint: string, field: string, start: number, end: number, line: number, column: number }} Located */
/**
 * The verdict on a text that the user types; positions count UTF-16 units, as the page's own strings do.
 * @typedef {{ ok: true, facts: FormulaFacts } | { ok: false, error: Located }} FormulaVerdict
 */
/** @typedef {{ ok: true, facts: { states: number, sets: number, propositions: string[] } } | { ok: false, error: Located }} HoaVerdict */

/**
 * Everything of a map that a painter must know.
 * @typedef {object} MapFacts
 * @property {string} name
 * @property {string} unit
 * @property {[number, number]} size      width and height, in `unit`
 * @property {number} reach               the longest way of one step, in `unit`
 * @property {{ name: string, meaning: string, area: number }[]} labels
 * @property {number | null} hazard       the label that wins over all others
 * @property {string | null} picture
 * @property {[number, number]} cells     columns and rows
 * @property {number[][]} letters         the letters that occur, each as indices of its labels
 * @property {Uint8Array} indices         the letter of each cell, row by row from the top
 * @property {number} start_cells
 * @property {string} suggested           a formula to begin with; empty for a map without labels
 * @property {string} json                the map as one map file
 */
/** @typedef {{ ok: true, facts: MapFacts } | { ok: false, error: Located }} MapVerdict */

/**
 * Learning curves: one entry per kept point; a point is the mean over `every` episodes.
 * @typedef {object} Curves
 * @property {number} every
 * @property {Float32Array} episode
 * @property {Float32Array} average   reward per step
 * @property {Float32Array} total     reward per episode
 * @property {Float32Array} rounds    rounds closed per episode
 * @property {Float32Array} success   share of episodes that satisfied the task, 0 … 1
 * @property {Float32Array} critic    critic loss
 * @property {Float32Array[]} modules   critic loss of each module; NaN where it was not updated
 */
/** @typedef {{ name: string, visits: number, replay: number, capacity: number, updates: number, critic: number, actor: number }} ModuleStatistics */

/**
 * How an automaton compares with a formula; where they differ, on which word, and whether the automaton accepts it.
 * @typedef {{ equal: boolean, words: number, length: number, word: Word | null, accepted: boolean, sentence: string }} Comparison
 */
/** @typedef {{ ok: true, facts: Comparison } | { ok: false, error: Located }} ComparisonVerdict */

/** Which values are asked for: automaton state, frontier (a bit per set), points. @typedef {{ q: number, frontier: number, columns: number, rows: number }} ValueMapRequest */
/**
 * V(x) on a grid, rows from the least value of the second channel upwards; each point stands in the middle of its cell.
 * @typedef {object} ValueMap
 * @property {number | null} module   `null` where several compete: in each place the one that promises most
 * @property {{ channel: number, low: number, high: number }[]} axes   what changes along a row, and along a column
 * @property {number} columns
 * @property {number} rows
 * @property {Float32Array} values     rows × columns
 * @property {Float32Array} controls   rows × columns × controls: what the policy does there
 */

/**
 * One greedy episode: `rows` frames end to end.
 * @typedef {{ rows: number, data: Float32Array, rounds: number, success: boolean }} Episode
 */

/**
 * The best policy that the evaluations of a training have seen: after how many steps, and how many of the episodes satisfied the task.
 * @typedef {{ step: number, runs: number, successes: number, rounds_mean: number }} BestPolicy
 */

/**
 * How an evaluation stands.
 * @typedef {object} EvaluationProgress
 * @property {number} wanted
 * @property {number} runs
 * @property {number} successes
 * @property {number} low    bounds of the 95 % Clopper–Pearson interval of the success rate
 * @property {number} high
 * @property {number} rounds_mean
 * @property {number} sink_rate
 * @property {number} seed
 */

/** Whose policy: that of the open session as it is now, the best that its evaluations have seen, or the trained one that came with the page. @typedef {'present' | 'best' | 'shipped'} Whose */

/**
 * An infinite word: its letters, each the propositions that hold; the letter that follows the last one; ε-jumps, each before which
 * letter (counted on through the repetitions) and to which state.
 * @typedef {{ letters: string[][], back: number, jumps?: [number, number][] }} Word
 */
/**
 * A word that was read: a frame before the first letter, then one per letter and per jump, until the run repeats itself from row `back`.
 * @typedef {object} WordReading
 * @property {boolean} satisfied       whether the word satisfies the formula, by the logic alone
 * @property {boolean} accepted        whether the automaton accepts it, with the best jumps
 * @property {boolean} run_accepting   whether the run with the word's own jumps is accepting
 * @property {number} rows
 * @property {number} back
 * @property {number[]} positions      per row the letter read last; −1 before the first
 * @property {Float32Array} data
 */

/**
 * What the page asks of the worker. Each command is answered by one `done` or `failed` reply with its `id`.
 * @typedef {{ kind: 'open', request: OpenRequest }
 *   | { kind: 'train', pace: number, until?: number }
 *   | { kind: 'pause' }
 *   | { kind: 'step' }
 *   | { kind: 'episode' }
 *   | { kind: 'rollout', index: number, of: Whose, from?: number[] }
 *   | { kind: 'value_map', request: ValueMapRequest, of: Whose }
 *   | { kind: 'load_policy', bytes: Uint8Array }
 *   | { kind: 'begin_drive', index: number }
 *   | { kind: 'drive', control: number[], jump: number | null }
 *   | { kind: 'evaluate', runs: number, of?: Whose }
 *   | { kind: 'check_formula', text: string }
 *   | { kind: 'check_hoa', text: string }
 *   | { kind: 'read_word', word: Word }
 *   | { kind: 'judge_word', formula: string, word: Word }
 *   | { kind: 'check_map', json: string, image: { width: number, height: number, pixels: Uint8Array } | null }
 *   | { kind: 'map_of_picture', name: string, width: number, height: number, pixels: Uint8Array }
 *   | { kind: 'present_map' }
 *   | { kind: 'save', form: 'whole' | 'small' | 'policy' }
 *   | { kind: 'keep', form: 'whole' | 'small' }
 *   | { kind: 'restore', bytes: Uint8Array }} Command
 */

/**
 * What the worker tells the page.
 * @typedef {{ kind: 'ready', tasks: TaskEntry[] }
 *   | { kind: 'done', id: number, value: any }
 *   | { kind: 'failed', id: number, error: Located }
 *   | { kind: 'frame', generation: number, data: Float32Array }
 *   | { kind: 'telemetry', generation: number, rate: number, steps: number, memory: number, curves: Curves, modules: ModuleStatistics[], best: BestPolicy | null }
 *   | { kind: 'evaluation', generation: number, progress: EvaluationProgress }
 *   | { kind: 'finished', generation: number, steps: number, first_perfect_step: number | null }
 *   | { kind: 'halted', generation: number, message: string }
 *   | { kind: 'broken', message: string }} Reply
 */

/** The layout version this page reads. */
export const LAYOUT_VERSION = 1;

/** A frame: named numbers read in place from a flat array, no copy. */
export class Frame {
  /** @param {Layout} layout */
  constructor(layout) {
    if (layout.version !== LAYOUT_VERSION) {
      throw new Error(`The numbers of this session have layout ${layout.version}; the page reads layout ${LAYOUT_VERSION}. Reload the page.`);
    }
    this.length = layout.length;
    /** @type {Map<string, Field>} */
    this.fields = new Map(layout.fields.map((field) => [field.name, field]));
    /** @type {Float32Array} */
    this.data = new Float32Array(layout.length);
    this.base = 0;
  }

  /**
   * Points at row `row` of `data`.
   * @param {Float32Array} data
   * @param {number} row
   */
  at(data, row) {
    const base = row * this.length;
    if (base < 0 || base + this.length > data.length) throw new RangeError(`row ${row} is outside the data`);
    this.data = data;
    this.base = base;
    return this;
  }

  /** @param {string} name */
  field(name) {
    const field = this.fields.get(name);
    if (!field) throw new Error(`the frame has no field ${name}`);
    return field;
  }

  /**
   * Number `index` of field `name`.
   * @param {string} name
   * @param {number} [index]
   */
  number(name, index = 0) {
    const field = this.field(name);
    if (index >= field.length) throw new RangeError(`${name} has ${field.length} numbers, not ${index + 1}`);
    return this.data[this.base + field.offset + index];
  }

  /**
   * Bit `index` of a bit field, which is stored 16 bits a number.
   * @param {string} name
   * @param {number} index
   */
  bit(name, index) {
    return ((this.number(name, index >> 4) >> (index & 15)) & 1) === 1;
  }

  /**
   * A counter, which is stored as two numbers: units below 2^24 and multiples of 2^24.
   * @param {string} name
   */
  counter(name) {
    return this.number(name, 0) + this.number(name, 1) * 16777216;
  }

  /**
   * The numbers of field `name`, in place.
   * @param {string} name
   */
  numbers(name) {
    const field = this.field(name);
    return this.data.subarray(this.base + field.offset, this.base + field.offset + field.length);
  }
}

/** The values of the field `end`. */
export const END = Object.freeze({ running: 0, terminated: 1, truncated: 2 });

/**
 * The error of a failed command as the page shows it.
 * @param {unknown} error
 * @returns {Located}
 */
export function located(error) {
  if (error && typeof error === 'object' && 'message' in error) {
    const e = /** @type {Partial<Located>} */ (error);
    return { message: String(e.message), hint: e.hint ?? '', start: e.start ?? 0, end: e.end ?? 0, line: e.line ?? 0, column: e.column ?? 0, field: e.field ?? '' };
  }
  return { message: String(error), field: '', hint: '', start: 0, end: 0, line: 0, column: 0 };
}
