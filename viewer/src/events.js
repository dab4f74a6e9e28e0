// SPDX-License-Identifier: MIT
// Server-sent events. Not through EventSource, which does not tell that a connection is dead, gives up
// on some errors, and waits for as long as it likes.

const silence = 25_000;                        // ms without even a heartbeat: the connection is dead
const pauses = [300, 600, 1000, 2000, 3000];   // ms before the next attempt

// Cuts a stream of text into events; comments are heartbeats and nothing else.
export class EventParser {
  #text = '';

  *parse(text) {
    this.#text += text;
    const blocks = this.#text.split('\n\n');
    this.#text = blocks.pop();
    for (const block of blocks) {
      const event = { id: undefined, type: 'message', data: '' };
      for (const line of block.split('\n')) {
        const [, field, value] = /^(\w+): ?(.*)$/.exec(line) ?? [];
        if (field === 'id') event.id = value;
        if (field === 'event') event.type = value;
        if (field === 'data') event.data += value;
      }
      if (event.data) yield event;
    }
  }
}

export class Events {
  #address;
  #take;
  #tell;
  #last;
  #failures = 0;

  // take(type, data) gets each event; tell(state) hears 'live' and 'lost'. What was missed in between
  // comes when the connection is there again.
  constructor(address, take, tell) {
    this.#address = address;
    this.#take = take;
    this.#tell = tell;
  }

  async run() {
    for (;;) {
      try {
        await this.#listen();
      } catch {
        // Refused, cut off or silent: the same to those who watch.
      }
      this.#tell('lost');
      const pause = pauses[Math.min(this.#failures++, pauses.length - 1)];
      await new Promise((resolve) => setTimeout(resolve, pause));
    }
  }

  async #listen() {
    const abort = new AbortController();
    const headers = this.#last === undefined ? {} : { 'Last-Event-ID': this.#last };
    let timer = setTimeout(() => abort.abort(), silence);
    try {
      const response = await fetch(this.#address, { headers, signal: abort.signal, cache: 'no-store' });
      if (!response.ok) throw new Error(String(response.status));
      const parser = new EventParser();
      const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
      for (;;) {
        const { done, value } = await reader.read();
        if (done) return;
        clearTimeout(timer);
        timer = setTimeout(() => abort.abort(), silence);
        this.#failures = 0;
        this.#tell('live');
        for (const event of parser.parse(value)) this.#handle(event);
      }
    } finally {
      clearTimeout(timer);
    }
  }

  #handle({ id, type, data }) {
    this.#take(type, JSON.parse(data));
    if (id !== undefined) this.#last = id;
  }
}
