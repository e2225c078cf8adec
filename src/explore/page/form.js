// Fields of the controls: a label, one or two inputs, and what is wrong with them.

import { element } from './dom.js';

let numbered = 0;

/** Whether a number can be one of periods, of cells or of pixels. */
export function isWhole(value) {
  return Number.isInteger(value) && value >= 0 && value < 2 ** 32;
}

/** A whole number that is typed. */
export function whole(value, name, changed) {
  return number(value, name, changed, isWhole);
}

/** A number that is typed; `changed` hears it once it is complete, if it is one of those that `fits`. */
export function number(value, name, changed, fits = Number.isFinite) {
  const input = element('input', { type: 'text', inputmode: 'decimal', value: String(value), 'aria-label': name,
    autocomplete: 'off', spellcheck: 'false' });
  input.addEventListener('change', () => {
    const typed = Number(input.value.replace(',', '.').replace('−', '-'));
    const fine = input.value.trim() !== '' && fits(typed);
    input.setAttribute('aria-invalid', String(!fine));
    input.dataset.typing = String(!fine);
    if (fine) changed(typed);
  });
  input.addEventListener('input', () => { input.dataset.typing = 'true'; });
  return input;
}

/** Remembers the field of a form that has the focus; to be called once another form has taken its place: the field of that name has the
 * focus then, with what is being typed or selected there. */
export function focused(form) {
  const held = form.contains(document.activeElement) ? document.activeElement : null;
  const name = held?.getAttribute('aria-label');
  const text = held?.type === 'text' ? { value: held.value, from: held.selectionStart, to: held.selectionEnd } : null;
  const typing = held?.dataset.typing === 'true';
  return () => {
    const field = name && form.querySelector(`[aria-label="${CSS.escape(name)}"]`);
    if (!field) return;
    if (typing) {
      field.value = text.value;
      field.dataset.typing = 'true';
    }
    field.focus();
    if (text?.from === 0 && text.to === text.value.length) field.select();
    else if (text) field.setSelectionRange(text.from, text.to);
  };
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
