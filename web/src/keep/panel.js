// @ts-check
// What is kept on this machine, as a list: go on with a run, forget it, forget everything.

import { byId, count, element } from '../dom.js';
import { notice } from '../keeping.js';
import { ago, megabytes } from './keeper.js';

/** @typedef {import('./keeper.js').Keeper} Keeper */
/** @typedef {import('./store.js').Store} Store */

/** @param {Keeper} keeper @param {Store} store */
export function wireKeptRuns(keeper, store) {
  const panel = byId('kept-here', HTMLDetailsElement);
  const list = byId('kept-here-runs', HTMLElement);
  const note = byId('kept-here-note', HTMLElement);
  const refresh = async () => {
    if (!panel.open) return;
    const [runs, maps, lasts] = await Promise.all([store.runs(), store.maps(), store.lasts()]);
    const now = Date.now();
    list.replaceChildren(...runs.map((run) => {
      const go = element('button', { type: 'button', 'aria-label': `Continue ${run.title} at ${count(run.steps)} steps` }, 'Continue');
      go.addEventListener('click', () => keeper.resume(run));
      const forget = element('button', { type: 'button', className: 'quiet', 'aria-label': `Forget ${run.title} at ${count(run.steps)} steps` }, 'Forget');
      forget.addEventListener('click', async () => {
        await store.removeRun(run.key);
        await refresh();
      });
      return element('li', {}, element('span', {}, element('b', {}, `${count(run.steps)} steps`), ` · ${run.title} · seed ${run.seed}`,
        element('span', { className: 'soft' }, ` · ${ago(run.when, now)}, ${megabytes(run.size)}${run.exact ? '' : ', without replays'}`)), go, forget);
    }));
    const size = runs.reduce((sum, run) => sum + run.size, 0);
    const what = `${count(runs.length)} ${runs.length === 1 ? 'run' : 'runs'} (${megabytes(size)}) and ${count(maps.length)} ${maps.length === 1 ? 'map' : 'maps'}`;
    note.textContent = lasts ? `${what} are kept in this browser, nowhere else.` : `This browser keeps nothing between visits (a private window?): ${what} until the page is closed.`;
  };
  keeper.changed = () => void refresh();
  panel.addEventListener('toggle', () => void refresh());
  byId('forget', HTMLButtonElement).addEventListener('click', async () => {
    const sure = byId('forget-sure', HTMLDialogElement);
    sure.returnValue = '';
    sure.showModal();
  });
  byId('forget-sure', HTMLDialogElement).addEventListener('close', async () => {
    if (byId('forget-sure', HTMLDialogElement).returnValue !== 'forget') return;
    await forgetEverything(store);
    await refresh();
    notice('Everything that this page kept in this browser is forgotten: runs, maps, and the copy for use without a network.');
  });
}

/** @param {Store} store */
async function forgetEverything(store) {
  await store.forget();
  if ('caches' in window) for (const name of await caches.keys()) if (name.startsWith('ltl-rover-')) await caches.delete(name);
  for (const worker of await navigator.serviceWorker?.getRegistrations() ?? []) await worker.unregister();
}
