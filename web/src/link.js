// @ts-check
// The link: the page's address follows the state, the state follows an address that is typed, and a wrong one is told.

import { byId } from './dom.js';
import { notice } from './keeping.js';
import { inLink } from './maps/shelf.js';
import { readHash, writeHash } from './state.js';

/** @typedef {import('./app.js').App} App */

/** Tells what is wrong with a link. @param {import('./state.js').Problem[]} problems */
export function tellProblems(problems) {
  for (const { property, message } of problems) notice(`The link’s “${property}” ${message}.`, true);
}

/** @param {App} app */
export function wireLink(app) {
  const write = () => {
    const hash = writeHash(app.state);
    if (hash !== location.hash) history.replaceState(null, '', hash || location.pathname + location.search);
  };
  app.signals.on('state', write);
  app.signals.on('opened', write);
  window.addEventListener('hashchange', () => {
    const { state, problems } = readHash(location.hash);
    tellProblems(problems);
    app.open(state);
  });
  byId('share', HTMLButtonElement).addEventListener('click', async () => {
    write();
    try {
      await navigator.clipboard.writeText(location.href);
      const { map } = app.state;
      notice(map && !inLink(map)
        ? 'The link is copied, but its map is too large for a link: it opens on this machine only. Send the map too: Paint map, then Save as file.'
        : 'The link to this task, seed and view is copied.');
    } catch {
      notice(`Copy the address of this page: ${location.href}`);
    }
  });
}
