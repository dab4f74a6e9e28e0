// SPDX-License-Identifier: MIT
// The box around the surface with its lengths in the input's unit, and a grid under it.
import { Box3Helper, BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments, Vector3 } from 'three';
import { number } from './text.js';

// 1, 2 or 5 times a power of ten, so that about ten of them make `length`.
export function stepFor(length) {
  const power = 10 ** Math.floor(Math.log10(length / 10));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= length / 10);
}

export class Surroundings {
  #scene;
  #grid;
  #helper;
  #labels;
  #box;

  constructor(scene, labels) {
    this.material = new LineBasicMaterial({ transparent: true, opacity: 0.5 });
    this.#grid = new LineSegments(new BufferGeometry(), this.material);
    this.#grid.frustumCulled = false;
    this.#labels = labels;
    scene.add(this.#grid);
    this.#scene = scene;
  }

  set colour(colour) {
    this.material.color.set(colour);
    this.#helper?.material.color.set(colour);
  }

  // Returns the step of the grid, in the input's unit.
  surround(box, frame, unit) {
    this.#box = box;
    this.#helper?.removeFromParent();
    if (box.isEmpty()) return undefined;
    this.#helper = new Box3Helper(box, this.material.color);
    this.#helper.material.transparent = true;
    this.#helper.material.opacity = 0.7;
    this.#scene.add(this.#helper);
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
    this.#grid.geometry.dispose();
    this.#grid.geometry = new BufferGeometry();
    this.#grid.geometry.setAttribute('position', new Float32BufferAttribute(numbers, 3));
    return step;
  }

  // Puts the lengths beside the edges that are nearest to the eye at the outline of the box.
  placeLabels(camera, canvas) {
    const isShown = this.#box !== undefined && !this.#box.isEmpty();
    for (const label of this.#labels) label.hidden = !isShown;
    if (!isShown) return;
    const { min, max } = this.#box;
    const nearX = camera.position.x > (min.x + max.x) / 2 ? max.x : min.x;
    const nearZ = camera.position.z > (min.z + max.z) / 2 ? max.z : min.z;
    const farX = nearX === max.x ? min.x : max.x;
    const places = [new Vector3((min.x + max.x) / 2, min.y, nearZ),
                    new Vector3(farX, (min.y + max.y) / 2, nearZ),
                    new Vector3(nearX, min.y, (min.z + max.z) / 2)];
    for (const [i, label] of this.#labels.entries()) {
      const place = places[i].project(camera);
      label.style.left = `${((place.x + 1) / 2) * canvas.clientWidth}px`;
      label.style.top = `${((1 - place.y) / 2) * canvas.clientHeight}px`;
    }
  }
}
