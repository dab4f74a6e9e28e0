// SPDX-License-Identifier: MIT
// What lies over the picture: a scale bar, and letters at its borders where the frame is a
// patient's.
import { Vector3 } from 'three';
import { directionToInput } from './cut.js';
import { lettersOf } from './letters.js';
import { number } from './text.js';

const longest = 140;  // pixels of the bar

// The largest of 1, 2 or 5 times a power of ten that is not more.
export function roundDown(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * [5, 2, 1].find((factor) => factor * power <= length * (1 + 1e-12));
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
    const width = `${(length / pixel).toFixed(2)}px`;
    if (this.#bar.style.width !== width) this.#bar.style.width = width;
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
