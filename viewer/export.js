// SPDX-License-Identifier: MIT
// In a page that was exported, opened from the disk or from any web server, this answers in place
// of loft: contents.js calls loftContents() with all that there is to be asked for.
(() => {
  'use strict';
  const answers = new Map();
  let reset;

  const json = (value) => () => new Response(JSON.stringify(value), { headers: { 'Content-Type': 'application/json' } });

  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  globalThis.loftContents = ({ reset: all, status, labels, slices, slabs }) => {
    reset = all;
    answers.set('status', json(status));
    answers.set('labels', json(labels));
    // Whichever are asked for all come at once; what is not wanted is left out there.
    answers.set('slabs', () => new Response(new Blob(slabs.map(bytesOf))));
    all.slices.forEach((z, i) => answers.set(`slices?z=${encodeURIComponent(z)}`, () => new Response(slices[i])));
  };

  globalThis.fetch = async (address) => {
    const answer = answers.get(address) ?? answers.get(address.split('?')[0]);
    return answer ? answer() : new Response('', { status: 404 });
  };

  // Tells once of all that there is; nothing changes.
  globalThis.EventSource = class extends EventTarget {
    static CLOSED = 2;
    readyState = 1;
    constructor() {
      super();
      setTimeout(() => {
        this.dispatchEvent(new Event('open'));
        this.dispatchEvent(new MessageEvent('reset', { data: JSON.stringify(reset), lastEventId: 'exported' }));
      });
    }
    close() {}
  };
})();
