// @ts-check
/// <reference lib="webworker" />
// The worker: owns one session and the clock. Trains in slices of about 16 ms and listens to commands between them.

import init, { Session, builtin_tasks, check_formula, check_hoa, check_map, check_map_and_picture, default_map, judge_word, map_of_picture } from '../pkg/ltl_rover.js';
import { END, Frame, located } from './protocol.js';

/** @typedef {import('./protocol.js').Command} Command */
/** @typedef {import('./protocol.js').Reply} Reply */
/** @typedef {import('./protocol.js').OpenRequest} OpenRequest */

const scope = /** @type {DedicatedWorkerGlobalScope} */ (/** @type {unknown} */ (globalThis));

/** How long a slice of work may take before messages are heard again, in milliseconds. */
const SLICE = 16;
/** How often curves and statistics are sent while training, in milliseconds. */
const TELEMETRY = 250;
/** Training stops before the module's memory is larger than this, in bytes: replays of large recipes grow for hours. */
const MAX_MEMORY = 2 ** 31;

/** The module's memory. @type {WebAssembly.Memory | null} */
let memory = null;
/** @type {Session | null} */
let session = null;
/** A trained policy that came with the page, for its episodes only. @type {Session | null} */
let shipped = null;
/** The best policy of the open session, for its episodes only, and of which step it is. @type {{ step: number, of: Session } | null} */
let best = null;
/** @type {Frame | null} */
let frame = null;
/** What the open environment labels its states with. @type {string[]} */
let propositions = [];
/** Every open, train, pause and step raises it; a loop of an older generation ends. */
let generation = 0;
/** Whether it was said that the recipe of this session has come to its end. */
let told = false;
/** The generation of the session: frames of a session that was replaced are not shown. */
let opened = 0;
/** Environment steps a second, measured over the last half second. */
let rate = 0;

/**
 * @param {Reply} reply
 * @param {Transferable[]} [transfer]
 */
const tell = (reply, transfer = []) => scope.postMessage(reply, transfer);

const channel = new MessageChannel();
/** @type {(() => void)[]} */
const waiting = [];
channel.port1.onmessage = () => waiting.shift()?.();
/** Lets messages in, without the 4 ms that nested timers cost. */
const breathe = () => new Promise((resolve) => {
  waiting.push(() => resolve(undefined));
  channel.port2.postMessage(0);
});
/** @param {number} ms */
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** What can be saved. */
const SAVERS = {
  whole: (/** @type {Session} */ s) => s.save(),
  small: (/** @type {Session} */ s) => s.save_small(),
  policy: (/** @type {Session} */ s) => s.save_policy(),
};

function present() {
  if (!session) throw new Error('no task is open');
  return session;
}

/** How many steps of training a session has made. @param {Session} open */
const stepsOf = (open) => /** @type {Frame} */ (frame).at(open.frame(), 0).counter('step');

function sendFrame() {
  const data = present().frame();
  tell({ kind: 'frame', generation: opened, data }, [data.buffer]);
}

function sendTelemetry() {
  const open = present();
  const bytes = memory?.buffer.byteLength ?? 0;
  tell({ kind: 'telemetry', generation: opened, rate, steps: stepsOf(open), memory: bytes, curves: open.curves(), modules: open.statistics(), best: open.best ?? null });
}

/**
 * Trains until another command takes over, or up to so many steps.
 * @param {number} mine
 * @param {number} pace  steps a second; 0: as fast as possible
 * @param {number} until
 */
async function train(mine, pace, until = Infinity) {
  const open = present();
  /** Steps that are left. */
  let left = until - stepsOf(open);
  /** Whether the recipe is at its end, which is to be told. */
  const ended = () => open.finished && !told && until === Infinity;
  let chunk = 8;
  let counted = 0;
  let since = performance.now();
  let reported = since;
  let due = 0;
  let last = since;
  while (mine === generation) {
    const start = performance.now();
    if (pace > 0) {
      due = Math.min(due + ((start - last) * pace) / 1000, Math.max(1, pace / 10));
      last = start;
      const whole = Math.min(Math.floor(due), left);
      if (whole > 0) {
        const made = open.advance(whole);
        counted += made;
        left -= made;
      }
      due -= whole;
    } else {
      // Several calls a slice, each a quarter of it, so that a slow step is noticed in time.
      do {
        const before = performance.now();
        const made = open.advance(Math.min(chunk, left));
        counted += made;
        left -= made;
        const spent = performance.now() - before;
        chunk = Math.max(1, Math.min(4096, Math.round(spent > 0 ? (chunk * SLICE) / 4 / spent : chunk * 2)));
        // What the recipe ends with is what stands there.
        if (ended()) break;
      } while (left > 0 && performance.now() - start < SLICE - 2);
    }
    const now = performance.now();
    if (now - since > 500) {
      rate = (counted * 1000) / (now - since);
      counted = 0;
      since = now;
    }
    sendFrame();
    if (now - reported > TELEMETRY) {
      reported = now;
      sendTelemetry();
      if ((memory?.buffer.byteLength ?? 0) > MAX_MEMORY) {
        stop();
        tell({ kind: 'halted', generation: opened, message: `its memory has grown to ${Math.round(MAX_MEMORY / 1e9)} GB. Start again with a smaller learner.replay` });
      }
    }
    if (left <= 0) {
      sendTelemetry();
      return;
    }
    if (ended()) {
      // Once; whoever wants more presses Train again.
      told = true;
      stop();
      sendTelemetry();
      tell({ kind: 'finished', generation: opened, steps: stepsOf(open), first_perfect_step: open.first_perfect_step ?? null });
    }
    await (pace > 0 ? sleep(Math.max(SLICE, 1000 / pace / 2)) : breathe());
  }
}

/** The session whose policy is meant. @param {import('./protocol.js').Whose} of */
function whose(of) {
  if (of === 'present') return present();
  if (of === 'best') return bestOf(present());
  if (!shipped) throw new Error('no trained policy is loaded');
  return shipped;
}

/** The best policy of a session, or the session itself where none has been evaluated yet. @param {Session} open */
function bestOf(open) {
  const step = open.best?.step;
  if (step === undefined) return open;
  if (best?.step === step) return best.of;
  best?.of.free();
  best = null;
  best = { step, of: Session.restore(open.save_policy()) };
  return best.of;
}

/**
 * An evaluation in slices; the last progress, or `null` when another command took over.
 * @param {number} mine
 * @param {number} runs
 * @param {Session} open
 */
async function evaluate(mine, runs, open) {
  open.begin_evaluation(runs);
  for (;;) {
    if (mine !== generation) return null;
    const start = performance.now();
    let more = true;
    do more = open.advance_evaluation(64);
    while (more && performance.now() - start < SLICE - 2);
    const progress = open.evaluation();
    if (progress) tell({ kind: 'evaluation', generation: opened, progress });
    if (!more) return progress;
    await breathe();
  }
}

/** @param {Session} next */
function replace(next) {
  generation++;
  opened++;
  // A run that was at its recipe's end when it was kept has told so.
  told = next.finished;
  rate = 0;
  session?.free();
  shipped?.free();
  shipped = null;
  best?.of.free();
  best = null;
  session = next;
  const description = next.describe();
  propositions = description.environment.propositions.map((p) => p.name);
  frame = new Frame(description.layout);
  return { generation: opened, description };
}

function stop() {
  generation++;
  rate = 0;
}

/** One step of training; a periodic evaluation that is going on is played to its end first. @param {Session} open */
function stepOnce(open) {
  while (open.advance(1) === 0);
}

/** @param {() => void} advance */
function single(advance) {
  stop();
  advance();
  sendFrame();
  sendTelemetry();
}

/**
 * @param {Command} command
 * @returns {unknown}
 */
function obey(command) {
  switch (command.kind) {
    case 'open': {
      const { task, formula, hoa, map, seed, preset, overrides } = command.request;
      return replace(Session.open({ task, formula, hoa, map, preset, overrides, seed: BigInt(seed) }));
    }
    case 'restore':
      return replace(Session.restore(command.bytes));
    case 'load_policy': {
      // It is shown with the frames of the open session, so both must have the same automaton and scene.
      const loaded = Session.restore(command.bytes);
      const same = (/** @type {Session} */ s) => {
        const { automaton, environment, layout } = s.describe();
        return JSON.stringify([automaton, environment.name, layout]);
      };
      const fits = same(loaded) === same(present());
      shipped?.free();
      shipped = fits ? loaded : null;
      if (!fits) loaded.free();
      return { generation: opened, fits };
    }
    case 'train': {
      present();
      stop();
      const training = train(generation, command.pace, command.until);
      // With an end in sight the answer comes at the end.
      if (command.until !== undefined) return training;
      training.catch(fail);
      return null;
    }
    case 'pause':
      stop();
      if (session) sendTelemetry();
      return null;
    case 'step':
      single(() => stepOnce(present()));
      return null;
    case 'episode':
      single(() => {
        const open = present();
        const counters = /** @type {Frame} */ (frame);
        do stepOnce(open);
        while (counters.at(open.frame(), 0).number('end') === END.running);
      });
      return null;
    case 'rollout': {
      const player = whose(command.of);
      const index = BigInt(command.index);
      const after = command.of === 'best' ? best?.step : undefined;
      return { generation: opened, after, episode: command.from ? player.rollout_from(index, Float32Array.from(command.from)) : player.rollout(index) };
    }
    case 'value_map':
      return { generation: opened, map: whose(command.of).value_map(command.request) };
    case 'begin_drive':
      return { generation: opened, data: present().begin_drive(BigInt(command.index)) };
    case 'drive':
      return { generation: opened, data: present().drive(Float32Array.from(command.control), command.jump ?? undefined) };
    case 'evaluate':
      stop();
      sendTelemetry();
      return evaluate(generation, command.runs, whose(command.of ?? 'present'));
    case 'check_formula':
      return check_formula(command.text, propositions);
    case 'check_hoa':
      return check_hoa(command.text);
    case 'read_word':
      return present().read_word(command.word);
    case 'judge_word':
      return judge_word(command.formula, command.word);
    case 'check_map':
      return command.image ? check_map_and_picture(command.json, command.image.width, command.image.height, command.image.pixels) : check_map(command.json);
    case 'map_of_picture':
      return map_of_picture(command.name, command.width, command.height, command.pixels);
    case 'present_map':
      return present().map() ?? default_map();
    case 'keep': {
      const open = present();
      const bytes = SAVERS[command.form](open);
      return { generation: opened, steps: stepsOf(open), bytes };
    }
    case 'save':
      return SAVERS[command.form](present());
  }
}

/** What of an answer is handed over rather than copied. @param {Command} command @param {any} value @returns {Transferable[]} */
function belongings(command, value) {
  if (command.kind === 'save') return [value.buffer];
  return command.kind === 'keep' ? [value.bytes.buffer] : [];
}

/** @param {unknown} error */
function fail(error) {
  stop();
  tell({ kind: 'broken', message: located(error).message });
}

scope.addEventListener('message', async (event) => {
  const { id, command } = /** @type {{ id: number, command: Command }} */ (event.data);
  try {
    const value = await obey(command);
    tell({ kind: 'done', id, value }, belongings(command, value));
    // Of another session the page first hears what it is, then how it stands.
    if (command.kind === 'open' || command.kind === 'restore') {
      sendFrame();
      sendTelemetry();
    }
  } catch (error) {
    // A trap leaves the module in an unknown state: the page starts another worker.
    if (error instanceof WebAssembly.RuntimeError) fail(error);
    tell({ kind: 'failed', id, error: located(error) });
  }
});

try {
  ({ memory } = await init());
  tell({ kind: 'ready', tasks: builtin_tasks() });
} catch (error) {
  fail(error);
}
