// SPDX-License-Identifier: MIT
// What goes to the program and what comes from it. Edits go one after the other; of those of one
// thing that wait, the last one counts. Events come in order, none twice; after a pause the program
// sends what was missed, or the whole state.

const shortest = 500;  // ms between two attempts
const longest = 10_000;

// Dispatches `reset` and `change` ({event, content}), `connected`, `lost`, and `refused` ({edit, why}).
export class Link extends EventTarget {
  #tab;
  #source;
  #last = '';
  #pause = shortest;
  #timer;
  #waiting = [];  // {tab, edit, key, resolve}
  #isSending = false;
  #token = new URLSearchParams(location.hash.slice(1)).get('token') ?? '';

  constructor() {
    super();
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden && this.#source?.readyState === EventSource.CLOSED) this.#open();
    });
    addEventListener('pagehide', () => this.close());
  }

  // Which tab's events come; `last` is the id of the last one that is known of it.
  follow(tab, last = '') {
    this.#tab = tab;
    this.#last = last;
    this.#open();
  }

  get last() { return this.#last; }

  // No events come until a tab is followed again.
  close() {
    clearTimeout(this.#timer);
    this.#source?.close();
  }

  // Resolves with the number of the edit's event, or nothing where it was refused. Edits with the same
  // key replace one another while they wait.
  send(edit, key) {
    return new Promise((resolve) => {
      const same = key && this.#waiting.findIndex((one) => one.key === key && one.tab === this.#tab);
      if (key && same >= 0) {
        this.#waiting[same].resolve();
        this.#waiting.splice(same, 1);
      }
      this.#waiting.push({ tab: this.#tab, edit, key, resolve });
      this.#sendNext();
    });
  }

  // What the program knows: `question` is the end of an address.
  async ask(question) {
    const response = await fetch(`tabs/${this.#tab}/${question}`);
    if (!response.ok) throw new Error((await response.json()).error);
    return response.json();
  }

  // The same, where the answer is numbers alone.
  async numbers(question) {
    const response = await fetch(`tabs/${this.#tab}/${question}`);
    if (!response.ok) throw new Error(`no ${question}`);
    return new Float32Array(await response.arrayBuffer());
  }

  async #sendNext() {
    if (this.#isSending || this.#waiting.length === 0) return;
    this.#isSending = true;
    const { tab, edit, key, resolve } = this.#waiting.shift();
    try {
      resolve(await this.#post(tab, edit));
    } catch {
      // The connection is lost: what was moved last is told later; no edit is done twice by that.
      if (key && !this.#waiting.some((one) => one.key === key)) {
        this.#waiting.unshift({ tab, edit, key, resolve });
        await new Promise((done) => { setTimeout(done, shortest); });
      } else {
        this.dispatchEvent(new CustomEvent('refused', { detail: { edit, why: 'The connection was lost; try again.' } }));
        resolve();
      }
    }
    this.#isSending = false;
    this.#sendNext();
  }

  async #post(tab, edit) {
    const headers = { 'Content-Type': 'application/json' };
    if (this.#token) headers.Authorization = `Bearer ${this.#token}`;
    const response = await fetch(`tabs/${tab}`, { method: 'POST', headers, body: JSON.stringify(edit) });
    const answer = await response.json();
    if (response.ok) return answer.event;
    if (response.status === 401 && this.#askForToken()) return this.#post(tab, edit);
    this.dispatchEvent(new CustomEvent('refused', { detail: { edit, why: answer.error } }));
    return undefined;
  }

  #askForToken() {
    const token = prompt('Edits need the token that was printed at the start:');
    this.#token = token ?? '';
    return token !== null;
  }

  #open() {
    clearTimeout(this.#timer);
    this.#source?.close();
    const after = this.#last ? `&after=${this.#last}` : '';
    const source = new EventSource(`events?tab=${this.#tab}${after}`);
    this.#source = source;
    source.addEventListener('open', () => {
      this.#pause = shortest;
      this.dispatchEvent(new Event('connected'));
    });
    source.addEventListener('error', () => this.#fail(source));
    for (const kind of ['reset', 'change']) {
      source.addEventListener(kind, ({ data, lastEventId }) => {
        if (source !== this.#source) return;
        this.#last = lastEventId;
        const detail = { event: Number(lastEventId.split('.')[1]), content: JSON.parse(data) };
        this.dispatchEvent(new CustomEvent(kind, { detail }));
      });
    }
  }

  #fail(source) {
    if (source !== this.#source) return;
    this.dispatchEvent(new Event('lost'));
    if (source.readyState !== EventSource.CLOSED) return;
    this.#timer = setTimeout(() => this.#open(), this.#pause);
    this.#pause = Math.min(2 * this.#pause, longest);
  }
}
