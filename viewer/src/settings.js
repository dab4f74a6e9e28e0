// SPDX-License-Identifier: MIT
// The controls for what is shown: contours, one slice, the cut, colours.
import { coordinate, exact } from './text.js';

function element(id) {
  return document.getElementById(id);
}

export class Settings extends EventTarget {
  #heights = [];
  #z;
  #isChosen = false;  // else the middle one is shown
  #range;
  #cutZ;  // once it was moved
  #unit = '';

  constructor() {
    super();
    for (const id of ['contours', 'slice-on', 'cut-on', 'cut-below', 'colour'])
      element(id).addEventListener('change', () => this.#tell());
    element('slice').addEventListener('input', () => this.#choose());
    element('cut').addEventListener('input', () => this.#moveCut());
  }

  get hasContours() { return element('contours').checked; }
  get colour() { return element('colour').value; }
  // The height of the slice to be shown, if any is.
  get slice() { return element('slice-on').checked ? this.#z : undefined; }
  // { z, keepsBelow }, if there is a cut.
  get cut() {
    if (!element('cut-on').checked || !this.#range) return undefined;
    return { z: this.#cutHeight(), keepsBelow: element('cut-below').checked };
  }

  toggle(id) {
    if (element(id).disabled) return;
    element(id).checked = !element(id).checked;
    this.#tell();
  }

  // Turns a slider on and gives it the focus; off, if it has it.
  reach(id) {
    if (element(id).disabled) return;
    const isThere = element(`${id}-on`).checked && document.activeElement === element(id);
    element(`${id}-on`).checked = !isThere;
    if (!isThere) element(id).focus();
    this.#tell();
  }

  nextColour() {
    const select = element('colour');
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    this.#tell();
  }

  // The heights of the slices, and how far the surface reaches.
  setHeights(heights, range, unit) {
    this.#heights = heights;
    this.#unit = unit;
    this.#range = range;
    const slider = element('slice');
    slider.max = Math.max(heights.length - 1, 0);
    for (const id of ['contours', 'slice-on', 'slice']) element(id).disabled = heights.length === 0;
    for (const id of ['cut-on', 'cut', 'cut-below']) element(id).disabled = !this.#range;
    this.#z = this.#isChosen ? this.#nearest(this.#z) : heights[Math.floor(heights.length / 2)];
    slider.value = Math.max(heights.indexOf(this.#z), 0);
    this.#placeCut();
    this.#show();
  }

  // Makes a slice the chosen one.
  choose(z) {
    this.#isChosen = true;
    this.#z = this.#nearest(z);
    element('slice').value = this.#heights.indexOf(this.#z);
    this.#show();
  }

  #nearest(z) {
    let best = this.#heights[0];
    for (const height of this.#heights)
      if (Math.abs(height - z) < Math.abs(best - z)) best = height;
    return best;
  }

  #choose() {
    this.choose(this.#heights[Number(element('slice').value)]);
    element('slice-on').checked = true;
    this.#tell();
  }

  #moveCut() {
    const [low, high] = this.#range;
    this.#cutZ = low + (Number(element('cut').value) / Number(element('cut').max)) * (high - low);
    element('cut-on').checked = true;
    this.#tell();
  }

  // Where it stays while the surface grows.
  #placeCut() {
    if (!this.#range || this.#range[0] === this.#range[1]) return;
    const [low, high] = this.#range;
    const slider = element('cut');
    slider.value = ((this.#cutHeight() - low) / (high - low)) * Number(slider.max);
  }

  #cutHeight() {
    const [low, high] = this.#range;
    return Math.min(Math.max(this.#cutZ ?? (low + high) / 2, low), high);
  }

  #cutText() {
    return coordinate(this.#cutHeight(), this.#range[1] - this.#range[0]);
  }

  #tell() {
    this.#show();
    this.dispatchEvent(new Event('change'));
  }

  #show() {
    const slice = this.#z === undefined ? '–' : `${exact(this.#z)} ${this.#unit}`;
    const cut = this.#range ? `${this.#cutText()} ${this.#unit}` : '–';
    for (const [id, text] of [['slice', slice], ['cut', cut]]) {
      if (element(`${id}-height`).textContent === text) continue;
      element(`${id}-height`).textContent = text;
      element(id).setAttribute('aria-valuetext', text);
    }
  }
}
