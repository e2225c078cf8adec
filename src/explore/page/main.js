// The explorer: what is in sight, what is asked for, and what comes of it.

import { Address, read } from './address.js';
import { Axes } from './axes.js';
import { Controls } from './controls.js';
import { Curves } from './curves.js';
import { element, shape } from './dom.js';
import { Grid } from './grid.js';
import { Keys } from './keys.js';
import { Legend } from './legend.js';
import { Link } from './link.js';
import { Marks } from './marks.js';
import { Paint } from './paint.js';
import { Panel } from './panel.js';
import { fitted, makeRoom, MARGINS } from './place.js';
import { Pointer } from './pointer.js';
import { Save } from './save.js';
import { Slice } from './slice.js';
import { Status } from './status.js';
import { Summary } from './summary.js';
import * as theme from './theme.js';
import { Tiles } from './tiles.js';
import { first } from './timing.js';
import { Told } from './told.js';
import { Toolbar } from './toolbar.js';
import { clipped, View } from './view.js';
import { asHtml } from './words.js';

const EM = 13;

performance.mark('script');
theme.begin();
const at = (id) => document.getElementById(id);
const plane = at('plane'), frame = at('frame'), canvas = plane.querySelector('canvas');
const state = { scene: null, motions: [], over: null, cursor: null, pending: null, shownFor: null };

const told = new Told();
const view = new View();
const grid = new Grid();
const paint = new Paint(canvas);
const status = new Status(at('progress'), at('notices'));
const link = new Link(hear);
const tiles = new Tiles((keys) => state.scene && link.send({ type: 'want', scene: state.scene.scene, tiles: keys, layer: grid.layer }));
const clip = shape('clipPath', { id: 'plot' }, shape('rect', {}));
frame.append(shape('defs', {}, clip));
const curves = new Curves(frame, link, status);
const slice = new Slice(frame, at('slice'), link, status);
const marks = new Marks(frame, plane, at('hover'), at('readout'), view, MARGINS);
const axes = new Axes(frame, link, MARGINS);
const summary = new Summary({ state, grid, view, paint, link, legend: new Legend(at('legend')) }, redraw);
const panel = new Panel(at('cards'), link, () => chosen());
const save = new Save(link, status, () => ({ scene: state.scene.scene, window: shown(), curves: curves.shown, layer: grid.layer }));
const address = new Address(() => ({
  plane: state.scene.plane, window: view.window, cell: panel.current?.cell, curves: curves.shown, layer: grid.layer,
}), go);
const toolbar = new Toolbar(at('tools'), { state, grid, curves, slice, plane, home, showLayer, toggleCurves, save: save.root });
let controls = null;

/** The window that is taken along: whole cells in sight; of the whole plane, exactly its cells. */
function shown() {
  const z = view.level;
  const [i0, i1, j0, j1] = view.cells(z);
  const whole = view.window.every((value, k) => Math.abs(value - view.whole[k]) < 1e-6);
  if (whole) return { z: 0, columns: [0, state.scene.x.count - 1], rows: [0, state.scene.y.count - 1] };
  return state.scene.clip({ z, columns: [i0, i1], rows: [j0, j1] });
}

// ——— messages of the server ———

function hear(type, message) {
  if (type === 'hello' || type === 'tile') first(type);
  if (type === 'hello') welcome(message);
  else if (type === 'tile') tile(message);
  else if (type === 'motions') motions(message);
  else if (type === 'failed' && message.scene === state.scene?.scene) status.notice(message.message, 'tiles');
  else if (type === 'refused') status.notice(message.message, 'refused');
  else if (type === 'closed') {
    if (state.scene) status.notice('The connection was lost; trying again …', 'link');
    state.pending = null;
  } else if (type === 'moved') {
    status.notice('The program was started anew: open the address that it prints now.', 'link');
  }
}

function welcome(hello) {
  status.clear('link');
  address.first = hello.plane;
  controls ??= new Controls(at('controls'), hello, (asked) => open(asked, { step: true }));
  const before = state.scene && { plane: state.scene.plane, window: view.window, cell: null, curves: false, layer: grid.layer };
  const wanted = before ?? read(location.hash, hello.plane) ?? { plane: hello.plane };
  state.scene = null;
  told.forget();
  open(wanted.plane, { ...wanted, fallback: hello.plane, again: before != null });
}

/** Asks for a plane; the view stays where the axes do. */
function open(asked, { window = null, cell = null, curves: withCurves = false, layer = grid.layer, step = false, fallback = null, again = false, because = null } = {}) {
  const request = state.pending = {};
  link.once({ type: 'open', plane: asked }, 'scene').then((scene) => {
    if (state.pending !== request) return;
    state.pending = null;
    arrive(scene, { window, again, layer });
    if (cell) panel.show(scene.scene, cell);
    if (withCurves) toggleCurves(true);
    address.write(step);
    if (because) status.notice(because, 'open');
  }, (refused) => {
    if (state.pending !== request) return;
    state.pending = null;
    if (fallback && !state.scene) return void open(fallback, { because: refused.message });
    if (refused.line != null) controls.system.fail(refused);
    else status.notice(refused.message, 'open');
    controls.refuse();
  });
}

function arrive(scene, { window, again, layer }) {
  first('scene');
  const before = state.scene;
  const same = before && ['x', 'y'].every((side) => before[side].text === scene[side].text)
    && before.system.text === scene.system.text;
  scene.clip = (cells) => clipped(cells, scene.x.count, scene.y.count);
  state.scene = scene;
  state.motions = told.of(scene.scene);
  grid.layer = layered(layer);
  summary.bar(null);
  tiles.clear();
  if (!again) {
    paint.clear();
    panel.clear();
  }
  if (before && before.system.text !== scene.system.text) summary.none();
  state.motions.forEach((motion, k) => paint.meet(k, motion));
  curves.clear();
  slice.close();
  status.clear('open');
  state.stale = state.fresh = true;
  view.extent(scene.x.count, scene.y.count);
  if (window ? !view.set(window) : !same && !again) view.reset();
  at('system-name').textContent = scene.system.name;
  at('title').replaceChildren(...scene.title.flatMap((words) => [element('span', {}, ...asHtml(words)), ' ']));
  document.title = `${scene.x.name}, ${scene.y.name} – Impact Atlas`;
  plane.setAttribute('data-scene', scene.scene);
  controls.show(scene);
  tools();
  look();
}

function motions(message) {
  told.add(message);
  if (message.scene === state.scene?.scene) message.motions.forEach((motion, k) => paint.meet(message.first + k, motion));
}

function tile(message) {
  if (message.scene !== state.scene?.scene || message.layer !== layerPlace()) return;
  tiles.put(message);
  if (state.stale) {
    state.stale = false;
    grid.rebuild(view, tiles);
  } else {
    grid.put(message);
  }
  tiles.topUp();
  redraw();
  summary.count();
}

// ——— the view ———

/** Asks for what the view lacks, and for its ticks. */
function look() {
  if (!state.scene) return;
  if (!state.stale) grid.fit(view, tiles);
  const [x0, x1, y0, y1] = view.window;
  tiles.look(view, state.over ?? [(x0 + x1) / 2, (y0 + y1) / 2]);
  axes.ask(state.scene.scene, view, EM, (sides) => {
    paint.hatch = sides.hatch;
    // Under a pointer that holds the plane nothing moves by itself.
    const changes = pointer.down.size === 0 && makeRoom(sides.y, plane.clientWidth, state.fresh);
    state.fresh = false;
    if (changes) fit();
    else redraw();
  });
  redraw();
  summary.count();
}

/** The view moves; a `step` ends there, and going back undoes the whole of it. */
function moved(step) {
  look();
  if (step) address.write(true);
}

let drawing = false;
function redraw() {
  if (drawing) return;
  drawing = true;
  requestAnimationFrame(() => {
    drawing = false;
    if (!state.scene) return;
    if (!state.stale) paint.draw(view, grid);
    axes.draw(view);
    curves.draw(view, MARGINS, EM);
    slice.place(view, MARGINS);
    marks.draw(state, panel.cellsOf(state.scene.scene), tiles);
    const share = tiles.share;
    const [i0, i1, j0, j1] = view.cells(view.level);
    status.tiles(share, [i1 - i0 + 1, j1 - j0 + 1]);
    plane.dataset.share = share.toFixed(4);
    plane.dataset.known = String(!state.stale && tiles.isBegun(view));
    if (plane.dataset.known === 'true') first('known');
  });
}

/** The name of a layer of numbers; null for motions and for names that there are not. */
function layered(name) {
  return state.scene?.layers.some((layer) => layer.name === name) ? name : null;
}

/** By what number a tile says that it carries the numbers of the layer that is shown; those of another come anew. */
function layerPlace() {
  return 1 + state.scene.layers.findIndex((layer) => layer.name === grid.layer);
}

/** Shows motions, or a layer of numbers. */
function showLayer(name) {
  grid.layer = layered(name);
  summary.bar(null);
  // Tiles carry the numbers of one layer; the program still has their cells.
  tiles.clear();
  state.stale = true;
  look();
  address.replace();
}

// ——— input ———

function click(x, y) {
  if (!state.scene) return;
  panel.show(state.scene.scene, view.cellAt(x, y));
  chosen();
}

/** Another cell is shown, or none: a step that going back undoes. */
function chosen() {
  redraw();
  address.write(true);
}

const tools = () => toolbar.show();
const over = (x, y) => { state.over = x == null ? null : [x, y]; redraw(); };

function home() {
  state.fresh = true;
  view.reset();
  moved(true);
}

function go(wanted) {
  const { scene } = state;
  wanted ??= { plane: address.first };
  if (layered(wanted.layer) !== grid.layer) showLayer(wanted.layer);
  if (!scene || JSON.stringify(wanted.plane) !== JSON.stringify({ ...scene.plane })) return void open(wanted.plane, wanted);
  if (!wanted.window || !view.set(wanted.window)) view.reset();
  const cell = panel.current?.cell;
  if (wanted.cell && String(cell) !== String(wanted.cell)) panel.show(scene.scene, wanted.cell);
  if (!wanted.cell) panel.clear();
  if (Boolean(wanted.curves) !== curves.shown) toggleCurves(!curves.shown);
  look();
}

function toggleCurves(on) {
  if (on) curves.compute(state.scene, view, () => { tools(); redraw(); address.replace(); });
  else curves.clear();
  tools();
  redraw();
  address.replace();
}

const cutting = () => slice.active;
const line = (from, to, done) => { slice.draw(from, to, done, state.scene.scene); redraw(); };
const pointer = new Pointer(plane, view, MARGINS, { moved, over, clicked: click, cutting, line });
new Keys(plane, view, {
  moved, home, clicked: click, cutting,
  cursor: (place) => { state.cursor = place; slice.follow(place); redraw(); },
  mark: (place) => { slice.mark(place, state.scene.scene); redraw(); },
});
addEventListener('keydown', (event) => { if (event.key === 'Escape') slice.close(); });

/** The plot in the room that there is. */
function fit() {
  view.size = fitted(plane, canvas, clip);
  paint.resize(view.size);
  look();
}
new ResizeObserver(fit).observe(plane);

globalThis.explorer = { state, view, grid, tiles, paint, panel, link, curves, slice, save, shown };
