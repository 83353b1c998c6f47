// @ts-check
// Completes propositions in the formula: a small list below the field, with what each of them means.

import { element } from '../dom.js';

/** @typedef {import('../protocol.js').Proposition} Proposition */

/** Letters that are operators, not beginnings of names. */
const OPERATORS = /^[GFXUWRM]$/;

/**
 * The name that is being typed at `caret`: where it begins, and what stands of it. `null` where none is.
 * @param {string} text
 * @param {number} caret
 */
export function wordAt(text, caret) {
  const found = /[A-Za-z_][A-Za-z0-9_]*$/.exec(text.slice(0, caret));
  if (!found || OPERATORS.test(found[0]) || /[A-Za-z0-9_]/.test(text[caret] ?? '')) return null;
  return { start: found.index, typed: found[0] };
}

/**
 * The propositions that `typed` may become, those that begin so first; none if it is one already.
 * @param {Proposition[]} propositions
 * @param {string} typed
 */
export function completions(propositions, typed) {
  const low = typed.toLowerCase();
  if (propositions.some(({ name }) => name === typed)) return [];
  const begins = propositions.filter(({ name }) => name.toLowerCase().startsWith(low));
  const holds = propositions.filter((p) => !begins.includes(p) && p.name.toLowerCase().includes(low));
  return [...begins, ...holds];
}

export class Completion {
  /**
   * @param {HTMLInputElement} field
   * @param {HTMLElement} list    the listbox
   * @param {HTMLElement} chips   where all propositions stand, to be put in by a click
   */
  constructor(field, list, chips) {
    this.field = field;
    this.list = list;
    this.chips = chips;
    /** @type {Proposition[]} */
    this.propositions = [];
    /** @type {Proposition[]} */
    this.offered = [];
    this.active = -1;
    field.setAttribute('role', 'combobox');
    field.setAttribute('aria-autocomplete', 'list');
    field.setAttribute('aria-controls', list.id);
    field.setAttribute('aria-expanded', 'false');
    field.addEventListener('input', () => this.offer(false));
    field.addEventListener('blur', () => this.close());
    // Before the field's own keys: what the list takes, the field does not see.
    field.addEventListener('keydown', (event) => {
      if (this.key(event)) {
        event.preventDefault();
        event.stopImmediatePropagation();
      }
    }, { capture: true });
  }

  /** @param {Proposition[]} propositions */
  set(propositions) {
    this.propositions = propositions;
    this.chips.replaceChildren(...propositions.map((proposition) => {
      const chip = element('button', { type: 'button', className: 'small', title: proposition.meaning }, proposition.name);
      chip.addEventListener('click', () => this.insert(proposition.name));
      return chip;
    }));
    this.close();
  }

  /** @param {boolean} all  whether all are offered where no name is being typed */
  offer(all) {
    const word = wordAt(this.field.value, this.field.selectionStart ?? 0);
    this.show(word ? completions(this.propositions, word.typed) : all ? this.propositions : []);
  }

  /** @param {Proposition[]} offered */
  show(offered) {
    this.offered = offered;
    this.active = -1;
    this.list.hidden = offered.length === 0;
    this.field.setAttribute('aria-expanded', String(offered.length > 0));
    this.field.removeAttribute('aria-activedescendant');
    this.list.replaceChildren(...offered.map(({ name, meaning }, k) => {
      const option = element('li', { id: `completion-${k}`, role: 'option', 'aria-selected': 'false' }, element('b', {}, name), element('span', {}, meaning));
      // Before the field loses the focus.
      option.addEventListener('pointerdown', (event) => {
        event.preventDefault();
        this.take(k);
      });
      return option;
    }));
  }

  close() {
    if (!this.list.hidden) this.show([]);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.key === ' ' && event.ctrlKey) {
      this.offer(true);
      return true;
    }
    if (this.offered.length === 0) return false;
    if (event.key === 'ArrowDown' || event.key === 'ArrowUp') {
      const n = this.offered.length;
      this.activate((this.active + (event.key === 'ArrowDown' ? 1 : this.active < 0 ? 0 : -1) + n) % n);
      return true;
    }
    if (event.key === 'Escape') {
      this.close();
      return true;
    }
    if ((event.key === 'Enter' || event.key === 'Tab') && this.active >= 0) {
      this.take(this.active);
      return true;
    }
    return false;
  }

  /** @param {number} k */
  activate(k) {
    this.active = k;
    [...this.list.children].forEach((option, j) => option.setAttribute('aria-selected', String(j === k)));
    this.list.children[k]?.scrollIntoView({ block: 'nearest' });
    this.field.setAttribute('aria-activedescendant', `completion-${k}`);
  }

  /** @param {number} k */
  take(k) {
    const caret = this.field.selectionStart ?? this.field.value.length;
    const word = wordAt(this.field.value, caret);
    this.put(word ? word.start : caret, caret, this.offered[k].name);
  }

  /** Puts a name in where the caret is, with blanks around it where letters stand. @param {string} name */
  insert(name) {
    const { value } = this.field;
    const [from, to] = [this.field.selectionStart ?? value.length, this.field.selectionEnd ?? value.length];
    const before = /[A-Za-z0-9_]$/.test(value.slice(0, from)) ? ' ' : '';
    const after = /^[A-Za-z0-9_]/.test(value.slice(to)) ? ' ' : '';
    this.put(from, to, before + name + after);
  }

  /** @param {number} from @param {number} to @param {string} text */
  put(from, to, text) {
    this.field.setRangeText(text, from, to, 'end');
    this.close();
    this.field.focus();
    this.field.dispatchEvent(new Event('input', { bubbles: true }));
    this.close();
  }
}
