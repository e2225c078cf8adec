// Where the plot lies within the plane's element.

import { shape } from './dom.js';

/** The least room at the left: for short labels and the title. */
const LEAST = innerWidth < 760 ? 60 : 78;
/** What a label has beside it there, and by how much the room grows at a time. */
const BESIDE = 42, GROWS = 14, MOST = 240;

/** The room around the plot, in pixels: for ticks and titles at the left and below. */
export const MARGINS = { left: LEAST, right: 14, top: 10, bottom: 56 };

const pen = document.createElement('canvas').getContext('2d');

/** Makes room at the left for the labels of an axis; whether there was more or less before. */
export function makeRoom({ labelled }) {
  pen.font = '13px Inter, system-ui, sans-serif';
  const widest = Math.max(0, ...labelled.map(([, label]) => pen.measureText(label).width));
  const more = Math.ceil(Math.max(0, widest + BESIDE - LEAST) / GROWS) * GROWS;
  const left = Math.min(LEAST + more, Math.max(LEAST, MOST));
  const changes = left !== MARGINS.left;
  MARGINS.left = left;
  document.documentElement.style.setProperty('--left', `${left}px`);
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
