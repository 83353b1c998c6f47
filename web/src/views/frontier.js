// @ts-check
// The frontier T (accepting sets still to be visited in this round) and T_Φ (states that shaping still rewards), as chips.

import { element } from '../dom.js';
import { colourClass, setName, shapeIcon, shapeName, stateName } from '../palette.js';

/** @typedef {import('../protocol.js').AutomatonGraph} AutomatonGraph */
/** @typedef {import('../protocol.js').Frame} Frame */

export class Frontier {
  /**
   * @param {HTMLElement} sets    list for T
   * @param {HTMLElement} states  list for T_Φ
   * @param {HTMLElement} jumps   where ε-jumps are offered
   */
  constructor(sets, states, jumps) {
    this.roots = { sets, states, jumps };
    this.offered = '';
    /** @type {HTMLElement[]} */
    this.sets = [];
    /** @type {{ id: number, chip: HTMLElement }[]} */
    this.states = [];
  }

  /** @param {AutomatonGraph} graph */
  show(graph) {
    this.sets = Array.from({ length: graph.sets }, (_, k) =>
      element('li', { className: `chip ${colourClass(k)}`, title: `${setName(k)}, drawn as a ${shapeName(k)}` }, shapeIcon(k), setName(k)));
    this.states = graph.states
      .filter((s) => s.id !== graph.initial && !s.sink && s.reachable)
      .map((s) => ({ id: s.id, chip: element('li', { className: 'chip plain', title: s.name }, stateName(s.id)) }));
    this.roots.sets.replaceChildren(...this.sets);
    this.roots.states.replaceChildren(...this.states.map((s) => s.chip));
  }

  /** @param {Frame} frame */
  update(frame) {
    this.sets.forEach((chip, k) => this.put(chip, frame.bit('frontier', k), frame.bit('fresh', k)));
    this.states.forEach(({ id, chip }) => this.put(chip, frame.bit('unvisited', id), false));
  }

  /**
   * Offers the ε-jumps of this moment to the user who drives; none without a frame.
   * @param {Frame | null} frame
   * @param {(target: number) => void} jump
   */
  jumps(frame, jump) {
    const targets = frame ? this.states.map((s) => s.id).filter((id) => frame.bit('jumps', id)) : [];
    const text = targets.join();
    if (text === this.offered) return;
    this.offered = text;
    this.roots.jumps.replaceChildren(...targets.map((id) => {
      const button = element('button', { type: 'button' }, `Jump to ${stateName(id)}`);
      button.addEventListener('click', () => jump(id));
      return button;
    }));
  }

  /** @param {HTMLElement} chip @param {boolean} waits @param {boolean} fresh */
  put(chip, waits, fresh) {
    chip.classList.toggle('waits', waits);
    chip.classList.toggle('fresh', fresh);
    const said = waits ? 'still to be visited' : 'visited';
    if (chip.getAttribute('data-state') !== said) {
      chip.setAttribute('data-state', said);
      chip.setAttribute('aria-label', `${chip.textContent}: ${said}`);
    }
  }
}
