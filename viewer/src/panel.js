// SPDX-License-Identifier: MIT
// What the page says in words: the state of the connection, counts, and what was clicked.
import { coordinate, count, counted, exact, number } from './text.js';

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
  #isConnected = false;
  #isRecorded;  // whether nothing comes any more; undefined until the server says what it shows
  #picked;

  showCounts({ counts, volume, edits, unit }) {
    const texts = { ...counts, edits };
    for (const kind of ['slices', 'slabs', 'faces', 'vertices', 'edits'])
      show(kind, texts[kind] === undefined ? undefined : count(texts[kind]));
    element('volume').textContent = Number.isFinite(volume) ? `${number(volume)} ${unit}³` : '–';
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

  // The server's own figure, as long as there is none from here; after a resume it has none, either.
  showStatus({ latency_ms: latency }) {
    if (this.#latencies.length === 0 && latency?.last > 0) this.#showLatency(latency.median);
  }

  // What it is that is shown, as a `reset` says it.
  showKind({ kind, name, edits }) {
    this.#isRecorded = kind === undefined ? edits === undefined : kind !== 'capture';
    document.title = name ? `${name} – Loft` : 'Loft';
    element('name').textContent = element('name').title = name ?? '';
    this.#showState();
  }

  showConnected() {
    this.#isConnected = true;
    this.#showState();
    element('banner').hidden = true;
    element('announcement').textContent = this.#wasConnected ? 'Connected again.' : '';
    this.#wasConnected = true;
  }

  showLost() {
    this.#isConnected = false;
    this.#showState();
    element('banner').hidden = false;
    element('announcement').textContent = '';
  }

  showPending(pending, isEmpty) {
    element('loading').textContent = pending > 0 ? `Loading ${counted(pending, 'slab')} …` : '';
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
                ['Point', `${nearest.point}: ${exact(x)}, ${exact(y)} ${unit}`]);
    }
    const [px, py, pz] = place.map((value) => coordinate(value, high - low));
    rows.push(['Place', `${px}, ${py}, ${pz} ${unit}`]);
    if (slab.label) rows.push(['Label', slab.label]);
    this.#picked = slab;
    if (slab.confidence !== undefined)  // not of a mesh
      rows.push(['Slab', slab.id],
                ['Between', `${exact(slab.low)} and ${exact(slab.high)} ${unit}`],
                ['Confidence', number(slab.confidence)], ['Edit', count(slab.edit)]);
    element('pick').replaceChildren();
    this.#addToPick(rows);
    element('pick-hint').hidden = true;
  }

  // The label of what was picked, until its figures are there.
  get pickedLabel() { return this.#picked?.label; }

  // Those of a label (figures.js), if it is still what was picked.
  addFigures(label, { volume, area }, measure) {
    if (this.#picked?.label !== label) return;
    this.#picked = undefined;  // once
    this.#addToPick([['Volume', `${number(volume)} ${measure.volumeUnit}`],
                     ['Area', `${number(area)} ${measure.areaUnit}`]]);
  }

  forgetPick() {
    this.#picked = undefined;
    element('pick').replaceChildren();
    element('pick-hint').hidden = false;
  }

  #addToPick(rows) {
    for (const [term, text] of rows) {
      element('pick').appendChild(document.createElement('dt')).textContent = term;
      element('pick').appendChild(document.createElement('dd')).textContent = text;
    }
  }

  #showState() {
    const state = element('state');
    const word = this.#isRecorded === undefined ? 'Connected' : this.#isRecorded ? 'Recorded' : 'Live';
    state.textContent = this.#isConnected ? word : 'Not connected';
    state.dataset.state = this.#isConnected ? word.toLowerCase() : 'lost';
  }

  #showLatency(latency) {
    const isKnown = latency !== undefined;
    element('latency').textContent = isKnown ? `${latency.toFixed(latency < 100 ? 2 : 0)} ms` : '–';
  }
}
