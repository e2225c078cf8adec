// Floquet multipliers beside the unit circle.

import { digits, element, shape } from './dom.js';

const HALF = 78;

function plot(values) {
  const farthest = Math.max(1, ...values.map(([re, im]) => Math.hypot(re, im)).filter(Number.isFinite));
  const reach = Math.min(farthest, 2.5) * 1.14;
  const at = (value) => (value / reach) * HALF;
  const points = values.filter(([re, im]) => Math.hypot(re, im) <= reach).map(([re, im]) => shape('circle', {
    cx: at(re), cy: -at(im), r: 4, class: Math.hypot(re, im) > 1 ? 'outside' : 'inside',
  }));
  return shape('svg', {
    viewBox: `${-HALF - 4} ${-HALF - 4} ${2 * HALF + 8} ${2 * HALF + 8}`, class: 'circle', role: 'img',
    'aria-label': 'Floquet multipliers and the unit circle',
  },
  shape('path', { d: `M${-HALF} 0H${HALF}M0 ${-HALF}V${HALF}`, class: 'cross' }),
  shape('circle', { r: at(1), class: 'unit' }), ...points);
}

/** Multipliers as a picture and as numbers. */
export function multipliers({ values, stable, none }) {
  if (none) return element('p', { class: 'none', text: none });
  const text = ([re, im]) => {
    const size = digits(Math.hypot(re, im), 4);
    if (Math.abs(im) < 1e-12) return digits(re, 5);
    return `${digits(re, 4)} ${im < 0 ? '−' : '+'} ${digits(Math.abs(im), 4)} i  (|·| = ${size})`;
  };
  const says = stable == null ? '' : stable ? 'All lie within the unit circle: stable.' : 'Not all lie within the unit circle: unstable.';
  return element('div', { class: 'floquet' }, plot(values),
    element('div', {}, element('ol', {}, ...values.map((value) => element('li', { text: text(value) }))),
      element('p', { text: says })));
}
