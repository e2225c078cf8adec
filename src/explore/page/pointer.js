// Mouse, pen and fingers: drag moves, wheel and pinch zoom, a click asks, a line cuts.

const STILL = 5;

export class Pointer {
  /**
   * `view` is moved and zoomed; `hears` has moved(step), clicked(x, y), over(x, y) or over(null), and line(from, to, done);
   * `cutting()` says whether a drag draws a line.
   */
  constructor(plane, view, origin, hears) {
    Object.assign(this, { plane, view, origin, hears, down: new Map() });
    plane.addEventListener('pointerdown', (event) => this.press(event));
    plane.addEventListener('pointermove', (event) => this.drag(event));
    for (const type of ['pointerup', 'pointercancel']) plane.addEventListener(type, (event) => this.lift(event));
    plane.addEventListener('pointerleave', () => { if (this.down.size === 0) hears.over(null); });
    plane.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    plane.addEventListener('dblclick', (event) => this.twice(event));
  }

  at(event) {
    const box = this.plane.getBoundingClientRect();
    return [event.clientX - box.left - this.origin.left, event.clientY - box.top - this.origin.top];
  }

  inside([px, py]) {
    const [width, height] = this.view.size;
    return px >= 0 && py >= 0 && px <= width && py <= height;
  }

  press(event) {
    const at = this.at(event);
    if (event.button !== 0 || !this.inside(at)) return;
    this.plane.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, at);
    if (this.down.size === 1) {
      this.began = at;
      this.moved = false;
      this.from = this.hears.cutting() ? this.view.placeAt(...at) : null;
    } else {
      this.moved = true;
      this.from = null;
    }
  }

  drag(event) {
    const at = this.at(event);
    const last = this.down.get(event.pointerId);
    if (!last) {
      if (this.inside(at)) this.hears.over(...this.view.placeAt(...at));
      else this.hears.over(null);
      return;
    }
    if (!this.moved && Math.hypot(at[0] - this.began[0], at[1] - this.began[1]) < STILL) return;
    this.moved = true;
    if (this.from) {
      this.hears.line(this.from, this.view.placeAt(...at), false);
      return;
    }
    if (this.down.size === 2) this.pinch(event.pointerId, last, at);
    else this.view.move(at[0] - last[0], at[1] - last[1]);
    this.down.set(event.pointerId, at);
    this.hears.moved(false);
  }

  pinch(id, last, at) {
    const [, other] = [...this.down].find(([key]) => key !== id);
    const before = Math.hypot(last[0] - other[0], last[1] - other[1]);
    const now = Math.hypot(at[0] - other[0], at[1] - other[1]);
    const middle = [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2];
    this.view.move((at[0] - last[0]) / 2, (at[1] - last[1]) / 2);
    if (before > 10) this.view.zoom([now / before, now / before], ...middle);
  }

  lift(event) {
    if (!this.down.delete(event.pointerId) || this.down.size > 0) return;
    const at = this.at(event);
    if (this.from && this.moved) this.hears.line(this.from, this.view.placeAt(...at), true);
    else if (this.moved) this.hears.moved(true);
    else if (event.type === 'pointerup') this.hears.clicked(...this.view.placeAt(...at));
    this.from = null;
  }

  wheel(event) {
    const at = this.at(event);
    if (!this.inside(at)) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    const factor = Math.exp(-Math.max(-240, Math.min(240, (event.deltaY || event.deltaX) * lines)) * 0.0022);
    // With Shift along the lower axis alone, with Alt along the left one.
    this.view.zoom([event.altKey ? 1 : factor, event.shiftKey ? 1 : factor], ...at);
    this.hears.moved(false);
    clearTimeout(this.settling);
    this.settling = setTimeout(() => this.hears.moved(true), 350);
  }

  twice(event) {
    const at = this.at(event);
    if (!this.inside(at)) return;
    this.view.zoom([2, 2], ...at);
    this.hears.moved(true);
  }
}
