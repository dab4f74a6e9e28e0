// SPDX-License-Identifier: MIT
// Where things are: the input's x, y, z in its unit; glTF's metres, +Y up, about an origin; and the
// scene, which is glTF's space scaled to a size that a camera copes with.
import { Vector3 } from 'three';

// As people write it; a unit given as a number of metres has no name.
export function nameOf(unit) {
  if (unit === 'um') return 'µm';
  return Number.isNaN(Number(unit)) ? unit : 'units';
}

const farthest = 1e4;  // in the scene, where things are 1 to 10 in size

export class Frame {
  #metres;
  #origin;
  #scale;

  // `origin` is a node's translation; `size` a length in metres that becomes 1 to 10 in the scene.
  constructor(metresPerUnit, origin, size) {
    this.#metres = metresPerUnit;
    this.#origin = origin;
    this.#scale = size > 0 ? 10 ** -Math.floor(Math.log10(size)) : 1;
  }

  // The same about a slice of a stack that is so high; undefined where the slice has no points.
  static around({ z, contours }, height, metresPerUnit) {
    const points = contours.flat();
    if (points.length === 0) return undefined;
    const [x, y] = [0, 1].map((axis) => {
      let [low, high] = [Infinity, -Infinity];
      for (const point of points) {
        low = Math.min(low, point[axis]);
        high = Math.max(high, point[axis]);
      }
      return { middle: (low + high) / 2, size: high - low };
    });
    const origin = [x.middle, z, -y.middle].map((value) => value * metresPerUnit);
    return new Frame(metresPerUnit, origin, Math.hypot(x.size, y.size, height) * metresPerUnit);
  }

  // The positions of a node as the scene has them, changed in place.
  place(positions, translation) {
    for (let i = 0; i < positions.length; ++i) {
      const shift = translation[i % 3] - this.#origin[i % 3];
      positions[i] = (positions[i] + shift) * this.#scale;
    }
    return positions;
  }

  // Whether coordinates about another origin would lose their last digits here.
  isFarFrom(origin) {
    const distance = Math.hypot(...origin.map((value, axis) => value - this.#origin[axis]));
    return distance * this.#scale > farthest;
  }

  toScene(x, y, z, target = new Vector3()) {
    return target.set(this.#coordinate(x, 0), this.#coordinate(z, 1), this.#coordinate(-y, 2));
  }

  toInput(place) {
    const metres = place.toArray().map((value, axis) => value / this.#scale + this.#origin[axis]);
    return [metres[0] / this.#metres, -metres[2] / this.#metres, metres[1] / this.#metres];
  }

  // A length of the scene in the input's unit.
  length(length) {
    return length / this.#scale / this.#metres;
  }

  #coordinate(value, axis) {
    return (value * this.#metres - this.#origin[axis]) * this.#scale;
  }
}
