// SPDX-License-Identifier: MIT
// The box around the surface with its lengths in the input's unit, and a grid under it.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments,
         Vector3 } from 'three';
import { number } from './text.js';

// 1, 2 or 5 times a power of ten, so that about ten of them make `length`.
export function stepFor(length) {
  const power = 10 ** Math.floor(Math.log10(length / 10));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= length / 10);
}

function replace(lines, numbers) {
  lines.geometry.dispose();
  lines.geometry = new BufferGeometry();
  lines.geometry.setAttribute('position', new Float32BufferAttribute(numbers, 3));
}

// Corner i of a box: bits 0, 1, 2 say whether x, y, z are the larger ones.
function corner({ min, max }, i) {
  return [i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z];
}

// The corner next to a place outside.
function nearestCorner({ min, max }, place) {
  const isLarger = (axis) => place[axis] > (min[axis] + max[axis]) / 2;
  return ['x', 'y', 'z'].reduce((bits, axis, i) => bits | (isLarger(axis) << i), 0);
}

// The edges of a box but for those at a corner.
function edgesWithout(box, left) {
  const numbers = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) {
      if (i & bit || i === left || (i | bit) === left) continue;
      numbers.push(...corner(box, i), ...corner(box, i | bit));
    }
  }
  return numbers;
}

export class Surroundings {
  #grid;
  #edges;
  #corner = -1;  // of the box, next to the eye: its edges are left out
  #labels;
  #box;

  constructor(scene, labels) {
    this.material = new LineBasicMaterial({ transparent: true, opacity: 0.5 });
    this.#grid = new LineSegments(new BufferGeometry(), this.material);
    this.#edges = new LineSegments(new BufferGeometry(), this.material);
    for (const lines of [this.#grid, this.#edges]) {
      lines.frustumCulled = false;
      scene.add(lines);
    }
    this.#labels = labels;
  }

  set colour(colour) {
    this.material.color.set(colour);
  }

  // Returns the step of the grid, in the input's unit.
  surround(box, frame, unit) {
    this.#box = box;
    this.#corner = -1;
    this.#grid.visible = this.#edges.visible = !box.isEmpty();
    if (box.isEmpty()) return undefined;
    const size = box.getSize(new Vector3());
    const texts = [`x ${number(frame.length(size.x))}`, `z ${number(frame.length(size.y))}`,
                   `y ${number(frame.length(size.z))}`];
    for (const [i, label] of this.#labels.entries()) label.textContent = `${texts[i]} ${unit}`;
    return this.#lay(box, size, frame);
  }

  #lay(box, size, frame) {
    const step = stepFor(frame.length(Math.max(size.x, size.z)) || 1);
    const width = step / frame.length(1);
    const [low, high] = ['min', 'max'].map((end) => [box[end].x, box[end].z]);
    const margin = 2 * width;
    const from = low.map((value) => Math.floor((value - margin) / width));
    const to = high.map((value) => Math.ceil((value + margin) / width));
    const y = box.min.y - 0.002 * size.length();
    const numbers = [];
    for (let i = from[0]; i <= to[0]; ++i)
      numbers.push(i * width, y, from[1] * width, i * width, y, to[1] * width);
    for (let k = from[1]; k <= to[1]; ++k)
      numbers.push(from[0] * width, y, k * width, to[0] * width, y, k * width);
    replace(this.#grid, numbers);
    return step;
  }

  // Draws the edges that lie behind the surface as the eye has it, and puts the lengths beside
  // those near the outline of the box.
  lookFrom(camera, { width, height }) {
    const isShown = this.#box !== undefined && !this.#box.isEmpty();
    for (const label of this.#labels) label.hidden = !isShown;
    if (!isShown) return;
    const near = nearestCorner(this.#box, camera.position);
    if (near !== this.#corner) replace(this.#edges, edgesWithout(this.#box, near));
    this.#corner = near;
    const { min, max } = this.#box;
    const [nearX, , nearZ] = corner(this.#box, near);
    const farX = nearX === max.x ? min.x : max.x;
    const places = [new Vector3((min.x + max.x) / 2, min.y, nearZ),
                    new Vector3(farX, (min.y + max.y) / 2, nearZ),
                    new Vector3(nearX, min.y, (min.z + max.z) / 2)];
    for (const [i, label] of this.#labels.entries()) {
      const place = places[i].project(camera);
      label.style.left = `${((place.x + 1) / 2) * width}px`;
      label.style.top = `${((1 - place.y) / 2) * height}px`;
    }
  }
}
