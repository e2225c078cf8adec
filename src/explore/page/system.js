// The system: one that comes with the program, or the text of one's own.

import { element } from './dom.js';

const OWN = '(own)';
/** A wrong line is shown with about so many above it. */
const ABOVE = 4;

export class SystemForm {
  /** `chosen(system)` asks for a system by its name or its text. */
  constructor(systems, chosen) {
    this.systems = systems;
    this.select = element('select', { 'aria-label': 'system' },
      ...systems.map(({ name, title }) => element('option', { value: name, text: title, title: name })),
      element('option', { value: OWN, text: 'your own …' }));
    this.text = element('textarea', { rows: 14, spellcheck: 'false', 'aria-label': 'the system as a file', wrap: 'off' });
    this.error = element('p', { class: 'error', role: 'alert', hidden: true });
    const use = element('button', { type: 'button', text: 'Use this system', onclick: () => this.use() });
    const keep = element('button', { type: 'button', text: 'Keep the file', onclick: () => this.download() });
    this.editor = element('details', { class: 'editor' }, element('summary', { text: 'The file' }), this.text, this.error,
      element('p', { class: 'buttons' }, use, keep));
    this.root = element('section', { class: 'system' }, this.select, this.editor);
    this.chosen = chosen;
    this.select.addEventListener('change', () => {
      if (this.select.value === OWN) this.editor.open = true;
      else this.chosen({ name: this.select.value });
    });
  }

  use() {
    const known = this.systems.find(({ text }) => text === this.text.value);
    this.chosen(known ? { name: known.name } : { text: this.text.value });
  }

  download() {
    const link = element('a', { download: 'system.toml', href: URL.createObjectURL(new Blob([this.text.value])) });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  /** Shows the system that is open; what was written since stays as long as that is the same. */
  show({ system }) {
    const known = this.systems.some(({ name }) => name === system.origin);
    this.select.value = known ? system.origin : OWN;
    if (this.shown === system.text) return;
    this.fail(null);
    this.text.value = this.shown = system.text;
  }

  /** Says what is wrong with the text, and goes to its line. */
  fail(refused) {
    this.error.hidden = refused == null;
    if (refused == null) return;
    this.error.textContent = refused.message;
    if (refused.line == null) return;
    this.editor.open = true;
    const lines = this.text.value.split('\n');
    const before = lines.slice(0, refused.line - 1).join('\n').length + (refused.line > 1 ? 1 : 0);
    this.text.focus();
    this.text.setSelectionRange(before, before + (lines[refused.line - 1]?.length ?? 0));
    this.text.scrollTop = ((refused.line - ABOVE) / lines.length) * this.text.scrollHeight;
  }
}
