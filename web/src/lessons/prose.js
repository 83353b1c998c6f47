// @ts-check
// The lessons' little markup: `…` is code, *…* is stressed.

import { element } from '../dom.js';

/**
 * A text in pieces.
 * @param {string} text
 * @returns {{ kind: 'plain' | 'code' | 'stress', text: string }[]}
 */
export function pieces(text) {
  return text.split(/(`[^`]+`|\*[^*]+\*)/).filter(Boolean).map((part) => {
    if (part.startsWith('`')) return { kind: 'code', text: part.slice(1, -1) };
    if (part.startsWith('*') && part.length > 2) return { kind: 'stress', text: part.slice(1, -1) };
    return { kind: 'plain', text: part };
  });
}

/** The nodes of a text. @param {string} text @returns {(Node | string)[]} */
export const prose = (text) => pieces(text).map(({ kind, text: part }) => (kind === 'plain' ? part : element(kind === 'code' ? 'code' : 'em', {}, part)));
