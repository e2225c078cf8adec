// Ticks, labels and titles around the plot: chosen by the server, placed here.

import { seldom, shape } from './dom.js';
import { asSvg } from './words.js';

const TICK = 6, MINOR = 3, GAP = 5;

export class Axes {
  constructor(svg, link, margins) {
    this.link = link;
    this.margins = margins;
    this.sides = null;
    this.group = shape('g', { class: 'axes' });
    svg.append(this.group);
    this.refresh = seldom(60, () => this.fetch());
  }

  /** Asks for the ticks of a view. */
  ask(scene, view, em, heard) {
    this.wanted = { scene, view, em, heard };
    this.refresh();
  }

  fetch() {
    const { scene, view, em, heard } = this.wanted;
    const [x0, x1, y0, y1] = view.window;
    this.link.once({ type: 'axes', scene, x: [x0, x1], y: [y0, y1], size: view.size, em }, 'axes')
      .then((sides) => { this.sides = sides; heard(sides); }, () => {});
  }

  draw(view) {
    const { left, top } = this.margins;
    const [width, height] = view.size;
    const [x0, x1, y0, y1] = view.window;
    const parts = [shape('rect', { x: left - 0.5, y: top - 0.5, width: width + 1, height: height + 1, class: 'edge' })];
    const lines = [];
    const across = (place) => left + ((place - x0) / (x1 - x0)) * width;
    const up = (place) => top + ((y1 - place) / (y1 - y0)) * height;
    const inside = (place, from, to) => place >= from - 1e-9 && place <= to + 1e-9;
    const bottom = top + height;
    for (const [place, label] of this.sides?.x.labelled ?? []) {
      if (!inside(place, x0, x1)) continue;
      lines.push(`M${across(place)} ${bottom}v${TICK}`);
      parts.push(shape('text', { x: across(place), y: bottom + TICK + GAP + 10, 'text-anchor': 'middle', text: label }));
    }
    for (const place of this.sides?.x.minor ?? []) {
      if (inside(place, x0, x1)) lines.push(`M${across(place)} ${bottom}v${MINOR}`);
    }
    for (const [place, label] of this.sides?.y.labelled ?? []) {
      if (!inside(place, y0, y1)) continue;
      lines.push(`M${left} ${up(place)}h${-TICK}`);
      parts.push(shape('text', { x: left - TICK - GAP, y: up(place) + 4.5, 'text-anchor': 'end', text: label }));
    }
    for (const place of this.sides?.y.minor ?? []) {
      if (inside(place, y0, y1)) lines.push(`M${left} ${up(place)}h${-MINOR}`);
    }
    parts.push(shape('path', { d: lines.join(''), class: 'ticks' }));
    if (this.sides) {
      const x = left + width / 2, y = top + height / 2;
      parts.push(shape('text', { x, y: bottom + 44, 'text-anchor': 'middle', class: 'name' }, ...asSvg(this.sides.x.title)));
      parts.push(shape('text', { 'text-anchor': 'middle', class: 'name', transform: `translate(16 ${y}) rotate(-90)` },
        ...asSvg(this.sides.y.title)));
    }
    this.group.replaceChildren(...parts);
  }
}
