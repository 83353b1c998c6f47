// @ts-check
// What is drawn over the ground, as switches.

import { byId, element } from './dom.js';
import { isHazard } from './views/ground.js';

/** @typedef {import('./app.js').App} App */

const LAYERS = Object.freeze([
  { layer: 'labels', name: 'Labels', title: 'Regions of the propositions, with their names' },
  { layer: 'unsafe', name: 'Unsafe', title: 'Ground that is to be avoided, hatched' },
  { layer: 'paths', name: 'Earlier runs', title: 'The ways of the last episodes, fading' },
  { layer: 'value', name: 'Value', title: 'What the critic expects from each place, and what the policy does there' },
]);

/** Offers what the scene has: hazards, places on a ground. @param {App['description']} description @param {HTMLInputElement[]} boxes */
function offerFitting(description, boxes) {
  if (!description) return;
  const { scene, propositions } = description.environment;
  const fits = { unsafe: propositions.some((_, p) => isHazard(scene, propositions, p)), paths: scene.body.kind !== 'cart_pole' };
  for (const box of boxes) {
    const label = /** @type {HTMLElement} */ (box.parentElement);
    label.hidden = fits[/** @type {keyof typeof fits} */ (box.value)] === false;
  }
}

/** @param {App} app */
export function wireLayers(app) {
  const root = byId('layers', HTMLElement);
  const boxes = LAYERS.map(({ layer, name, title }) => {
    const box = element('input', { type: 'checkbox', className: 'unseen', value: layer });
    box.addEventListener('change', () => {
      const { layers } = app.state;
      app.change({ layers: LAYERS.map((l) => l.layer).filter((l) => (l === layer ? box.checked : layers.includes(l))) });
    });
    root.append(element('label', { title }, box, name));
    return box;
  });
  const show = () => {
    offerFitting(app.description, boxes);
    for (const box of boxes) box.checked = app.state.layers.includes(box.value);
    app.theatre.setLayers(app.state.layers);
  };
  app.signals.on('state', show);
  app.signals.on('opened', show);
  show();
}
