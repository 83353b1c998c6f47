// @ts-check
// Worksheets to print: a lesson's words, its questions with boxes to tick, its words and automata drawn; the key on a page of its own.

import { Client } from '../client.js';
import { element } from '../dom.js';
import { stateName } from '../palette.js';
import { draw } from '../vendor.js';
import { Automaton } from '../views/automaton.js';
import { LESSONS, lesson as named } from './content/index.js';
import { automatonOutcome, instrumentState, wordOutcome } from './experiments.js';
import { isQuestion } from './model.js';
import { frontierName, frontiers, policies, tryAll } from './places.js';
import { picture } from './places_bench.js';
import { prose } from './prose.js';
import { measuredSentence } from './questions.js';
import { withStyle } from './style.js';

/** @typedef {import('./model.js').Lesson} Lesson */
/** @typedef {import('./model.js').Question} Question */
/** @typedef {import('../protocol.js').Description} Description */
/** @typedef {import('../protocol.js').Word} Word */
/** @typedef {import('./experiments.js').Ask} Ask */

/** What is known of a question once the core was asked. @typedef {{ description: Description | null, bore: number, said: string, table: Node | null }} Answer */

/**
 * A word as a table; `states` fills the row of states in, else it stays empty to be written in.
 * @param {Word} word
 * @param {string[]} names
 * @param {string[] | null} states
 */
function wordTable(word, names, states) {
  const cells = (/** @type {(k: number) => string} */ text) => word.letters.map((_, k) => element('td', {}, text(k)));
  return element('table', { className: 'word-table on-paper' },
    element('thead', {},
      element('tr', { className: 'brace' }, element('td', {}), ...(word.back > 0 ? [element('th', { colSpan: word.back, scope: 'colgroup' }, 'once')] : []),
        element('th', { colSpan: word.letters.length - word.back, scope: 'colgroup', className: 'repeats' }, '↻ for ever')),
      element('tr', {}, element('th', { scope: 'row' }, 'step'), ...word.letters.map((_, k) => element('th', { scope: 'col' }, String(k))))),
    element('tbody', {},
      ...names.map((name) => element('tr', {}, element('th', { scope: 'row' }, element('code', {}, name)), ...cells((k) => (word.letters[k].includes(name) ? '●' : '')))),
      element('tr', { className: 'states' }, element('th', { scope: 'row' }, 'state'), ...cells((k) => states?.[k] ?? ''))));
}

/** Asks the core what the key needs. @param {Ask} ask @param {Question} step @returns {Promise<Answer>} */
async function answer(ask, { experiment, bears, key }) {
  const { task, formula, hoa, seed, preset, set } = instrumentState(experiment.state, [], null);
  /** @type {{ description: Description }} */
  const { description } = await ask({ kind: 'open', request: { task, formula: formula || null, hoa: hoa || null, map: null, seed, preset: preset || null, overrides: set } });
  switch (experiment.kind) {
    case 'word': {
      const { word, formulas = [] } = experiment;
      const reading = await ask({ kind: 'read_word', word });
      const others = await Promise.all(formulas.map(async (f) => ({ formula: f, holds: await ask({ kind: 'judge_word', formula: f, word }) })));
      const outcome = wordOutcome(description, reading, word.letters.length, others);
      const names = description.environment.propositions.map((p) => p.name);
      return { description, bore: bears(outcome), said: outcome.words, table: wordTable(word, names, outcome.states.map(stateName)) };
    }
    case 'automaton': {
      const outcome = automatonOutcome(description);
      return { description, bore: bears(outcome), said: outcome.words, table: null };
    }
    case 'policies': {
      const { told, tried } = await tryAll(ask, description);
      const good = tried.filter((t) => t.satisfied).map((t) => told.map((f) => `${frontierName(f)} → ${t.policy[f]}`).join(', '));
      return { description, bore: key, said: good.length > 0 ? `Satisfying: ${good.join('; or ')}.` : `None of the ${tried.length} policies satisfies it.`, table: null };
    }
    default:
      return { description, bore: key, said: '', table: null };
  }
}

/** A blank line to write on. */
const line = () => element('div', { className: 'line' });

/** What a question shows on paper before it is answered. @param {Question} step @param {Description | null} description */
function given({ experiment }, description) {
  if (!description) return [];
  if (experiment.kind === 'word') return [wordTable(experiment.word, description.environment.propositions.map((p) => p.name), null)];
  if (experiment.kind !== 'policies') return [];
  const told = frontiers(description);
  return [picture(), element('p', { className: 'note' }, `Policies: ${policies(told).map((p) => `(${told.map((t) => p[t]).join(', ')})`).join('  ')}${told.length > 1 ? `, where to go from free ground while T is ${told.map(frontierName).join(', ')}` : ', where to go from free ground'}.`)];
}

/** The automaton of a description, drawn. @param {Description} description */
async function drawing(description) {
  const root = element('div', { className: 'graph' });
  document.body.append(root);
  const automaton = new Automaton(root, element('span', {}), draw);
  await automaton.show(description.automaton);
  root.remove();
  return element('figure', { className: 'paper-graph' }, root, element('figcaption', {}, 'Automaton of ', element('code', {}, description.formula.text)));
}

/** @param {Lesson} lesson @param {Ask} ask @param {boolean} withKey */
async function sheet(lesson, ask, withKey) {
  /** @type {(Answer | null)[]} */
  const answers = [];
  for (const step of lesson.steps) answers.push(isQuestion(step) ? await answer(ask, step) : null);
  const items = [];
  let drawn = '';
  for (const [k, step] of lesson.steps.entries()) {
    if (!isQuestion(step)) {
      items.push(element('li', {}, element('p', {}, ...prose(step.try)), line()));
      continue;
    }
    const description = answers[k]?.description ?? null;
    const text = description ? description.hoa : '';
    const graph = description && text !== drawn && step.experiment.kind !== 'automaton' && step.experiment.kind !== 'train' ? [await drawing(description)] : [];
    if (graph.length > 0) drawn = text;
    items.push(element('li', {},
      element('p', { className: 'ask' }, ...prose(step.ask)), ...graph, ...given(step, description),
      element('ul', { className: 'boxes' }, ...step.choices.map((choice) => element('li', {}, '☐ ', ...prose(choice)))),
      element('p', { className: 'note' }, 'What happened, and why?'), line(), line()));
  }
  const page = element('article', { className: 'sheet' },
    element('header', { className: 'sheet-head' }, element('h1', {}, ...prose(lesson.title)), element('p', { className: 'name-line' }, 'Name: ______________________  Date: ____________')),
    element('p', { className: 'aim' }, ...prose(lesson.aim)), ...lesson.words.map((text) => element('p', {}, ...prose(text))), element('ol', { className: 'questions' }, ...items),
    element('p', { className: 'note where' }, `On the screen: ${new URL(`?lesson=${lesson.name}`, location.href).href}`));
  if (!withKey) return [page];
  const keys = lesson.steps.flatMap((step, k) => {
    const found = answers[k];
    if (!isQuestion(step) || !found) return [element('li', {}, 'Nothing to mark.')];
    return [element('li', {}, element('p', {}, element('b', {}, ...prose(step.choices[found.bore]))), ...(found.table ? [found.table] : []),
      ...(found.said ? [element('p', {}, ...prose(found.said))] : []),
      ...(step.experiment.kind === 'train' ? [element('p', { className: 'note' }, `${measuredSentence(`${lesson.name}/${k + 1}`)} A run in class may differ.`)] : []),
      element('p', {}, ...prose(step.why)))];
  });
  return [page, element('article', { className: 'sheet key' }, element('header', { className: 'sheet-head' }, element('h1', {}, 'Key: ', ...prose(lesson.title))), element('ol', { className: 'questions' }, ...keys))];
}

/** Shows worksheets in place of the page. @param {{ worksheet: string, key: boolean }} address */
export async function showWorksheet({ worksheet, key }) {
  await withStyle();
  document.documentElement.dataset.theme = 'light';
  const chosen = worksheet === 'all' ? [...LESSONS] : LESSONS.filter((l) => l.name === worksheet);
  document.title = `${worksheet === 'all' ? 'Worksheets' : `Worksheet: ${named(worksheet)?.title}`} · ltl-rover`;
  const print = element('button', { type: 'button', className: 'primary' }, 'Print');
  print.addEventListener('click', () => window.print());
  const lessonLink = worksheet === 'all' ? element('a', { href: './' }, 'To the instrument') : element('a', { href: `?lesson=${worksheet}` }, 'To the lesson');
  const main = element('main', { className: 'sheets', 'aria-busy': 'true' },
    element('nav', { className: 'row not-printed', 'aria-label': 'Worksheet' }, print, element('a', { href: `?worksheet=${worksheet}${key ? '' : '&key=1'}` }, key ? 'Without the key' : 'With the key'), lessonLink,
      worksheet === 'all' ? '' : element('a', { href: `?worksheet=all${key ? '&key=1' : ''}` }, 'All worksheets')));
  document.body.replaceChildren(main);
  const nothing = () => {};
  const client = new Client(() => new Worker(new URL('../worker.js', import.meta.url), { type: 'module' }), {
    frame: nothing, telemetry: nothing, evaluation: nothing, finished: nothing, broken: (message) => main.append(element('p', { className: 'notice problem' }, `The worksheet could not be made: ${message}`)),
  });
  await client.ready;
  for (const lesson of chosen) main.append(...(await sheet(lesson, (command) => client.ask(command), key)));
  main.removeAttribute('aria-busy');
  client.worker?.terminate();
}
