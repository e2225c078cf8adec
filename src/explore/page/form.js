// Fields of the controls: a label, one or two inputs, and what is wrong with them.

import { element } from './dom.js';

let numbered = 0;

/** A number that is typed; `changed` hears it once it is complete. */
export function number(value, name, changed) {
  const input = element('input', { type: 'text', inputmode: 'decimal', value: String(value), 'aria-label': name,
    autocomplete: 'off', spellcheck: 'false' });
  input.addEventListener('change', () => {
    const typed = Number(input.value.replace(',', '.').replace('−', '-'));
    const fine = input.value.trim() !== '' && Number.isFinite(typed);
    input.setAttribute('aria-invalid', String(!fine));
    if (fine) changed(typed);
  });
  return input;
}

/** A choice of some values. */
export function choice(options, value, name, changed) {
  const select = element('select', { 'aria-label': name }, ...options.map(([key, text]) => (
    element('option', { value: key, selected: key === value, text }))));
  select.addEventListener('change', () => changed(select.value));
  return select;
}

/** Fields in a line under a name. */
export function row(name, title, ...fields) {
  const id = `field-${++numbered}`;
  if (fields[0] && !fields[0].id) fields[0].id = id;
  return element('div', { class: 'row', title }, element('label', { for: fields[0]?.id, text: name }), ...fields);
}

/** A group of fields that can be folded away. */
export function group(name, open, ...rows) {
  return element('details', { class: 'group', open }, element('summary', { text: name }), ...rows);
}
