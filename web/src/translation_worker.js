// @ts-check
/// <reference lib="webworker" />
// The worker that translates while the user types: one translator, for the environment that was named last.

import init, { Translator } from '../pkg/ltl_rover.js';
import { located } from './protocol.js';

/** @typedef {{ id: number, task: string, map: string | null, formula: string, hoa: string | null }} Question */

const scope = /** @type {DedicatedWorkerGlobalScope} */ (/** @type {unknown} */ (globalThis));
/** @type {Translator | null} */
let translator = null;
let environment = '';

/** @param {string} task @param {string | null} map */
function of(task, map) {
  const wanted = `${map ?? ''}\n${task}`;
  if (translator && wanted === environment) return translator;
  translator?.free();
  translator = Translator.of_task(task, map ?? undefined);
  environment = wanted;
  return translator;
}

const ready = init();
scope.addEventListener('message', async (event) => {
  const { id, task, map, formula, hoa } = /** @type {Question} */ (event.data);
  try {
    await ready;
    const asked = of(task, map);
    scope.postMessage({ id, verdict: hoa === null ? asked.translate(formula, { classify: true }) : asked.compare(formula, hoa) });
  } catch (error) {
    scope.postMessage({ id, verdict: { ok: false, error: located(error) } });
  }
});
