// SPDX-License-Identifier: MIT
// The server's events. The browser connects anew by itself and says which event was the last; where
// it gives up, or the connection is dead without saying so, this does.

const shortest = 500;    // ms between two attempts
const longest = 15000;
const watch = 10000;     // ms between two looks at the server

export class Events extends EventTarget {
  #source;
  #pause = shortest;
  #timer;
  #isOpen = false;

  start() {
    this.#open();
    setInterval(() => this.#look(), watch);
    addEventListener('online', () => this.restart());
  }

  // From the beginning: the server says all that there is.
  restart() {
    clearTimeout(this.#timer);
    this.#open();
  }

  #open() {
    this.#source?.close();
    this.#source = new EventSource('events');
    this.#source.addEventListener('open', () => this.#tell(true));
    this.#source.addEventListener('error', () => this.#fail());
    for (const kind of ['reset', 'change']) {
      this.#source.addEventListener(kind, (event) => {
        this.#tell(true);
        this.dispatchEvent(new CustomEvent(kind, { detail: JSON.parse(event.data) }));
      });
    }
  }

  #tell(isOpen) {
    if (isOpen) this.#pause = shortest;
    if (isOpen === this.#isOpen) return;
    this.#isOpen = isOpen;
    this.dispatchEvent(new CustomEvent(isOpen ? 'connected' : 'lost'));
  }

  #fail() {
    const isOver = this.#source.readyState === EventSource.CLOSED;
    this.#isOpen = true;  // also where the first attempt fails
    this.#tell(false);
    if (!isOver) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#open(), this.#pause);
    this.#pause = Math.min(2 * this.#pause, longest);
  }

  async #look() {
    if (!this.#isOpen) return;
    try {
      const response = await fetch('status', { signal: AbortSignal.timeout(watch), cache: 'no-store' });
      if (response.ok) this.dispatchEvent(new CustomEvent('status', { detail: await response.json() }));
    } catch {
      this.restart();
      this.#tell(false);
    }
  }
}
