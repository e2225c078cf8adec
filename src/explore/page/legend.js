// The legend of what is in sight, in the words and paints of the pictures.

import { element, shape } from './dom.js';
import { asHtml } from './words.js';

/** A bar is chosen by at most so many cells. */
const MOST_CELLS = 20000;

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
    this.bar = element('div', { class: 'bar', hidden: true });
    this.root.append(this.bar, this.rows, this.notes);
  }

  /** Asks for the colour bar of a layer, from some of the cells in sight. */
  ask(link, scene, layer, view) {
    let z = view.level;
    const cells = () => {
      const [i0, i1, j0, j1] = view.cells(z);
      return (i1 - i0 + 1) * (j1 - j0 + 1);
    };
    while (z > -12 && cells() > MOST_CELLS) z -= 1;
    const [i0, i1, j0, j1] = view.cells(z);
    const window = { z, columns: [i0, i1], rows: [j0, j1] };
    return link.once({ type: 'bar', scene, layer, window, length: Math.max(100, this.root.clientWidth - 28), em: 12 }, 'bar');
  }

  /** The colour bar of a layer of numbers above the motions; none for null. */
  scale(bar) {
    this.bar.hidden = bar == null;
    if (bar == null) return;
    const { colours, ticks, title, undefined: none, lost } = bar;
    const strip = shape('svg', { viewBox: `0 0 ${colours.length} 10`, preserveAspectRatio: 'none', 'aria-hidden': 'true' },
      ...colours.map((fill, x) => shape('rect', { x, width: 1.5, height: 10, fill })));
    const labels = ticks.map(([share, text]) => {
      const label = element('span', { text });
      label.style.left = `${100 * share}%`;
      return label;
    });
    this.bar.replaceChildren(element('p', { text: title }), strip, element('div', { class: 'ticks' }, ...labels),
      element('p', { class: 'notes' }, sample([[none[0], null]]), ` ${none[1]} `, sample([[lost[0], null]]), ` ${lost[1]}`));
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
