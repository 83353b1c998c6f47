// @ts-check
// Files for tests: pictures with known pixels, and the hostile ones.

import { crc32, deflateSync } from 'node:zlib';

/** @typedef {{ name: string, mimeType: string, buffer: Buffer }} TestFile */

/** @param {string} type @param {Buffer} data */
function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), data]);
  const whole = Buffer.alloc(body.length + 8);
  whole.writeUInt32BE(data.length, 0);
  body.copy(whole, 4);
  whole.writeUInt32BE(crc32(body), body.length + 4);
  return whole;
}

/** The head of a PNG. @param {number} width @param {number} height */
function head(width, height) {
  const data = Buffer.alloc(13);
  data.writeUInt32BE(width, 0);
  data.writeUInt32BE(height, 4);
  data.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from('89504e470d0a1a0a', 'hex'), chunk('IHDR', data)]);
}

/**
 * A PNG.
 * @param {number} width
 * @param {number} height
 * @param {(x: number, y: number) => [number, number, number]} colour
 */
export function png(width, height, colour) {
  const rows = Array.from({ length: height }, (_, y) => Buffer.from([0, ...Array.from({ length: width }, (_, x) => colour(x, y)).flat()]));
  return Buffer.concat([head(width, height), chunk('IDAT', deflateSync(Buffer.concat(rows))), chunk('IEND', Buffer.alloc(0))]);
}

/** A flat picture: green on the left, blue on the right, red in the middle below, white elsewhere. @type {(x: number, y: number) => [number, number, number]} */
export const flat = (x, y) => (x < 12 ? [0, 255, 0] : x >= 48 ? [0, 0, 255] : y > 30 && x > 24 && x < 36 ? [255, 0, 0] : [255, 255, 255]);
/** As many colours as pixels. @type {(x: number, y: number) => [number, number, number]} */
export const shaded = (x, y) => [(x * 4) % 256, (y * 6) % 256, (x * y) % 256];

/** @param {string} name @param {Buffer | string} content @param {string} [mimeType] @returns {TestFile} */
export const file = (name, content, mimeType = 'application/octet-stream') => ({ name, mimeType, buffer: Buffer.from(content) });

const good = png(60, 40, flat);
const pair = '"columns":2,"rows":1';
const map = (/** @type {string} */ body) => `{"name":"m","unit":"m","width":2,"height":1,"reach":1,"labels":[{"name":"a"}],${body}}`;
const record = (/** @type {object} */ metadata) => {
  const header = Buffer.from(JSON.stringify({ __metadata__: metadata }).padEnd(400));
  const length = Buffer.alloc(8);
  length.writeBigUInt64LE(BigInt(header.length));
  return Buffer.concat([length, header]);
};

/** What the editor refuses, and what it says. @type {[TestFile, RegExp][]} */
export const HOSTILE_MAPS = [
  [file('empty.png', ''), /no picture that is read here/],
  [file('cut.png', good.subarray(0, 90)), /damaged or cut off/],
  [file('bomb.png', Buffer.concat([head(60_000, 60_000), chunk('IDAT', deflateSync(Buffer.alloc(1000))), chunk('IEND', Buffer.alloc(0))])), /60000 × 60000/],
  [file('nothing.png', png(0, 0, flat)), /0 × 0/],
  [file('vector.png', '<svg xmlns="http://www.w3.org/2000/svg"><script>alert(1)</script></svg>'), /no picture that is read here/],
  [file('deep.json', '['.repeat(100_000)), /deep.json: line 1/],
  [file('open.json', '{"name": '), /open.json: line 1/],
  [file('type.json', map('"regions": 3')), /invalid type/],
  [file('runs.json', map(`"grid":{${pair},"letters":[[]],"runs":[[0,1]]}`)), /fewer cells/],
  [file('huge.json', map('"grid":{"columns":99999999,"rows":99999999,"letters":[[]],"runs":[]}')), /grid cells/],
  [file('cell.json', map('"cell": 1e-9')), /grid cells/],
  [file('unknown.json', map(`"grid":{${pair},"letters":[["b"]],"runs":[[0,2]]}`)), /no label `b`/],
  [file('nowhere.json', map(`"grid":{${pair},"letters":[["a"]],"runs":[[0,2]]}`)), /nowhere to start/],
  [file('names.json', JSON.stringify({ name: 'm', unit: 'm', width: 2, height: 1, reach: 1, labels: Array.from({ length: 70 }, (_, k) => ({ name: `l${k}` })) })), /64/],
  [file('hands.json', JSON.stringify({ name: 'm', unit: 'm', width: 2, height: 1, reach: 1, labels: Array.from({ length: 40 }, (_, k) => ({ name: `l${k}` })) })), /by hand/],
  [file('image.json', map('"image":{"colours":{}}')), /takes labels from a picture/],
];

/** What “Open…” refuses, and what it says. @type {[TestFile, RegExp][]} */
export const HOSTILE_FILES = [
  [file('empty', ''), /it is empty/],
  [file('noise', Buffer.from(Array.from({ length: 300 }, (_, k) => (k * 197 + 128) % 256))), /cannot be opened/],
  [file('short.safetensors', Buffer.from([200, 0, 0, 0, 0, 0, 0, 0, 0x7b, 0x7d])), /cannot be opened/],
  [file('bare.safetensors', record({})), /`format` is missing/],
  [file('other.safetensors', record({ format: 'another' })), /its format is `another`/],
  [file('task.safetensors', record({ format: 'ltl-rover checkpoint 1', task_name: 'x', task: 'x = 1', preset: 'fast', settings: '', seed: '1' })), /x/],
  [file('seed.safetensors', record({ format: 'ltl-rover checkpoint 1', task_name: 'x', task: '', preset: '', settings: '', seed: '-1' })), /`-1` is no seed/],
  [file('odd.json', '{"what": 1}'), /no map and no description/],
  [file('broken.json', '{"what": '), /no JSON/],
  [file('request.json', '{"layout": {}, "request": {"task": "<script>", "formula": 7, "seed": -4, "overrides": {"x": {}}}}'), /no built-in task/],
  [file('task.toml', '[environment]\nname = "moon"\n[specification]\nltl = "F a"\n'), /missing field|moon/],
];
