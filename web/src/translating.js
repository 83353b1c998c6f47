// @ts-check
// Translation while one types: the formula's automaton drawn as a preview, its class and size, doubts; a pasted automaton held against the
// formula, with a word on which they differ.

import { byId, count, element, setText } from './dom.js';
import { TranslatorClient } from './translator.js';
import { Completion } from './views/completion.js';

/** @typedef {import('./app.js').App} App */
/** @typedef {import('../pkg/ltl_rover.js').TranslationFacts} TranslationFacts */
/** @typedef {import('./protocol.js').Comparison} Comparison */

/** Doubts that mean that there is nothing to train. */
const GRAVE = new Set(['unsatisfiable', 'impossible_here', 'lost_at_start']);

/** @param {number} n @param {string} one @param {string} many */
const many = (n, one, many) => `${count(n)} ${n === 1 ? one : many}`;

/** The size of an automaton in words. @param {TranslationFacts['size']} size */
export function sizeInWords(size) {
  const parts = [many(size.states, 'state', 'states'), many(size.sets, 'accepting set', 'accepting sets')];
  if (size.sinks > 0) parts[0] += ` (${size.sinks} ${size.sinks === 1 ? 'sink' : 'sinks'})`;
  if (size.epsilon > 0) parts.push(many(size.epsilon, 'ε-jump', 'ε-jumps'));
  return parts.join(', ');
}

/** A letter of a word, as a chip. @param {string[]} letter */
const letterChip = (letter) => element('span', { className: 'letter' }, letter.length > 0 ? letter.join(' ') : '∅');

/** A word: its letters, and those that are repeated for ever marked. @param {NonNullable<Comparison['word']>} word */
export function wordLine({ letters, back }) {
  return element('span', { className: 'word' }, ...letters.slice(0, back).map(letterChip),
    element('span', { className: 'cycle', title: 'again and again' }, ...letters.slice(back).map(letterChip)));
}

class Translating {
  /** @param {App} app */
  constructor(app) {
    this.app = app;
    this.facts = byId('formula-facts', HTMLElement);
    this.compared = byId('hoa-compared', HTMLElement);
    this.preview = byId('automaton-preview', HTMLElement);
    this.client = new TranslatorClient(() => new Worker(new URL('./translation_worker.js', import.meta.url), { type: 'module' }));
    this.completion = new Completion(byId('formula', HTMLInputElement), byId('completions', HTMLElement), byId('propositions', HTMLElement));
    this.turn = 0;
    const formula = byId('formula', HTMLInputElement);
    formula.addEventListener('focus', () => this.client.warm());
    app.signals.on('opened', (description) => {
      this.completion.set(description.environment.propositions);
      this.leave();
    });
    app.spec.on({ formula: (text, sound) => this.formula(text, sound), hoa: (text, sound) => this.hoa(text, sound) });
  }

  /** The open environment, by which propositions are judged. */
  async environment() {
    const { task, map } = await this.app.requestOf(this.app.state);
    return { task, map };
  }

  /** Ends the preview: the automaton of the open session stands again. */
  leave() {
    this.turn++;
    this.preview.hidden = true;
    this.facts.replaceChildren();
    this.app.theatre.endPreview();
  }

  /** @param {string} text @param {boolean} sound  whether it is a formula */
  async formula(text, sound) {
    const turn = ++this.turn;
    if (!sound) return this.facts.replaceChildren();
    const own = text === this.app.spec.opened;
    if (own) this.leave();
    // The open formula is not translated again until somebody works at it.
    if (own && document.activeElement !== byId('formula', HTMLInputElement)) return;
    const mine = own ? this.turn : turn;
    this.facts.classList.add('busy');
    const verdict = await this.client.translate(await this.environment(), text);
    if (!verdict || mine !== this.turn) return;
    this.facts.classList.remove('busy');
    if (!verdict.ok) {
      this.facts.replaceChildren(element('span', { className: 'fact bad' }, verdict.error.message), ...(verdict.error.hint ? [element('span', { className: 'fact' }, verdict.error.hint)] : []));
      return;
    }
    this.say(verdict.facts);
    if (own) return;
    await this.app.theatre.preview(verdict.facts.graph);
    if (mine !== this.turn) return this.app.theatre.endPreview();
    this.preview.hidden = false;
  }

  /** @param {TranslationFacts} facts */
  say(facts) {
    const { size, warnings, paraphrase } = facts;
    const kind = facts.class;
    const grave = warnings.filter((w) => GRAVE.has(w.kind));
    const doubts = warnings.filter((w) => !GRAVE.has(w.kind) && w.kind !== 'notation');
    this.facts.replaceChildren(
      ...grave.map((w) => element('span', { className: 'fact bad' }, w.message)),
      ...(kind ? [element('span', { className: 'fact', title: kind.meaning }, element('b', {}, kind.name))] : []),
      element('span', { className: 'fact' }, sizeInWords(size)),
      ...doubts.map((w) => element('span', { className: 'fact doubt' }, w.message)),
      ...(paraphrase ? [element('span', { className: 'fact paraphrase' }, paraphrase)] : []));
    this.app.spec.doubt(warnings);
  }

  /** @param {string} text @param {boolean} sound  whether it is an automaton */
  async hoa(text, sound) {
    const turn = ++this.turn;
    this.compared.replaceChildren();
    if (!sound) return;
    const formula = byId('formula', HTMLInputElement).value;
    const verdict = await this.client.compare(await this.environment(), formula, text);
    if (!verdict || turn !== this.turn) return;
    if (!verdict.ok) return setText(this.compared, verdict.error.message);
    const { equal, words, word, accepted, sentence } = verdict.facts;
    if (equal) this.compared.replaceChildren(element('span', { className: 'fact good' }, `Equal to the formula on all ${count(words)} words that were tried`));
    else if (word) {
      this.compared.replaceChildren(element('span', { className: 'fact bad' }, 'Different from the formula'),
        element('span', {}, ' for example on ', wordLine(word), accepted ? ': the automaton accepts it, the formula is false' : ': the automaton rejects it, the formula is true'));
    } else setText(this.compared, sentence);
  }
}

/** @param {App} app */
export function wireTranslating(app) {
  app.translating = new Translating(app);
}
