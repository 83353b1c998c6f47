// @ts-check
// Files out and in: checkpoints, policies, pictures, tables.

import { byId, offer } from './dom.js';
import { notice, wireExports } from './keeping.js';

/** @typedef {import('./app.js').App} App */

/** The largest checkpoint that is read, in bytes. */
const MAX_CHECKPOINT = 400_000_000;

/** @param {App} app @param {'whole' | 'policy'} form */
async function save(app, form) {
  /** @type {Uint8Array<ArrayBuffer> | undefined} */
  const bytes = await app.ask({ kind: 'save', form });
  const name = `${app.state.task}-seed${app.state.seed}${form === 'policy' ? '-policy' : ''}.safetensors`;
  if (bytes) offer(name, bytes, 'application/octet-stream');
}

/** @param {App} app @param {File} file */
async function load(app, file) {
  if (file.size > MAX_CHECKPOINT) return notice(`${file.name} is larger than ${MAX_CHECKPOINT / 1e6} MB.`, true);
  if (await app.restore(new Uint8Array(await file.arrayBuffer()))) notice(`${file.name} is open.`);
}

/** @param {App} app */
export function wireFiles(app) {
  const on = (/** @type {string} */ id, /** @type {() => void} */ act) => byId(id, HTMLButtonElement).addEventListener('click', act);
  on('save', () => save(app, 'whole'));
  on('save-policy', () => save(app, 'policy'));
  const input = byId('load', HTMLInputElement);
  input.addEventListener('change', async () => {
    const file = input.files?.[0];
    if (file) await load(app, file);
    input.value = '';
  });
  wireExports({ name: () => app.state.task, csv: () => app.curves?.csv() ?? '', description: () => app.description });
}
