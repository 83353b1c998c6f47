// @ts-check
// Files out and in: checkpoints, policies, pictures, tables; and one “Open…” that finds out by itself what a file is.

import { byId, offer } from './dom.js';
import { MAX_FILE, recognise } from './keep/recognise.js';
import { notice, wireExports } from './keeping.js';

/** @typedef {import('./app.js').App} App */

/** @param {App} app @param {'whole' | 'policy'} form */
async function save(app, form) {
  /** @type {Uint8Array<ArrayBuffer> | undefined} */
  const bytes = await app.ask({ kind: 'save', form });
  const name = `${app.description?.task.name ?? 'run'}-seed${app.state.seed}${form === 'policy' ? '-policy' : ''}.safetensors`;
  if (bytes) offer(name, bytes, 'application/octet-stream');
}

/**
 * Opens files, whatever they are.
 * @param {App} app
 * @param {File[]} files
 * @param {(files: File[]) => void} editMap  for maps and pictures
 */
export async function openFiles(app, files, editMap) {
  const [file] = files;
  if (!file) return;
  if (file.size > MAX_FILE) return notice(`${file.name} has ${Math.round(file.size / 1e6)} MB; files of at most ${MAX_FILE / 1e6} MB are opened.`, true);
  const bytes = new Uint8Array(await file.arrayBuffer());
  const found = recognise(bytes);
  const opened = (/** @type {boolean} */ stands) => {
    if (stands) notice(`${file.name} is open.`);
  };
  switch (found.kind) {
    case 'checkpoint':
      return opened(await app.restore(bytes));
    case 'picture':
    case 'map':
      return editMap(files);
    case 'hoa':
      return app.spec.takeHoa(found.text);
    case 'formula':
      return void app.spec.putFormula(found.text);
    case 'task':
      return opened(await app.open({ ...app.state, task: found.text, formula: '', hoa: '', map: '', preset: '', set: {} }));
    case 'description':
      return opened(await app.open({ ...app.state, ...(await app.stateOf(found.request)) }));
    case 'unknown':
      return notice(`${file.name} cannot be opened: ${found.why}.`, true);
  }
}

/** @param {App} app @param {(files: File[]) => void} editMap */
export function wireFiles(app, editMap) {
  const on = (/** @type {string} */ id, /** @type {() => void} */ act) => byId(id, HTMLButtonElement).addEventListener('click', act);
  on('save', () => save(app, 'whole'));
  on('save-policy', () => save(app, 'policy'));
  const input = byId('load', HTMLInputElement);
  input.addEventListener('change', async () => {
    await openFiles(app, [...(input.files ?? [])], editMap);
    input.value = '';
  });
  // A file may be dropped anywhere; places that take it for themselves say so by preventing what the browser would do.
  window.addEventListener('dragover', (event) => {
    if (event.dataTransfer?.types.includes('Files')) event.preventDefault();
  });
  window.addEventListener('drop', (event) => {
    if (event.defaultPrevented || !event.dataTransfer?.files.length) return;
    event.preventDefault();
    openFiles(app, [...event.dataTransfer.files], editMap);
  });
  wireExports({ name: () => app.description?.task.name ?? 'ltl-rover', csv: () => app.curves?.csv() ?? '', description: () => app.description });
}
