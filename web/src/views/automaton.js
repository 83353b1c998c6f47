// @ts-check
// The automaton, laid out by Graphviz and coloured by the stylesheet; the present state and the last edge are marked as they change.

import { colourClass, setName, shapeName, shapePath, stateName } from '../palette.js';
import { setText } from '../dom.js';

/** @typedef {import('../protocol.js').AutomatonGraph} AutomatonGraph */
/** @typedef {import('../protocol.js').AutomatonEdge} AutomatonEdge */
/** @typedef {import('../protocol.js').Frame} Frame */
/** Drawings of graphs in DOT: those that the build made of task `task`, or fresh ones. @typedef {(dots: string[], task: string | null) => Promise<SVGSVGElement[]>} Draw */

/** A text of DOT: quoted, with what it would read as an escape taken out. @param {string} s */
const quote = (s) => `"${s.replace(/\\/g, '\\\\').replace(/"/g, '\\"')}"`;

/** Stands in a label for the shape of a set until the layout is known: as wide as one letter. */
const PLACE = '\u25CF';

/** A label in the signs of logic. @param {string} label */
export const logical = (label) => label.replaceAll('!', '¬').replaceAll('&', '∧').replaceAll('|', '∨').replace(/^true$/, '⊤');

/** A graph with more edges than this has no room for their labels. */
const DENSE = 60;
/** A label longer than this is broken. */
const LONG = 13;

/**
 * A long label in short: of a conjunction what holds, the rest as dots.
 * @param {string} label  in the signs of logic
 */
export function inShort(label) {
  if (label.length <= SHORT || label.includes('∨')) return label;
  const holds = label.split(' ∧ ').filter((literal) => !literal.startsWith('¬'));
  return holds.length > 0 ? `${holds.join(' ∧ ')} …` : 'none of them';
}
/** The longest label that is said whole. */
const SHORT = 28;

/** Long labels are broken at their disjunctions, and longer ones at their conjunctions too. @param {string} label */
function broken(label) {
  const parts = label.length > LONG ? label.split(' ∨ ') : [label];
  return parts.map((part) => (part.length > LONG ? part.split(' ∧ ').join(' ∧\n') : part)).join(' ∨\n');
}

/**
 * The graph in DOT. Nodes have the ids `q0 …`, edges `e0 …`; letters are measured as those of a fixed-width font.
 * @param {AutomatonGraph} graph
 * @param {'LR' | 'TB'} direction
 */
export function toDot(graph, direction) {
  const dense = graph.edges.length > DENSE;
  const lines = [
    'digraph {',
    // Many edges: on a circle, without labels; the edge that is taken is named beside the drawing.
    ...(dense ? ['layout=circo; mindist=0.9;'] : []),
    `rankdir=${direction}; bgcolor=transparent; nodesep=0.4; ranksep=0.45; margin=0.05;`,
    'node [shape=circle, fontname="Courier", fontsize=13, width=0.5, fixedsize=true];',
    'edge [fontname="Courier", fontsize=12, arrowsize=0.7];',
    'start [shape=point, width=0.06, class="start"];',
    `start -> ${graph.initial} [class="start"];`,
  ];
  for (const state of graph.states) {
    if (!state.reachable) continue;
    const classes = ['state', state.sink ? 'sink' : '', state.marks.length > 0 ? 'accepting' : ''].filter(Boolean).join(' ');
    lines.push(`${state.id} [id="q${state.id}", class=${quote(classes)}, label=${quote(stateName(state.id))}, tooltip=${quote(state.name)}${state.marks.length > 0 ? ', shape=doublecircle' : ''}];`);
  }
  graph.edges.forEach((edge, k) => {
    if (!graph.states[edge.from].reachable) return;
    const own = ownMarks(graph, edge);
    const label = dense ? '' : broken(logical(edge.label)) + (own.length > 0 ? ` ${PLACE.repeat(own.length)}` : '');
    const jump = edge.kind === 'epsilon';
    const classes = [jump ? 'epsilon' : '', graph.states[edge.to].sink ? 'to-sink' : ''].filter(Boolean).join(' ');
    // Blanks around a label keep it off its edge.
    lines.push(`${edge.from} -> ${edge.to} [id="e${k}", class=${quote(classes)}, label=${quote(` ${label} `)}${dense ? `, tooltip=${quote(logical(edge.label))}, arrowsize=0.5` : ''}${jump ? ', style=dashed' : ''}];`);
  });
  lines.push('}');
  return lines.join('\n');
}

/** The sets of an edge that the state it enters does not carry itself. @param {AutomatonGraph} graph @param {AutomatonEdge} edge */
const ownMarks = (graph, edge) => edge.marks.filter((set) => !graph.states[edge.to].marks.includes(set));

/**
 * The graph in words, for those who hear the page.
 * @param {AutomatonGraph} graph
 */
export function inWords(graph) {
  const sinks = graph.states.filter((s) => s.sink).length;
  const jumps = graph.edges.filter((e) => e.kind === 'epsilon').length;
  return `Automaton with ${graph.states.length} states${sinks ? `, ${sinks} of them a sink` : ''}, ${graph.edges.length - jumps} edges`
    + `${jumps ? `, ${jumps} ε-jumps` : ''} and ${graph.sets} accepting ${graph.sets === 1 ? 'set' : 'sets'}: `
    + Array.from({ length: graph.sets }, (_, k) => `${setName(k)} a ${shapeName(k)}`).join(', ');
}

const SVG = 'http://www.w3.org/2000/svg';

/** @param {number} set @param {number} x @param {number} y @param {number} radius */
function badge(set, x, y, radius) {
  const path = document.createElementNS(SVG, 'path');
  path.setAttribute('d', shapePath(set));
  path.setAttribute('transform', `translate(${x} ${y}) scale(${radius})`);
  path.setAttribute('class', `badge ${colourClass(set)}`);
  return path;
}

/** Replaces the places in edge labels by shapes and puts the shapes of states onto them. @param {SVGSVGElement} svg @param {AutomatonGraph} graph */
function decorate(svg, graph) {
  graph.edges.forEach((edge, k) => {
    const own = ownMarks(graph, edge);
    if (own.length === 0) return;
    const text = [...svg.querySelectorAll(`[id="e${k}"] text`)].pop();
    if (!text?.textContent) return;
    const letters = text.textContent.trimEnd();
    const width = 12 * 0.6;
    const whole = text.textContent.length * width;
    const middle = Number(text.getAttribute('x'));
    const y = Number(text.getAttribute('y')) - 4;
    const start = middle - whole / 2 + (letters.length - own.length) * width;
    own.forEach((set, j) => text.after(badge(set, start + (j + 0.5) * width * 1.25, y, 4.6)));
    text.textContent = letters.slice(0, letters.length - own.length) + '\u2007'.repeat(own.length) + ' ';
  });
  for (const state of graph.states) {
    const ellipse = svg.querySelector(`[id="q${state.id}"] ellipse:last-of-type`);
    if (!ellipse) continue;
    const [x, y, r] = ['cx', 'cy', 'rx'].map((a) => Number(ellipse.getAttribute(a)));
    state.marks.forEach((set, j) => {
      const angle = -Math.PI / 4 + (j * Math.PI) / 5;
      ellipse.parentElement?.append(badge(set, x + (r + 1) * Math.cos(angle), y + (r + 1) * Math.sin(angle), 5));
    });
  }
}

export class Automaton {
  /**
   * @param {HTMLElement} root
   * @param {HTMLElement} now   where the present state is said in words
   * @param {Draw} draw
   */
  constructor(root, now, draw) {
    this.root = root;
    this.now = now;
    this.draw = draw;
    /** @type {AutomatonGraph | null} */
    this.graph = null;
    this.q = -1;
    this.edge = -2;
    /** Counts what was asked to be shown, and previews: only the newest of each is put into its place. */
    this.turn = 0;
    this.previews = 0;
    /** Ends when the automaton that moves stands, or could not be drawn. */
    this.standing = Promise.resolve();
    /** What stands in place of the preview when that ends. @type {Element[] | null} */
    this.kept = null;
  }

  /**
   * Draws another automaton.
   * @param {AutomatonGraph} graph
   * @param {string | null} [task]  the task whose automaton it may be
   */
  show(graph, task = null) {
    const turn = ++this.turn;
    this.graph = graph;
    this.q = -1;
    this.edge = -2;
    this.kept = null;
    const shown = this.drawn(graph, task).then((svg) => this.put(turn, svg));
    this.standing = shown.catch(() => {});
    return shown;
  }

  /** Puts the automaton that moves into its place, unless another has been asked for since. @param {number} turn @param {SVGSVGElement} svg */
  put(turn, svg) {
    if (turn !== this.turn) return;
    this.root.classList.remove('preview');
    this.root.replaceChildren(svg);
    this.q = -1;
    this.edge = -2;
  }

  /** Shows another automaton in place of the one that moves. @param {AutomatonGraph} graph */
  async preview(graph) {
    const [turn, preview] = [this.turn, ++this.previews];
    const svg = await this.drawn(graph, null);
    // What comes back after the preview must stand first.
    await this.standing;
    if (turn !== this.turn || preview !== this.previews) return;
    this.kept ??= [...this.root.children];
    this.root.classList.add('preview');
    this.root.replaceChildren(svg);
  }

  /** Shows the automaton that moves again; whether another was shown. */
  endPreview() {
    this.previews++;
    if (!this.kept) return false;
    this.root.classList.remove('preview');
    this.root.replaceChildren(...this.kept);
    this.kept = null;
    this.root.querySelectorAll('.current, .last').forEach((marked) => marked.classList.remove('current', 'last'));
    this.q = -1;
    this.edge = -2;
    return true;
  }

  /** @param {AutomatonGraph} graph @param {string | null} task */
  async drawn(graph, task) {
    const drawings = await this.draw([toDot(graph, 'LR'), toDot(graph, 'TB')], task);
    const svg = this.fitting(drawings);
    svg.querySelectorAll('title').forEach((title) => title.remove());
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', inWords(graph));
    const [, , width, height] = (svg.getAttribute('viewBox') ?? '0 0 1 1').split(' ').map(Number);
    svg.removeAttribute('width');
    svg.removeAttribute('height');
    // A graph of two states need not shout.
    svg.style.maxWidth = `${width * 1.8}px`;
    svg.style.maxHeight = `${height * 1.8}px`;
    decorate(svg, graph);
    return svg;
  }

  /** Of the drawing from left to right and the one from top to bottom the one that shows larger. @param {SVGSVGElement[]} drawings */
  fitting([wide, tall]) {
    const { width, height } = this.root.getBoundingClientRect();
    const scale = (/** @type {SVGSVGElement} */ svg) => {
      const [, , w, h] = (svg.getAttribute('viewBox') ?? '0 0 1 1').split(' ').map(Number);
      return Math.min(width / w, Math.max(height, 190) / h);
    };
    return scale(wide) >= scale(tall) ? wide : tall;
  }

  /** @param {Frame} frame */
  update(frame) {
    if (this.kept) return;
    const [q, edge] = [frame.number('q'), frame.number('edge')];
    if (q !== this.q) {
      this.mark(`q${this.q}`, `q${q}`, 'current');
      this.q = q;
    }
    if (edge !== this.edge) {
      this.mark(`e${this.edge}`, `e${edge}`, 'last');
      this.edge = edge;
      const taken = this.graph?.edges[edge];
      setText(this.now, taken ? `${stateName(taken.from)} → ${stateName(taken.to)} on ${inShort(logical(taken.label))}` : `in ${stateName(q)}`);
    }
  }

  /** @param {string} before @param {string} after @param {string} name */
  mark(before, after, name) {
    this.root.querySelector(`[id="${before}"]`)?.classList.remove(name);
    this.root.querySelector(`[id="${after}"]`)?.classList.add(name);
  }
}
