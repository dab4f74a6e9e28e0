// SPDX-License-Identifier: MIT
// Contours as thin lines, many slices to a draw call; only the page whose slice changed is redone.
import { Box3, BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments,
         Vector3 } from 'three';

const slicesPerPage = 64;

// Pairs of ends, three numbers an end.
export function segmentsOf(slice, frame) {
  const numbers = [];
  const place = new Vector3();
  for (const points of slice.contours) {
    for (const [i, end] of points.entries()) {
      const start = points[i === 0 ? points.length - 1 : i - 1];
      for (const [x, y] of [start, end]) {
        frame.toScene(x, y, slice.z, place);
        numbers.push(place.x, place.y, place.z);
      }
    }
  }
  return numbers;
}

class Page {
  slices = new Map();  // by z: segments
  isStale = false;
  #object;

  constructor(group, material) {
    this.#object = new LineSegments(new BufferGeometry(), material);
    this.#object.frustumCulled = false;
    group.add(this.#object);
  }

  refresh() {
    this.isStale = false;
    this.#object.geometry.dispose();
    this.#object.geometry = new BufferGeometry();
    const numbers = [...this.slices.values()].flat();
    this.#object.geometry.setAttribute('position', new Float32BufferAttribute(numbers, 3));
  }
}

export class Lines {
  #pages = [];
  #pageOf = new Map();
  #boxes = new Map();  // by z
  #group;

  constructor(scene) {
    this.#group = new Group();
    this.#group.visible = false;
    scene.add(this.#group);
    this.material = new LineBasicMaterial({ transparent: true, opacity: 0.75 });
  }

  get isShown() { return this.#group.visible; }
  set isShown(isShown) { this.#group.visible = isShown; }
  // Around all of them.
  get box() {
    const all = new Box3();
    for (const box of this.#boxes.values()) all.union(box);
    return all;
  }
  has(z) { return this.#pageOf.has(z); }

  set(slice, frame) {
    const page = this.#pageOf.get(slice.z) ?? this.#pageWithRoom();
    const segments = segmentsOf(slice, frame);
    page.slices.set(slice.z, segments);
    this.#boxes.set(slice.z, new Box3().setFromArray(segments));
    page.isStale = true;
    this.#pageOf.set(slice.z, page);
  }

  delete(z) {
    const page = this.#pageOf.get(z);
    if (!page) return;
    page.slices.delete(z);
    this.#boxes.delete(z);
    page.isStale = true;
    this.#pageOf.delete(z);
  }

  clear() {
    for (const z of [...this.#pageOf.keys()]) this.delete(z);
  }

  // To be called before a frame is drawn.
  refresh() {
    for (const page of this.#pages) if (page.isStale) page.refresh();
  }

  #pageWithRoom() {
    const known = this.#pages.find((page) => page.slices.size < slicesPerPage);
    if (known) return known;
    const page = new Page(this.#group, this.material);
    this.#pages.push(page);
    return page;
  }
}
