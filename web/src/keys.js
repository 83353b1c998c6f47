// @ts-check
// The keyboard: one table of keys, for the whole page.

import { byId } from './dom.js';

/** @typedef {import('./app.js').App} App */

/** @param {App} app @returns {Record<string, () => void>} */
function table(app) {
  const { theatre } = app;
  const press = (/** @type {string} */ id) => () => byId(id, HTMLButtonElement).click();
  return {
    ' ': () => theatre.togglePlay(),
    t: () => app.toggleTraining(),
    s: () => app.single('step'),
    e: () => app.single('episode'),
    ',': () => theatre.jump(-1),
    '.': () => theatre.jump(1),
    ArrowLeft: () => theatre.seek(theatre.player.row - 1),
    ArrowRight: () => theatre.seek(theatre.player.row + 1),
    r: press('reset'),
    n: press('new-seed'),
    1: () => app.watch('trained'),
    2: () => app.watch('policy'),
    3: () => app.watch('training'),
    4: () => app.watch('drive'),
    b: () => app.watch('best'),
    k: press('keep'),
    x: press('next-episode'),
    v: () => app.change({ layers: toggled(app.state.layers, 'value') }),
    '?': press('help-open'),
  };
}

/** A list with an entry added or taken out. @param {string[]} list @param {string} entry */
const toggled = (list, entry) => (list.includes(entry) ? list.filter((e) => e !== entry) : [...list, entry]);

/** Listens to keys that no field takes. @param {App} app */
export function wireKeys(app) {
  const keys = table(app);
  window.addEventListener('keydown', (event) => {
    const target = /** @type {HTMLElement} */ (event.target);
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    if (target.matches('input:not([type=radio], [type=range], [type=checkbox]), select, textarea, [role=option]')) return;
    if (app.theatre.drive.driver.press(event.key)) return event.preventDefault();
    if (event.key === ' ' && target.matches('button, summary, label, [type=checkbox]')) return;
    if (event.key.startsWith('Arrow') && target.matches('input')) return;
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
