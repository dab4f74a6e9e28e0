// SPDX-License-Identifier: MIT
// The server's events. The browser connects anew by itself and says which event was the last; where
// it gives up, or the connection is dead without saying so, this does. A page that is not seen lets
// go of its connection: a browser has few for all its pages.

const shortest = 500;    // ms between two attempts
const longest = 15_000;
const watch = 10_000;    // ms between two looks at the server
const unseen = 30_000;   // ms until a hidden page lets go

// Dispatches `reset` and `change` with what the server says, `status`, and `connected` or `lost`.
export class Events extends EventTarget {
  #source;
  #last = '';
  #pause = shortest;
  #timer;
  #unseenTimer;
  #state = 'waiting';

  start() {
    this.#open();
    setInterval(() => this.#look(), watch);
    addEventListener('online', () => { if (this.#state !== 'connected') this.#reopen(); });
    document.addEventListener('visibilitychange', () => this.#turn(document.hidden));
  }

  // From the beginning: the server says all that there is.
  restart() {
    this.#last = '';
    this.#reopen();
  }

  #reopen() {
    clearTimeout(this.#timer);
    this.#open();
  }

  #open() {
    this.#source?.close();
    this.#source = new EventSource(this.#last ? `events?after=${this.#last}` : 'events');
    this.#source.addEventListener('open', () => this.#tell('connected'));
    this.#source.addEventListener('error', () => this.#fail());
    for (const kind of ['reset', 'change']) {
      this.#source.addEventListener(kind, ({ data, lastEventId }) => {
        this.#last = lastEventId;
        this.dispatchEvent(new CustomEvent(kind, { detail: JSON.parse(data) }));
      });
    }
  }

  #turn(isHidden) {
    clearTimeout(this.#unseenTimer);
    if (isHidden) {
      this.#unseenTimer = setTimeout(() => {
        this.#source.close();
        clearTimeout(this.#timer);
        this.#state = 'away';
      }, unseen);
    } else if (this.#state === 'away') {
      this.#reopen();
    }
  }

  #fail() {
    this.#tell('lost');
    if (this.#source.readyState !== EventSource.CLOSED) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#open(), this.#pause);
    this.#pause = Math.min(2 * this.#pause, longest);
  }

  #tell(state) {
    if (state === 'connected') this.#pause = shortest;
    if (state === this.#state) return;
    this.#state = state;
    this.dispatchEvent(new CustomEvent(state));
    if (state === 'connected') this.#look();
  }

  async #look() {
    if (this.#state !== 'connected') return;
    try {
      const response = await fetch('status', { signal: AbortSignal.timeout(watch) });
      if (!response.ok) return;
      this.dispatchEvent(new CustomEvent('status', { detail: await response.json() }));
    } catch {
      this.#tell('lost');
      this.#reopen();
    }
  }
}
