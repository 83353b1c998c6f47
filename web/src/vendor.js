// @ts-check
// The libraries, loaded when they are first needed: uPlot for curves, Graphviz for the automaton.

/** @returns {Promise<import('./views/curves.js').PlotClass>} */
export async function loadPlot() {
  const module = await import(new URL('../vendor/uplot.js', import.meta.url).href);
  return module.default;
}

/** @typedef {{ renderString: (dot: string, options: { format: 'svg' }) => string }} Viz */

/** @type {Promise<Viz> | null} */
let viz = null;

/** Graphviz, once. @returns {Promise<Viz>} */
function loadViz() {
  viz ??= import(new URL('../vendor/viz.js', import.meta.url).href).then((module) => module.instance());
  return viz;
}

/** A drawing as an element of the page. @param {string} svg */
function parsed(svg) {
  const root = new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement;
  return /** @type {SVGSVGElement} */ (/** @type {unknown} */ (document.importNode(root, true)));
}

/**
 * Drawings of graphs in DOT: those that the build made for `task` where they are of the same graphs, else fresh ones.
 * @type {import('./views/automaton.js').Draw}
 */
export async function draw(dots, task) {
  if (task) {
    const url = new URL(`../drawings/${encodeURIComponent(task)}.json`, import.meta.url);
    /** @type {{ dot: string, svg: string }[]} */
    const made = await fetch(url).then((answer) => (answer.ok ? answer.json() : {})).then(Object.values).catch(() => []);
    const found = dots.map((dot) => made.find((one) => one.dot === dot)?.svg);
    if (found.every((svg) => svg !== undefined)) return found.map((svg) => parsed(/** @type {string} */ (svg)));
  }
  const graphviz = await loadViz();
  return dots.map((dot) => parsed(graphviz.renderString(dot, { format: 'svg' })));
}
