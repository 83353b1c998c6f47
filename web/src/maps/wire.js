// @ts-check
// The map editor, loaded when it is first asked for, and joined to the app: a button on rover tasks, pictures and map files dropped anywhere.

import { byId } from '../dom.js';
import { notice } from '../keeping.js';

/** @typedef {import('../app.js').App} App */
/** @typedef {import('../keep/store.js').Store} Store */
/** @typedef {import('./editor.js').MapEditor} MapEditor */

/**
 * @param {App} app
 * @param {Store} store
 * @returns {(files: File[]) => void}  opens the editor on files
 */
export function wireMaps(app, store) {
  const button = byId('paint-map', HTMLButtonElement);
  app.signals.on('opened', ({ environment }) => (button.hidden = environment.name !== 'rover'));
  /** @type {Promise<MapEditor> | null} */
  let editor = null;
  const load = () => (editor ??= import('./editor.js').then(({ MapEditor }) => new MapEditor({
    check: (json, image) => app.client.ask({ kind: 'check_map', json, image: image ?? null }),
    ofPicture: (name, { width, height, data }) => app.client.ask({ kind: 'map_of_picture', name, width, height, pixels: new Uint8Array(data.buffer) }),
    use: (json) => use(app, json),
    kept: {
      list: () => store.maps(),
      get: (name) => store.namedMap(name),
      put: (name, json) => store.putNamedMap(name, json).then(() => '', (error) => `It could not be kept: ${error.message}.`),
      remove: (name) => store.removeNamedMap(name),
    },
  })));
  const open = async () => {
    const json = await app.client.ask({ kind: 'present_map' });
    await (await load()).open(json);
  };
  const failed = (/** @type {unknown} */ error) => notice(`The map editor cannot be opened: ${error instanceof Error ? error.message : error}`, true);
  button.addEventListener('click', () => open().catch(failed));
  return (files) => {
    const take = async () => {
      await open();
      await (await load()).take(files);
    };
    take().catch(failed);
  };
}

/**
 * Opens a task on the map: the open one if it is a rover's, else the one for maps of one's own. The formula stays if the map has its
 * propositions. What is wrong, or nothing.
 * @param {App} app
 * @param {string} json
 */
async function use(app, json) {
  const { state, description } = app;
  const map = await app.shelf.keyOf(json);
  const rover = description?.environment.name === 'rover';
  const labels = /** @type {{ labels: { name: string }[] }} */ (JSON.parse(json)).labels.map(({ name }) => name);
  const fits = rover && (description?.formula.propositions ?? []).every((name) => labels.includes(name));
  const base = rover ? state : { ...state, task: 'own_map', preset: '', set: {}, formula: '', hoa: '' };
  let wrong = '';
  const watch = state.watch === 'trained' ? 'policy' : state.watch;
  await app.open({ ...base, map, watch, ...(fits ? {} : { formula: '', hoa: '' }) }, false, (error) => (wrong = error.message));
  return wrong;
}
