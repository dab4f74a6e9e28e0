// SPDX-License-Identifier: MIT
// The controls for what is shown: contours, one slice, colours.
import { exact } from './text.js';

function element(id) {
  return document.getElementById(id);
}

export class Settings extends EventTarget {
  #heights = [];
  #z;
  #isChosen = false;  // else the middle one is shown
  #unit = '';

  constructor() {
    super();
    for (const id of ['contours', 'slice-on', 'colour'])
      element(id).addEventListener('change', () => this.#tell());
    element('slice').addEventListener('input', () => this.#choose());
  }

  get hasContours() { return element('contours').checked; }
  get colour() { return element('colour').value; }
  // The height of the slice to be shown, if any is.
  get slice() { return element('slice-on').checked ? this.#z : undefined; }

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

  setHeights(heights, unit) {
    this.#heights = heights;
    this.#unit = unit;
    const slider = element('slice');
    slider.max = Math.max(heights.length - 1, 0);
    for (const id of ['contours', 'slice-on', 'slice']) element(id).disabled = heights.length === 0;
    element('no-contours').hidden = heights.length > 0;
    this.#z = this.#isChosen ? this.#nearest(this.#z) : heights[Math.floor(heights.length / 2)];
    slider.value = Math.max(heights.indexOf(this.#z), 0);
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

  #tell() {
    this.#show();
    this.dispatchEvent(new Event('change'));
  }

  #show() {
    const slice = this.#z === undefined ? '–' : `${exact(this.#z)} ${this.#unit}`;
    if (element('slice-height').textContent === slice) return;
    element('slice-height').textContent = slice;
    element('slice').setAttribute('aria-valuetext', slice);
  }
}
