// Everything that says which plane it is: axes, parameters, start, periods, back end. Each change asks for another plane.

import { afterwards, element } from './dom.js';
import { choice, focused, group, number, row, whole } from './form.js';
import { SystemForm } from './system.js';

const STEPS = 400;

export class Controls {
  /** `open(plane)` asks for a plane. */
  constructor(root, hello, open) {
    this.root = root;
    this.hello = hello;
    this.open = open;
    this.slide = afterwards(120, (name, value) => this.set(name, value));
    this.system = new SystemForm(hello.systems, (system) => this.change({ system, x: null, y: null, set: {}, start: 'rest' }));
    this.body = element('div', {});
    for (const type of ['pointerup', 'pointercancel']) addEventListener(type, () => { this.held = false; });
    root.replaceChildren(this.system.root, this.body);
  }

  change(changes) {
    this.open({ ...this.plane, ...changes });
  }

  set(name, value) {
    this.change({ set: { ...this.plane.set, [name]: value } });
  }

  /** Shows the plane that is open. While a slider is held it stays as it is, and what is being typed stays. */
  show(scene) {
    const sameSystem = this.scene && this.scene.system.text === scene.system.text;
    const sameAxes = sameSystem && this.scene.x.name === scene.x.name && this.scene.y.name === scene.y.name;
    this.scene = scene;
    this.plane = scene.plane;
    this.system.show(scene);
    if (sameAxes && this.held) return void this.update(scene);
    this.build(scene);
  }

  /** What was asked for is refused: the fields say again which plane is open. */
  refuse() {
    if (this.scene) this.build(this.scene);
  }

  build(scene) {
    const focus = focused(this.body);
    const folded = new Map([...this.body.querySelectorAll('details')].map((g) => [g.firstChild.textContent, g.open]));
    const open = (name, first) => folded.get(name) ?? first;
    this.inputs = new Map();
    this.body.replaceChildren(
      group('Parameters', open('Parameters', true), ...this.parameters(scene)),
      group('Axes', open('Axes', true), ...this.axis('x', scene), ...this.axis('y', scene)),
      group('Start and periods', open('Start and periods', false), ...this.start(scene)),
      group('Computing', open('Computing', false), this.backend(scene)));
    focus();
  }

  update(scene) {
    for (const { name, value } of scene.parameters) {
      const pair = this.inputs.get(name);
      for (const input of pair ?? []) {
        if (input === document.activeElement) continue;
        input.value = input.type === 'range' ? this.toSlider(name, value) : String(value);
        if (input.type === 'range') input.setAttribute('aria-valuetext', String(value));
      }
    }
  }

  toSlider(name, value) {
    const { slider: [low, high] } = this.scene.parameters.find((parameter) => parameter.name === name);
    return Math.round(((value - low) / (high - low)) * STEPS);
  }

  parameters(scene) {
    const free = scene.parameters.filter(({ name }) => name !== scene.x.name && name !== scene.y.name);
    return free.map(({ name, symbol, about, value, slider: [low, high], range }) => {
      const typed = number(value, name, (given) => this.set(name, given));
      const slider = element('input', { type: 'range', min: 0, max: STEPS, 'aria-label': `${name}, slider`, 'aria-valuetext': String(value),
        value: Math.round(((value - low) / (high - low)) * STEPS) });
      slider.addEventListener('pointerdown', () => { this.held = true; });
      slider.addEventListener('input', () => {
        const given = Number((low + (slider.value / STEPS) * (high - low)).toPrecision(4));
        typed.value = String(given);
        slider.setAttribute('aria-valuetext', typed.value);
        this.slide(name, given);
      });
      this.inputs.set(name, [typed, slider]);
      const label = symbol === name ? name : `${symbol}  ${name}`;
      return row(label, `${about || name}: ${range}`, typed, slider);
    });
  }

  axis(which, scene) {
    const { name, first, last, count, log } = scene[which];
    const other = scene[which === 'x' ? 'y' : 'x'].name;
    const names = [...scene.parameters.map((parameter) => parameter.name), ...scene.components];
    const options = names.filter((candidate) => candidate !== other).map((candidate) => [candidate, candidate]);
    const text = (changes) => {
      const axis = { ...this.scene[which], ...changes };
      return `${axis.name}=${axis.first}:${axis.last}:${axis.count}${axis.log ? ':log' : ''}`;
    };
    const change = (changes) => this.change({ [which]: text(changes) });
    const title = which === 'x' ? 'across' : 'up';
    const choose = choice(options, name, `${title}: what`, (chosen) => this.vary(which, chosen));
    const ratios = element('input', { type: 'checkbox', checked: log, 'aria-label': `${title}: equal ratios` });
    ratios.addEventListener('change', () => change({ log: ratios.checked }));
    return [
      row(title, 'What the axis varies', choose, element('label', { class: 'check', title: 'Values at equal ratios' }, ratios, 'log')),
      row('from', 'The first value', number(first, `${title}: from`, (value) => change({ first: value })),
        element('span', { class: 'to', text: 'to' }), number(last, `${title}: to`, (value) => change({ last: value }))),
      row('cells', 'Cells of the whole plane; closer up they are finer',
        whole(count, `${title}: cells`, (value) => change({ count: value }))),
    ];
  }

  /** Another quantity on an axis, over its slider's range; what was there takes the middle of its own. */
  vary(which, name) {
    const scene = this.scene;
    const parameter = scene.parameters.find((candidate) => candidate.name === name);
    const range = parameter ? parameter.slider : scene.component_ranges[scene.components.indexOf(name)];
    const [low, high] = range.map((end) => Number(end.toPrecision(6)));
    const set = { ...this.plane.set };
    delete set[name];
    const { count } = scene[which];
    const varied = [name, scene[which === 'x' ? 'y' : 'x'].name].some((axis) => scene.components.includes(axis));
    const start = varied && this.plane.start === 'symmetric' ? 'rest' : this.plane.start;
    this.change({ [which]: `${name}=${low}:${high}:${count}`, set, start });
  }

  start(scene) {
    const kinds = [['rest', 'at rest'], ...(scene.starts_symmetric ? [['symmetric', 'on the 1-1-1 motion']] : []), ['state', 'a state']];
    const kind = ['rest', 'symmetric'].includes(scene.start) ? scene.start : 'state';
    const zero = scene.components.map(() => '0').join(',');
    const typed = element('input', { type: 'text', value: kind === 'state' ? scene.start : zero, 'aria-label': 'start state',
      hidden: kind !== 'state', spellcheck: 'false', title: scene.components.join(', ') });
    typed.addEventListener('change', () => this.change({ start: typed.value }));
    const choose = choice(kinds, kind, 'start', (chosen) => this.change({ start: chosen === 'state' ? typed.value : chosen }));
    const periods = (name, title, key) => row(name, title, whole(this.plane[key], name, (value) => this.change({ [key]: value })));
    return [
      row('start', 'How every cell begins', choose), typed,
      periods('transient', 'Forcing periods before the observation', 'transient'),
      periods('observe', 'Forcing periods of the observation', 'observe'),
      periods('largest N', 'Largest N looked for in N-p-q', 'max_period'),
    ];
  }

  backend(scene) {
    const options = this.hello.backends.map(({ name, about }) => [name, about]);
    const choose = choice(options, this.plane.backend, 'back end', (backend) => this.change({ backend }));
    return element('div', {}, row('on', 'What computes', choose),
      element('p', { class: 'note', text: `now ${scene.backend}: ${scene.adapter}` }));
  }
}
