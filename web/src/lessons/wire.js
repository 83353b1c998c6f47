// @ts-check
// Where lessons meet the page: what the address asks for, before the app begins and after it stands.

import { byId, element } from '../dom.js';
import { readHash } from '../state.js';
import { readAddress } from './address.js';
import { lesson as named } from './content/index.js';
import { instrumentState } from './experiments.js';
import { showGallery } from './gallery.js';
import { Instrument } from './instrument.js';
import { isQuestion } from './model.js';
import { LessonPanel } from './panel.js';
import { PlacesBench } from './places_bench.js';
import { withStyle } from './style.js';
import { wireTeacher } from './teacher.js';
import { WordBench } from './word_bench.js';

/** @typedef {import('../app.js').App} App */

/** What the address asks for. */
export const { address, problems } = readAddress(location.search);

/** Whether a lesson or the gallery stands beside the instrument. */
export const inLesson = address.lesson !== '' || address.gallery !== '';

/** The state that the app begins in: a lesson's own, or that of the link with the teacher's seed. @param {string} hash */
export function beginning(hash) {
  const found = readHash(hash);
  const { lesson, gallery, seed, step } = address;
  const chosen = named(lesson);
  if (chosen && !gallery) {
    const first = chosen.steps[Math.min(Math.max(step - 1, 0), chosen.steps.length - 1)];
    const state = instrumentState(isQuestion(first) ? first.experiment.state : first.state, chosen.hide, seed);
    return { state: { ...state, watch: /** @type {const} */ ('policy') }, problems };
  }
  if (gallery) return { state: instrumentState({ task: 'ball_pass_b1', preset: 'fast', speed: 4 }, ['spec', 'compare', 'details'], seed), problems };
  return { state: seed === null ? found.state : { ...found.state, seed }, problems: [...found.problems, ...problems] };
}

/** Shows the worksheet that the address asks for, in place of the page. */
export const showWorksheet = async () => (await import('./worksheet.js')).showWorksheet(address);

/** @param {App} app */
export async function wireLessons(app) {
  const chosen = address.gallery ? undefined : named(address.lesson);
  if (address.hide.length > 0 || chosen || address.gallery) await withStyle();
  if (!chosen && !address.gallery) return wireTeacher(app, address);
  const bench = /** @type {HTMLElement} */ (document.querySelector('.bench'));
  const place = (/** @type {string} */ name) => {
    const card = element('section', { className: `card ${name}`, id: `${name}-panel`, 'aria-labelledby': `${name}-title`, hidden: true });
    bench.prepend(card);
    return card;
  };
  const ask = (/** @type {import('../protocol.js').Command} */ command) => app.ask(command);
  const word = new WordBench(place('word'), app.theatre, ask);
  const places = new PlacesBench(place('places'), async (made) => {
    if (!app.description) return;
    word.show({ description: app.description, word: made });
    const reading = await app.ask({ kind: 'read_word', word: made });
    if (reading) await word.play(reading, () => word.word === made || JSON.stringify(word.word) === JSON.stringify(made));
  });
  const instrument = new Instrument(app, { word, places }, address.seed);
  const root = element('aside', { className: 'card lesson', id: 'lesson-panel', 'aria-labelledby': 'lesson-title' });
  const main = /** @type {HTMLElement} */ (document.querySelector('main'));
  // Space and letters choose an answer here; elsewhere they are the page's keys.
  root.addEventListener('keydown', (event) => {
    if (event.target instanceof HTMLInputElement) event.stopPropagation();
  });
  main.classList.add('with-lesson');
  main.prepend(root);
  /** @type {LessonPanel | null} */
  let panel = null;
  if (chosen) panel = new LessonPanel(root, chosen, instrument);
  else showGallery(root, instrument);
  document.title = `${chosen?.title ?? 'Break it'} · ltl-rover`;
  wireTeacher(app, address);
  let begun = false;
  app.signals.on('opened', () => {
    if (begun) return;
    begun = true;
    panel?.go(address.step > 0 ? address.step - 1 : panel.open);
    if (!panel) document.getElementById(address.gallery)?.scrollIntoView();
  });
  byId('lesson-title', HTMLElement).focus({ preventScroll: true });
}
