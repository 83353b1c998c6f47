// @ts-check
// Starts the computing worker at once, while the page's other modules are still on their way, and keeps what it says until somebody listens.

const able = typeof WebAssembly === 'object' && typeof Worker === 'function' && !/[?&]worksheet\b/.test(location.search);
/** @type {Worker | null} */
let worker = able ? new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }) : null;
/** @type {(() => void)[]} */
const missed = [];
if (worker) {
  const begun = worker;
  begun.onmessage = (event) => missed.push(() => begun.onmessage?.(event));
  begun.onerror = (event) => missed.push(() => begun.onerror?.(event));
}

/** A worker: at first the one that was started early; its listeners hear what it said before, once they are attached. */
export function startWorker() {
  const begun = worker ?? new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  worker = null;
  queueMicrotask(() => missed.splice(0).forEach((tell) => tell()));
  return begun;
}
