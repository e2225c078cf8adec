// A line through the plane, and the bifurcation diagram along it.

import { drawn, element, shape } from './dom.js';

const COLUMNS = 500;

export class Slice {
  constructor(svg, root, link, status) {
    Object.assign(this, { root, link, status, active: false, line: null, begun: null });
    this.path = shape('path', { class: 'cut', hidden: true });
    svg.append(this.path);
  }

  /** The line while it is drawn, and the diagram once it is. */
  draw(from, to, done, scene) {
    this.begun = null;
    this.line = [from, to];
    if (done) this.compute(scene);
  }

  /** One end of the line, then the other: where keys set them. */
  mark(place, scene) {
    if (!this.begun) {
      this.begun = place;
      this.follow(place);
    } else if (String(place) !== String(this.begun)) {
      this.draw(this.begun, place, true, scene);
    }
  }

  /** The line from the end that was set to a place; nowhere, no other end will be set. */
  follow(place) {
    if (!this.begun) return;
    this.line = place && [this.begun, place];
    if (!place) this.begun = null;
  }

  place(view, { left, top }) {
    this.path.toggleAttribute('hidden', !this.line);
    if (!this.line) return;
    const [a, b] = this.line.map(([x, y]) => view.pixelAt(x, y));
    this.path.setAttribute('d', `M${left + a[0]} ${top + a[1]}L${left + b[0]} ${top + b[1]}`);
  }

  compute(scene) {
    if (this.ask) this.link.cancel(this.ask);
    const [from, to] = this.line;
    const width = Math.round(Math.max(360, Math.min(1100, innerWidth - 48)));
    this.open(element('p', { class: 'hint', text: 'Computing the diagram along the line …' }));
    this.ask = this.link.ask({ type: 'slice', scene, from, to, columns: COLUMNS, width }, (kind, content) => {
      if (kind === 'progress') this.status.running('slice', { words: content.what, share: content.share, stop: () => this.close() });
      if (kind === 'slice') this.open(drawn(content.svg, 'Bifurcation diagram along the line'));
      if (kind === 'refused') this.open(element('p', { class: 'none', text: content.message }));
      if (kind === 'done' || kind === 'refused') {
        this.ask = null;
        this.status.running('slice', null);
      }
    });
  }

  open(content) {
    const close = element('button', { type: 'button', text: '×', 'aria-label': 'Close the diagram', onclick: () => this.close() });
    // Away from the line, over the other half of the plane.
    const middle = this.path.getBoundingClientRect();
    this.root.classList.toggle('above', middle.top + middle.bottom > innerHeight);
    this.root.hidden = false;
    this.root.replaceChildren(close, content);
  }

  close() {
    if (this.ask) {
      this.link.cancel(this.ask);
      this.ask = null;
      this.status.running('slice', null);
    }
    this.line = this.begun = null;
    this.root.hidden = true;
    this.path.setAttribute('hidden', '');
  }
}
