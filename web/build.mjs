// @ts-check
// Assembles the page into web/dist: sources, WebAssembly, libraries, fonts, assets, the drawings of the automata that come with it, and
// the offline worker with its list of files. Prints what a first visit transfers, and fails when that is too much.
// usage: node build.mjs [--mock] [--quick] [--out DIR]
//   --mock   the scripted stand-in instead of the WebAssembly, for tests of the views
//   --quick  the WebAssembly as the compiler made it, not optimised further

import { execFile } from 'node:child_process';
import { createHash } from 'node:crypto';
import { cp, mkdir, readFile, readdir, rename, rm, stat, writeFile } from 'node:fs/promises';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs, promisify } from 'node:util';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { bakeDrawings } from './bake.mjs';
import { initialState } from './src/state.js';

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({ options: { mock: { type: 'boolean', default: false }, quick: { type: 'boolean', default: false }, out: { type: 'string', default: join(here, 'dist') } } });
const out = values.out;
const modules = join(here, 'node_modules');

/** @param {string} path */
const exists = (path) => stat(path).then(() => true, () => false);
/** @param {string} from @param {string} to */
const copy = (from, to) => cp(join(here, from), join(out, to), { recursive: true });

/** What the module may use: what every browser since 2021 has. */
const FEATURES = ['bulk-memory', 'multivalue', 'mutable-globals', 'nontrapping-float-to-int', 'reference-types', 'sign-ext', 'simd'];

/**
 * The module after binaryen's optimiser, kept beside it under a name that changes with its content.
 * @param {string} file
 */
async function optimised(file) {
  const name = createHash('sha256').update(await readFile(file)).digest('hex').slice(0, 16);
  if (values.quick) return file;
  const made = join(dirname(file), `optimised-${name}.wasm`);
  if (!(await exists(made))) {
    for (const old of await readdir(dirname(file))) if (old.startsWith('optimised-')) await rm(join(dirname(file), old));
    console.log('page: optimising the WebAssembly module (half a minute)');
    const flags = FEATURES.map((feature) => `--enable-${feature}`);
    await promisify(execFile)(process.execPath, [join(modules, 'binaryen/bin/wasm-opt'), '-O3', ...flags, file, '-o', `${made}.part`]);
    await rename(`${made}.part`, made);
  }
  return made;
}

await rm(out, { recursive: true, force: true });
await mkdir(join(out, 'vendor'), { recursive: true });
await copy('index.html', 'index.html');
await copy('style.css', 'style.css');
await copy('src', 'src');
await copy('static', '.');

if (values.mock) {
  await mkdir(join(out, 'pkg'));
  await copy('tests/mock/ltl_rover.js', 'pkg/ltl_rover.js');
} else {
  if (!(await exists(join(here, 'pkg/ltl_rover_bg.wasm')))) throw new Error('web/pkg is missing: run `make wasm` first');
  await copy('pkg/ltl_rover.js', 'pkg/ltl_rover.js');
  await cp(await optimised(join(here, 'pkg/ltl_rover_bg.wasm')), join(out, 'pkg/ltl_rover_bg.wasm'));
}

// uPlot is shipped as a script; one line makes a module of it.
await writeFile(join(out, 'vendor/uplot.js'), (await readFile(join(modules, 'uplot/dist/uPlot.iife.min.js'), 'utf8')) + '\nexport default uPlot;\n');
await cp(join(modules, 'uplot/dist/uPlot.min.css'), join(out, 'vendor/uplot.css'));
await cp(join(modules, '@viz-js/viz/dist/viz.js'), join(out, 'vendor/viz.js'));
for (const [library, name] of [['uplot', 'uplot'], ['@viz-js/viz', 'viz'], ['@fontsource-variable/ibm-plex-sans', 'ibm-plex-sans'], ['@fontsource/ibm-plex-mono', 'ibm-plex-mono']]) {
  for (const file of ['LICENSE', 'LICENSE.md']) {
    if (await exists(join(modules, library, file))) await cp(join(modules, library, file), join(out, `vendor/LICENSE-${name}.txt`));
  }
}
await mkdir(join(out, 'fonts'));
await cp(join(modules, '@fontsource-variable/ibm-plex-sans/files/ibm-plex-sans-latin-wght-normal.woff2'), join(out, 'fonts/ibm-plex-sans.woff2'));
await cp(join(modules, '@fontsource/ibm-plex-mono/files/ibm-plex-mono-latin-400-normal.woff2'), join(out, 'fonts/ibm-plex-mono.woff2'));
await cp(join(modules, '@fontsource/ibm-plex-mono/files/ibm-plex-mono-latin-500-normal.woff2'), join(out, 'fonts/ibm-plex-mono-500.woff2'));
if (await exists(join(here, '../assets'))) await cp(join(here, '../assets'), join(out, 'assets'), { recursive: true });

// The tasks whose trained policies come along.
const policies = await readdir(join(out, 'assets/policies')).catch(() => /** @type {string[]} */ ([]));
await writeFile(join(out, 'policies.json'), JSON.stringify(policies.filter((f) => f.endsWith('.safetensors')).map((f) => f.replace('.safetensors', '')).sort()));

// The page's modules are fetched at once, not one after the other as they name each other.
const begins = 'src/main.js';
const eager = values.mock ? [begins] : await reached(join(out, begins));
const html = await readFile(join(out, 'index.html'), 'utf8');
const hints = eager.map((file) => `<link rel="modulepreload" href="${file}" />`);
await writeFile(join(out, 'index.html'), html.replace('<link rel="modulepreload" href="src/main.js" />', hints.join('\n    ')));

/** The modules that a module of the page imports at once, itself included. @param {string} entry */
async function reached(entry) {
  const found = new Set([entry]);
  for (const file of found) {
    for (const [, name] of (await readFile(file, 'utf8')).matchAll(/^import\b[^'"]*['"](\.[^'"]+)['"];/gm)) found.add(join(dirname(file), name));
  }
  return [...found].map((file) => relative(out, file));
}

if (!values.mock) await bakeDrawings(out, await optimised(join(here, 'pkg/ltl_rover_bg.wasm')));

// What the offline worker keeps: everything, under a name that changes with the content.
const files = (await readdir(out, { recursive: true, withFileTypes: true }))
  .filter((entry) => entry.isFile())
  .map((entry) => relative(out, join(entry.parentPath, entry.name)))
  .filter((file) => !file.endsWith('.md') && !file.startsWith('vendor/LICENSE'))
  .sort();
const hash = createHash('sha256');
let [whole, packed] = [0, 0];
/** @type {{ file: string, packed: number }[]} */
const sizes = [];
for (const file of files) {
  const bytes = await readFile(join(out, file));
  hash.update(file).update(bytes);
  // The large ones are packed as well as can be, beside them: that takes too long for a server to do when it is asked.
  let small = gzipSync(bytes, { level: 9 }).length;
  if (/\.(wasm|js)$/.test(file) && bytes.length > 1e6) {
    const best = brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length } });
    await writeFile(join(out, `${file}.br`), best);
    small = best.length;
  }
  whole += bytes.length;
  packed += small;
  sizes.push({ file, packed: small });
}
const worker = await readFile(join(here, 'service_worker.js'), 'utf8');
await writeFile(join(out, 'service_worker.js'), worker
  .replace("'VERSION'", JSON.stringify(hash.digest('hex').slice(0, 16)))
  .replace('[/* FILES */]', JSON.stringify(['./', ...files])));

sizes.sort((a, b) => b.packed - a.packed);
// What the first visit needs before anything moves: all that is not loaded later on, with the policy and drawing of the first task.
const task = initialState().task;
const LATER = /^(vendor\/(viz|uplot\.js|LICENSE)|assets\/|drawings\/|lessons\/|src\/lessons\/|src\/maps\/(canvas|easel|editor)\.js|service_worker|manifest)/;
const FIRST = new Set([`assets/policies/${task}.safetensors`, `drawings/${task}.json`]);
const first = sizes.filter(({ file }) => FIRST.has(file) || !LATER.test(file)).reduce((sum, f) => sum + f.packed, 0);
const FIRST_LIMIT = 1024 * 1024;

console.log(`page: first visit ${Math.round(first / 1024)} KB compressed, map pictures and Graphviz aside (at most ${FIRST_LIMIT / 1024} KB)`);
if (first > FIRST_LIMIT) {
  console.error('page: the first visit transfers too much; load something of it later');
  process.exitCode = 1;
}
console.log(`page: ${files.length + 1} files, ${Math.round(whole / 1024)} KB, ${Math.round(packed / 1024)} KB compressed, in ${relative(process.cwd(), out) || '.'}`);
for (const { file, packed: small } of sizes.slice(0, 6)) console.log(`  ${String(Math.round(small / 1024)).padStart(5)} KB  ${file}`);
