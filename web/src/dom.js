// @ts-check
// Building elements, in one line each.

/**
 * An element with properties, attributes (`aria-…`, `data-…`, `role`, `for`) and children.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} [properties]
 * @param {(Node | string)[]} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes('-') || key === 'role' || key === 'for') made.setAttribute(key, String(value));
    else Object.assign(made, { [key]: value });
  }
  made.append(...children);
  return made;
}

/**
 * The element with this id; the page's own markup has it.
 * @template {HTMLElement} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 */
export function byId(id, type) {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`the page has no ${type.name} #${id}`);
  return found;
}

/** Sets text only when it differs, so that nothing is laid out in vain. @param {Element} where @param {string} text */
export function setText(where, text) {
  if (where.textContent !== text) where.textContent = text;
}

/** @type {Map<string, string>} */
const colours = new Map();
/** An element out of sight whose colour is computed. @type {HTMLElement | null} */
let probe = null;
/** Forgets the colours that were looked up, for another theme. */
export const forgetColours = () => colours.clear();
/** The colour that custom property `name` of the stylesheet stands for in the present theme. @param {string} name */
export function colour(name) {
  const known = colours.get(name);
  if (known) return known;
  if (!probe) document.body.append((probe = element('span', { hidden: true })));
  probe.style.color = `var(${name})`;
  const found = getComputedStyle(probe).color;
  colours.set(name, found);
  return found;
}

const NUMBER = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
const DECIMAL = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });
/** A count with digit groups. @param {number} n */
export const count = (n) => NUMBER.format(n);

/**
 * A number of about three significant digits, for reading; a real minus sign.
 * @param {number} x
 */
export function brief(x) {
  if (!Number.isFinite(x)) return '–';
  const size = Math.abs(x);
  const text = size === 0 ? '0' : size >= 1000 ? NUMBER.format(x) : size >= 1e-5 ? DECIMAL.format(x) : x.toExponential(1);
  return text.replace('-', '−');
}

/**
 * Offers `bytes` as a file.
 * @param {string} name
 * @param {BlobPart} bytes
 * @param {string} type
 */
export function offer(name, bytes, type) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = element('a', { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
