// @ts-check
// Episodes that the user keeps: named, chosen, deleted, for as long as the session is open.

import { byId, count, element } from './dom.js';
import { notice } from './keeping.js';

/** @typedef {import('./app.js').App} App */
/** @typedef {import('./protocol.js').Episode} Episode */
/** @typedef {{ id: number, name: string, of: string, episode: Episode }} Kept */

/** How many episodes are kept; the oldest goes. */
const MOST = 24;

/** What a kept episode is called at first. @param {App} app */
function source(app) {
  const { mode, player, trained } = app.theatre;
  if (mode === 'drive') return 'Driven by hand';
  if (mode === 'training') return 'In training';
  const step = app.theatre.live?.counter('step') ?? 0;
  if (player.of === 'best') return `Best policy after ${count(player.after)} steps`;
  return player.of === 'shipped' || (mode === 'trained' && trained) ? 'Trained policy' : `Policy after ${count(step)} steps`;
}

export class KeptEpisodes {
  /** @param {App} app */
  constructor(app) {
    this.app = app;
    this.root = byId('kept', HTMLElement);
    /** @type {Kept[]} */
    this.list = [];
    this.next = 1;
    /** @type {number | null} */
    this.chosen = null;
    byId('keep', HTMLButtonElement).addEventListener('click', () => this.keep());
    app.signals.on('opened', () => {
      this.list = [];
      this.chosen = null;
      this.show();
    });
    app.signals.on('watch', () => this.choose(null));
    app.signals.on('episode', (episode) => {
      if (this.list.find((kept) => kept.id === this.chosen)?.episode !== episode) this.choose(null);
    });
    this.show();
  }

  keep() {
    const episode = this.app.theatre.current;
    if (!episode || episode.rows < 2) return notice('There is no episode to keep yet.');
    if (this.list.some((kept) => kept.episode === episode)) return notice('This episode is kept already.');
    const whole = this.outcome(episode);
    const id = this.next++;
    this.list = [...this.list, { id, name: `Episode ${id}`, of: source(this.app), episode: whole }].slice(-MOST);
    this.show();
  }

  /** The episode with its outcome, which a recording does not carry. @param {Episode} episode @returns {Episode} */
  outcome(episode) {
    const reader = this.app.theatre.reader;
    if (!reader || episode.rounds > 0 || episode.success) return episode;
    const rounds = reader.at(episode.data, episode.rows - 1).number('rounds');
    return rounds === 0 ? episode : { ...episode, rounds, success: reader.number('end') !== 1 };
  }

  /** @param {number | null} id */
  choose(id) {
    this.chosen = id;
    for (const row of this.root.querySelectorAll('li')) row.toggleAttribute('data-chosen', row.dataset.id === String(id));
  }

  show() {
    byId('kept-panel', HTMLElement).hidden = this.list.length === 0;
    this.root.replaceChildren(...this.list.map((kept) => this.row(kept)));
    this.choose(this.chosen);
  }

  /** @param {Kept} kept */
  row(kept) {
    const { id, name, of, episode } = kept;
    const play = element('button', { type: 'button', className: 'small', 'aria-label': `Play ${name}` }, '▶');
    const field = element('input', { type: 'text', value: name, maxLength: 60, 'aria-label': `Name of ${name}` });
    const remove = element('button', { type: 'button', className: 'small quiet', 'aria-label': `Delete ${name}` }, '✕');
    play.addEventListener('click', () => {
      this.app.theatre.replay(episode);
      this.choose(id);
    });
    field.addEventListener('change', () => {
      kept.name = field.value.trim() || name;
      this.show();
    });
    remove.addEventListener('click', () => {
      this.list = this.list.filter((one) => one !== kept);
      this.show();
      byId('keep', HTMLButtonElement).focus();
    });
    const steps = count(episode.rows - 1);
    const facts = `${of} · ${steps} steps · ${count(episode.rounds)} ${episode.rounds === 1 ? 'round' : 'rounds'}`;
    return element('li', { 'data-id': String(id) }, play, field, element('span', { className: 'note' }, facts), remove);
  }
}

/** @param {App} app */
export function wireKept(app) {
  app.kept = new KeptEpisodes(app);
}
