// What is in sight: the place in the middle and the pixels of a cell, in cells of level 0.

const FINEST = 30;
const COARSEST = -12;
/** Half a cell, less what rounding may add: a cell whose edge alone is in sight is not. */
const EDGE = 0.5 - 1e-6;
/** A cell has at least so many pixels; a screen has at most so many cells. */
const LEAST_PIXELS = 0.7;
const MOST_CELLS = 1.2e6;
/** Sides of what is looked at, and how far away it may be, in cells of level 0; rounding may take a little of them. */
const SMALLEST = 4 * 2 ** -FINEST;
const LARGEST = 2 ** 19;
const FARTHEST = 2 ** 30;

export class View {
  constructor() {
    this.size = [600, 400];
    this.whole = [-0.5, 0.5, -0.5, 0.5];
    this.window = [...this.whole];
  }

  /** Sets the plane's own extent, half a cell around its cells. */
  extent(columns, rows) {
    this.whole = [-0.5, columns - 0.5, -0.5, rows - 0.5];
  }

  /** Pixels of a cell of level 0, across and up. */
  get scale() {
    const [x0, x1, y0, y1] = this.window;
    return [this.size[0] / (x1 - x0), this.size[1] / (y1 - y0)];
  }

  /** The level whose cells are shown. */
  get level() {
    const [across, up] = this.scale;
    // Of the whole plane its own cells are shown; of a part of it, about as many.
    const [x0, x1, y0, y1] = this.window, [a0, a1, b0, b1] = this.whole;
    const closer = Math.log2(Math.max((a1 - a0) / (x1 - x0), (b1 - b0) / (y1 - y0)));
    let z = Math.floor(Math.min(Math.log2(Math.min(across, up) / LEAST_PIXELS), closer + 1e-6));
    const cells = (level) => ((this.size[0] / across) * (this.size[1] / up)) * 4 ** level;
    while (cells(z) > MOST_CELLS) z -= 1;
    return Math.max(COARSEST, Math.min(FINEST, z));
  }

  /** The place under a pixel, from the upper left corner of the plot. */
  placeAt(px, py) {
    const [x0, , , y1] = this.window;
    const [across, up] = this.scale;
    return [x0 + px / across, y1 - py / up];
  }

  /** The pixel of a place. */
  pixelAt(x, y) {
    const [x0, , , y1] = this.window;
    const [across, up] = this.scale;
    return [(x - x0) * across, (y1 - y) * up];
  }

  /** Columns and rows of a level that are in sight: first and last of each. */
  cells(z, margin = 0) {
    const [x0, x1, y0, y1] = this.window;
    const unit = 2 ** z;
    const wide = margin * (x1 - x0), high = margin * (y1 - y0);
    return [
      Math.ceil((x0 - wide) * unit - EDGE), Math.floor((x1 + wide) * unit + EDGE),
      Math.ceil((y0 - high) * unit - EDGE), Math.floor((y1 + high) * unit + EDGE),
    ];
  }

  /** The cell of a level that holds a place. */
  cellAt(x, y, z = this.level) {
    return [z, Math.round(x * 2 ** z), Math.round(y * 2 ** z)];
  }

  move(dx, dy) {
    const [across, up] = this.scale;
    const [x0, x1, y0, y1] = this.window;
    this.set([x0 - dx / across, x1 - dx / across, y0 + dy / up, y1 + dy / up]);
  }

  /** Zooms in by factors, the place under a pixel staying where it is. */
  zoom(factors, px, py) {
    const [x, y] = this.placeAt(px, py);
    const [x0, x1, y0, y1] = this.window;
    const span = (from, to, factor) => Math.max(8 * 2 ** -FINEST, Math.min(2 ** 18, (to - from) / factor)) / (to - from);
    const fx = span(x0, x1, factors[0]), fy = span(y0, y1, factors[1]);
    this.set([x + (x0 - x) * fx, x + (x1 - x) * fx, y + (y0 - y) * fy, y + (y1 - y) * fy]);
  }

  /** Shows a window; false where it cannot be looked at. */
  set(window) {
    const extent = (from, to) => to - from >= SMALLEST && to - from <= LARGEST && Math.max(Math.abs(from), Math.abs(to)) <= FARTHEST;
    const fits = window.length === 4 && extent(window[0], window[1]) && extent(window[2], window[3]);
    if (fits) this.window = window;
    return fits;
  }

  reset() {
    this.window = [...this.whole];
  }
}

/** The part of a window of cells that lies on a plane of so many columns and rows, where any does. */
export function clipped({ z, columns, rows }, across, up) {
  const inside = ([from, to], count) => {
    const last = Math.floor((count - 1) * 2 ** z);
    return to < 0 || from > last ? [from, to] : [Math.max(from, 0), Math.min(to, last)];
  };
  return { z, columns: inside(columns, across), rows: inside(rows, up) };
}
