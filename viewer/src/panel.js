// SPDX-License-Identifier: MIT
// What the page says in words: the state of the connection, counts, and what was clicked.
import { coordinate, count, exact, number } from './text.js';

const kept = 100;  // latencies that the median is of

function element(id) {
  return document.getElementById(id);
}

// Sets what stands behind a term, or hides both.
function show(id, text) {
  element(id).textContent = text ?? '';
  element(id).hidden = element(id).previousElementSibling.hidden = text === undefined;
}

export function median(values) {
  if (values.length === 0) return undefined;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)];
}

export class Panel {
  #latencies = [];
  #wasConnected = false;

  showCounts({ counts, volume, edits, unit }) {
    const texts = { ...counts, edits };
    for (const kind of ['slices', 'slabs', 'faces', 'vertices', 'edits'])
      show(kind, texts[kind] === undefined ? undefined : count(texts[kind]));
    element('volume').textContent = `${number(volume)} ${unit}³`;
    show('latency', edits === undefined ? undefined : element('latency').textContent);
  }

  // Links to the surface as a file, by extension.
  showDownloads(extensions = ['.glb', '.ply']) {
    const links = extensions.map((extension) => {
      const link = document.createElement('a');
      link.href = `surface${extension}`;
      link.download = `surface${extension}`;
      link.textContent = extension.slice(1).toUpperCase();
      link.setAttribute('aria-label', `Download the surface as ${link.textContent}`);
      return link;
    });
    element('downloads').replaceChildren(...links);
  }

  showGrid(step, unit) {
    element('grid').textContent = step === undefined ? '–' : `${number(step)} ${unit}`;
  }

  addLatency(latency) {
    if (!Number.isFinite(latency)) return;
    this.#latencies = [...this.#latencies, latency].slice(-kept);
    this.#showLatency(median(this.#latencies));
  }

  // The server's own figure, as long as there is none from here.
  showStatus({ latency_ms: latency, edits }) {
    if (this.#latencies.length === 0 && edits > 0) this.#showLatency(latency?.median);
  }

  showConnected() {
    element('state').textContent = 'Live';
    element('state').dataset.state = 'live';
    element('banner').hidden = true;
    element('announcement').textContent = this.#wasConnected ? 'Connected again.' : '';
    this.#wasConnected = true;
  }

  showLost() {
    element('state').textContent = 'Not connected';
    element('state').dataset.state = 'lost';
    element('banner').hidden = false;
    element('announcement').textContent = '';
  }

  showPending(pending, isEmpty) {
    element('loading').textContent = pending > 0 ? `Loading ${count(pending)} slabs …` : '';
    element('canvas').setAttribute('aria-busy', String(pending > 0));
    element('empty').hidden = !isEmpty;
  }

  // `place` in the input's coordinates, `nearest` as nearestPoint() gives it.
  showPick(slab, place, nearest, unit, [low, high]) {
    const rows = [];
    if (nearest) {
      const [x, y] = nearest.slice.contours[nearest.contour][nearest.point];
      const label = nearest.slice.labels?.[nearest.contour];
      rows.push(['Slice', `z ${exact(nearest.slice.z)} ${unit}`],
                ['Contour', `${nearest.contour}${label ? ` (${label})` : ''}`],
                ['Point', `${nearest.point}: ${exact(x)}, ${exact(y)}`]);
    }
    rows.push(['Place', place.map((value) => coordinate(value, high - low)).join(', ')]);
    if (slab.label) rows.push(['Label', slab.label]);
    if (slab.confidence !== undefined)  // not of a mesh
      rows.push(['Slab', slab.id],
                ['Between', `${exact(slab.low)} and ${exact(slab.high)} ${unit}`],
                ['Confidence', number(slab.confidence)], ['Edit', count(slab.edit)]);
    const list = element('pick');
    list.replaceChildren();
    for (const [term, text] of rows) {
      list.appendChild(document.createElement('dt')).textContent = term;
      list.appendChild(document.createElement('dd')).textContent = text;
    }
    element('pick-hint').hidden = true;
  }

  forgetPick() {
    element('pick').replaceChildren();
    element('pick-hint').hidden = false;
  }

  #showLatency(latency) {
    const isKnown = latency !== undefined;
    element('latency').textContent = isKnown ? `${latency.toFixed(latency < 100 ? 2 : 0)} ms` : '–';
  }
}
