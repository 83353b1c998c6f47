// @ts-check
// The world of three places, and a table of all its deterministic policies; each row can be read as a word.

import { element, setText } from '../dom.js';
import { frontierName, frontiers, policies } from './places.js';

/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('./places.js').Policy} Policy */
/** @typedef {import('../protocol.js').Word} Word */

const BEAT = 420;
const still = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
const SVG = 'http://www.w3.org/2000/svg';

/** @param {string} name @param {Record<string, string | number>} attributes @param {(Node | string)[]} children */
function shape(name, attributes, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

/** The three places as a picture. */
export function picture() {
  const place = (/** @type {number} */ x, /** @type {string} */ label, /** @type {string} */ more) =>
    shape('g', { class: `place ${more}` }, shape('circle', { cx: x, cy: 44, r: 30 }), shape('text', { x, y: 49, 'text-anchor': 'middle' }, label));
  const way = (/** @type {number} */ from, /** @type {number} */ to, /** @type {number} */ bend) => {
    const [a, b] = from < to ? [from + 27, to - 27] : [from - 27, to + 27];
    return shape('path', { d: `M${a} ${44 + bend * 0.4}Q${(a + b) / 2} ${44 + bend} ${b} ${44 + bend * 0.4}`, class: 'way', 'marker-end': 'url(#way-end)' });
  };
  return shape('svg', { viewBox: '0 0 320 88', role: 'img', 'aria-label': 'Free ground in the middle, region 1 on the left, region 2 on the right; ways lead from free ground to each and back' },
    shape('defs', {}, shape('marker', { id: 'way-end', viewBox: '0 0 8 8', refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: 'auto' }, shape('path', { d: 'M0 0 8 4 0 8z', class: 'way-head' }))),
    way(160, 45, -26), way(45, 160, 26), way(160, 275, -26), way(275, 160, 26),
    place(45, 'r1', 'set-0'), place(160, 'free', ''), place(275, 'r2', 'set-1'));
}

/** The run of a word, place by place. @param {Word} word */
const runOf = ({ letters, back }) => {
  const name = (/** @type {string[]} */ letter) => letter[0] ?? '·';
  const once = letters.slice(0, back).map(name);
  return `${once.length > 0 ? `${once.join(' ')} ` : ''}(${letters.slice(back).map(name).join(' ')})↻`;
};

export class PlacesBench {
  /**
   * @param {HTMLElement} root
   * @param {(word: Word) => void} read   reads a word beside the automaton
   */
  constructor(root, read) {
    this.root = root;
    this.read = read;
    this.table = element('table', { className: 'policies' });
    root.append(
      element('header', { className: 'card-head' }, element('h2', { id: 'places-title' }, 'Three places')),
      picture(),
      element('p', { className: 'note' }, 'Every row is a deterministic policy: where it goes from free ground. From a region it goes back. In a run, · is free ground, and the part in parentheses repeats.'),
      element('div', { className: 'word-scroll', tabIndex: 0, role: 'group', 'aria-label': 'All deterministic policies' }, this.table));
  }

  /** Shows the policies of a product, not tried yet; nothing with `null`. @param {Description | null} description */
  show(description) {
    this.root.hidden = description === null;
    if (description) this.lay(frontiers(description), policies(frontiers(description)).map((policy) => ({ policy, word: null, satisfied: null })));
  }

  /** @param {readonly number[]} told @param {{ policy: Policy, word: Word | null, satisfied: boolean | null }[]} rows */
  lay(told, rows) {
    const body = rows.map(({ policy, word, satisfied }, k) => {
      const verdict = element('td', { className: 'verdict-cell' });
      const run = element('td', { className: 'mono run' });
      const row = element('tr', {}, element('th', { scope: 'row' }, String(k + 1)), ...told.map((t) => element('td', { className: 'mono' }, `→ ${policy[t]}`)), run, verdict);
      this.fill(row, word, satisfied);
      return row;
    });
    const head = (/** @type {string | Node} */ text, /** @type {Record<string, any>} */ more = {}) => element('th', { scope: 'col', ...more }, text);
    const wide = told.length > 1 ? { rowSpan: 2 } : {};
    this.table.replaceChildren(
      element('thead', {},
        element('tr', {}, head(element('span', { className: 'unseen' }, 'policy'), wide),
          head(told.length > 1 ? 'from free ground, when T is' : 'from free ground', { colSpan: told.length, scope: told.length > 1 ? 'colgroup' : 'col' }), head('its run', wide), head('holds', wide)),
        ...(told.length > 1 ? [element('tr', {}, ...told.map((t) => head(frontierName(t).replace(', ', ','))))] : [])),
      element('tbody', {}, ...body));
  }

  /** @param {HTMLTableRowElement} row @param {Word | null} word @param {boolean | null} satisfied */
  fill(row, word, satisfied) {
    const [run, verdict] = [...row.cells].slice(-2);
    if (!word || satisfied === null) {
      setText(run, '');
      setText(verdict, '?');
      return;
    }
    const button = element('button', { type: 'button', className: 'quiet reads', title: 'Read this run beside the automaton' }, runOf(word));
    button.addEventListener('click', () => this.read(word));
    run.replaceChildren(button);
    setText(verdict, satisfied ? '✓ yes' : '✗ no');
    row.classList.toggle('holds', satisfied);
  }

  /**
   * Fills in the runs, row by row.
   * @param {readonly number[]} told
   * @param {{ policy: Policy, word: Word, satisfied: boolean }[]} tried
   * @param {() => boolean} wanted
   */
  async play(told, tried, wanted) {
    this.lay(told, tried.map(({ policy }) => ({ policy, word: null, satisfied: null })));
    const rows = /** @type {HTMLTableRowElement[]} */ ([...this.table.tBodies[0].rows]);
    for (const [k, { word, satisfied }] of tried.entries()) {
      if (!wanted()) return;
      this.fill(rows[k], word, satisfied);
      if (!still()) await new Promise((resolve) => setTimeout(resolve, BEAT));
    }
  }
}
