// The cells in sight, each from the finest tile that has it.

import { NOWHERE, SIDE } from './protocol.js';
import { Tiles } from './tiles.js';

/** No tile is there yet. */
export const UNKNOWN = 65534;
const MARGIN = 0.3;

export class Grid {
  constructor() {
    this.level = null;
    this.range = [0, -1, 0, -1];
    this.motion = new Uint16Array(0);
    this.from = new Int8Array(0);
    /** The layer of numbers that is shown, by its name; null for motions. */
    this.layer = null;
  }

  get columns() { return this.range[1] - this.range[0] + 1; }
  get rows() { return this.range[3] - this.range[2] + 1; }

  /** Makes the grid hold a view, and fills it anew if it did not. */
  fit(view, tiles) {
    const z = view.level;
    const [i0, i1, j0, j1] = view.cells(z);
    const [a0, a1, b0, b1] = this.range;
    if (z === this.level && i0 >= a0 && i1 <= a1 && j0 >= b0 && j1 <= b1) return;
    this.rebuild(view, tiles);
  }

  rebuild(view, tiles) {
    this.level = view.level;
    this.range = view.cells(this.level, MARGIN);
    const cells = this.columns * this.rows;
    this.motion = new Uint16Array(cells).fill(UNKNOWN);
    this.from = new Int8Array(cells).fill(-128);
    this.value = this.layer ? new Float32Array(cells).fill(NaN) : null;
    const wide = { level: view.level, cells: (z) => view.cells(z, MARGIN) };
    // Coarser levels first: finer ones cover them.
    for (let z = Tiles.first(view) - 3; z <= this.level; z++) {
      if (z < -12) continue;
      for (const key of tiles.inSight(wide, z)) {
        const tile = tiles.get(...key);
        if (tile) this.put(tile);
      }
    }
  }

  /** Fills in a tile; a cell of a coarser level covers those around its place. */
  put(tile) {
    const finer = this.level - tile.z;
    if (finer < 0 || finer > 20) return;
    const [a0, a1, b0, b1] = this.range;
    const columns = this.columns;
    const values = this.layer ? tile.number : null;
    const size = 2 ** finer, half = size / 2;
    for (let row = 0; row < SIDE; row++) {
      const middle = (tile.j * SIDE + row) * size;
      const top = Math.min(b1, Math.ceil(middle + half) - 1);
      for (let j = Math.max(b0, Math.ceil(middle - half)); j <= top; j++) {
        for (let column = 0; column < SIDE; column++) {
          const motion = tile.motion[row * SIDE + column];
          const centre = (tile.i * SIDE + column) * size;
          const last = Math.min(a1, Math.ceil(centre + half) - 1);
          const line = (j - b0) * columns - a0;
          for (let i = Math.max(a0, Math.ceil(centre - half)); i <= last; i++) {
            if (this.from[line + i] <= tile.z) {
              this.motion[line + i] = motion;
              this.from[line + i] = tile.z;
              if (values) this.value[line + i] = values[row * SIDE + column];
            }
          }
        }
      }
    }
  }

  /** How many cells in sight have each motion: pairs of a motion and a count. */
  count(view) {
    const [i0, i1, j0, j1] = view.cells(this.level);
    const counts = new Map();
    for (let j = Math.max(j0, this.range[2]); j <= Math.min(j1, this.range[3]); j++) {
      const line = (j - this.range[2]) * this.columns - this.range[0];
      for (let i = Math.max(i0, this.range[0]); i <= Math.min(i1, this.range[1]); i++) {
        const motion = this.motion[line + i];
        if (motion !== UNKNOWN && motion !== NOWHERE) counts.set(motion, (counts.get(motion) ?? 0) + 1);
      }
    }
    return [...counts];
  }
}
