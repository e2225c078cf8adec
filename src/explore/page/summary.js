// What is in sight in sum: the legend of its motions, and the colour bar of a layer of numbers.

import { seldom } from './dom.js';

const NOTHING = { rows: [], notes: [] };

export class Summary {
  /** `parts` has state, grid, view, paint, link and legend; `redraw()` draws the plane anew. */
  constructor(parts, redraw) {
    Object.assign(this, { ...parts, redraw });
    this.count = seldom(120, () => this.ask());
  }

  /** Asks for the legend of what is in sight, and for the colour bar. */
  ask() {
    const { state, grid, view, paint, link, legend } = this;
    if (!state.scene || state.stale) return;
    if (grid.layer) this.askBar();
    const counts = grid.count(view);
    if (counts.length === 0) return void legend.show(NOTHING);
    const rows = innerWidth < 760 ? 12 : 14;
    const { scene } = state.scene;
    link.once({ type: 'legend', scene, cells: counts, rows }, 'legend').then((shown) => {
      if (scene !== state.scene?.scene) return;
      counts.forEach(([motion], k) => paint.set(motion, shown.paints[k]));
      legend.show(shown);
      this.redraw();
    }, () => {});
  }

  askBar() {
    const { state, grid, view, link, legend } = this;
    const { layer } = grid;
    legend.ask(link, state.scene.scene, layer, view).then((shown) => {
      if (grid.layer !== layer) return;
      this.bar(shown);
      this.redraw();
    }, () => {});
  }

  /** Shows that nothing is known yet. */
  none() {
    this.legend.show(NOTHING);
    this.paint.blank();
  }

  /** Shows a colour bar, and numbers by it; neither for null. */
  bar(shown) {
    this.paint.bar = shown;
    this.legend.scale(shown);
  }
}
