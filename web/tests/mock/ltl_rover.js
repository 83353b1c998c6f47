// @ts-check
// Stands in for the WebAssembly module in tests of the views: the same interface, a scripted ball, no learning.

/** @typedef {import('../../src/protocol.js').Field} Field */

const FIELDS = /** @type {[string, number][]} */ ([
  ['source', 1], ['step', 2], ['updates', 2], ['episode', 2], ['episode_step', 1], ['rounds', 1], ['q', 1], ['q_before', 1], ['edge', 1],
  ['module', 1], ['epsilon', 1], ['jumps', 1], ['letter', 4], ['frontier', 2], ['unvisited', 1], ['visited', 2], ['fresh', 2], ['closes_round', 1],
  ['end', 1], ['reward', 1], ['discount', 1], ['accepting_reward', 1], ['sink_reward', 1], ['shaping_reached', 1], ['shaping_left', 1],
  ['return', 1], ['losses', 3], ['state', 4], ['action', 2],
]);

/** @returns {import('../../src/protocol.js').Layout} */
export function layout() {
  let offset = 0;
  /** @type {Field[]} */
  const fields = FIELDS.map(([name, length]) => {
    const field = { name, offset, length };
    offset += length;
    return field;
  });
  return { version: 1, length: offset, fields };
}

export const TASKS = [
  { name: 'ball_pass_b1', title: 'Ball-Pass, φ_B1', environment: 'ball_pass', formula: 'G F r1 & G F r2', presets: ['fast', 'paper'] },
  { name: 'ball_pass_b2', title: 'Ball-Pass, φ_B2', environment: 'ball_pass', formula: 'F (r1 & F r2)', presets: ['fast', 'paper'] },
];

const LAYOUT = layout();
/** @param {string} name */
const at = (name) => /** @type {Field} */ (LAYOUT.fields.find((f) => f.name === name)).offset;

/** @param {number} t @param {number} step */
function row(t, step) {
  const out = new Float32Array(LAYOUT.length);
  const phase = (t % 120) / 120;
  const s = (1 - Math.cos(2 * Math.PI * phase)) / 2;
  const x = 180 + 300 * s;
  const y = 180 + 180 * s + 60 * Math.sin(4 * Math.PI * phase);
  const [r1, r2] = [Math.hypot(x - 180, y - 180) < 30, Math.hypot(x - 480, y - 360) < 30];
  const q = phase > 0.5 ? 1 : 0;
  out[at('step')] = step;
  out[at('episode')] = Math.floor(t / 240);
  out[at('episode_step')] = t % 240;
  out[at('rounds')] = Math.floor((t % 240) / 120);
  out[at('q')] = q;
  out[at('q_before')] = q;
  out[at('edge')] = q === 0 ? (r2 ? 1 : 0) : r1 ? 3 : 2;
  out[at('letter')] = (r1 ? 1 : 0) | (r2 ? 2 : 0);
  out[at('frontier')] = q === 0 ? 3 : 1;
  out[at('unvisited')] = q === 0 ? 3 : 1;
  out[at('fresh')] = t % 120 === 60 ? 2 : t % 120 === 0 && t > 0 ? 1 : 0;
  out[at('closes_round')] = t % 120 === 0 && t > 0 ? 1 : 0;
  out[at('end')] = t % 240 === 239 ? 2 : 0;
  out[at('epsilon')] = -1;
  out[at('reward')] = out[at('fresh')] > 0 ? 0.01 : 0;
  out[at('accepting_reward')] = out[at('reward')];
  out[at('discount')] = 0.9999;
  out.set([x, y, 0, 0], at('state'));
  return out;
}

/** @param {string} text */
function facts(text) {
  return { text, parenthesised: `(${text})`, warnings: [], propositions: ['r1', 'r2'] };
}

/** @param {string} text */
export function check_formula(text) {
  const start = text.indexOf('@');
  if (start < 0) return { ok: true, facts: facts(text) };
  return { ok: false, error: { message: 'unexpected character "@"', hint: 'a proposition or an operator is expected here', start, end: start + 1, line: 1, column: start + 1 } };
}

/** @param {string} text */
export function check_hoa(text) {
  if (text.startsWith('HOA: v1')) return { ok: true, facts: { states: 2, sets: 2, propositions: ['r1', 'r2'] } };
  return { ok: false, error: { message: 'an automaton begins with "HOA: v1"', hint: '', start: 0, end: 1, line: 1, column: 1 } };
}

export function judge_word() {
  return true;
}

export function builtin_tasks() {
  return TASKS;
}

export class Session {
  /** @param {any} request */
  static open(request) {
    if (String(request.formula ?? '').includes('@')) throw { message: 'unexpected character "@"', start: 0, end: 1 };
    const session = new Session();
    session.request = request;
    return session;
  }
  static restore() {
    return new Session();
  }
  constructor() {
    /** @type {any} */
    this.request = { task: 'ball_pass_b1', seed: 1n };
    this.steps = 0;
    this.trial = { wanted: 0, runs: 0 };
  }
  free() {}
  describe() {
    return {
      task: { name: this.request.task, title: 'Ball-Pass, φ_B1', description: '', preset: this.request.preset ?? 'fast', presets: ['fast', 'paper'], max_steps: 200, text: '' },
      formula: facts(this.request.formula ?? 'G F r1 & G F r2'),
      environment: {
        name: 'ball_pass',
        dt: 0.05,
        state: ['x', 'y', 'v_x', 'v_y'].map((name) => ({ name, unit: 'm', low: 0, high: 600 })),
        action: ['a_x', 'a_y'].map((name) => ({ name, unit: 'm/s²', low: -600, high: 600 })),
        propositions: [{ name: 'r1', meaning: 'the ball is in region 1' }, { name: 'r2', meaning: 'the ball is in region 2' }],
        scene: {
          ground: { x: [0, 600], y: [0, 600], unit: 'm', y_axis: 'up' },
          regions: [[180, 180], [480, 360]].map((centre, k) => ({ proposition: k, name: `Region ${k + 1}`, shape: { kind: 'disc', centre, radius: 30 }, margin: 10 })),
          body: { kind: 'ball', radius: 10, position: [0, 1], velocity: [2, 3] }, picture: null, hazard: null,
        },
      },
      automaton: {
        propositions: ['r1', 'r2'],
        initial: 0,
        sets: 2,
        states: [0, 1].map((id) => ({ id, name: '', sink: false, deterministic: true, reachable: true, marks: /** @type {number[]} */ ([]) })),
        edges: [
          { from: 0, to: 0, label: '!r2', marks: /** @type {number[]} */ ([]) }, { from: 0, to: 1, label: 'r2', marks: [1] },
          { from: 1, to: 1, label: '!r1', marks: [] }, { from: 1, to: 0, label: 'r1', marks: [0] },
        ].map((edge) => ({ ...edge, kind: /** @type {const} */ ('letter') })),
      },
      hoa: 'HOA: v1\n',
      shaping: true,
      modules: ['q0', 'q1'],
      settings: [{ key: 'algorithm.discount', value: '0.9999' }],
      seed: Number(this.request.seed),
      layout: LAYOUT,
    };
  }
  /** @param {number} steps */
  advance(steps) {
    this.steps += steps;
    return steps;
  }
  frame() {
    return row(this.steps % 1200, this.steps);
  }
  /** @param {import('../../src/protocol.js').Word} word */
  read_word(word) {
    const rows = word.letters.length + 1;
    const data = new Float32Array(rows * LAYOUT.length);
    const positions = Array.from({ length: rows }, (_, k) => k - 1);
    return { satisfied: true, accepted: true, run_accepting: true, rows, back: word.back + 1, positions, data };
  }
  /** @param {bigint} _index */
  rollout(_index) {
    const data = new Float32Array(240 * LAYOUT.length);
    for (let t = 0; t < 240; t++) data.set(row(t, this.steps), t * LAYOUT.length);
    return { rows: 240, data, rounds: 2, success: true };
  }
  curves() {
    const n = Math.min(400, Math.floor(this.steps / 200));
    const each = (/** @type {(k: number) => number} */ f) => Float32Array.from({ length: n }, (_, k) => f(k));
    const rise = (/** @type {number} */ k) => 1 - Math.exp(-k / 80);
    return {
      every: 1, episode: each((k) => k), average: each((k) => 0.0002 * rise(k) + 0.00004 * Math.sin(k * 1.7)), total: each((k) => 0.04 * rise(k) + 0.006 * Math.sin(k * 2.3)),
      rounds: each((k) => Math.round(2 * rise(k) + 0.4 * Math.sin(k * 3.1))), success: each((k) => rise(k)), critic: each((k) => 0.01 / (1 + k / 30)), modules: [0.008, 0.012].map((c) => each((k) => c / (1 + k / 30))),
    };
  }
  statistics() {
    return ['q0', 'q1'].map((name, k) => ({ name, visits: Math.floor(this.steps / (k + 2)), replay: Math.min(50000, this.steps), capacity: 50000, updates: this.steps, critic: 0.01, actor: -0.2 }));
  }
  /** @param {number} runs */
  begin_evaluation(runs) {
    this.trial = { wanted: runs, runs: 0 };
  }
  /** @param {number} _steps */
  advance_evaluation(_steps) {
    return ++this.trial.runs < this.trial.wanted;
  }
  evaluation() {
    return { ...this.trial, successes: this.trial.runs, low: 0.98, high: 1, rounds_mean: 2, sink_rate: 0, seed: 1 };
  }
  get finished() {
    return false;
  }
  get best() {
    return undefined;
  }
  get first_perfect_step() {
    return undefined;
  }
  /** @param {bigint} _index */
  begin_drive(_index) {
    return row(0, 0);
  }
  /** @param {Float32Array} _control */
  drive(_control) {
    return row(1, 0);
  }
  save() {
    return new Uint8Array([1, 2, 3]);
  }
  save_policy() {
    return new Uint8Array([2]);
  }
  save_small() {
    return new Uint8Array([1]);
  }
}

export default async function init() {}
