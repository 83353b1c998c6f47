// @ts-check
// The page begins here: the app, and the parts that are wired to it. A new part is a module with one `wire…(app)`.

import { App } from './app.js';
import { wireChrome } from './chrome.js';
import { byId, element } from './dom.js';
import { wireExperiment } from './experiment/panel.js';
import { wireFiles } from './files.js';
import { Keeper } from './keep/keeper.js';
import { wireKeptRuns } from './keep/panel.js';
import { Store } from './keep/store.js';
import { wireKept } from './kept.js';
import { wireKeys } from './keys.js';
import { wireLayers } from './layers.js';
import { tellProblems, wireLink } from './link.js';
import { Shelf } from './maps/shelf.js';
import { wireMaps } from './maps/wire.js';
import { readHash } from './state.js';
import { wireTranslating } from './translating.js';
import { wireValues } from './values.js';

if (typeof WebAssembly !== 'object' || typeof Worker !== 'function') {
  byId('notices', HTMLElement).append(element('p', { className: 'notice problem' }, 'This browser has no WebAssembly or no workers; the page cannot compute anything here.'));
} else {
  // Lessons are loaded when the address asks for something of theirs, or their menu is opened.
  const lessons = location.search.length > 1 ? await import('./lessons/wire.js') : null;
  if (lessons?.address.worksheet) {
    await lessons.showWorksheet();
  } else {
    const { state, problems } = (lessons?.beginning ?? readHash)(location.hash);
    const store = new Store();
    const app = new App(state, new Shelf(store));
    for (const wire of [wireChrome, wireKeys, wireLink, wireLayers, wireKept, wireValues, wireTranslating, wireExperiment]) wire(app);
    wireFiles(app, wireMaps(app, store));
    const keeper = new Keeper(app, store);
    keeper.idle = lessons?.inLesson ?? false;
    wireKeptRuns(keeper, store);
    app.lastCheckpoint = () => keeper.last();
    await lessons?.wireLessons(app);
    byId('lessons-open', HTMLButtonElement).addEventListener('click', async () => (await import('./lessons/menu.js')).openMenu());
    tellProblems(problems);
    app.start().then(() => (keeper.idle ? undefined : keeper.offer()));
  }
  if ('serviceWorker' in navigator) navigator.serviceWorker.register('service_worker.js').catch(() => {});
}
