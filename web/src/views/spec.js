// @ts-check
// The task: which one, its formula with errors at their place as one types, its preset, and the automaton file.

import { element } from '../dom.js';

/** @typedef {import('../protocol.js').Located} Located */
/** @typedef {import('../protocol.js').FormulaFacts} FormulaFacts */
/** @typedef {import('../protocol.js').FormulaVerdict} FormulaVerdict */
/** @typedef {import('../protocol.js').HoaVerdict} HoaVerdict */
/** @typedef {import('../protocol.js').TaskEntry} TaskEntry */
/** @typedef {import('../protocol.js').Description} Description */

/**
 * @typedef {object} SpecActions
 * @property {(text: string) => Promise<FormulaVerdict>} checkFormula
 * @property {(text: string) => Promise<HoaVerdict>} checkHoa
 * @property {(name: string) => void} chooseTask
 * @property {(name: string) => void} choosePreset
 * @property {(text: string) => void} useFormula
 * @property {(text: string) => void} useHoa   empty: the task's own
 * @property {(text: string) => void} saveHoa
 */
/**
 * @typedef {object} SpecPlaces
 * @property {HTMLSelectElement} task
 * @property {HTMLSelectElement} preset
 * @property {HTMLInputElement} formula
 * @property {HTMLElement} mirror
 * @property {HTMLElement} said
 * @property {HTMLElement} words
 * @property {HTMLButtonElement} apply
 * @property {HTMLDetailsElement} hoaPanel
 * @property {HTMLTextAreaElement} hoa
 * @property {HTMLElement} hoaSaid
 * @property {HTMLButtonElement} hoaApply
 * @property {HTMLButtonElement} hoaOwn
 * @property {HTMLButtonElement} hoaSave
 * @property {HTMLInputElement} hoaFile
 */

/** The longest automaton file that is read, in bytes. */
const MAX_FILE = 8_000_000;
/** How long after the last key the text is checked, in milliseconds. */
const PAUSE = 70;

/**
 * The pieces of `text` with the places that are marked, for the mirror behind the field. Overlapping places are cut.
 * @param {string} text
 * @param {{ start: number, end: number, gentle: boolean }[]} places
 * @returns {{ text: string, mark: 'none' | 'firm' | 'gentle' }[]}
 */
export function pieces(text, places) {
  /** @type {{ text: string, mark: 'none' | 'firm' | 'gentle' }[]} */
  const out = [];
  let at = 0;
  for (const place of [...places].sort((a, b) => a.start - b.start)) {
    const start = Math.max(at, Math.min(place.start, text.length));
    // A place of no width, such as the end of the text, still shows.
    const end = Math.max(place.end, start + 1);
    if (place.end < at) continue;
    if (start > at) out.push({ text: text.slice(at, start), mark: 'none' });
    out.push({ text: text.slice(start, end) || ' ', mark: place.gentle ? 'gentle' : 'firm' });
    at = end;
  }
  if (at < text.length) out.push({ text: text.slice(at), mark: 'none' });
  return out;
}

/** An error as one line: where, what, and what to do. @param {Located} error @param {boolean} lines */
export function errorLine(error, lines) {
  const where = lines && error.line > 0 ? `line ${error.line}, column ${error.column}: ` : !lines && error.column > 0 ? `column ${error.column}: ` : '';
  return `${where}${error.message}`;
}

export class Spec {
  /**
   * @param {SpecPlaces} places
   * @param {SpecActions} actions
   */
  constructor(places, actions) {
    this.places = places;
    this.actions = actions;
    this.opened = '';
    this.openedHoa = '';
    this.turn = 0;
    this.timer = 0;
    /** Who hears of texts that were checked, and whether they are what they should be. @type {{ formula: (text: string, sound: boolean) => void, hoa: (text: string, sound: boolean) => void }[]} */
    this.hearers = [];
    const { task, preset, formula, mirror, apply, hoa, hoaApply, hoaOwn, hoaSave, hoaFile, hoaPanel } = places;
    task.addEventListener('change', () => actions.chooseTask(task.value));
    preset.addEventListener('change', () => actions.choosePreset(preset.value));
    formula.addEventListener('input', () => this.soon(() => this.checkFormula()));
    formula.addEventListener('scroll', () => (mirror.scrollLeft = formula.scrollLeft));
    formula.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.useWhatStands();
      if (event.key === 'Escape') this.putFormula(this.opened);
    });
    apply.addEventListener('click', () => actions.useFormula(formula.value));
    hoa.addEventListener('input', () => this.soon(() => this.checkHoa()));
    hoaApply.addEventListener('click', () => actions.useHoa(hoa.value));
    hoaOwn.addEventListener('click', () => actions.useHoa(''));
    hoaSave.addEventListener('click', () => actions.saveHoa(hoa.value));
    hoaFile.addEventListener('change', () => this.readFile(hoaFile.files?.[0]));
    const body = /** @type {HTMLElement} */ (hoa.parentElement);
    for (const kind of ['dragenter', 'dragover']) {
      hoaPanel.addEventListener(kind, (event) => {
        event.preventDefault();
        body.classList.add('over');
      });
    }
    hoaPanel.addEventListener('dragleave', () => body.classList.remove('over'));
    hoaPanel.addEventListener('drop', (event) => {
      event.preventDefault();
      body.classList.remove('over');
      this.readFile(event.dataTransfer?.files[0]);
    });
  }

  /** @param {Spec['hearers'][0]} hearer */
  on(hearer) {
    this.hearers.push(hearer);
  }

  /** Marks doubts that were found after the text was read. @param {{ start: number, end: number, message: string }[]} doubts */
  doubt(doubts) {
    const whole = this.places.formula.value.length;
    this.mark(doubts.filter((d) => d.end - d.start < whole).map((d) => ({ start: d.start, end: d.end, gentle: true })));
  }

  /** @param {() => void} act */
  soon(act) {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(act, PAUSE);
  }

  /** @param {TaskEntry[]} tasks */
  offer(tasks) {
    this.places.task.replaceChildren(...tasks.map((t) => element('option', { value: t.name }, t.title)));
  }

  /** Shows what is open. @param {Description} description */
  show(description) {
    const { task, preset, hoa } = this.places;
    if (![...task.options].some((o) => o.value === description.task.name)) {
      task.append(element('option', { value: description.task.name }, description.task.title));
    }
    task.value = description.task.name;
    preset.replaceChildren(...description.task.presets.map((p) => element('option', { value: p }, p)));
    preset.value = description.task.preset;
    this.opened = description.formula.text;
    this.openedHoa = description.hoa;
    this.putFormula(description.formula.text);
    hoa.value = description.hoa;
    this.places.hoaApply.disabled = true;
    this.sayHoa('');
  }

  /** @param {string} text */
  putFormula(text) {
    this.places.formula.value = text;
    return this.checkFormula();
  }

  /** Uses the formula that stands in the field, if it is one and another than the open one. */
  async useWhatStands() {
    clearTimeout(this.timer);
    await this.checkFormula();
    if (!this.places.apply.disabled) this.actions.useFormula(this.places.formula.value);
  }

  async checkFormula() {
    const turn = ++this.turn;
    const { formula, apply } = this.places;
    const text = formula.value;
    try {
      const verdict = await this.actions.checkFormula(text);
      if (turn !== this.turn) return;
      if (verdict.ok) this.sayFormula(verdict.facts);
      else this.refuse(verdict.error);
      apply.disabled = !verdict.ok || text === this.opened;
      for (const hearer of this.hearers) hearer.formula(text, verdict.ok);
    } catch (error) {
      if (turn === this.turn) this.refuse({ message: String(error), hint: '', field: '', start: 0, end: 0, line: 0, column: 0 });
    }
  }

  /** @param {FormulaFacts} facts */
  sayFormula(facts) {
    const { formula, said, words } = this.places;
    formula.removeAttribute('aria-invalid');
    this.mark(facts.warnings.map((w) => ({ start: w.start, end: w.end, gentle: true })));
    said.classList.remove('bad');
    said.replaceChildren('read as ', element('span', { className: 'echo' }, facts.parenthesised));
    words.replaceChildren(...facts.warnings.flatMap((w, k) => (k ? [element('br'), w.message] : [w.message])));
  }

  /** Shows an error of the formula at its place. @param {Located} error */
  refuse(error) {
    const { formula, said, words } = this.places;
    formula.setAttribute('aria-invalid', 'true');
    this.mark(error.end > 0 || error.column > 0 ? [{ start: error.start, end: error.end, gentle: false }] : []);
    said.classList.add('bad');
    said.replaceChildren(errorLine(error, false));
    words.replaceChildren(error.hint);
  }

  /** @param {{ start: number, end: number, gentle: boolean }[]} places */
  mark(places) {
    const { formula, mirror } = this.places;
    mirror.replaceChildren(...pieces(formula.value, places).map((p) =>
      p.mark === 'none' ? p.text : element('mark', { className: p.mark }, p.text)));
    mirror.style.width = `${formula.clientWidth}px`;
    mirror.scrollLeft = formula.scrollLeft;
  }

  async checkHoa() {
    const { hoa, hoaApply } = this.places;
    const turn = ++this.turn;
    const text = hoa.value;
    if (text.trim() === '') {
      hoaApply.disabled = true;
      return this.sayHoa('');
    }
    try {
      const verdict = await this.actions.checkHoa(text);
      if (turn !== this.turn) return;
      hoaApply.disabled = !verdict.ok || text === this.openedHoa;
      for (const hearer of this.hearers) hearer.hoa(text, verdict.ok);
      if (!verdict.ok) return this.refuseHoa(verdict.error);
      const { states, sets, propositions } = verdict.facts;
      this.sayHoa(`${states} states, ${sets} accepting ${sets === 1 ? 'set' : 'sets'}, propositions ${propositions.join(', ') || '(none)'}`);
    } catch (error) {
      if (turn === this.turn) this.sayHoa(String(error), true);
    }
  }

  /** Shows an error of the automaton file at its place. @param {Located} error */
  refuseHoa(error) {
    this.places.hoaPanel.open = true;
    this.sayHoa(errorLine(error, true) + (error.hint ? ` (${error.hint})` : ''), true);
  }

  /** @param {string} text @param {boolean} [bad] */
  sayHoa(text, bad = false) {
    const { hoa, hoaSaid } = this.places;
    hoaSaid.classList.toggle('bad', bad);
    hoaSaid.textContent = text;
    hoa.toggleAttribute('aria-invalid', bad);
    if (bad) hoa.setAttribute('aria-invalid', 'true');
  }

  /** @param {File | undefined} file */
  async readFile(file) {
    if (!file) return;
    this.places.hoaPanel.open = true;
    if (file.size > MAX_FILE) return this.sayHoa(`${file.name} has ${Math.round(file.size / 1e6)} MB; at most ${MAX_FILE / 1e6} MB are read`, true);
    await this.takeHoa(await file.text());
  }

  /** Puts an automaton file into its field and judges it. @param {string} text */
  async takeHoa(text) {
    this.places.hoaPanel.open = true;
    this.places.hoa.value = text;
    await this.checkHoa();
  }
}
