// @ts-check
// The lower panels: statistics of the modules, the hyper-parameters in force, an evaluation as it fills.

import { brief, count, element } from '../dom.js';

/** @typedef {import('../protocol.js').ModuleStatistics} ModuleStatistics */
/** @typedef {import('../protocol.js').EvaluationProgress} EvaluationProgress */
/** @typedef {import('../protocol.js').Setting} Setting */

/** @param {string[]} heads @param {(string | Node)[][]} rows */
function table(heads, rows) {
  return element('table', {},
    element('thead', {}, element('tr', {}, ...heads.map((h) => element('th', { scope: 'col' }, h)))),
    element('tbody', {}, ...rows.map((cells) => element('tr', {}, ...cells.map((c) => element('td', {}, c))))));
}

/** A number with a bar beneath it. @param {number} part  0 … 1 @param {string} text */
function bar(part, text) {
  const fill = element('i');
  fill.style.width = `${Math.round(part * 100)}%`;
  return element('span', { className: 'barred' }, text, element('span', { className: 'bar-track', 'aria-hidden': 'true' }, fill));
}

export class Modules {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.last = '';
  }

  /** @param {ModuleStatistics[]} modules */
  update(modules) {
    const full = (/** @type {ModuleStatistics} */ m) => Math.round((100 * m.replay) / Math.max(1, m.capacity));
    const text = JSON.stringify(modules);
    if (text === this.last) return;
    this.last = text;
    const most = Math.max(1, ...modules.map((m) => m.visits));
    const rows = modules.map((m) => [m.name, bar(m.visits / most, count(m.visits)), bar(full(m) / 100, `${full(m)} %`), count(m.updates), brief(m.critic), brief(m.actor)]);
    this.root.replaceChildren(table(['module', 'visits', 'replay', 'updates', 'critic', 'actor'], rows));
  }
}

export class Settings {
  /**
   * @param {HTMLElement} root
   * @param {(key: string, value: string) => void} change  asks for another value: the task is opened anew with it
   */
  constructor(root, change) {
    this.root = root;
    this.change = change;
  }

  /** @param {Setting[]} settings @param {Record<string, string>} overrides */
  show(settings, overrides) {
    /** @type {HTMLTableRowElement[]} */
    const rows = [];
    let section = '';
    const sectionOf = (/** @type {Setting} */ { key }) => key.slice(0, key.lastIndexOf('.'));
    for (const { key, value } of [...settings].sort((a, b) => sectionOf(a).localeCompare(sectionOf(b)))) {
      const at = key.lastIndexOf('.');
      if (key.slice(0, at) !== section) {
        section = key.slice(0, at);
        rows.push(element('tr', {}, element('th', { scope: 'colgroup', colSpan: 2 }, section.replaceAll('.', ' › '))));
      }
      const input = element('input', { type: 'text', value, spellcheck: false, autocomplete: 'off', 'aria-label': key, className: key in overrides ? 'changed' : '' });
      input.addEventListener('change', () => this.change(key, input.value.trim()));
      rows.push(element('tr', {}, element('td', {}, key.slice(at + 1)), element('td', {}, input)));
    }
    this.root.replaceChildren(element('table', {}, element('tbody', {}, ...rows)));
  }
}

/** @param {number} share */
export const percent = (share) => `${brief(Math.round(share * 1000) / 10)} %`;

export class Evaluation {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.clear();
  }

  clear() {
    this.root.replaceChildren(element('p', { className: 'note' }, 'Greedy episodes with fresh starts: how many satisfy the task, with a 95 % Clopper–Pearson interval.'));
  }

  /** @param {EvaluationProgress} progress */
  update(progress) {
    const { runs, wanted, successes, low, high } = progress;
    const band = element('div', { className: 'band' });
    band.style.left = `${low * 100}%`;
    band.style.width = `${(high - low) * 100}%`;
    const point = element('div', { className: 'point' });
    point.style.left = `calc(${(runs > 0 ? successes / runs : 0) * 100}% - 1.5px)`;
    this.root.replaceChildren(
      element('p', { className: 'verdict', role: runs === wanted ? 'status' : 'presentation' }, `${successes} of ${runs} runs succeed`),
      element('div', { className: 'interval', role: 'img', 'aria-label': `95 % interval from ${percent(low)} to ${percent(high)}` }, band, point),
      element('dl', { className: 'facts' },
        element('dt', {}, '95 % interval'), element('dd', {}, `${percent(low)} to ${percent(high)}`),
        element('dt', {}, 'rounds, mean'), element('dd', {}, brief(progress.rounds_mean)),
        element('dt', {}, 'ended in a sink'), element('dd', {}, percent(progress.sink_rate)),
        element('dt', {}, 'runs'), element('dd', {}, `${runs} of ${wanted}, seed ${progress.seed}`)));
  }
}
