// The legend of what is in sight, in the words and paints of the pictures.

import { element } from './dom.js';
import { asHtml } from './words.js';

/** A sample of paints side by side. */
export function sample(paints) {
  const part = ([ground, hatch]) => {
    const box = element('span', { class: hatch ? 'hatched' : null });
    box.style.setProperty('--ground', ground);
    if (hatch) box.style.setProperty('--hatch', hatch);
    return box;
  };
  return element('span', { class: 'sample', 'aria-hidden': 'true' }, ...paints.map(part));
}

export class Legend {
  constructor(root) {
    this.root = root;
    this.rows = element('table', {});
    this.notes = element('p', { class: 'notes' });
    this.root.append(this.rows, this.notes);
  }

  show({ rows, notes }) {
    const head = element('tr', {}, element('th', { scope: 'col', colspan: 2, text: 'motion' }),
      element('th', { scope: 'col', class: 'share', text: 'share of view' }));
    this.rows.replaceChildren(head, ...rows.map(({ paints, name, share }) => element('tr', {},
      element('td', {}, sample(paints)),
      element('td', {}, ...asHtml(name)),
      element('td', { class: 'share' }, ...asHtml(share)))));
    this.notes.replaceChildren(...notes.flatMap((note) => [...asHtml(note), ' ']));
  }
}
