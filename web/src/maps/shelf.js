// @ts-check
// Maps of one's own by short keys that stand in a link: a small map is its own key, a large one is kept on this machine under its hash.

/** The longest map that stands in a link, in characters. */
export const MAX_IN_LINK = 9000;
/** The longest map file, in characters: what the core reads. */
const MAX_TEXT = 4 << 20;
/** Keys of maps that do not stand in the link begin with this. */
const KEPT = 'kept.';

/** A key whose map is not to be had; the message is for the user. */
export class NoMap extends Error {}

/** @param {ReadableStream<any>} stream @param {number} longest @returns {Promise<Uint8Array<ArrayBuffer>>} */
async function gather(stream, longest) {
  const reader = stream.getReader();
  /** @type {Uint8Array[]} */
  const parts = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > longest) {
      await reader.cancel();
      throw new RangeError(`the map is longer than ${longest} bytes`);
    }
    parts.push(value);
  }
  const whole = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/** A text, compressed, in characters that a link may have. @param {string} text */
export async function pack(text) {
  const bytes = await gather(new Blob([text]).stream().pipeThrough(new CompressionStream('deflate-raw')), Infinity);
  let binary = '';
  for (let at = 0; at < bytes.length; at += 8192) binary += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

/** The text that `pack` packed. @param {string} packed @returns {Promise<string>} rejects for what `pack` did not make */
export async function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  const text = await gather(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')), MAX_TEXT);
  return new TextDecoder('utf-8', { fatal: true }).decode(text);
}

/** Two 32-bit hashes of a text (FNV-1a with two bases) as 16 hexadecimal digits: a name, no seal. @param {string} text */
export function digest(text) {
  let [a, b] = [0x811c9dc5, 0x01000193];
  for (let k = 0; k < text.length; k++) {
    a = Math.imul(a ^ text.charCodeAt(k), 0x01000193);
    b = Math.imul(b ^ (text.charCodeAt(k) + k), 0x85ebca6b);
  }
  return [a, b].map((n) => (n >>> 0).toString(16).padStart(8, '0')).join('');
}

export class Shelf {
  /** @param {{ putMap: (key: string, text: string) => Promise<unknown>, getMap: (key: string) => Promise<string | null> }} store */
  constructor(store) {
    this.store = store;
    /** The maps of this visit. @type {Map<string, string>} */
    this.texts = new Map();
  }

  /** The key of a map file. @param {string} text */
  async keyOf(text) {
    const packed = text.length > 40 * MAX_IN_LINK ? '' : await pack(text);
    const small = packed !== '' && packed.length <= MAX_IN_LINK;
    const key = small ? packed : KEPT + digest(text);
    this.texts.set(key, text);
    // Where there is no room the map still stands as long as the page does.
    if (!small) await this.store.putMap(key, text).catch(() => {});
    return key;
  }

  /**
   * The map file of a key.
   * @param {string} key
   * @throws {NoMap}
   */
  async textOf(key) {
    const here = this.texts.get(key) ?? (key.startsWith(KEPT) ? await this.store.getMap(key).catch(() => null) : null);
    if (here !== null) return here;
    if (key.startsWith(KEPT)) throw new NoMap('The map of this link was kept on the machine where it was made, and is not here. Ask for its map file (JSON).');
    try {
      return await unpack(key);
    } catch {
      throw new NoMap('The map in this link is damaged.');
    }
  }
}

/** Whether the map of this key stands in the link itself. @param {string} key */
export const inLink = (key) => !key.startsWith(KEPT);
