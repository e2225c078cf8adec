// What is drawn over the cells: rings around the cells of the cards, the cursor, and what is under the pointer.

import { element, shape } from './dom.js';
import { readout } from './hover.js';

export class Marks {
  constructor(svg, plane, box, line, view, margins) {
    Object.assign(this, { plane, box, line, view, margins });
    this.group = shape('g', { class: 'marks', 'clip-path': 'url(#plot)' });
    svg.append(this.group);
  }

  /** Draws them for the places `over` and `cursor` of a state, and the cells of some cards. */
  draw(state, cells, tiles) {
    const parts = cells.flatMap((cell) => this.ring(cell));
    if (state.cursor) {
      const [x, y] = this.view.pixelAt(...state.cursor);
      const d = `M${this.margins.left + x - 9} ${this.margins.top + y}h18m-9 -9v18`;
      parts.push(shape('path', { d, class: 'cursor light' }), shape('path', { d, class: 'cursor' }));
    }
    this.group.replaceChildren(...parts);
    this.read(state, tiles);
  }

  ring({ cell: [z, i, j], kept }) {
    const [x, y] = this.view.pixelAt(i * 2 ** -z, j * 2 ** -z);
    const place = { cx: this.margins.left + x, cy: this.margins.top + y };
    return [shape('circle', { ...place, r: 7, class: 'ring light' }), shape('circle', { ...place, r: 7, class: kept ? 'ring kept' : 'ring' })];
  }

  read(state, tiles) {
    const place = state.over ?? state.cursor;
    this.box.hidden = !state.over;
    if (!place) return;
    const { place: where, words } = readout(state.scene, state.motions, tiles, this.view, ...place);
    this.line.textContent = `${where}: ${words}`;
    if (state.over) this.beside(state.over, words, where);
  }

  /** The box beside the pointer, on the side where there is room. */
  beside(over, words, where) {
    const { left, top } = this.margins;
    const [px, py] = this.view.pixelAt(...over);
    const [width, height] = this.view.size;
    this.box.replaceChildren(element('b', { text: words }), element('span', { text: where }));
    const leftwards = px > width / 2;
    this.box.style.left = leftwards ? 'auto' : `${left + px + 14}px`;
    this.box.style.right = leftwards ? `${this.plane.clientWidth - left - px + 14}px` : 'auto';
    this.box.style.top = `${top + Math.max(4, Math.min(py + 14, height - 54))}px`;
  }
}
