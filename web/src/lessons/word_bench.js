// @ts-check
// An infinite word as a table: a column a letter, the repeated part under a brace; read letter by letter with the automaton beside it.

import { brief, element, setText } from '../dom.js';
import { stateName } from '../palette.js';
import { Frame } from '../protocol.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Word} Word */
/** @typedef {import('../protocol.js').WordReading} WordReading */
/** @typedef {import('../theatre.js').Theatre} Theatre */

/** How long a letter stands when a word is played, in milliseconds. */
const BEAT = 650;

/** Words without motion are shown at their end at once. */
const still = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

export class WordBench {
  /**
   * @param {HTMLElement} root
   * @param {Theatre} theatre
   * @param {(command: import('../protocol.js').Command) => Promise<any>} ask
   */
  constructor(root, theatre, ask) {
    this.root = root;
    this.theatre = theatre;
    this.ask = ask;
    /** @type {Description | null} */
    this.description = null;
    /** @type {Word} */
    this.word = { letters: [[]], back: 0 };
    /** @type {WordReading | null} */
    this.reading = null;
    this.row = 0;
    this.shown = -1;
    this.frame = /** @type {Frame | null} */ (null);
    this.said = element('p', { className: 'word-said', id: 'word-said' });
    this.verdict = element('p', { className: 'word-verdict', role: 'status' });
    const arrow = (/** @type {string} */ d) => {
      const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
      svg.setAttribute('viewBox', '0 0 20 20');
      svg.setAttribute('aria-hidden', 'true');
      const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
      path.setAttribute('d', d);
      svg.append(path);
      return svg;
    };
    this.before = element('button', { type: 'button', className: 'icon', 'aria-label': 'One letter back' }, arrow('M14 4v12L5 10z'));
    this.after = element('button', { type: 'button', className: 'icon', 'aria-label': 'Read the next letter' }, arrow('M6 4v12l9-6z'));
    this.before.addEventListener('click', () => this.go(this.row - 1));
    this.after.addEventListener('click', () => this.go(this.row + 1));
    this.table = element('table', { className: 'word-table' });
    this.note = element('p', { className: 'note' });
    this.formula = element('p', { className: 'word-formula mono' });
    this.read = element('p', { className: 'note' });
    root.append(
      element('header', { className: 'card-head' }, element('h2', { id: 'word-title' }, 'Word'), this.before, this.after),
      element('div', {}, this.formula, this.read),
      element('div', { className: 'word-scroll', tabIndex: 0, role: 'group', 'aria-label': 'The word, letter by letter' }, this.table), this.said, this.verdict, this.note);
    const paint = () => {
      if (!root.hidden || this.frame) this.paint();
      requestAnimationFrame(paint);
    };
    requestAnimationFrame(paint);
  }

  /** Shows a word that is not read yet; nothing with `null`. @param {{ description: Description, word: Word } | null} what */
  show(what) {
    this.root.hidden = what === null;
    this.reading = null;
    this.frame = null;
    this.row = 0;
    this.shown = -1;
    setText(this.verdict, '');
    if (!what) return;
    this.description = what.description;
    this.word = structuredClone(what.word);
    this.frame = this.start(what.description);
    this.lay();
  }

  /** Shows the automaton alone, at its start. @param {Description} description */
  still(description) {
    this.description = description;
    this.frame = this.start(description);
    this.shown = -1;
  }

  /** The moment before the first letter. @param {Description} description */
  start({ layout, automaton }) {
    const frame = new Frame(layout);
    const put = (/** @type {string} */ name, /** @type {number} */ value) => (frame.data[frame.field(name).offset] = value);
    put('q', automaton.initial);
    put('q_before', automaton.initial);
    put('edge', -1);
    put('epsilon', -1);
    put('frontier', 2 ** Math.min(automaton.sets, 16) - 1);
    return frame;
  }

  /** Builds the table for the present word. */
  lay() {
    const { word, description } = this;
    if (!description) return;
    const n = word.letters.length;
    const names = description.environment.propositions.map((p) => p.name);
    setText(this.formula, description.formula.text);
    setText(this.read, `read as ${description.formula.parenthesised}`);
    const cell = (/** @type {string} */ text, /** @type {Record<string, any>} */ more = {}) => element('td', more, text);
    const head = element('thead', {},
      element('tr', { className: 'brace' }, element('td', {}), ...(word.back > 0 ? [element('th', { colSpan: word.back, scope: 'colgroup' }, 'once')] : []),
        element('th', { colSpan: n - word.back, scope: 'colgroup', className: 'repeats' }, '↻ for ever')),
      element('tr', {}, element('th', { scope: 'row' }, 'step'), ...word.letters.map((_, k) => element('th', { scope: 'col', className: 'number' }, String(k)))));
    const rows = names.map((name) => element('tr', {}, element('th', { scope: 'row' }, element('code', {}, name)), ...word.letters.map((letter, k) => this.toggle(name, k, letter.includes(name)))));
    const row = (/** @type {string} */ label, /** @type {string} */ className) =>
      element('tr', { className }, element('th', { scope: 'row' }, label), ...word.letters.map(() => cell('')));
    this.table.classList.toggle('long', n > 6);
    this.table.replaceChildren(head, element('tbody', {}, ...rows, row('state', 'states'), row('paid', 'paid')));
    this.note.textContent = this.reading ? 'Press a field to change the word; it is read again at once.' : '';
    setText(this.said, this.reading ? '' : 'Not read yet.');
  }

  /** @param {string} name @param {number} k @param {boolean} holds */
  toggle(name, k, holds) {
    const button = element('button', { type: 'button', className: 'letter', 'aria-pressed': String(holds), 'aria-label': `${name} at step ${k}`, disabled: this.reading === null });
    button.addEventListener('click', () => this.change(name, k, !holds));
    return element('td', {}, button);
  }

  /** @param {string} name @param {number} k @param {boolean} holds */
  async change(name, k, holds) {
    const { description } = this;
    if (!description) return;
    // Regions that do not overlap are never visited at once.
    const alone = description.environment.scene.body.kind !== 'cart_pole' || name !== 'unsafe';
    const others = holds && alone ? this.word.letters[k].filter((n) => n === 'unsafe') : this.word.letters[k].filter((n) => n !== name);
    this.word.letters[k] = holds ? [...others, name] : others;
    const jumps = this.word.jumps;
    let reading = await this.ask({ kind: 'read_word', word: this.word });
    if (!reading && jumps) reading = await this.ask({ kind: 'read_word', word: { ...this.word, jumps: [] } });
    if (!reading) return;
    this.reading = reading;
    this.lay();
    this.go(reading.rows - 1);
    this.judge();
    /** @type {HTMLElement | null} */ (this.table.querySelector(`[aria-label="${name} at step ${k}"]`))?.focus();
  }

  /**
   * Plays a reading to its end.
   * @param {WordReading} reading
   * @param {() => boolean} wanted   false once something else is to be shown
   */
  async play(reading, wanted) {
    this.reading = reading;
    this.lay();
    const last = Math.max(reading.positions.indexOf(this.word.letters.length - 1), Math.min(reading.rows - 1, this.word.letters.length + 2));
    if (still()) this.go(reading.rows - 1);
    for (let row = 0; !still() && row <= last; row++) {
      if (!wanted()) return;
      this.go(row);
      await new Promise((resolve) => setTimeout(resolve, BEAT));
    }
    if (!wanted()) return;
    this.go(reading.rows - 1);
    this.judge();
  }

  judge() {
    const { reading, description } = this;
    if (!reading || !description) return;
    this.verdict.classList.toggle('holds', reading.satisfied);
    setText(this.verdict, reading.satisfied ? '✓ The formula holds on this word.' : '✗ The formula does not hold on this word.');
  }

  /** @param {number} row */
  go(row) {
    const { reading, description } = this;
    if (!reading || !description) return;
    this.row = Math.max(0, Math.min(row, reading.rows - 1));
    this.frame = new Frame(description.layout).at(reading.data, this.row);
  }

  paint() {
    const { frame, theatre, reading, description } = this;
    if (!frame || !theatre.held || !description) return;
    theatre.show(frame);
    this.before.disabled = !reading || this.row === 0;
    this.after.disabled = !reading || this.row === reading.rows - 1;
    if (!reading || this.shown === this.row) return;
    this.shown = this.row;
    const reader = new Frame(description.layout);
    const cells = (/** @type {string} */ name) => [...this.table.querySelectorAll(`tr.${name} td`)];
    const [states, paid] = [cells('states'), cells('paid')];
    for (const list of [states, paid]) for (const cell of list) setText(cell, '');
    for (let row = 1; row <= this.row; row++) {
      const position = reading.positions[row];
      if (position < 0) continue;
      reader.at(reading.data, row);
      const q = stateName(reader.number('q'));
      if (reader.number('epsilon') >= 0) {
        setText(states[position], `${states[position].textContent}⇢${q}`);
        continue;
      }
      setText(states[position], q);
      const reward = reader.number('reward');
      setText(paid[position], Math.abs(reward) < 1e-9 ? '0' : brief(reward));
    }
    const here = reading.positions[this.row];
    this.table.querySelectorAll('tr').forEach((tr) => [...tr.children].forEach((td, k) => {
      if (!tr.classList.contains('brace')) td.classList.toggle('here', k === here + 1);
    }));
    reader.at(reading.data, this.row);
    const q = stateName(reader.number('q'));
    const jump = reader.number('epsilon');
    if (this.row === 0) setText(this.said, `Before the first letter: in ${q}.`);
    else if (jump >= 0) setText(this.said, `The run jumps to ${q}; no letter is read.`);
    else setText(this.said, `Step ${here} read: ${stateName(reader.number('q_before'))} → ${q}.${description.automaton.states[reader.number('q')].sink ? ' A sink: nothing is accepted from here.' : ''}`);
  }
}
