// @ts-check
// What a teacher's link fixes: parts that are hidden, controls that are locked.

import { element } from '../dom.js';
import { LOCKS, PARTS } from './address.js';

/** @typedef {import('../app.js').App} App */
/** @typedef {import('./address.js').Address} Address */

/**
 * Hides and locks now, and whenever the page has made its parts anew.
 * @param {App} app
 * @param {Address} address
 */
export function wireTeacher(app, { hide, lock }) {
  if (hide.length === 0 && lock.length === 0) return;
  const all = (/** @type {string} */ selector) => /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(selector));
  const hold = () => {
    for (const part of hide) for (const each of all(PARTS[part])) each.classList.add('withheld');
    for (const part of lock) {
      for (const each of all(LOCKS[part])) {
        const control = /** @type {HTMLInputElement | HTMLTextAreaElement} */ (each);
        const text = control instanceof HTMLTextAreaElement;
        // Only what is still open is touched: the observer below would hear of it for ever.
        if (text ? control.readOnly : control.disabled) continue;
        if (text) control.readOnly = true;
        else control.disabled = true;
        control.title = 'Fixed by the link';
      }
    }
  };
  hold();
  // Some controls are made, or enabled, when a task is opened or a text is checked.
  new MutationObserver(hold).observe(document.body, { subtree: true, childList: true, attributes: true, attributeFilter: ['disabled'] });
  app.signals.on('opened', hold);
  // What is dropped on the automaton is a way round its lock.
  if (lock.includes('hoa')) {
    for (const panel of all('#hoa-panel')) panel.addEventListener('drop', (event) => event.stopPropagation(), { capture: true });
  }
  if (lock.length > 0) {
    const head = document.querySelector('.lesson-head') ?? document.getElementById('notices');
    head?.append(element('p', { className: 'note fixed' }, `Fixed by the link: ${lock.length === Object.keys(LOCKS).length ? 'everything' : lock.join(', ')}.`));
  }
}
