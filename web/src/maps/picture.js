// @ts-check
// Pictures from outside: recognised by their first bytes, measured before they are decoded, scaled, kept small.

/** The largest picture file, in bytes. */
export const MAX_FILE = 32 << 20;
/** The longest side and the most pixels of a picture that is decoded. */
const [MAX_SIDE, MAX_PIXELS] = [16384, 64e6];
/** The longest side of a picture whose colours are labels, and of one that is shown below them. */
const [LABEL_SIDE, BACKDROP_SIDE] = [1024, 1600];
/** The longest picture in a map file, in bytes before it is written as text. */
const MAX_BACKDROP = 1_200_000;

/** Something wrong with what the user brought, in a sentence. */
export class Unusable extends Error {}

/**
 * What a file of pixels is and how large, from its first bytes; `null` for what is neither PNG, JPEG nor WebP.
 * @param {Uint8Array} bytes
 * @returns {{ type: 'image/png' | 'image/jpeg' | 'image/webp', width: number, height: number } | null}
 */
export function measure(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const ascii = (/** @type {number} */ at, /** @type {number} */ n) => String.fromCharCode(...bytes.subarray(at, at + n));
  if (bytes.length >= 24 && ascii(1, 3) === 'PNG' && view.getUint32(0) === 0x89504e47 && ascii(12, 4) === 'IHDR') {
    return { type: 'image/png', width: view.getUint32(16), height: view.getUint32(20) };
  }
  if (bytes.length >= 30 && ascii(0, 4) === 'RIFF' && ascii(8, 4) === 'WEBP') {
    const three = (/** @type {number} */ at) => view.getUint8(at) | (view.getUint8(at + 1) << 8) | (view.getUint8(at + 2) << 16);
    const size = (/** @type {number} */ width, /** @type {number} */ height) => ({ type: /** @type {const} */ ('image/webp'), width, height });
    if (ascii(12, 4) === 'VP8X') return size(1 + three(24), 1 + three(27));
    if (ascii(12, 4) === 'VP8L') return size(1 + (view.getUint16(21, true) & 0x3fff), 1 + ((view.getUint32(21, true) >>> 14) & 0x3fff));
    if (ascii(12, 4) === 'VP8 ') return size(view.getUint16(26, true) & 0x3fff, view.getUint16(28, true) & 0x3fff);
    return null;
  }
  if (bytes.length >= 4 && view.getUint16(0) === 0xffd8) {
    for (let at = 2; at + 9 <= bytes.length;) {
      if (bytes[at] !== 0xff) return null;
      const marker = bytes[at + 1];
      const frame = marker >= 0xc0 && marker <= 0xcf && marker !== 0xc4 && marker !== 0xc8 && marker !== 0xcc;
      if (frame) return { type: 'image/jpeg', width: view.getUint16(at + 7), height: view.getUint16(at + 5) };
      at += marker === 0xff ? 1 : 2 + view.getUint16(at + 2);
    }
  }
  return null;
}

/**
 * Decodes a picture file.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {string} name
 * @throws {Unusable}
 */
export async function decode(bytes, name) {
  if (bytes.length > MAX_FILE) throw new Unusable(`${name} has ${Math.round(bytes.length / 1e6)} MB; pictures have at most ${MAX_FILE >> 20} MB.`);
  const facts = measure(bytes);
  if (!facts) throw new Unusable(`${name} is no picture that is read here: PNG, WebP and JPEG are.`);
  const { type, width, height } = facts;
  if (width === 0 || height === 0 || Math.max(width, height) > MAX_SIDE || width * height > MAX_PIXELS) {
    throw new Unusable(`${name} has ${width} × ${height} pixels; at most ${MAX_SIDE} on a side and ${MAX_PIXELS / 1e6} million in all are read.`);
  }
  try {
    return await createImageBitmap(new Blob([bytes], { type }), { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  } catch {
    throw new Unusable(`${name} cannot be decoded: the file is damaged or cut off.`);
  }
}

/** @param {ImageBitmap} bitmap @param {number} longest @param {boolean} smooth */
function scaled(bitmap, longest, smooth) {
  const scale = Math.min(1, longest / Math.max(bitmap.width, bitmap.height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(bitmap.width * scale));
  canvas.height = Math.max(1, Math.round(bitmap.height * scale));
  const context = canvas.getContext('2d', { willReadFrequently: !smooth });
  if (!context) throw new Unusable('This browser gives no canvas to draw the picture on.');
  context.imageSmoothingEnabled = smooth;
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  return { canvas, context };
}

/** The pixels of a picture whose colours may be labels, no colour mixed with another. @param {ImageBitmap} bitmap */
export function pixels(bitmap) {
  const { canvas, context } = scaled(bitmap, LABEL_SIDE, false);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

/** A small copy of a picture, to be shown below the labels, as a data URL. @param {ImageBitmap} bitmap */
export async function backdrop(bitmap) {
  for (const [longest, quality] of [[BACKDROP_SIDE, 0.85], [1100, 0.8], [700, 0.7]]) {
    const { canvas } = scaled(bitmap, longest, true);
    for (const type of ['image/webp', 'image/jpeg']) {
      const blob = await new Promise((/** @type {(blob: Blob | null) => void} */ resolve) => canvas.toBlob(resolve, type, quality));
      if (blob?.type !== type || blob.size > MAX_BACKDROP) continue;
      return await new Promise((/** @type {(url: string) => void} */ resolve, reject) => {
        const reader = new FileReader();
        reader.onload = () => resolve(String(reader.result));
        reader.onerror = () => reject(new Unusable('The picture cannot be kept.'));
        reader.readAsDataURL(blob);
      });
    }
  }
  throw new Unusable('The picture cannot be made small enough to be kept with the map.');
}

/**
 * Where the picture of a scene is loaded from: pictures that came with the page lie in `assets`, one's own stands in the map itself.
 * @param {string} picture
 */
export function pictureAddress(picture) {
  return /^data:image\/(png|jpeg|webp);base64,[A-Za-z0-9+/=]*$/.test(picture) ? picture : `assets/${encodeURIComponent(picture)}`;
}
