// A card about one cell: it fills as the parts of the answer come.

import { digits, drawn, element } from './dom.js';
import { multipliers } from './circle.js';
import { sample } from './legend.js';

const PARTS = [
  ['portrait', 'Phase portrait'], ['series', 'Time series'], ['multipliers', 'Floquet multipliers'],
  ['exponents', 'Lyapunov exponents per forcing period'], ['coexisting', 'From other starts'], ['section', 'Poincaré section'],
];

export class Card {
  constructor({ onclose, onkeep }) {
    this.name = element('h2', { text: '…' });
    this.place = element('p', { class: 'place' });
    this.numbers = element('dl', {});
    this.keep = element('button', { type: 'button', 'aria-pressed': 'false', text: 'Keep', onclick: onkeep,
      title: 'Keeps this card beside the next one' });
    const close = element('button', { type: 'button', text: '×', 'aria-label': 'Close', onclick: onclose });
    this.parts = new Map(PARTS.map(([kind, title]) => {
      const body = element('div', { class: 'body' });
      return [kind, element('section', { class: `part waiting ${kind}` }, element('h3', { text: title }), body)];
    }));
    this.progress = element('p', { class: 'step' });
    this.root = element('article', { class: 'card' },
      element('header', {}, this.name, this.keep, close), this.place, this.numbers, ...this.parts.values(), this.progress);
    this.parts.get('section').hidden = true;
  }

  set kept(kept) {
    this.keep.setAttribute('aria-pressed', String(kept));
    this.keep.textContent = kept ? 'Kept' : 'Keep';
  }

  fill(kind, ...content) {
    const part = this.parts.get(kind);
    part.hidden = false;
    part.classList.remove('waiting');
    part.querySelector('.body').replaceChildren(...content);
  }

  hear(kind, content) {
    if (kind === 'motion') return this.motion(content);
    if (kind === 'progress') return void (this.progress.textContent = `${content.what} …`);
    if (kind === 'refused') {
      if (!this.place.textContent) this.name.textContent = 'no motion';
      this.progress.textContent = content.message;
    }
    if (kind === 'done') this.progress.textContent = '';
    if (kind === 'done' || kind === 'refused') {
      for (const part of this.parts.values()) if (part.classList.contains('waiting')) part.hidden = true;
      return undefined;
    }
    if (kind === 'multipliers') return this.fill(kind, multipliers(content));
    if (content.none) return this.fill(kind, element('p', { class: 'none', text: content.none }));
    if (content.svg) return this.fill(kind, drawn(content.svg, PARTS.find(([part]) => part === kind)[1]));
    if (kind === 'exponents') return this.fill(kind, this.exponents(content));
    if (kind === 'coexisting') return this.fill(kind, this.coexisting(content));
    return undefined;
  }

  motion({ place, fixed, name, regime, exponent, forgets, peak, impacts, periods, state, start, command }) {
    this.name.textContent = name;
    this.place.textContent = place.map((p) => `${p.name} = ${digits(p.value, 15)}`).join(', ');
    this.place.title = fixed.map((p) => `${p.name} = ${digits(p.value, 8)}`).join(', ');
    const row = (term, value) => [element('dt', { text: term }), element('dd', { text: value })];
    this.numbers.replaceChildren(
      ...(regime === name || name.startsWith(regime) ? [] : row('regime', regime)),
      ...row('λ1 per period', digits(forgets ? -Infinity : exponent, 5)), ...row('peak impact velocity', digits(peak, 5)),
      ...row('impacts observed', String(impacts)), ...row('periods followed', String(periods)),
      ...row('started', start), element('dt', { text: 'state' }), element('dd', {}, ...state.flatMap((s, k) => [
        k > 0 ? ', ' : '', element('span', { text: `${s.name} = ${digits(s.value, 6)}` })])));
    const copy = element('button', { type: 'button', class: 'small', text: 'Copy command',
      onclick: () => navigator.clipboard?.writeText(command).then(() => { copy.textContent = 'Copied'; }, () => {}) });
    this.numbers.append(element('dt', { text: 'classify' }), element('dd', {}, copy));
    if (regime !== 'periodic' && regime !== 'periodic with sticking') this.parts.get('section').hidden = regime === 'no impact';
  }

  exponents({ values }) {
    const text = ([value, error]) => (value == null ? '−∞ (a direction is lost)' : `${digits(value, 5)} ± ${digits(error, 2)}`);
    return element('ol', {}, ...values.map((value) => element('li', { text: text(value) })));
  }

  coexisting({ motions, starts }) {
    const rows = motions.map(({ name, paint, starts: own, first, own: same }) => element('li', { title: `first from ${first}` },
      sample([paint]), element('span', { text: same ? `${name} (this one)` : name }),
      element('span', { class: 'share', text: `${own} of ${starts}` })));
    return element('ul', { class: 'coexisting' }, ...rows);
  }
}
