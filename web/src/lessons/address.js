// @ts-check
// What a lesson's address may say. In the query, because the part behind # is the instrument's own and follows it.

import { BREAKS } from './content/breaks.js';
import { LESSONS } from './content/index.js';

/**
 * @typedef {object} Address
 * @property {string} lesson      name of a lesson; empty: none
 * @property {number} step        the step to begin with, from 1; 0: where this reader left off
 * @property {string} gallery     the card of the "break it" gallery, or `1` for the gallery from its top; empty: none
 * @property {string} worksheet   name of a lesson, or `all`; empty: none
 * @property {boolean} key        whether the worksheet comes with its key
 * @property {number | null} seed the seed of every run
 * @property {string[]} hide      what is not shown
 * @property {string[]} lock      what cannot be changed
 */

/** What can be hidden: the name in the address, and where it is in the page. @type {Readonly<Record<string, string>>} */
export const PARTS = Object.freeze({
  spec: '#spec-panel', hoa: '#hoa-panel', stage: '#stage-panel', watch: '#watch', layers: '#layers', map: '#paint-map', transport: '.transport', timeline: '#timeline',
  kept: '#kept-panel', automaton: '#automaton-panel', frontier: '.chips-row', reward: '.reward', training: '#training-panel', curves: '#curves', seed: '.seed, #new-seed',
  compare: '#compare-panel', details: '#details-panel', evaluation: '#details-panel > :has(#evaluation)', modules: '#details-panel > :has(#modules)',
  settings: '#details-panel > :has(#settings)', files: '#details-panel > :has(#save)', share: '#share', help: '#help-open', lessons: '#lessons-open',
});

/** What can be locked: the name in the address, and the controls behind it. @type {Readonly<Record<string, string>>} */
export const LOCKS = Object.freeze({
  task: '#task', formula: '#formula, #formula-apply', hoa: '#hoa, #hoa-apply, #hoa-own, #hoa-file', preset: '#preset', seed: '#seed, #new-seed',
  settings: '#settings input, #settings select, #settings-own', map: '#paint-map', files: '#load',
});

/** @type {Address} */
export const NOWHERE = Object.freeze({ lesson: '', step: 0, gallery: '', worksheet: '', key: false, seed: null, hide: [], lock: [] });

/** @param {string} text @param {Readonly<Record<string, string>>} names */
function list(text, names) {
  const parts = text.split(',').filter(Boolean);
  const wrong = parts.find((part) => !Object.hasOwn(names, part));
  return wrong === undefined ? { parts } : { problem: `has “${wrong.slice(0, 40)}”, which is none of ${Object.keys(names).join(', ')}` };
}

/**
 * Reads the query of an address. What is wrong keeps its default and is reported; what others read is left alone.
 * @param {string} search
 * @returns {{ address: Address, problems: { property: string, message: string }[] }}
 */
export function readAddress(search) {
  /** @type {Address} */
  const address = { ...NOWHERE };
  /** @type {{ property: string, message: string }[]} */
  const problems = [];
  const tell = (/** @type {string} */ property, /** @type {string} */ message) => problems.push({ property, message });
  if (search.length > 2000) return { address, problems: [{ property: 'query', message: 'is longer than 2000 characters; nothing of it was used' }] };
  const given = new URLSearchParams(search);
  const names = LESSONS.map((l) => l.name);
  for (const [property, text] of given) {
    const shown = text.slice(0, 40);
    switch (property) {
      case 'lesson':
      case 'worksheet':
        if (names.includes(text) || (property === 'worksheet' && text === 'all')) address[property] = text;
        else tell(property, `is “${shown}”, which is none of ${names.join(', ')}`);
        break;
      case 'step':
        if (/^[1-9]\d?$/.test(text)) address.step = Number(text);
        else tell(property, `is “${shown}”, which is not a number from 1 on`);
        break;
      case 'seed':
        if (/^\d{1,16}$/.test(text) && Number(text) <= Number.MAX_SAFE_INTEGER) address.seed = Number(text);
        else tell(property, `is “${shown}”, which is not a whole number from 0 to ${Number.MAX_SAFE_INTEGER}`);
        break;
      case 'gallery':
        if (text === '1' || BREAKS.some((b) => b.name === text)) address.gallery = text;
        else tell(property, `is “${shown}”, which is neither 1 nor one of ${BREAKS.map((b) => b.name).join(', ')}`);
        break;
      case 'key':
        if (text === '1' || text === '0') address.key = text === '1';
        else tell(property, `is “${shown}”, which is neither 1 nor 0`);
        break;
      case 'hide':
      case 'lock': {
        const names = property === 'hide' ? PARTS : LOCKS;
        const { parts, problem } = property === 'lock' && text === 'all' ? { parts: Object.keys(LOCKS), problem: undefined } : list(text, names);
        if (parts) address[property] = parts;
        else tell(property, problem ?? '');
        break;
      }
    }
  }
  return { address, problems };
}

/** The address of another lesson; what the teacher has fixed stays. @param {string} name */
export function lessonAddress(name) {
  const search = new URLSearchParams(location.search);
  for (const left of ['step', 'gallery', 'worksheet', 'key']) search.delete(left);
  search.set('lesson', name);
  return `?${search}`;
}
