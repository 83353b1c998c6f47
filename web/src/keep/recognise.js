// @ts-check
// What a file is, by its content: whatever is dropped or opened goes where it belongs, whatever it is called.

import { measure } from '../maps/picture.js';

/** The longest file that is opened, in bytes: the largest checkpoint. */
export const MAX_FILE = 400_000_000;
/** The longest text, in bytes. */
const MAX_TEXT = 4 << 20;

/**
 * @typedef {{ kind: 'checkpoint' } | { kind: 'picture' } | { kind: 'hoa' | 'map' | 'task' | 'formula', text: string }
 *   | { kind: 'description', request: Record<string, unknown> } | { kind: 'unknown', why: string }} Recognised
 */

/**
 * @param {Uint8Array} bytes
 * @returns {Recognised}
 */
export function recognise(bytes) {
  if (bytes.length === 0) return { kind: 'unknown', why: 'it is empty' };
  if (measure(bytes)) return { kind: 'picture' };
  if (bytes.length > 9) {
    const header = new DataView(bytes.buffer, bytes.byteOffset, 8).getBigUint64(0, true);
    if (header > 1n && header <= BigInt(bytes.length - 8) && bytes[8] === 0x7b) return { kind: 'checkpoint' };
  }
  if (bytes.length > MAX_TEXT) return { kind: 'unknown', why: `it is no checkpoint and no picture, and too long (${Math.round(bytes.length / 1e6)} MB) for anything else` };
  let text;
  try {
    text = new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return { kind: 'unknown', why: 'it is no text, no picture (PNG, WebP, JPEG) and no checkpoint' };
  }
  if (/^HOA\s*:/.test(withoutComments(text))) return { kind: 'hoa', text };
  if (text.trimStart().startsWith('{')) return json(text);
  if (/^\[environment\]/m.test(text) && /^\[specification\]/m.test(text)) return { kind: 'task', text };
  const line = text.trim();
  if (line.length > 0 && line.length <= 2000 && !line.includes('\n')) return { kind: 'formula', text: line };
  return { kind: 'unknown', why: 'it is no checkpoint, automaton (HOA), map (JSON), picture, task file (TOML) or formula' };
}

/** The text from its first word that stands in no comment. @param {string} text */
function withoutComments(text) {
  let rest = text.trimStart();
  while (rest.startsWith('/*')) {
    const end = rest.indexOf('*/');
    if (end < 0) return '';
    rest = rest.slice(end + 2).trimStart();
  }
  return rest;
}

/** @param {string} text @returns {Recognised} */
function json(text) {
  let value;
  try {
    value = JSON.parse(text);
  } catch (error) {
    return { kind: 'unknown', why: `it is no JSON: ${error instanceof Error ? error.message : error}` };
  }
  if ('layout' in value && typeof value.request === 'object' && value.request !== null) return { kind: 'description', request: value.request };
  if ('labels' in value || 'regions' in value || 'grid' in value) return { kind: 'map', text };
  return { kind: 'unknown', why: 'it is JSON, but no map and no description of a run' };
}
