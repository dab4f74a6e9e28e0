// SPDX-License-Identifier: MIT
// What lies over the picture: a scale bar, and letters at its borders where the frame is a
// patient's.
import { Vector3 } from 'three';
import { directionToInput } from './cut.js';
import { number } from './text.js';

const longest = 140;  // pixels of the bar
const clear = 0.4;    // a direction's share from which on its letter is told

// The largest of 1, 2 or 5 times a power of ten that is not more.
export function roundDown(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * [5, 2, 1].find((factor) => factor * power <= length * (1 + 1e-12));
}

// Where a direction (x, y, z) points in a patient: left is +x, posterior +y, superior +z; the
// letter of its largest share first.
export function lettersOf(direction) {
  const names = [['L', 'R'], ['P', 'A'], ['S', 'I']];
  const shares = direction.map((value, axis) => ({ size: Math.abs(value), name: names[axis][value < 0 ? 1 : 0] }));
  return shares.filter(({ size }) => size > clear).sort((a, b) => b.size - a.size)
    .map(({ name }) => name).join('');
}

export class Overlay {
  #bar = document.getElementById('scale');
  #letters = [...document.querySelectorAll('#letters span')];  // right, left, top, bottom
  isPatient = false;

  // Ahead of a frame.
  follow(stage, frame, unit) {
    this.#bar.hidden = frame === undefined;
    for (const letter of this.#letters) letter.hidden = frame === undefined || !this.isPatient;
    if (!frame) return;
    this.#measure(stage, frame, unit);
    if (this.isPatient) this.#tellDirections(stage.camera);
  }

  #measure(stage, frame, unit) {
    const { target } = stage.controls;
    const pixel = frame.length(stage.unitsPerPixel(target));
    const length = roundDown(longest * pixel);
    this.#bar.style.width = `${length / pixel}px`;
    const depth = stage.isParallel ? '' : ', at the middle';
    const text = `${number(length)} ${unit}${depth}`;
    const output = this.#bar.firstElementChild;
    if (output.textContent !== text) output.textContent = text;
  }

  #tellDirections(camera) {
    const [right, up] = [0, 1].map((column) =>
      directionToInput(new Vector3().setFromMatrixColumn(camera.matrixWorld, column)));
    const directions = [right, right.map((value) => -value), up, up.map((value) => -value)];
    for (const [i, letter] of this.#letters.entries()) letter.textContent = lettersOf(directions[i]);
  }
}
