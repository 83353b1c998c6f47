// @ts-check
// Draws the automata of the tasks that come with the page while it is built, so that a first visit needs no Graphviz.

import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { instance } from '@viz-js/viz';
import { toDot } from './src/views/automaton.js';

/**
 * Writes `drawings/<task>.json` below `out`: for each direction the graph in DOT and its drawing in SVG.
 * @param {string} out
 * @param {string} wasm  the module that opens the tasks
 */
export async function bakeDrawings(out, wasm) {
  const viz = await instance();
  const core = await import(pathToFileURL(join(out, 'pkg/ltl_rover.js')).href);
  core.initSync({ module: await readFile(wasm) });
  await mkdir(join(out, 'drawings'), { recursive: true });
  for (const { name } of core.builtin_tasks()) {
    const session = core.Session.open({ task: name, seed: 1n });
    const graph = session.describe().automaton;
    session.free();
    const draw = (/** @type {'LR' | 'TB'} */ direction) => {
      const dot = toDot(graph, direction);
      return { dot, svg: slim(viz.renderString(dot, { format: 'svg' })) };
    };
    await writeFile(join(out, `drawings/${name}.json`), JSON.stringify({ LR: draw('LR'), TB: draw('TB') }));
  }
}

/** The drawing without its prologue and remarks. @param {string} svg */
const slim = (svg) => svg.slice(svg.indexOf('<svg')).replace(/<!--[\s\S]*?-->\s*/g, '').trim();
