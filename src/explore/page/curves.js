// Bifurcation curves over the plane: computed for what is in sight when asked for.

import { shape } from './dom.js';

/** About so many cells are looked at to find where curves begin. */
const SEED_CELLS = 20000;

/** The places of a window's cells, where they are not the whole plane. */
function partOf({ z, columns, rows }, view) {
  const edges = ([first, last]) => [(first - 0.5) * 2 ** -z, (last + 0.5) * 2 ** -z];
  const part = [...edges(columns), ...edges(rows)];
  const unit = 2 ** -Math.min(0, z);
  const whole = part.every((edge, k) => Math.abs(edge - view.whole[k]) < unit);
  return whole ? null : part;
}

export class Curves {
  constructor(svg, link, status) {
    this.link = link;
    this.status = status;
    this.group = shape('g', { class: 'curves', 'clip-path': 'url(#plot)' });
    svg.append(this.group);
    this.clear();
  }

  clear() {
    if (this.ask) this.stop();
    this.lines = [];
    this.part = null;
    this.shown = false;
    this.group.replaceChildren();
  }

  stop() {
    this.link.cancel(this.ask);
    this.ask = null;
    this.status.running('curves', null);
  }

  /** Asks for the curves of a view. */
  compute(scene, view, done) {
    if (this.ask) this.stop();
    this.shown = true;
    let z = view.level;
    const cells = (level) => {
      const [i0, i1, j0, j1] = view.cells(level);
      return (i1 - i0 + 1) * (j1 - j0 + 1);
    };
    while (z > -12 && cells(z) > SEED_CELLS) z -= 1;
    const [i0, i1, j0, j1] = view.cells(z);
    const window = { z, columns: [i0, i1], rows: [j0, j1] };
    const clipped = scene.clip(window);
    this.part = partOf(clipped, view);
    const stop = () => { this.clear(); done(); };
    this.status.running('curves', { words: 'following the bifurcation curves', share: null, stop });
    this.ask = this.link.ask({ type: 'curves', scene: scene.scene, window: clipped, max_period: 2, all: false }, (kind, content) => {
      if (kind === 'progress') this.status.running('curves', { words: content.what, share: content.share, stop });
      if (kind === 'curves') this.lines = content.lines;
      if (kind === 'refused') this.status.notice(content.message, 'curves');
      if (kind === 'done' || kind === 'refused') {
        this.ask = null;
        this.status.running('curves', null);
        if (kind === 'refused') this.shown = false;
      }
      done();
    });
  }

  draw(view, { left, top }, em) {
    const path = (points) => points.map(([x, y], k) => {
      const [px, py] = view.pixelAt(x, y);
      return `${k ? 'L' : 'M'}${(left + px).toFixed(1)} ${(top + py).toFixed(1)}`;
    }).join('');
    const inSight = ({ points }) => points.some(([x, y]) => {
      const [x0, x1, y0, y1] = view.window;
      return x >= x0 && x <= x1 && y >= y0 && y <= y1;
    });
    const lines = this.lines.filter(inSight).map((line) => ({ ...line, d: path(line.points) }));
    const width = (value) => Math.max(1, value * em);
    const cased = lines.map(({ d, widths }) => shape('path', { d, class: 'casing', 'stroke-width': width(widths[1]) + 1 }));
    const inked = lines.map(({ d, widths, dashes, colour }) => shape('path', {
      d, stroke: colour, 'stroke-width': width(widths[0]), 'stroke-dasharray': dashes.map((length) => length * em).join(' ') || null,
    }));
    const felt = lines.map(({ d, about }) => shape('path', { d, class: 'felt' }, shape('title', { text: about })));
    // The paper's names come first; a name that would cover another one is left out, and is there on hover.
    const taken = [];
    const order = [...lines].sort((a, b) => /^L\d/.test(b.name) - /^L\d/.test(a.name));
    const named = order.map((line) => this.label(line, view, left, top, taken)).filter(Boolean);
    this.group.replaceChildren(...cased, ...inked, ...named, ...felt, ...this.outline(view, left, top));
  }

  /** The part of the plane that curves were followed in, where more than that is in sight. */
  outline(view, left, top) {
    if (!this.part || this.lines.length === 0) return [];
    const [a0, a1, b0, b1] = this.part, [x0, x1, y0, y1] = view.window;
    const slack = [0.02 * (x1 - x0), 0.02 * (y1 - y0)];
    if (x0 >= a0 - slack[0] && x1 <= a1 + slack[0] && y0 >= b0 - slack[1] && y1 <= b1 + slack[1]) return [];
    const [[x, y], [right, bottom]] = [view.pixelAt(a0, b1), view.pixelAt(a1, b0)];
    const [width, height] = view.size;
    if (right < 0 || x > width || bottom < 0 || y > height) return [];
    const at = { x: left + x, y: top + y };
    const named = { x: left + Math.max(0, x) + 5, y: top + Math.max(y - 5, 13) };
    return [
      ...['followed light', 'followed'].map((name) => shape('rect', { ...at, width: right - x, height: bottom - y, class: name })),
      shape('text', { ...named, class: 'curve-name', text: 'curves were followed here' }),
    ];
  }

  /** The name of a curve at its middle in sight, where it is long enough. */
  label({ name, colour, points }, view, left, top, taken) {
    const [width, height] = view.size;
    const pixels = points.map(([x, y]) => view.pixelAt(x, y)).filter(([x, y]) => x > 20 && y > 14 && x < width - 20 && y < height - 8);
    if (pixels.length < 2) return null;
    const [a, b] = [pixels[0], pixels.at(-1)];
    if (Math.hypot(a[0] - b[0], a[1] - b[1]) < 60) return null;
    const half = 3.6 * name.length + 4;
    const free = ([x, y]) => taken.every(([cx, cy, ch]) => Math.abs(x - cx) > half + ch || Math.abs(y - cy) > 14);
    const found = [0.5, 0.3, 0.7, 0.15, 0.85].map((share) => pixels[Math.floor(share * (pixels.length - 1))]).find(free);
    if (!found) return null;
    const [x, y] = found;
    taken.push([x, y, half]);
    return shape('text', { x: left + x, y: top + y - 6, fill: colour, class: 'curve-name', 'text-anchor': 'middle', text: name });
  }
}
