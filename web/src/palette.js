// @ts-check
// How accepting sets and propositions look: a colour and a shape each, so that neither is needed to tell them apart.

/** Shapes in order; drawn inside a box of side 2 around the origin, as an SVG path. */
const PATHS = Object.freeze([
  'M0-1A1 1 0 0 1 0 1A1 1 0 0 1 0-1Z',
  'M-.88-.88H.88V.88H-.88Z',
  'M0-1 .98.78H-.98Z',
  'M0-1.12 1.12 0 0 1.12-1.12 0Z',
  'M-.34-1H.34V-.34H1V.34H.34V1H-.34V.34H-1V-.34H-.34Z',
  'M0 1-.98-.78H.98Z',
  'M0-1.1.95-.34.59.82H-.59L-.95-.34Z',
  'M-.5-1H.5L1 0 .5 1H-.5L-1 0Z',
]);
/** The shapes' names, for those who hear the page. */
const NAMES = Object.freeze(['circle', 'square', 'triangle', 'diamond', 'cross', 'inverted triangle', 'pentagon', 'hexagon']);
/** How many colours `--set-0 …` the stylesheet has. */
const COLOURS = 6;

/** @param {number} set */
export const shapePath = (set) => PATHS[set % PATHS.length];
/** @param {number} set */
export const shapeName = (set) => NAMES[set % NAMES.length];
/** The name of the stylesheet's colour of set `set`. @param {number} set */
export const colourVariable = (set) => `--set-${set % COLOURS}`;
/** The stylesheet's class that colours set `set`. @param {number} set */
export const colourClass = (set) => `set-${set % COLOURS}`;

const SUBSCRIPT = '₀₁₂₃₄₅₆₇₈₉';
/** @param {number} n */
export const subscript = (n) => String(n).replace(/\d/g, (d) => SUBSCRIPT[Number(d)]);
/** F₁ for set 0: the paper counts from one. @param {number} set */
export const setName = (set) => `F${subscript(set + 1)}`;
/** @param {number} q */
export const stateName = (q) => `q${subscript(q)}`;

/**
 * An SVG element of the shape of set `set`, coloured by class.
 * @param {number} set
 * @param {number} [size]
 */
export function shapeIcon(set, size = 12) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '-1.3 -1.3 2.6 2.6');
  svg.setAttribute('width', String(size));
  svg.setAttribute('height', String(size));
  svg.setAttribute('aria-hidden', 'true');
  svg.classList.add('shape', colourClass(set));
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', shapePath(set));
  svg.append(path);
  return svg;
}
