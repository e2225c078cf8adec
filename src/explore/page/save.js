// Taking it along: PNG, SVG or npz of what is in sight, or the command that makes it.

import { element } from './dom.js';
import { whole } from './form.js';

const FORMATS = [['png', 'PNG'], ['svg', 'SVG'], ['npz', 'npz']];

export class Save {
  /** `asked()` gives the plane and the window that are in sight, and whether curves are drawn. */
  constructor(link, status, asked) {
    Object.assign(this, { link, status, asked, size: [1600, 1200] });
    const side = (k, name) => whole(this.size[k], name, (value) => { this.size[k] = value; });
    const buttons = FORMATS.map(([format, name]) => element('button', { type: 'button', text: name, onclick: () => this.save(format) }));
    this.command = element('button', { type: 'button', text: 'Copy command', onclick: () => this.copy() });
    this.text = element('textarea', { rows: 3, readonly: true, hidden: true, 'aria-label': 'the command' });
    this.root = element('details', { class: 'menu' }, element('summary', { text: 'Save' }), element('div', { class: 'sheet' },
      element('p', {}, ...buttons),
      element('p', { class: 'size' }, side(0, 'width in pixels'), ' × ', side(1, 'height in pixels'), ' pixels'),
      this.command, this.text));
    const away = (event) => event.key === 'Escape' || (event.type === 'pointerdown' && !this.root.contains(event.target));
    for (const type of ['keydown', 'pointerdown']) addEventListener(type, (event) => { if (away(event)) this.root.open = false; });
  }

  request() {
    const { scene, window, curves, layer } = this.asked();
    return { scene, window, size: this.size, curves: curves ? 2 : null, layer };
  }

  save(format) {
    this.root.open = false;
    const stop = () => { this.link.cancel(ask); this.status.running('save', null); };
    const ask = this.link.ask({ type: 'save', format, ...this.request() }, (kind, content) => {
      if (kind === 'progress') this.status.running('save', { words: content.what, share: content.share, stop });
      if (kind === 'refused') this.status.notice(content.message, 'save');
      if (kind === 'done' || kind === 'refused') this.status.running('save', null);
      if (kind === 'file') this.download(content);
    });
  }

  download({ name, media, content }) {
    const link = element('a', { download: name, href: URL.createObjectURL(new Blob([content], { type: media })) });
    document.body.dataset.saved = `${name} ${content.byteLength}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  copy() {
    this.text.hidden = true;
    this.link.once({ type: 'command', ...this.request() }, 'command').then(({ text }) => {
      this.text.hidden = false;
      this.text.value = text;
      this.text.select();
      navigator.clipboard?.writeText(text).then(() => {
        this.command.textContent = 'Copied';
        setTimeout(() => { this.command.textContent = 'Copy command'; }, 1500);
      }, () => {});
    }, (error) => this.status.notice(error.message, 'save'));
  }
}
