// SPDX-License-Identifier: MIT
// Where things are: the input's x, y, z in its unit; glTF's metres, +Y up, about an origin; and the
// scene, which is glTF's space scaled to a size that a camera copes with.
import { Vector3 } from 'three';

// How a unit is written.
export function nameOf(unit) {
  return Number.isFinite(Number(unit)) ? 'units' : unit.replace('um', 'µm');
}

export class Frame {
  #metres;
  #origin;
  #scale;

  // `metres`: of the input's unit; `origin` in metres as glTF has it; `size` a length in metres that
  // becomes 1 to 10 in the scene.
  constructor(metres, origin, size) {
    this.#metres = metres;
    this.#origin = origin;
    this.#scale = size > 0 ? 10 ** -Math.floor(Math.log10(size)) : 1;
  }

  // The positions of a node as the scene has them, changed in place.
  place(positions, translation) {
    for (let i = 0; i < positions.length; ++i) {
      const shift = translation[i % 3] - this.#origin[i % 3];
      positions[i] = (positions[i] + shift) * this.#scale;
    }
    return positions;
  }

  toScene(x, y, z, target = new Vector3()) {
    return target.set(this.#length(x, 0, 1), this.#length(z, 1, 1), this.#length(y, 2, -1));
  }

  toInput(place) {
    const metres = place.toArray().map((value, axis) => value / this.#scale + this.#origin[axis]);
    return [metres[0] / this.#metres, -metres[2] / this.#metres, metres[1] / this.#metres];
  }

  // A length in the input's unit.
  length(sceneLength) {
    return sceneLength / this.#scale / this.#metres;
  }

  #length(value, axis, sign) {
    return (sign * value * this.#metres - this.#origin[axis]) * this.#scale;
  }
}
