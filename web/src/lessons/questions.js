// @ts-check
// One step of a lesson in the panel: a question with its choices, its run and what came of it, or something to try.

import { element, setText } from '../dom.js';
import { notice } from '../keeping.js';
import { Superseded } from './instrument.js';
import { MEASURED } from './measured.js';
import { isQuestion } from './model.js';
import { prose } from './prose.js';

/** @typedef {import('./model.js').Question} Question */
/** @typedef {import('./model.js').Trial} Trial */
/** @typedef {import('./model.js').Outcome} Outcome */
/** @typedef {import('./instrument.js').Instrument} Instrument */

/** What was measured of a training, in a sentence; empty if nothing was. @param {string} name  such as `frontier/3` */
export function measuredSentence(name) {
  const found = MEASURED[name];
  if (!found) return '';
  const { successes, runs, seeds } = found;
  const list = (/** @type {(string | number)[]} */ items) => `${items.slice(0, -1).join(', ')} and ${items[items.length - 1]}`;
  return `Measured beforehand, with seeds ${list(seeds)}: ${list(successes)} of ${runs} runs.`;
}

/** A step in the page. */
export class StepView {
  /**
   * @param {Question | Trial} step
   * @param {string} name   such as `frontier/3`
   * @param {Instrument} instrument
   * @param {{ said: number, bore: number } | undefined} kept   an earlier answer
   * @param {(answer: { said: number, bore: number }) => void} keep
   */
  constructor(step, name, instrument, kept, keep) {
    this.step = step;
    this.name = name;
    this.instrument = instrument;
    this.keep = keep;
    this.said = kept?.said ?? -1;
    this.bar = element('progress', { max: 1, value: 0, 'aria-label': 'How far the run has come' });
    this.barWords = element('span', { className: 'soft number' });
    this.barRow = element('div', { className: 'run-progress', hidden: true }, this.bar, this.barWords);
    this.result = element('div', { className: 'result', role: 'status', 'aria-live': 'polite' });
    this.root = isQuestion(step) ? this.question(step) : this.trial(step);
    if (kept && kept.bore >= 0 && isQuestion(step)) this.remember(step, kept);
  }

  /** @param {Question} step */
  question(step) {
    const name = `answer-${this.name.replace('/', '-')}`;
    this.inputs = step.choices.map((_, k) => element('input', { type: 'radio', name, value: String(k), checked: k === this.said }));
    const labels = step.choices.map((choice, k) => element('label', { className: 'choice' }, this.inputs?.[k] ?? '', element('span', {}, ...prose(choice))));
    this.inputs.forEach((input, k) => input.addEventListener('change', () => {
      this.said = k;
      this.offer();
    }));
    this.go = element('button', { type: 'button', className: 'primary run' }, 'Run');
    this.setUp = element('button', { type: 'button' }, 'Set this up');
    this.show = element('button', { type: 'button' }, 'Show');
    this.again = element('button', { type: 'button', className: 'quiet', hidden: true }, 'Clear');
    this.go.addEventListener('click', () => this.run(step));
    this.setUp.addEventListener('click', () => this.prepare(step.experiment));
    this.show.addEventListener('click', () => this.point());
    this.again.addEventListener('click', () => this.reopen());
    this.offer();
    return element('div', { className: 'step' },
      element('fieldset', {}, element('legend', {}, ...prose(step.ask)), element('div', { className: 'choices' }, ...labels)),
      element('div', { className: 'row' }, this.go, this.setUp, this.show, this.again), this.barRow, this.result);
  }

  /** @param {Trial} step */
  trial(step) {
    const go = element('button', { type: 'button', className: 'primary' }, step.button);
    go.addEventListener('click', async () => {
      await this.prepare(step);
      this.point();
    });
    const show = element('button', { type: 'button' }, 'Show');
    show.addEventListener('click', () => this.point());
    return element('div', { className: 'step' }, element('p', { className: 'ask' }, ...prose(step.try)), element('div', { className: 'row' }, go, show), this.barRow, this.result);
  }

  /** What can be done now. */
  offer() {
    if (!this.go) return;
    this.go.disabled = this.said < 0;
    this.go.title = this.said < 0 ? 'Choose an answer first' : '';
  }

  /** Brings the instrument in front of the reader. */
  point() {
    const held = document.body.classList.contains('without-world');
    const shown = [held ? '#word-panel:not([hidden]), #places-panel:not([hidden])' : '#stage-panel', '#automaton-panel'].map((s) => document.querySelector(s)).find((e) => e);
    if (!(shown instanceof HTMLElement)) return;
    shown.tabIndex = -1;
    shown.focus({ preventScroll: true });
    shown.scrollIntoView({ block: 'start', behavior: matchMedia('(prefers-reduced-motion: reduce)').matches ? 'auto' : 'smooth' });
  }

  /** @param {import('./model.js').Experiment | Trial} experiment */
  async prepare(experiment) {
    try {
      await this.instrument.setUp(experiment);
    } catch (error) {
      this.fail(error);
    }
  }

  /** @param {unknown} error */
  fail(error) {
    this.barRow.hidden = true;
    if (error instanceof Superseded) return;
    notice(error instanceof Error ? error.message : String(error), true);
  }

  reopen() {
    this.said = -1;
    for (const input of this.inputs ?? []) {
      input.disabled = false;
      input.checked = false;
      input.closest('label')?.classList.remove('bore', 'missed');
    }
    this.result.replaceChildren();
    if (this.again) this.again.hidden = true;
    this.offer();
    this.inputs?.[0].focus();
  }

  /** @param {Question} step */
  async run(step) {
    if (this.said < 0 || !this.go) return;
    for (const input of this.inputs ?? []) input.disabled = true;
    this.result.replaceChildren();
    this.barRow.hidden = false;
    this.bar.removeAttribute('value');
    setText(this.barWords, '');
    // On a narrow screen the instrument lies below the question.
    if (this.instrument.app.theatre.canvas.getBoundingClientRect().top > innerHeight || innerWidth < 1080) this.point();
    this.go.textContent = 'Running…';
    this.go.disabled = true;
    try {
      const outcome = await this.instrument.run(step.experiment, (done, of, words) => {
        this.bar.max = Math.max(1, of);
        this.bar.value = done;
        setText(this.barWords, words);
      });
      const bore = step.bears(outcome);
      this.keep({ said: this.said, bore });
      this.tell(step, outcome.words, bore);
      this.result.scrollIntoView({ block: 'nearest' });
    } catch (error) {
      this.fail(error);
      if (this.again) this.again.hidden = false;
    }
    this.barRow.hidden = true;
    this.go.textContent = 'Run again';
    this.go.disabled = false;
  }

  /** An answer of an earlier visit. @param {Question} step @param {{ said: number, bore: number }} kept */
  remember(step, kept) {
    for (const input of this.inputs ?? []) input.disabled = true;
    this.said = kept.said;
    if (this.go) this.go.textContent = 'Run again';
    this.offer();
    this.tell(step, '', kept.bore);
  }

  /** @param {Question} step @param {string} happened @param {number} bore */
  tell(step, happened, bore) {
    this.inputs?.forEach((input, k) => {
      input.closest('label')?.classList.toggle('bore', k === bore);
      input.closest('label')?.classList.toggle('missed', k === this.said && k !== bore);
    });
    const right = bore === this.said;
    const parts = [element('p', { className: right ? 'came right' : 'came wrong' }, element('b', {}, right ? '✓ As you said. ' : '✗ It came out otherwise. '),
      ...prose(right || bore < 0 ? '' : `The run bears out: ${step.choices[bore]}.`))];
    if (happened) parts.push(element('p', {}, element('b', {}, 'What happened. '), ...prose(happened)));
    if (step.experiment.kind === 'train') {
      const odd = bore === step.key ? '' : 'This run came out otherwise than it mostly does. ';
      parts.push(element('p', { className: 'note' }, odd + measuredSentence(this.name)));
    }
    parts.push(element('p', {}, element('b', {}, 'Why. '), ...prose(step.why)));
    this.result.replaceChildren(...parts);
    if (this.again) this.again.hidden = false;
  }
}
