// The address holds the whole view: plane, window, clicked cell, curves; the browser's history goes through the views.

import { afterwards } from './dom.js';
import { isWhole } from './form.js';

const WORDS = ['x', 'y', 'start', 'backend'];
const NUMBERS = ['transient', 'observe', 'max_period'];

/** A view as the part of the address behind #. */
export function written({ plane, window, cell, curves, layer }) {
  const words = new URLSearchParams();
  if (plane.system.name) words.set('system', plane.system.name);
  else words.set('described', plane.system.text);
  for (const key of [...WORDS, ...NUMBERS]) if (plane[key] != null) words.set(key, plane[key]);
  if (plane.fixed_periods) words.set('fixed_periods', '1');
  for (const [name, value] of Object.entries(plane.set)) words.set(`set.${name}`, value);
  if (window) words.set('view', window.join(','));
  if (cell) words.set('cell', cell.join(','));
  if (curves) words.set('curves', '1');
  if (layer) words.set('layer', layer);
  return words.toString();
}

/** What an address says; null where it says nothing. */
export function read(hash, first) {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  if (!words.has('x') && !words.has('system') && !words.has('described')) return null;
  const plane = { ...first, set: {}, fixed_periods: words.get('fixed_periods') === '1' };
  if (words.has('described')) plane.system = { text: words.get('described') };
  else if (words.has('system')) plane.system = { name: words.get('system') };
  // Another system has axes of its own.
  if (JSON.stringify(plane.system) !== JSON.stringify(first.system)) Object.assign(plane, { x: null, y: null, start: 'rest' });
  for (const key of WORDS) if (words.has(key)) plane[key] = words.get(key);
  for (const key of NUMBERS) if (words.has(key) && isWhole(Number(words.get(key)))) plane[key] = Number(words.get(key));
  for (const [key, value] of words) {
    if (key.startsWith('set.') && Number.isFinite(Number(value))) plane.set[key.slice(4)] = Number(value);
  }
  const numbers = (key, count) => {
    const values = (words.get(key) ?? '').split(',').map(Number);
    return words.has(key) && values.length === count && values.every(Number.isFinite) ? values : null;
  };
  const cell = numbers('cell', 3);
  return { plane, window: numbers('view', 4), cell: cell?.every(Number.isSafeInteger) ? cell : null, curves: words.get('curves') === '1',
    layer: words.get('layer') };
}

export class Address {
  /** `state()` gives the view, `go(view)` shows another. */
  constructor(state, go) {
    this.state = state;
    this.replace = afterwards(250, () => this.write(false));
    addEventListener('popstate', () => go(read(location.hash, this.first)));
    addEventListener('hashchange', () => go(read(location.hash, this.first)));
  }

  /** A step that going back undoes, or a small move that it does not. */
  write(step) {
    const hash = `#${written(this.state())}`;
    if (hash === location.hash) return;
    if (step) history.pushState(null, '', hash);
    else history.replaceState(null, '', hash);
  }
}
