// The cells in pixels: ground, and where a motion has one its hatch.

import { NOWHERE } from './protocol.js';
import { UNKNOWN } from './grid.js';

/** A colour #rrggbb as the four bytes of a pixel. */
function pixel(css) {
  const rgb = parseInt(css.slice(1), 16);
  return (0xff000000 | ((rgb & 0xff) << 16) | (rgb & 0xff00) | (rgb >> 16)) >>> 0;
}

export class Paint {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', { alpha: true });
    this.grounds = new Uint32Array(65536);
    this.hatches = new Uint32Array(65536);
    /** 1 where no motion begins: such cells have no numbers. */
    this.barred = new Uint8Array(65536);
    this.hatch = [7, 2];
    this.scale = null;
  }

  /** A motion that the program tells of. */
  meet(motion, { paint, begins }) {
    this.set(motion, paint);
    this.barred[motion] = begins ? 0 : 1;
  }

  /** The paint of a motion: ground and hatch. */
  set(motion, [ground, hatch]) {
    this.grounds[motion] = pixel(ground);
    this.hatches[motion] = hatch ? pixel(hatch) : 0;
  }

  /** The colour bar of a layer of numbers; null for motions. */
  set bar(bar) {
    this.scale = bar && {
      parts: bar.parts,
      colours: Uint32Array.from(bar.colours, pixel),
      beyond: bar.beyond.map(pixel),
      undefined: pixel(bar.undefined[0]),
      lost: pixel(bar.lost[0]),
    };
  }

  /** The colour of a number. */
  number(value) {
    const { parts, colours, beyond, undefined: none, lost } = this.scale;
    if (Number.isNaN(value)) return none;
    if (value === -Infinity) return lost;
    if (value < parts[0].ends[0]) return beyond[0];
    if (value > parts.at(-1).ends[1]) return beyond[1];
    const { ends: [low, high], log, shares } = parts.find((part) => value <= part.ends[1]);
    const within = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    const share = shares[0] + within * (shares[1] - shares[0]);
    return colours[Math.max(0, Math.min(colours.length - 1, Math.floor(share * colours.length)))];
  }

  clear() {
    this.grounds.fill(0);
    this.hatches.fill(0);
    this.barred.fill(0);
  }

  /** Nothing is drawn. */
  blank() {
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  /** The canvas for a plot of so many pixels of the page. */
  resize([width, height]) {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.image = this.context.createImageData(this.canvas.width, this.canvas.height);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.ratio = ratio;
  }

  /** Draws what is in sight. */
  draw(view, grid) {
    const { width, height } = this.canvas;
    const unit = 2 ** grid.level;
    const columns = new Int32Array(width);
    for (let x = 0; x < width; x++) {
      const [place] = view.placeAt((x + 0.5) / this.ratio, 0);
      const i = Math.round(place * unit);
      columns[x] = i < grid.range[0] || i > grid.range[1] ? -1 : i - grid.range[0];
    }
    const [spacing, thickness] = this.hatch.map((length) => Math.max(1, Math.round(length * this.ratio)));
    const numbers = grid.layer && grid.value && this.scale;
    for (let y = 0; y < height; y++) {
      const [, place] = view.placeAt(0, (y + 0.5) / this.ratio);
      const j = Math.round(place * unit);
      const outside = j < grid.range[2] || j > grid.range[3];
      const line = (j - grid.range[2]) * grid.columns;
      for (let x = 0, at = y * width; x < width; x++, at++) {
        const motion = outside || columns[x] < 0 ? UNKNOWN : grid.motion[line + columns[x]];
        if (motion === UNKNOWN || motion === NOWHERE) {
          this.pixels[at] = 0;
          continue;
        }
        if (numbers && !this.barred[motion]) {
          this.pixels[at] = this.number(grid.value[line + columns[x]]);
          continue;
        }
        const hatch = this.hatches[motion];
        this.pixels[at] = hatch !== 0 && (x + y) % spacing < thickness ? hatch : this.grounds[motion];
      }
    }
    this.context.putImageData(this.image, 0, 0);
  }
}
