// The cards: one about the last click, and those that are kept beside it.

import { element } from './dom.js';
import { Card } from './card.js';

const MOST_KEPT = 3;
const HINT = 'Click the plane, or press Enter on it, to see what moves there.';

export class Panel {
  /** `closed()` hears that a card was closed. */
  constructor(root, link, closed) {
    this.root = root;
    this.link = link;
    this.closed = closed;
    this.cards = [];
    this.hint = element('p', { class: 'hint', text: HINT });
    root.append(this.hint);
  }

  get current() {
    return this.cards.find((entry) => !entry.kept);
  }

  /** Shows a cell of a plane. */
  show(scene, cell) {
    this.clear();
    const entry = { scene, cell, kept: false, asked: performance.now() };
    entry.card = new Card({
      onclose: () => { this.remove(entry); this.closed(); },
      onkeep: () => this.keep(entry),
    });
    const width = Math.round(Math.max(300, Math.min(460, this.root.clientWidth - 26)));
    entry.ask = this.link.ask({ type: 'probe', scene, cell, width }, (kind, content) => {
      entry.card.hear(kind, content);
      if (kind === 'portrait') document.body.dataset.portrait = String(Math.round(performance.now() - entry.asked));
    });
    this.cards.unshift(entry);
    this.root.prepend(entry.card.root);
    this.hint.hidden = true;
    // Beside the plane the card comes into sight; below it, on a phone, the plane stays where it is.
    const column = this.root.parentElement;
    if (column.scrollHeight > column.clientHeight) column.scrollTop = entry.card.root.offsetTop - column.offsetTop - 8;
  }

  keep(entry) {
    entry.kept = !entry.kept;
    entry.card.kept = entry.kept;
    const kept = this.cards.filter((other) => other.kept);
    if (kept.length > MOST_KEPT) this.remove(kept.at(-1));
  }

  remove(entry) {
    this.link.cancel(entry.ask);
    entry.card.root.remove();
    this.cards = this.cards.filter((other) => other !== entry);
    this.hint.hidden = this.cards.length > 0;
  }

  /** Removes what is not kept. */
  clear() {
    for (const entry of this.cards.filter(({ kept }) => !kept)) this.remove(entry);
  }

  /** The cells of a plane that are shown, to mark them. */
  cellsOf(scene) {
    return this.cards.filter((entry) => entry.scene === scene).map(({ cell, kept }) => ({ cell, kept }));
  }
}
