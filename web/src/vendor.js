// @ts-check
// The libraries, loaded when they are first needed: uPlot for curves, Graphviz for the automaton.

/** @returns {Promise<import('./views/curves.js').PlotClass>} */
export async function loadPlot() {
  const module = await import(new URL('../vendor/uplot.js', import.meta.url).href);
  return module.default;
}

/** @type {Promise<import('./views/automaton.js').Viz> | null} */
let viz = null;

/** Graphviz, once. @returns {Promise<import('./views/automaton.js').Viz>} */
export function loadViz() {
  viz ??= import(new URL('../vendor/viz.js', import.meta.url).href).then((module) => module.instance());
  return viz;
}
