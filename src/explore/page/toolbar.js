// The tools above the plane.

import { element } from './dom.js';
import { choice } from './form.js';
import * as theme from './theme.js';

function button(text, title, pressed, onclick, disabled = false) {
  const label = /\w/.test(text) ? null : title;
  return element('button', { type: 'button', text, title, onclick, 'aria-label': label, 'aria-pressed': pressed == null ? null : String(pressed), disabled });
}

export class Toolbar {
  /** `parts` has state, grid, curves, slice, plane, save, and what buttons do: home, showLayer, toggleCurves. */
  constructor(root, parts) {
    Object.assign(this, { root, parts });
  }

  show() {
    const { state, grid, curves, slice, plane, save, home, showLayer, toggleCurves } = this.parts;
    const layers = [['motion', 'Motions'], ...(state.scene?.layers ?? []).map(({ name, title }) => [name, title])];
    const inactive = !state.scene?.curves;
    const held = [...this.root.children].indexOf(document.activeElement);
    this.root.replaceChildren(
      choice(layers, grid.layer ?? 'motion', 'layer', showLayer),
      button('Whole plane', 'The whole plane (key 0)', null, home),
      button('Curves', inactive ? 'Curves need two parameters on the axes' : 'Bifurcation curves of what is in sight',
        curves.shown, () => toggleCurves(!curves.shown), inactive),
      button('Slice', 'Drag a line, or set its ends by Enter: the bifurcation diagram along it', slice.active, () => {
        slice.active = !slice.active;
        slice.follow(null);
        plane.classList.toggle('cutting', slice.active);
        this.show();
      }),
      save,
      button('◐', 'Light or dark', null, theme.toggle));
    this.root.children[held]?.focus();
  }
}
