// @ts-check
// Keep and share: notices, files out, the theme.

import { byId, element, forgetColours, offer } from './dom.js';

/** How long a notice that is no problem stands, in milliseconds. */
const STANDS = 6000;
/** How many notices stand at once. */
const NOTICES = 4;

/** Shows a line above the page. @param {string} text @param {boolean} [problem] */
export function notice(text, problem = false) {
  const close = element('button', { type: 'button', className: 'quiet' }, 'Dismiss');
  const line = element('div', { className: problem ? 'notice problem' : 'notice' }, element('span', {}, text), close);
  close.addEventListener('click', () => line.remove());
  const root = byId('notices', HTMLElement);
  root.append(line);
  while (root.children.length > NOTICES) root.firstElementChild?.remove();
  if (!problem) setTimeout(() => line.remove(), STANDS);
}

/**
 * Wires the buttons that write files from what the page shows.
 * @param {{ name: () => string, csv: () => string, description: () => object | null }} source
 */
export function wireExports({ name, csv, description }) {
  const on = (/** @type {string} */ id, /** @type {() => void} */ act) => byId(id, HTMLButtonElement).addEventListener('click', act);
  on('export-png', () => byId('stage', HTMLCanvasElement).toBlob((blob) => blob && offer(`${name()}.png`, blob, 'image/png')));
  on('export-svg', () => {
    const svg = byId('automaton', HTMLElement).querySelector('svg');
    if (svg) offer(`${name()}.svg`, new XMLSerializer().serializeToString(standingAlone(svg)), 'image/svg+xml');
  });
  on('export-csv', () => offer(`${name()}-curves.csv`, csv(), 'text/csv'));
  on('export-json', () => offer(`${name()}.json`, JSON.stringify(description(), null, 2), 'application/json'));
}

/** Attributes that the stylesheet gives to the drawing, and that a file of its own must carry. */
const CARRIED = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'font-family', 'font-size'];

/** A copy of a drawing that needs no stylesheet. @param {SVGSVGElement} svg */
function standingAlone(svg) {
  const copy = /** @type {SVGSVGElement} */ (svg.cloneNode(true));
  const copies = copy.querySelectorAll('*');
  svg.querySelectorAll('path, polygon, ellipse, text').forEach((original) => {
    const twin = copies[[...svg.querySelectorAll('*')].indexOf(original)];
    const computed = getComputedStyle(original);
    for (const name of CARRIED) twin.setAttribute(name, computed.getPropertyValue(name));
  });
  return copy;
}

/** Goes on to the next theme: as the system, light, dark. */
export function nextTheme() {
  const root = document.documentElement;
  const order = ['system', 'light', 'dark'];
  const next = order[(order.indexOf(root.dataset.theme ?? 'system') + 1) % order.length];
  if (next === 'system') delete root.dataset.theme;
  else root.dataset.theme = next;
  byId('theme', HTMLButtonElement).setAttribute('aria-label', `Theme: ${next === 'system' ? 'as the system' : next}`);
  forgetColours();
}
