// @ts-check
// The lessons' little markup: `…` is code, *…* is stressed, and x_F has its F below the line.

import { element } from '../dom.js';

/**
 * A text in pieces.
 * @param {string} text
 * @returns {{ kind: 'plain' | 'code' | 'stress' | 'sub', text: string }[]}
 */
export function pieces(text) {
  return text.split(/(`[^`]+`|\*[^*]+\*|(?<=[A-Za-zγ])_[A-ZΦ])/).filter(Boolean).map((part) => {
    if (part.startsWith('`')) return { kind: 'code', text: part.slice(1, -1) };
    if (part.startsWith('*') && part.length > 2) return { kind: 'stress', text: part.slice(1, -1) };
    if (/^_[A-ZΦ]$/.test(part)) return { kind: 'sub', text: part.slice(1) };
    return { kind: 'plain', text: part };
  });
}

const TAGS = Object.freeze({ code: 'code', stress: 'em', sub: 'sub' });

/** The nodes of a text. @param {string} text @returns {(Node | string)[]} */
export const prose = (text) => pieces(text).map(({ kind, text: part }) => (kind === 'plain' ? part : element(/** @type {'em'} */ (TAGS[kind]), {}, part)));
