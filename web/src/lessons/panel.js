// @ts-check
// The lesson beside the instrument: its words, its steps one at a time, the way to the lessons before and after.

import { element } from '../dom.js';
import { lessonAddress } from './address.js';
import { LESSONS } from './content/index.js';
import { answered, forgetAnswers, keepAnswer, readProgress } from './progress.js';
import { isQuestion } from './model.js';
import { prose } from './prose.js';
import { StepView } from './questions.js';

/** @typedef {import('./model.js').Lesson} Lesson */
/** @typedef {import('./instrument.js').Instrument} Instrument */

export class LessonPanel {
  /**
   * @param {HTMLElement} root
   * @param {Lesson} lesson
   * @param {Instrument} instrument
   */
  constructor(root, lesson, instrument) {
    this.lesson = lesson;
    this.instrument = instrument;
    const place = LESSONS.indexOf(lesson);
    this.place = element('ol', { className: 'steps' });
    this.box = element('div', { className: 'step-box' });
    this.on = element('button', { type: 'button' }, 'Next question');
    this.on.addEventListener('click', () => this.go(this.current + 1, true));
    this.current = 0;
    const [before, after] = [LESSONS[place - 1], LESSONS[place + 1]];
    const way = (/** @type {Lesson | undefined} */ to, /** @type {string} */ label, /** @type {string} */ rel) =>
      to ? element('a', { href: lessonAddress(to.name), rel, className: 'way' }, element('span', { className: 'soft' }, label), element('span', {}, ...prose(to.title))) : element('span', {});
    const clear = element('button', { type: 'button', className: 'quiet' }, 'Forget my answers');
    clear.addEventListener('click', () => {
      forgetAnswers(lesson.name);
      this.go(0, true);
    });
    root.append(
      element('header', { className: 'lesson-head' },
        element('p', { className: 'soft' }, `Lesson ${place + 1} of ${LESSONS.length} · ${lesson.minutes} minutes`),
        element('h2', { id: 'lesson-title', tabIndex: -1 }, ...prose(lesson.title)),
        element('p', { className: 'aim' }, ...prose(lesson.aim))),
      element('div', { className: 'lesson-words' }, ...lesson.words.map((text) => element('p', {}, ...prose(text)))),
      element('nav', { 'aria-label': 'Steps of this lesson' }, this.place),
      this.box,
      element('div', { className: 'row' }, this.on),
      element('footer', { className: 'lesson-foot' },
        element('nav', { className: 'ways', 'aria-label': 'Other lessons' }, way(before, '← before', 'prev'), way(after, 'next →', 'next')),
        element('p', { className: 'row small' }, element('a', { href: `?worksheet=${lesson.name}` }, 'Worksheet'), element('a', { href: './' }, 'Leave the lesson'), clear)));
  }

  /** @param {number} step @param {boolean} [byHand] */
  go(step, byHand = false) {
    const { lesson } = this;
    this.current = Math.max(0, Math.min(step, lesson.steps.length - 1));
    const kept = readProgress()[lesson.name] ?? {};
    this.place.replaceChildren(...lesson.steps.map((each, k) => {
      const done = isQuestion(each) && (kept[k]?.bore ?? -1) >= 0;
      const button = element('button', { type: 'button', className: done ? 'done' : '', 'aria-label': `${isQuestion(each) ? 'Question' : 'Try it'} ${k + 1}${done ? ', answered' : ''}` }, done ? `${k + 1} ✓` : String(k + 1));
      if (k === this.current) button.setAttribute('aria-current', 'step');
      button.addEventListener('click', () => this.go(k, true));
      return element('li', {}, button);
    }));
    const each = lesson.steps[this.current];
    const view = new StepView(each, `${lesson.name}/${this.current + 1}`, this.instrument, kept[this.current], (answer) => {
      keepAnswer(lesson.name, this.current, answer);
      this.mark();
    });
    this.box.replaceChildren(view.root);
    this.on.hidden = this.current === lesson.steps.length - 1;
    this.instrument.hide = lesson.hide.filter((panel) => !(isQuestion(each) && each.experiment.kind === 'train' && panel === 'training'));
    view.prepare(isQuestion(each) ? each.experiment : { ...each, state: { ...each.state, watch: 'policy' } });
    if (byHand) view.root.querySelector('input')?.focus();
  }

  /** Marks the present step as answered. */
  mark() {
    const button = this.place.children[this.current]?.firstElementChild;
    if (!button) return;
    button.className = 'done';
    button.textContent = `${this.current + 1} ✓`;
    button.setAttribute('aria-label', `Question ${this.current + 1}, answered`);
  }

  /** The first step without an answer. */
  get open() {
    const kept = readProgress()[this.lesson.name] ?? {};
    const at = this.lesson.steps.findIndex((step, k) => isQuestion(step) && (kept[k]?.bore ?? -1) < 0);
    return at < 0 || answered(readProgress(), this.lesson) === 0 ? 0 : at;
  }
}
