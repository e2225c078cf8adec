// The WebSocket: questions and their answers, and the way back when the connection is lost.

import { decoded, FILE, TILE } from './protocol.js';

const FIRST_WAIT = 300;
const LONGEST_WAIT = 5000;

export class Link {
  /** `heard(type, message)` gets what is no answer; types `closed` and `moved` tell of the connection. */
  constructor(heard) {
    this.heard = heard;
    this.asked = 0;
    this.open = new Map();
    this.wait = FIRST_WAIT;
    this.files = new Map();
    this.connect();
  }

  connect() {
    const address = new URL('ws', document.baseURI);
    address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
    address.hash = '';
    this.socket = new WebSocket(address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => { this.wait = FIRST_WAIT; };
    this.socket.onmessage = ({ data }) => (typeof data === 'string' ? this.text(JSON.parse(data)) : this.bytes(data));
    this.socket.onclose = () => this.lost();
  }

  lost() {
    for (const { heard } of this.open.values()) heard('refused', { message: 'The connection was lost.' });
    this.open.clear();
    this.heard('closed', {});
    setTimeout(() => this.again(), this.wait);
    this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
  }

  /** Connects again, unless another program answers here: one that was started anew has another address. */
  again() {
    const moved = ({ status }) => (status === 404 ? this.heard('moved', {}) : this.connect());
    fetch(document.baseURI, { cache: 'no-store' }).then(moved, () => this.connect());
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  send(request) {
    if (this.isOpen) this.socket.send(JSON.stringify(request));
  }

  /** Asks something; `heard(type, content)` gets every part of the answer, `done` or `refused` last. */
  ask(request, heard) {
    const ask = ++this.asked;
    if (!this.isOpen) {
      heard('refused', { message: 'There is no connection.' });
      return ask;
    }
    this.open.set(ask, { heard });
    this.send({ ...request, ask });
    return ask;
  }

  /** Asks something that has one answer. */
  once(request, type) {
    return new Promise((resolve, reject) => {
      // Where there is no connection it is refused at once, before it has a number.
      let ask = null;
      ask = this.ask(request, (heard, content) => {
        this.open.delete(ask);
        if (heard === type) resolve(content);
        else reject(Object.assign(new Error(content.message), content));
      });
    });
  }

  /** Gives up a question: nothing of it is heard any more. */
  cancel(ask) {
    if (this.open.delete(ask)) this.send({ type: 'cancel', ask });
  }

  text(message) {
    const question = message.ask == null ? null : this.open.get(message.ask);
    if (message.ask != null && !question) return;
    if (!question) return void this.heard(message.type, message);
    const { heard } = question;
    if (message.type === 'file') return void this.files.set(message.ask, message.content);
    if (message.type === 'done' || message.type === 'refused') this.open.delete(message.ask);
    heard(message.type, 'content' in message ? message.content : message);
  }

  bytes(buffer) {
    const message = decoded(buffer);
    if (message.kind === TILE) return void this.heard('tile', message);
    const about = this.files.get(message.ask);
    this.files.delete(message.ask);
    if (message.kind === FILE && about) {
      this.open.get(message.ask)?.heard('file', { ...about, content: message.content });
    }
  }
}
