// Elements in a line.

const SVG = 'http://www.w3.org/2000/svg';

function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (name === 'text') node.textContent = value;
    else if (value === true) node.setAttribute(name, '');
    else if (value !== false && value != null) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child != null));
  return node;
}

/** An HTML element with attributes, listeners (`onclick`) and children. */
export function element(tag, attributes, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** An SVG element. */
export function shape(tag, attributes, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

/** A figure that the server drew, as an element; nothing in it can act. */
export function drawn(svg, name) {
  // Styles are in the page's own sheets; the browser refuses others as soon as they are read.
  const unstyled = svg.replaceAll(/ style="[^"]*"/g, '');
  const root = new DOMParser().parseFromString(unstyled, 'image/svg+xml').documentElement;
  if (root.localName !== 'svg') return element('p', { text: 'The figure cannot be shown.' });
  root.querySelector('metadata')?.remove();
  root.setAttribute('role', 'img');
  root.setAttribute('aria-label', name);
  root.classList.add('figure');
  return document.importNode(root, true);
}

/** Does something at once, and at most once in so many milliseconds: of the calls meanwhile the last one counts. */
export function seldom(milliseconds, action) {
  let timer = null, next = null;
  const run = () => {
    timer = null;
    if (next) act(...next);
  };
  const act = (...values) => {
    next = null;
    timer = setTimeout(run, milliseconds);
    action(...values);
  };
  return (...values) => {
    if (timer == null) act(...values);
    else next = values;
  };
}

/** Does something once nobody has asked for it in so many milliseconds. */
export function afterwards(milliseconds, action) {
  let timer = null;
  return (...values) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(...values), milliseconds);
  };
}

/** A number in a few digits. */
export function digits(value, most = 6) {
  if (value == null || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  const text = Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-4)
    ? value.toExponential(Math.min(3, most - 1))
    : String(Number(value.toPrecision(most)));
  return text.replace('-', '−');
}
