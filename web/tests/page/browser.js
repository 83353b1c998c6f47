// @ts-check
// A page under test: the built page served on this machine, Chromium around it, and everything that went wrong in it.

import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { server } from '../../serve.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../../dist');
const EXECUTABLES = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
const FLAGS = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** The sizes at which the page is tested. */
export const SIZES = /** @type {const} */ ({ wide: { width: 1280, height: 800 }, phone: { width: 390, height: 844 } });

/** @typedef {import('playwright-core').Page} Page */

/** The page's server and a browser. Close both at the end. */
export async function start() {
  if (!existsSync(join(root, 'index.html'))) throw new Error('web/dist is missing: run `make page` first');
  const made = server(root);
  await new Promise((resolve) => made.listen(0, '127.0.0.1', () => resolve(undefined)));
  const { port } = /** @type {import('node:net').AddressInfo} */ (made.address());
  const executablePath = EXECUTABLES.find((path) => path && existsSync(path));
  const browser = await chromium.launch({ executablePath, args: FLAGS });
  return {
    browser,
    url: `http://localhost:${port}/`,
    /** Stops the server; the browser stays. */
    async stop() {
      made.closeAllConnections();
      await new Promise((resolve) => made.close(resolve));
    },
    async close() {
      await browser.close();
      await new Promise((resolve) => made.close(resolve));
    },
  };
}

/**
 * Opens the page in a fresh context. `problems` collects errors of the console, the page and the network.
 * @param {Awaited<ReturnType<typeof start>>} site
 * @param {{ hash?: string, size?: keyof typeof SIZES, colours?: 'light' | 'dark', motion?: 'reduce' | 'no-preference' }} [options]
 */
export async function visit(site, { hash = '', size = 'wide', colours = 'light', motion = 'no-preference' } = {}) {
  const context = await site.browser.newContext({ viewport: SIZES[size], colorScheme: colours, reducedMotion: motion, hasTouch: size === 'phone', acceptDownloads: true });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  /** @type {string[]} */
  const problems = [];
  page.on('console', (message) => {
    if (message.type() === 'error' || message.type() === 'warning') problems.push(message.text());
  });
  page.on('pageerror', (error) => problems.push(String(error)));
  page.on('request', (request) => {
    if (!/^(http:\/\/localhost:|blob:|data:)/.test(request.url())) problems.push(`a request left this machine: ${request.url()}`);
  });
  // A small task, whichever the page begins with, unless the test names one.
  await page.goto(site.url + (/task=/.test(hash) || !/^(#|$)/.test(hash) ? hash : `${hash || '#'}${hash.length > 1 ? '&' : ''}task=ball_pass_b1`));
  await page.waitForSelector('#automaton svg .node.current');
  return { page, context, problems };
}

/** The number shown in element `id`. @param {Page} page @param {string} id */
export async function number(page, id) {
  const text = await page.textContent(`#${id}`);
  return Number((text ?? '').replaceAll(',', ''));
}

/** The first number of a text, digit groups read as one. @param {string | null} text */
export const firstNumber = (text) => Number(/[\d,]+/.exec(text ?? '')?.[0].replaceAll(',', ''));

/** The steps of the kept runs, the newest first. @param {Page} page @returns {Promise<number[]>} */
export const kept = (page) => page.evaluate(async () => {
  // @ts-ignore: a module of the page
  const { Store } = await import('/src/keep/store.js');
  return (await new Store().runs()).map((/** @type {{ steps: number }} */ run) => run.steps);
});

/** Waits until a run of so many steps is kept. @param {Page} page @param {(steps: number) => boolean} wanted */
export async function untilKept(page, wanted) {
  const end = Date.now() + 60_000;
  for (;;) {
    const [steps = 0] = await kept(page);
    if (wanted(steps)) return steps;
    if (Date.now() > end) throw new Error(`kept are ${steps} steps`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

const axe = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** What axe finds wrong in the parts of the page that a selector names, or in all of it. @param {Page} page @param {string} [where] @returns {Promise<string[]>} */
export async function inaccessible(page, where) {
  await page.evaluate(axe);
  const found = await page.evaluate((where) => /** @type {any} */ (globalThis).axe.run(where ?? document), where);
  return found.violations.map((/** @type {any} */ v) => `${v.id}: ${v.nodes.map((/** @type {any} */ n) => n.html).join(' ')}`);
}
