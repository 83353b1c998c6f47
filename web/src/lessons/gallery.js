// @ts-check
// The "break it" gallery: each card opens the instrument without a part of the method, beside the reason for it, and mended.

import { element, setText } from '../dom.js';
import { notice } from '../keeping.js';
import { BREAKS } from './content/breaks.js';
import { Superseded } from './instrument.js';
import { MEASURED } from './measured.js';
import { prose } from './prose.js';

/** @typedef {import('./content/breaks.js').Break} Break */
/** @typedef {import('./content/breaks.js').Arm} Arm */
/** @typedef {import('./instrument.js').Instrument} Instrument */

/** What was measured of both sides, as a table. @param {Break} each */
export function measuredTable(each) {
  const row = (/** @type {'broken' | 'mended'} */ kind) => {
    const found = MEASURED[`${each.name}/${kind}`];
    const cells = found ? [found.successes.join(', '), found.rounds.map((r) => String(Math.round(r * 10) / 10)).join(', '), found.perfect.map((p) => (p === null ? '–' : `${Math.round(p / 1000)}k`)).join(', ')] : ['–', '–', '–'];
    return element('tr', {}, element('th', { scope: 'row' }, each[kind].label), ...cells.map((c) => element('td', {}, c)));
  };
  const head = (/** @type {string} */ text) => element('th', { scope: 'col' }, text);
  return element('table', { className: 'measured' },
    element('thead', {}, element('tr', {}, element('td', {}), head('successes of 50'), head('rounds'), head('first perfect'))), element('tbody', {}, row('broken'), row('mended')));
}

/**
 * @param {Break} each
 * @param {Instrument} instrument
 */
function card(each, instrument) {
  const bar = element('progress', { max: 1, value: 0, 'aria-label': 'How far the run has come' });
  const barWords = element('span', { className: 'soft number' });
  const barRow = element('div', { className: 'run-progress', hidden: true }, bar, barWords);
  const result = element('div', { className: 'result', role: 'status', 'aria-live': 'polite' });
  /** @param {() => Promise<string>} act */
  const guarded = async (act) => {
    result.replaceChildren();
    barRow.hidden = false;
    bar.removeAttribute('value');
    setText(barWords, '');
    try {
      const words = await act();
      if (words) result.replaceChildren(element('p', {}, element('b', {}, 'What happened. '), ...prose(words)));
    } catch (error) {
      if (!(error instanceof Superseded)) notice(error instanceof Error ? error.message : String(error), true);
    }
    barRow.hidden = true;
  };
  const progress = (/** @type {number} */ done, /** @type {number} */ of, /** @type {string} */ words) => {
    bar.max = Math.max(1, of);
    bar.value = done;
    setText(barWords, words);
  };
  const arm = (/** @type {Arm} */ { label, state, steps, word }, /** @type {boolean} */ mended) => {
    const train = element('button', { type: 'button', className: mended ? 'primary' : '' }, `Train: ${label}`);
    train.addEventListener('click', () => guarded(async () => `${label}. ${(await instrument.run({ kind: 'train', state, steps }, progress)).words}`));
    if (!word) return [train];
    const read = element('button', { type: 'button' }, `Read a word: ${label}`);
    read.addEventListener('click', () => guarded(async () => {
      const { paid } = await instrument.run({ kind: 'word', state, word }, progress);
      return `${label}. Of ${word.letters.filter((l) => l.length > 0).length} visits, ${paid.filter((p) => p > 0).length} ${paid.filter((p) => p > 0).length === 1 ? 'was' : 'were'} paid.`;
    }));
    return [read, train];
  };
  const settings = MEASURED[`${each.name}/broken`]?.settings ?? [];
  return element('section', { className: 'break', id: each.name, 'aria-labelledby': `${each.name}-title` },
    element('h3', { id: `${each.name}-title` }, each.title),
    element('p', {}, element('b', {}, 'What it is for. '), ...prose(each.why)),
    element('p', {}, element('b', {}, 'What was seen. '), ...prose(each.observed)),
    measuredTable(each),
    element('details', { className: 'soft' }, element('summary', {}, 'How it was measured'),
      element('p', { className: 'note' }, `Seeds 1, 2 and 3, one number each; at most ${each.broken.steps.toLocaleString('en')} and ${each.mended.steps.toLocaleString('en')} steps, ended by the first perfect evaluation; then 50 runs. Broken with:`),
      element('ul', { className: 'mono settings-list' }, ...settings.map((s) => element('li', {}, s)))),
    element('div', { className: 'row' }, ...arm(each.broken, false), ...arm(each.mended, true)),
    barRow, result);
}

/**
 * @param {HTMLElement} root
 * @param {Instrument} instrument
 */
export function showGallery(root, instrument) {
  instrument.hide = ['spec', 'compare', 'details'];
  root.append(
    element('header', { className: 'lesson-head' },
      element('p', { className: 'soft' }, 'Gallery'),
      element('h2', { id: 'lesson-title', tabIndex: -1 }, 'Break it'),
      element('p', { className: 'aim' }, 'Four parts of the method, taken out one at a time. Train the broken version, then the mended one, and compare with what was measured beforehand.')),
    ...BREAKS.map((each) => card(each, instrument)),
    element('footer', { className: 'lesson-foot' }, element('p', { className: 'row small' }, element('a', { href: './' }, 'Leave the gallery'))));
}
