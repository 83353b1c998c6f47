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
    check: (json, image) => app.client.ask({ kind: 'check_map', json, image: image ? plain(image) : null }),
    ofPicture: (name, image) => app.client.ask({ kind: 'map_of_picture', name, ...plain(image) }),
    use: (json, suggested) => use(app, json, suggested),
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

/** A picture as it crosses to the worker. @param {ImageData} image */
const plain = ({ width, height, data }) => ({ width, height, pixels: new Uint8Array(data.buffer) });

/**
 * Opens a task on the map: the open one if it is a rover's, else the one for maps of one's own. The formula stays if the map has its
 * propositions. What is wrong, or nothing.
 * @param {App} app
 * @param {string} json
 * @param {string} suggested  a formula for it
 */
async function use(app, json, suggested) {
  const { state, description } = app;
  const map = await app.shelf.keyOf(json);
  const rover = description?.environment.name === 'rover';
  const labels = /** @type {{ labels: { name: string }[] }} */ (JSON.parse(json)).labels.map(({ name }) => name);
  const fits = rover && (description?.formula.propositions ?? []).every((name) => labels.includes(name));
  const base = rover ? state : { ...state, task: 'own_map', preset: '', set: {}, formula: '', hoa: '' };
  let wrong = '';
  const watch = state.watch === 'trained' ? 'policy' : state.watch;
  const stands = await app.open({ ...base, map, watch, ...(fits ? {} : { formula: '', hoa: '' }) }, false, (error) => (wrong = error.message));
  const used = app.description?.formula.propositions ?? [];
  const unused = labels.filter((name) => !used.includes(name));
  if (stands && unused.length > 0) notice(`The formula does not speak of ${unused.join(', ')} yet: write it into the specification, such as ${suggested}.`);
  return wrong;
}
