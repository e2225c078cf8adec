// Where the plot lies within the plane's element.

import { shape } from './dom.js';

/** The least room at the left: for short labels and the title. */
const LEAST = innerWidth < 760 ? 60 : 78;
/** What a label has beside it there, by how much the room grows at a time, and what share of the width it takes at most. */
const BESIDE = 42, GROWS = 14, MOST = 0.4;

/** The room around the plot, in pixels: for ticks and titles at the left and below. */
export const MARGINS = { left: LEAST, right: 14, top: 10, bottom: 56 };
const say = () => document.documentElement.style.setProperty('--left', `${MARGINS.left}px`);
say();

const pen = document.createElement('canvas').getContext('2d');

/** Makes room at the left for the labels of an axis beside a plane of a width; less than before only where it is all `fresh`. */
export function makeRoom({ labelled }, width, fresh) {
  pen.font = '13px Inter, system-ui, sans-serif';
  const widest = Math.max(0, ...labelled.map(([, label]) => pen.measureText(label).width));
  const more = Math.ceil(Math.max(0, widest + BESIDE - LEAST) / GROWS) * GROWS;
  const left = Math.min(Math.max(LEAST + more, fresh ? 0 : MARGINS.left), Math.max(LEAST, Math.round(MOST * width)));
  const changes = left !== MARGINS.left;
  MARGINS.left = left;
  say();
  return changes;
}

/** Fits the canvas and the clip of curves into the room that the plane has; the plot's size in pixels. */
export function fitted(plane, canvas, clip) {
  const width = Math.max(60, plane.clientWidth - MARGINS.left - MARGINS.right);
  const height = Math.max(60, plane.clientHeight - MARGINS.top - MARGINS.bottom);
  canvas.style.left = `${MARGINS.left}px`;
  canvas.style.top = `${MARGINS.top}px`;
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  clip.firstChild.replaceWith(shape('rect', { x: MARGINS.left, y: MARGINS.top, width, height }));
  return [width, height];
}
