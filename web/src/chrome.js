// @ts-check
// What frames the instrument: the theme, the help, and the panels that a link hides.

import { byId } from './dom.js';
import { nextTheme } from './keeping.js';

/** @typedef {import('./app.js').App} App */

/** @param {App} app */
export function wireChrome(app) {
  const help = byId('help', HTMLDialogElement);
  const on = (/** @type {string} */ id, /** @type {() => void} */ act) => byId(id, HTMLButtonElement).addEventListener('click', act);
  on('help-open', () => help.showModal());
  on('help-close', () => help.close());
  on('theme', () => {
    nextTheme();
    app.retheme();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => app.retheme());
  const hide = () => {
    for (const panel of ['spec', 'training', 'automaton', 'compare', 'details']) byId(`${panel}-panel`, HTMLElement).hidden = app.state.hide.includes(panel);
    byId('curves', HTMLElement).hidden = app.state.hide.includes('curves');
  };
  app.signals.on('state', hide);
  hide();
}
