// What runs, and what went wrong.

import { element } from './dom.js';

export class Status {
  constructor(progress, notices) {
    this.progress = progress;
    this.notices = notices;
    this.bar = element('span', { class: 'bar' });
    this.words = element('span', { class: 'words' });
    this.stop = element('button', { type: 'button', class: 'small', text: 'Stop', hidden: true });
    progress.append(this.words, element('span', { class: 'track' }, this.bar), this.stop);
    this.tasks = new Map();
  }

  /** Of what runs, what began last; null where nothing does. */
  get task() {
    return [...this.tasks.values()].at(-1) ?? null;
  }

  /** How much of what is in sight is there. */
  tiles(share, cells) {
    this.share = share;
    this.cells = cells;
    this.show();
  }

  /** What else runs under a name: words, a share or null, and how to stop it; null where it has ended. */
  running(name, task) {
    if (task) this.tasks.set(name, task);
    else this.tasks.delete(name);
    this.stop.hidden = !this.task?.stop;
    this.stop.onclick = this.task?.stop ?? null;
    this.show();
  }

  show() {
    const share = this.task ? this.task.share : this.share;
    const busy = this.task != null || this.share < 1;
    this.progress.classList.toggle('busy', busy);
    this.progress.classList.toggle('endless', this.task != null && share == null);
    this.bar.style.width = `${Math.round(100 * (share ?? 1))}%`;
    const [columns, rows] = this.cells ?? [0, 0];
    const size = `${columns} × ${rows} cells`;
    if (this.task) this.words.textContent = `${this.task.words} …`;
    else this.words.textContent = busy ? `${size}, ${Math.floor(100 * this.share)} %` : size;
  }

  /** Something that went wrong, until it is closed or `clear`ed by its name; once, however many questions it is the answer to. */
  notice(text, name = null) {
    if (name) this.clear(name);
    for (const shown of [...this.notices.children]) if (shown.firstChild.textContent === text) shown.remove();
    const close = element('button', { type: 'button', text: '×', 'aria-label': 'Close', onclick: () => notice.remove() });
    const notice = element('div', { class: 'notice', 'data-name': name }, element('span', { text }), close);
    this.notices.append(notice);
    while (this.notices.children.length > 3) this.notices.firstChild.remove();
  }

  clear(name) {
    for (const notice of this.notices.querySelectorAll(`[data-name="${name}"]`)) notice.remove();
  }
}
