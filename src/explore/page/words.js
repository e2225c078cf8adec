// Texts that the server sends in parts: upright, italic, sub- and superscript.

import { element, shape } from './dom.js';

const TAGS = { italic: 'i', subscript: 'sub', superscript: 'sup', upright: 'span' };

/** The parts as HTML. */
export function asHtml(words) {
  return words.map(({ text, style }) => element(TAGS[style] ?? 'span', { text }));
}

/** The parts as plain text. */
export function asText(words) {
  return words.map(({ text }) => text).join('');
}

/** The parts as pieces of an SVG text. */
export function asSvg(words) {
  let shift = 0;
  return words.map(({ text, style }) => {
    const wanted = style === 'subscript' ? 0.18 : style === 'superscript' ? -0.36 : 0;
    const small = wanted !== 0;
    const piece = shape('tspan', {
      dy: `${wanted - shift}em`,
      'font-style': style === 'italic' ? 'italic' : null,
      class: small ? 'small' : null,
      text,
    });
    shift = wanted;
    return piece;
  });
}
