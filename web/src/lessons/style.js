// @ts-check
// The lessons' stylesheet, loaded when it is first needed.

import { element } from '../dom.js';

/** @type {Promise<void> | null} */
let loaded = null;

/** Resolves once the stylesheet is in force. */
export function withStyle() {
  loaded ??= new Promise((resolve) => {
    const link = element('link', { rel: 'stylesheet', href: new URL('./lessons.css', import.meta.url).href });
    link.addEventListener('load', () => resolve());
    link.addEventListener('error', () => resolve());
    document.head.append(link);
  });
  return loaded;
}
