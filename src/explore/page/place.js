// Where the plot lies within the plane's element.

import { shape } from './dom.js';

/** The room around the plot, in pixels: for ticks and titles at the left and below. */
export const MARGINS = { left: innerWidth < 760 ? 60 : 78, right: 14, top: 10, bottom: 56 };

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
