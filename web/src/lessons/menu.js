// @ts-check
// The menu of lessons: what there is, how far one has come.

import { element } from '../dom.js';
import { lessonAddress } from './address.js';
import { LESSONS } from './content/index.js';
import { isQuestion } from './model.js';
import { answered, readProgress } from './progress.js';
import { prose } from './prose.js';
import { withStyle } from './style.js';

/** Opens the menu. */
export async function openMenu() {
  await withStyle();
  document.getElementById('lessons')?.remove();
  const progress = readProgress();
  const close = element('button', { type: 'button', className: 'quiet' }, 'Close');
  const entry = (/** @type {import('./model.js').Lesson} */ lesson) => {
    const questions = lesson.steps.filter(isQuestion).length;
    const done = answered(progress, lesson);
    return element('li', {}, element('a', { href: lessonAddress(lesson.name) }, element('b', {}, ...prose(lesson.title)), element('span', {}, ...prose(lesson.aim))),
      element('span', { className: 'soft number' }, done === 0 ? `${lesson.minutes} min` : done === questions ? '✓ done' : `${done} of ${questions}`));
  };
  const dialog = element('dialog', { id: 'lessons', 'aria-labelledby': 'lessons-title' },
    element('header', { className: 'card-head' }, element('h2', { id: 'lessons-title' }, 'Lessons'), close),
    element('p', { className: 'note' }, 'Short: say what will happen, run it, read why. What you answer is kept in this browser only.'),
    element('ol', { className: 'lesson-list' }, ...LESSONS.map(entry)),
    element('p', { className: 'row' }, element('a', { href: '?gallery=1' }, 'Break it: a gallery'), element('a', { href: '?worksheet=all' }, 'Worksheets to print')));
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
