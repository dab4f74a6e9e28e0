// SPDX-License-Identifier: MIT
// The controls for the cut: where it is, how it is turned, what it keeps.
import { anglesOf, extentOf, normalOf } from './cut.js';
import { coordinate, exact } from './text.js';

export const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const sliderSteps = 1000;
const isClose = 1 / 400;  // of the way: a slice as near as this is where the cut goes

function element(id) {
  return document.getElementById(id);
}

function clamp(value, [low, high]) {
  return Math.min(Math.max(value, low), high);
}

function dot(a, b) {
  return a.reduce((sum, value, i) => sum + value * b[i], 0);
}

export class CutControls extends EventTarget {
  #normal = axes.z;  // across which it is, whatever it keeps
  #shownNormal;
  #place;            // along the normal, once it was moved
  #thickness;        // likewise
  #heights = [];
  #range;
  #box;              // [low, high], three numbers each
  #unit = '';

  constructor() {
    super();
    for (const id of ['cut-on', 'cut-below', 'cut-slab'])
      element(id).addEventListener('change', () => this.#tell());
    element('cut').addEventListener('input', () => this.#moveTo(this.#atSlider('cut')));
    element('cut-thickness').addEventListener('input', () => this.#thicken());
    for (const id of ['cut-tilt', 'cut-turn'])
      element(id).addEventListener('input', () => this.#turnBySliders());
  }

  get isOn() { return element('cut-on').checked && this.#range !== undefined; }
  // The plane by the side that goes (see planesOf()), if there is a cut; `slice` is the height of
  // the slice it lies in, if it does.
  get cut() {
    if (!this.isOn) return undefined;
    const place = this.#current();
    const sign = element('cut-below').checked ? 1 : -1;
    const isThick = element('cut-slab').checked;
    return { normal: this.#normal.map((value) => sign * value), offset: sign * place,
             thickness: isThick ? this.#currentThickness() : undefined, slice: this.#slice() };
  }

  // The heights of the slices, and how far the surface reaches.
  setHeights(heights, range, unit) {
    this.#heights = heights;
    this.#range = range;
    this.#unit = unit;
    for (const control of element('cut-section').querySelectorAll('input, button'))
      control.disabled = !range;
    this.#show();
  }

  setBox(box) {
    this.#box = box;
    if (this.#range) this.#show();
  }

  // Turns the cut on and gives its slider the focus; off, if it has it.
  reach() {
    if (element('cut-on').disabled) return;
    const isThere = this.isOn && document.activeElement === element('cut');
    element('cut-on').checked = !isThere;
    if (!isThere) element('cut').focus();
    this.#tell();
  }

  toggle(id) {
    if (element(id).disabled) return;
    element(id).checked = !element(id).checked;
    if (element(id).checked && id === 'cut-slab') element('cut-on').checked = true;
    this.#tell();
  }

  // About a place of the plane: by itself the one in the middle of what it cuts.
  turnTo(normal, pivot = this.#pivot()) {
    if (element('cut-on').disabled) return;
    this.#normal = normal;
    this.#place = pivot && clamp(dot(normal, pivot), this.#extent());
    element('cut-on').checked = true;
    this.#tell();
  }

  // As turnTo(), by the normal of the side that goes.
  turnAway(normal, pivot) {
    const [x, y, z] = normal.map((value) => (Math.abs(value) < 1e-9 ? 0 : value));
    const isUp = z > 0 || (z === 0 && (y > 0 || (y === 0 && x > 0)));
    element('cut-below').checked = isUp;
    this.turnTo(isUp ? normal : normal.map((value) => 0 - value), pivot);
  }

  // By a distance towards the side that goes.
  shift(distance) {
    this.#moveTo(this.#current() + (element('cut-below').checked ? distance : -distance));
  }

  // To the next slice above, or below.
  step(isUp) {
    if (!this.#isLevel() || element('cut-on').disabled) return;
    const z = this.#current();
    const next = isUp ? this.#heights.find((height) => height > z)
      : this.#heights.findLast((height) => height < z);
    if (next !== undefined) this.#moveTo(next);
  }

  #isLevel() { return this.#normal === axes.z || this.#normal[2] === 1; }
  #slice() {
    return this.#isLevel() && this.#heights.includes(this.#current()) ? this.#current() : undefined;
  }

  #extent() {
    if (this.#isLevel() || !this.#box) return this.#range;
    return extentOf(this.#box, this.#normal);
  }

  #current() {
    const [low, high] = this.#extent();
    return clamp(this.#place ?? (low + high) / 2, [low, high]);
  }

  #currentThickness() {
    const [low, high] = this.#extent();
    return Math.min(this.#thickness ?? (high - low) / 10, high - low);
  }

  // The place of the plane that is next to the middle of the box.
  #pivot() {
    if (!this.#box || !this.#range) return undefined;
    const middle = this.#box[0].map((value, axis) => (value + this.#box[1][axis]) / 2);
    const distance = this.#current() - dot(this.#normal, middle);
    return middle.map((value, axis) => value + distance * this.#normal[axis]);
  }

  #atSlider(id) {
    const [low, high] = this.#extent();
    return low + (Number(element(id).value) / sliderSteps) * (high - low);
  }

  #moveTo(place) {
    const [low, high] = this.#extent();
    const isNear = (height) => Math.abs(height - place) <= isClose * (high - low);
    const near = this.#isLevel() ? this.#heights.filter(isNear) : [];
    near.sort((a, b) => Math.abs(a - place) - Math.abs(b - place));
    this.#place = near[0] ?? clamp(place, [low, high]);
    element('cut-on').checked = true;
    this.#tell();
  }

  #thicken() {
    const [low, high] = this.#extent();
    this.#thickness = (Math.max(Number(element('cut-thickness').value), 1) / sliderSteps) * (high - low);
    element('cut-on').checked = element('cut-slab').checked = true;
    this.#tell();
  }

  #turnBySliders() {
    const tilt = Number(element('cut-tilt').value);
    const normal = normalOf(tilt, Number(element('cut-turn').value));
    this.turnTo(tilt === 0 ? axes.z : normal);
  }

  #tell() {
    this.#show();
    this.dispatchEvent(new Event('change'));
  }

  #show() {
    this.#showPlaces();
    if (this.#shownNormal === this.#normal) return;
    this.#shownNormal = this.#normal;
    if (document.activeElement !== element('cut-turn') && document.activeElement !== element('cut-tilt')) {
      const [tilt, turn] = anglesOf(this.#normal);
      element('cut-tilt').value = tilt;
      element('cut-turn').value = turn;
    }
    for (const id of ['cut-tilt', 'cut-turn'])
      this.#write(id, `${Math.round(Number(element(id).value))}°`);
    for (const [axis, normal] of Object.entries(axes)) {
      const isIt = normal.every((value, i) => value === this.#normal[i]);
      element(`cut-${axis}`).setAttribute('aria-pressed', String(isIt));
    }
  }

  #showPlaces() {
    if (!this.#range) {
      for (const id of ['cut', 'cut-thickness']) this.#write(id, '–');
      return;
    }
    const [low, high] = this.#extent();
    const length = (value) => `${coordinate(value, high - low)} ${this.#unit}`;
    const slice = this.#slice();
    this.#write('cut', slice === undefined ? length(this.#current())
      : `slice ${exact(slice)} ${this.#unit}`);
    this.#write('cut-thickness', length(this.#currentThickness()));
    if (low === high) return;
    this.#slide('cut', (this.#current() - low) / (high - low));
    this.#slide('cut-thickness', this.#currentThickness() / (high - low));
  }

  #slide(id, share) {
    const value = share * sliderSteps;
    if (Math.abs(Number(element(id).value) - value) > 1e-6) element(id).value = value;
  }

  #write(id, text) {
    const output = element(`${id}-text`);
    if (output.textContent === text) return;
    output.textContent = text;
    element(id).setAttribute('aria-valuetext', text);
  }
}
