// @ts-check
// The map editor: a dialog with the easel, its brushes and labels, pictures and map files in and out, and the maps kept on this machine.

import { element, offer, setText } from '../dom.js';
import { Refused } from '../client.js';
import { colourClass, shapeIcon } from '../palette.js';
import { LabelCanvas } from './canvas.js';
import { Easel } from './easel.js';
import { Unusable, backdrop, decode, pictureAddress, pixels } from './picture.js';

/** @typedef {import('../protocol.js').MapFacts} MapFacts */
/** @typedef {import('../protocol.js').MapVerdict} MapVerdict */
/** @typedef {{ name: string, unit: string, size: [number, number], reach: number, picture: string | null }} Frame */

/**
 * What the editor asks of the page.
 * @typedef {object} EditorOwner
 * @property {(json: string, image?: ImageData | null) => Promise<MapVerdict>} check
 * @property {(name: string, image: ImageData) => Promise<MapVerdict>} ofPicture
 * @property {(json: string, suggested: string) => Promise<string>} use   opens a task on the map; what is wrong, or nothing
 * @property {{ list: () => Promise<string[]>, get: (name: string) => Promise<string | null>, put: (name: string, json: string) => Promise<string>, remove: (name: string) => Promise<void> }} kept
 *   maps on this machine by name; `put` gives what is wrong, or nothing
 */

/** The largest map file, in bytes. */
const MAX_MAP = 4 << 20;
/** Columns of a map that begins empty. */
const BLANK = 180;

export class MapEditor {
  /** @param {EditorOwner} owner */
  constructor(owner) {
    this.owner = owner;
    /** @type {Frame} */
    this.frame = { name: 'My map', unit: 'm', size: [120, 80], reach: 3, picture: null };
    this.labels = new LabelCanvas(BLANK, 120, [], -1);
    /** The label that the brush paints; `null` erases. @type {number | null} */
    this.chosen = null;
    /** The picture that was dropped last, to be used as a backdrop after all. @type {ImageBitmap | null} */
    this.bitmap = null;
    const button = (/** @type {string} */ text, /** @type {() => void} */ act, /** @type {Record<string, any>} */ more = {}) => {
      const made = element('button', { type: 'button', ...more }, text);
      made.addEventListener('click', act);
      return made;
    };
    this.button = button;
    this.canvas = element('canvas', {
      className: 'easel', tabIndex: 0, role: 'application', 'aria-roledescription': 'map to paint on',
      'aria-label': 'The map. Arrow keys move the brush, with Shift further; Enter paints a spot, Space held while moving paints a line.',
    });
    this.spoken = element('p', { className: 'unseen', role: 'status' });
    this.brushes = element('div', { className: 'brushes', role: 'radiogroup', 'aria-label': 'Brush' });
    this.newName = element('input', { type: 'text', id: 'map-label', maxLength: 60, autocomplete: 'off', spellcheck: false, 'aria-describedby': 'map-said' });
    this.size = element('input', { type: 'range', id: 'map-brush', min: '1', max: '60', value: '12' });
    this.together = element('input', { type: 'checkbox', id: 'map-together' });
    this.name = element('input', { type: 'text', id: 'map-name', maxLength: 80, autocomplete: 'off' });
    this.reach = element('input', { type: 'number', id: 'map-reach', min: '0', step: 'any', inputMode: 'decimal' });
    this.said = element('p', { className: 'said', id: 'map-said', role: 'status' });
    this.undoButton = button('Undo', () => this.undo(), { 'aria-keyshortcuts': 'Control+Z' });
    this.redoButton = button('Redo', () => this.redo(), { 'aria-keyshortcuts': 'Control+Y' });
    this.asBackdrop = button('Only show the picture, no labels from it', () => this.useBackdrop(), { hidden: true });
    this.keptList = element('ul', { className: 'kept-maps', 'aria-label': 'Maps kept on this machine' });
    this.file = element('input', { type: 'file', className: 'unseen', id: 'map-file', multiple: true, accept: '.json,.png,.webp,.jpg,.jpeg,application/json,image/png,image/webp,image/jpeg' });
    this.dialog = this.build();
    document.body.append(this.dialog);
    this.easel = new Easel(this.canvas, {
      brush: () => ({ label: this.chosen, together: this.together.checked, radius: Number(this.size.value) / 2 }),
      painted: () => this.changed(),
      moved: (words) => setText(this.spoken, words),
    });
  }

  build() {
    const { button } = this;
    this.file.addEventListener('change', async () => {
      await this.take([...(this.file.files ?? [])]);
      this.file.value = '';
    });
    const adds = element('form', { className: 'row add' }, element('label', { for: 'map-label', className: 'unseen' }, 'Name of a new label'), this.newName, element('button', {}, 'Add label'));
    this.newName.placeholder = 'new label';
    adds.addEventListener('submit', (event) => {
      event.preventDefault();
      this.add();
    });
    this.size.addEventListener('input', () => this.easel.soon());
    const dialog = element('dialog', { id: 'painter', className: 'painter', 'aria-labelledby': 'painter-title' },
      element('header', { className: 'card-head' }, element('h2', { id: 'painter-title' }, 'Paint a map'), button('Close', () => dialog.close(), { className: 'quiet' })),
      element('div', { className: 'painter-body' },
        element('div', { className: 'easel-box' }, this.canvas, this.spoken),
        element('div', { className: 'tools' },
          element('h3', {}, 'Brush'), this.brushes, adds,
          element('label', { for: 'map-brush' }, 'Size of the brush'), this.size,
          element('label', { className: 'check', for: 'map-together' }, this.together, 'keep the labels below (they may overlap)'),
          element('div', { className: 'row' }, this.undoButton, this.redoButton, button('Erase all', () => this.clear())),
          element('h3', {}, 'Map'),
          element('div', { className: 'pair' },
            element('label', { for: 'map-name' }, 'Name'), this.name, element('label', { for: 'map-reach' }, 'Longest step'), this.reach),
          element('div', { className: 'row' },
            element('label', { className: 'button' }, 'Picture or map file…', this.file), button('Blank', () => this.blank()), button('Save as file', () => this.save())),
          this.asBackdrop,
          element('div', { className: 'row' }, button('Keep on this machine', () => this.keep())), this.keptList),
      ),
      element('div', { className: 'row foot' }, button('Use this map', () => this.use(), { className: 'primary big', id: 'map-use' }), this.said));
    dialog.addEventListener('keydown', (event) => this.key(event));
    for (const kind of ['dragenter', 'dragover']) dialog.addEventListener(kind, (event) => event.preventDefault());
    dialog.addEventListener('drop', (event) => {
      event.preventDefault();
      event.stopPropagation();
      this.take([...(event.dataTransfer?.files ?? [])]);
    });
    return dialog;
  }

  /** Opens the editor on a map file. @param {string} json */
  async open(json) {
    if (!this.dialog.open) this.dialog.showModal();
    this.say('');
    this.asBackdrop.hidden = true;
    await this.read(json);
    this.listKept();
  }

  /** @param {string} text @param {boolean} [bad] */
  say(text, bad = false) {
    this.said.classList.toggle('bad', bad);
    setText(this.said, text);
  }

  // --- maps in ---------------------------------------------------------------------------------------------------------------

  /** Takes a verdict; whether it was good. @param {MapVerdict} verdict @param {string} [what] */
  show(verdict, what) {
    if (!verdict.ok) {
      this.say((what ? `${what}: ` : '') + verdict.error.message, true);
      return false;
    }
    const { facts } = verdict;
    try {
      this.labels = LabelCanvas.of(facts);
    } catch (error) {
      this.say(`${what ?? facts.name}: ${error instanceof Error ? error.message : error}`, true);
      return false;
    }
    this.frame = { name: facts.name, unit: facts.unit, size: facts.size, reach: facts.reach, picture: facts.picture };
    this.shown();
    return true;
  }

  shown() {
    this.name.value = this.frame.name;
    this.reach.value = String(Number(this.frame.reach.toPrecision(6)));
    this.size.max = String(Math.max(8, Math.round(Math.max(this.labels.columns, this.labels.rows) / 3)));
    this.size.value = String(Math.max(3, Math.round(Math.max(this.labels.columns, this.labels.rows) / 12)));
    this.chosen = this.labels.labels.length > 0 ? 0 : null;
    this.easel.show(this.labels, this.frame.picture && pictureAddress(this.frame.picture), this.frame.size);
    this.changed();
  }

  /** @param {string} json @param {ImageData | null} [image] @param {string} [what] */
  async read(json, image = null, what) {
    return this.show(await this.owner.check(json, image), what);
  }

  /** Takes files: a map file, a picture, or a map file with the picture that it names. @param {File[]} files */
  async take(files) {
    this.say('');
    this.bitmap = null;
    this.asBackdrop.hidden = true;
    try {
      const isMap = (/** @type {File} */ file) => /json/.test(file.type) || /\.json$/i.test(file.name);
      const map = files.find(isMap);
      const picture = files.find((file) => !isMap(file));
      if (map && map.size > MAX_MAP) throw new Unusable(`${map.name} has ${Math.round(map.size / 1e6)} MB; map files have at most ${MAX_MAP >> 20} MB.`);
      if (map) {
        const image = picture ? pixels(await decode(new Uint8Array(await picture.arrayBuffer()), picture.name)) : null;
        if (await this.read(await map.text(), image, map.name)) this.say(`${map.name} is open.`);
      } else if (picture) await this.takePicture(picture);
    } catch (error) {
      this.say(error instanceof Error ? error.message : String(error), true);
    }
  }

  /** Flat colours become labels; any other picture is shown below the labels. @param {File} file */
  async takePicture(file) {
    const bitmap = await decode(new Uint8Array(await file.arrayBuffer()), file.name);
    this.bitmap = bitmap;
    const name = file.name.replace(/\.[a-z]+$/i, '').slice(0, 80) || 'My map';
    const verdict = await this.owner.ofPicture(name, pixels(bitmap));
    if (verdict.ok && verdict.facts.labels.length > 0) {
      if (!this.show(verdict, file.name)) return;
      this.asBackdrop.hidden = false;
      const count = verdict.facts.labels.length;
      return this.say(`The picture’s flat colours became ${count} ${count === 1 ? 'label' : 'labels'}: ${verdict.facts.labels.map((label) => label.name).join(', ')}.`);
    }
    this.frame = { ...this.frame, name };
    await this.useBackdrop();
    const why = verdict.ok ? 'has no colours that could be labels' : 'is not of flat colours';
    this.say(`${file.name} ${why}: it is shown below, paint the labels over it.`);
  }

  /** Shows the picture below an empty canvas. */
  async useBackdrop() {
    if (!this.bitmap) return;
    const { width, height } = this.bitmap;
    const longer = Math.max(width, height);
    const picture = await backdrop(this.bitmap);
    const scale = 240 / longer;
    this.labels = new LabelCanvas(Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)), [], -1);
    this.frame = { name: this.frame.name, unit: 'px', size: [width, height], reach: 0.025 * longer, picture };
    this.asBackdrop.hidden = true;
    this.shown();
    this.say('Add a label, then paint it over the picture.');
  }

  blank() {
    this.labels = new LabelCanvas(BLANK, (BLANK * 2) / 3, [], -1);
    this.frame = { name: 'My map', unit: 'm', size: [120, 80], reach: 3, picture: null };
    this.shown();
    this.say('Add a label, then paint it.');
    this.newName.focus();
  }

  // --- painting --------------------------------------------------------------------------------------------------------------

  /** The brushes, areas and buttons after a change. */
  changed() {
    const { labels, brushes } = this;
    const areas = labels.areas();
    const focused = document.activeElement instanceof HTMLInputElement && brushes.contains(document.activeElement) ? document.activeElement.value : null;
    const radio = (/** @type {string} */ value, /** @type {boolean} */ checked, /** @type {(Node | string)[]} */ ...inside) => {
      const input = element('input', { type: 'radio', name: 'map-brush', value, checked, className: 'unseen' });
      input.addEventListener('change', () => {
        this.chosen = value === 'erase' ? null : Number(value);
        this.easel.soon();
      });
      return element('label', {}, input, ...inside);
    };
    const total = labels.columns * labels.rows;
    brushes.replaceChildren(...labels.labels.map(({ name }, k) => {
      const share = areas[k] === 0 ? 'none yet' : areas[k] / total < 0.01 ? 'under 1 %' : `${Math.round((100 * areas[k]) / total)} %`;
      const icon = k === labels.hazard ? element('span', { className: 'hazard', 'aria-hidden': 'true' }) : shapeIcon(k);
      const drop = element('button', { type: 'button', className: 'quiet', 'aria-label': `Remove the label ${name}`, title: 'Remove this label everywhere' }, '×');
      drop.addEventListener('click', () => this.remove(k));
      return element('div', { className: `brush ${colourClass(k)}` },
        radio(String(k), this.chosen === k, icon, element('span', { className: 'mono' }, name), element('span', { className: 'soft' }, share)), drop);
    }), element('div', { className: 'brush' }, radio('erase', this.chosen === null, 'Erase')));
    if (focused !== null) brushes.querySelector(`input[value="${CSS.escape(focused)}"]`)?.dispatchEvent(new Event('focus'));
    const again = focused !== null && brushes.querySelector(`input[value="${CSS.escape(focused)}"]`);
    if (again instanceof HTMLInputElement) again.focus();
    this.undoButton.disabled = labels.past.length === 0;
    this.redoButton.disabled = labels.future.length === 0;
  }

  add() {
    const added = this.labels.add(this.newName.value, this.newName.value.trim() === 'unsafe');
    if (typeof added === 'string') {
      this.newName.setAttribute('aria-invalid', 'true');
      return this.say(added, true);
    }
    this.newName.removeAttribute('aria-invalid');
    this.newName.value = '';
    this.chosen = added;
    this.say(added === this.labels.hazard ? 'Unsafe ground hides every other label. Paint it.' : `Paint where ${this.labels.labels[added].name} holds.`);
    this.changed();
  }

  /** @param {number} label */
  remove(label) {
    this.labels.remove(label);
    if (this.chosen !== null && this.chosen >= label) this.chosen = this.labels.labels.length > 0 ? Math.max(0, this.chosen - 1) : null;
    this.after();
  }

  clear() {
    this.labels.clear();
    this.after();
  }

  undo() {
    if (this.labels.undo()) this.after();
  }

  redo() {
    if (this.labels.redo()) this.after();
  }

  after() {
    if (this.chosen !== null && this.chosen >= this.labels.labels.length) this.chosen = null;
    this.easel.refresh();
    this.changed();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (!(event.ctrlKey || event.metaKey) || (event.target instanceof HTMLInputElement && event.target.type === 'text')) return;
    const again = event.key === 'y' || (event.shiftKey && event.key.toLowerCase() === 'z');
    if (!again && event.key !== 'z') return;
    event.preventDefault();
    if (again) this.redo();
    else this.undo();
  }

  // --- maps out --------------------------------------------------------------------------------------------------------------

  /** The facts of the map as it stands; `null`, and it is said, if it is none. */
  async facts() {
    const reach = Number(this.reach.value);
    this.frame = { ...this.frame, name: this.name.value.trim() || 'My map', reach };
    const verdict = await this.owner.check(this.labels.toJson(this.frame));
    if (verdict.ok) return verdict.facts;
    this.say(verdict.error.message, true);
    return null;
  }

  async use() {
    try {
      const facts = await this.facts();
      if (facts === null) return;
      const wrong = await this.owner.use(facts.json, facts.suggested);
      if (wrong) this.say(wrong, true);
      else this.dialog.close();
    } catch (error) {
      this.say(error instanceof Refused || error instanceof Error ? error.message : String(error), true);
    }
  }

  async save() {
    const facts = await this.facts();
    if (facts) offer(`${facts.name.replace(/[^\p{L}\p{N}_-]+/gu, '_')}.json`, facts.json, 'application/json');
  }

  async keep() {
    const facts = await this.facts();
    if (facts === null) return;
    const wrong = await this.owner.kept.put(facts.name, facts.json);
    this.say(wrong || `${this.frame.name} is kept on this machine.`, wrong !== '');
    await this.listKept();
  }

  async listKept() {
    const names = await this.owner.kept.list();
    this.keptList.replaceChildren(...names.map((name) => {
      const open = element('button', { type: 'button' }, name);
      open.addEventListener('click', async () => {
        const json = await this.owner.kept.get(name);
        if (json !== null) await this.read(json, null, name);
      });
      const remove = element('button', { type: 'button', className: 'quiet', 'aria-label': `Forget the map ${name}` }, 'Forget');
      remove.addEventListener('click', async () => {
        await this.owner.kept.remove(name);
        await this.listKept();
      });
      return element('li', { className: 'row' }, open, remove);
    }));
    this.keptList.hidden = names.length === 0;
  }
}
