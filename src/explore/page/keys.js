// The plane by keyboard: arrows move, + and − zoom, Shift and arrows move a cursor, Enter asks what moves there or, where a line
// is to cut the plane, begins and ends it.

const STEP = 0.12;
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Keys {
  /**
   * `hears` has moved(step), clicked(x, y), cursor(place or null), home() and mark(place); `cutting()` says whether Enter marks
   * the ends of a line.
   */
  constructor(plane, view, hears) {
    this.cursor = null;
    const left = () => {
      this.cursor = null;
      hears.cursor(null);
    };
    plane.addEventListener('blur', left);
    plane.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey) return;
      const arrow = ARROWS[event.key];
      const [width, height] = view.size;
      if (arrow && event.shiftKey) this.step(view, arrow, event.altKey ? 10 : 1, hears);
      else if (arrow) {
        view.move(-arrow[0] * STEP * width, arrow[1] * STEP * height);
        hears.moved(true);
      } else if (event.key === '+' || event.key === '=') {
        view.zoom([1.5, 1.5], ...this.middle(view));
        hears.moved(true);
      } else if (event.key === '-') {
        view.zoom([1 / 1.5, 1 / 1.5], ...this.middle(view));
        hears.moved(true);
      } else if (event.key === '0' || event.key === 'Home') {
        hears.home();
      } else if (event.key === 'Enter' || event.key === ' ') {
        if (!event.repeat) this.enter(this.place(view), hears);
      } else {
        return;
      }
      event.preventDefault();
    });
  }

  /** Where the cursor is; the middle of the view where there is none in it. */
  place(view) {
    const [x0, x1, y0, y1] = view.window;
    const inSight = this.cursor && this.cursor[0] >= x0 && this.cursor[0] <= x1 && this.cursor[1] >= y0 && this.cursor[1] <= y1;
    return inSight ? this.cursor : view.placeAt(view.size[0] / 2, view.size[1] / 2);
  }

  /** Asks what moves at a place, or sets an end of a line there. */
  enter(place, hears) {
    if (!hears.cutting()) return void hears.clicked(...place);
    this.cursor = place;
    hears.cursor(place);
    hears.mark(place);
  }

  middle(view) {
    return view.pixelAt(...this.place(view));
  }

  step(view, [dx, dy], cells, hears) {
    const unit = Math.max(2 ** -view.level, 1.5 / Math.min(...view.scale));
    const [x, y] = this.place(view);
    const [x0, x1, y0, y1] = view.window;
    this.cursor = [
      Math.min(x1, Math.max(x0, x + dx * cells * unit)), Math.min(y1, Math.max(y0, y + dy * cells * unit)),
    ];
    hears.cursor(this.cursor);
  }
}
