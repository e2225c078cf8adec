// The tiles that came, and those that are wanted: visible ones, coarse before fine, nearest the pointer first.

import { SIDE } from './protocol.js';

const MOST_KEPT = 6000;
const MOST_WANTED = 320;
const TOP_UP = 120;
/** The coarsest level shows at most about so many cells, so that it is there at once. */
const FIRST_CELLS = 700;

export class Tiles {
  /** `want(keys)` asks for tiles; what it asked for before is forgotten. */
  constructor(want) {
    this.want = want;
    this.clear();
  }

  clear() {
    this.kept = new Map();
    this.asked = new Set();
    this.missing = [];
    this.all = 0;
  }

  /** The coarsest level that is worth showing in a view. */
  static first(view) {
    let z = view.level;
    for (;;) {
      const [i0, i1, j0, j1] = view.cells(z);
      if ((i1 - i0 + 1) * (j1 - j0 + 1) <= FIRST_CELLS || z <= -12) return z;
      z -= 1;
    }
  }

  /** Whether the coarsest level of a view is there. */
  isBegun(view) {
    for (const key of this.inSight(view, Tiles.first(view))) if (!this.get(...key)) return false;
    return true;
  }

  get(z, i, j) {
    return this.kept.get(`${z},${i},${j}`);
  }

  put(tile) {
    const key = `${tile.z},${tile.i},${tile.j}`;
    this.kept.delete(key);
    this.kept.set(key, tile);
    this.asked.delete(key);
    // A map keeps the order in which things were put there: the oldest come first.
    while (this.kept.size > MOST_KEPT) this.kept.delete(this.kept.keys().next().value);
  }

  /** The tiles of a level that are in sight. */
  *inSight(view, z) {
    const [i0, i1, j0, j1] = view.cells(z).map((cell) => Math.floor(cell / SIDE));
    for (let j = j0; j <= j1; j++) for (let i = i0; i <= i1; i++) yield [z, i, j];
  }

  /** Finds what a view lacks, nearest `at` (a place) first, and asks for it. */
  look(view, at) {
    this.missing = [];
    this.all = 0;
    for (let z = Tiles.first(view); z <= view.level; z++) {
      const near = [];
      const unit = SIDE * 2 ** -z;
      const [wide, high] = view.scale;
      for (const key of this.inSight(view, z)) {
        this.all += 1;
        const kept = this.get(...key);
        if (kept) {
          // Tiles that were looked at last are kept longest.
          this.kept.delete(key.join());
          this.kept.set(key.join(), kept);
          continue;
        }
        const dx = ((key[1] + 0.5) * unit - at[0]) * wide, dy = ((key[2] + 0.5) * unit - at[1]) * high;
        near.push([dx * dx + dy * dy, key]);
      }
      near.sort((a, b) => a[0] - b[0]);
      for (const [, key] of near) this.missing.push(key);
    }
    this.ask();
  }

  ask() {
    const keys = this.missing.filter((key) => !this.kept.has(key.join())).slice(0, MOST_WANTED);
    this.asked = new Set(keys.map((key) => key.join()));
    this.want(keys);
  }

  /** Asks for more once little is under way. */
  topUp() {
    if (this.asked.size > TOP_UP) return;
    const left = this.missing.filter((key) => !this.kept.has(key.join()));
    if (left.length > this.asked.size) {
      this.missing = left;
      this.ask();
    } else if (left.length === 0) {
      this.missing = left;
    }
  }

  /** The share of what is in sight that is there. */
  get share() {
    const left = this.missing.reduce((count, key) => count + (this.kept.has(key.join()) ? 0 : 1), 0);
    return this.all === 0 ? 1 : 1 - left / this.all;
  }
}
