// SPDX-License-Identifier: MIT
// The contours as they came in: fetched when they are asked for, kept until their slice changes.

export class Contours {
  #slices = new Map();   // by z: the line of the slice, or null while it is on its way
  #heights = new Set();
  #marks = new Map();    // by z: of the request under way
  #waiting = new Map();  // by z: those who asked for it
  #loader;
  #arrived;

  // arrived(slice) is called for each one that has come.
  constructor(loader, arrived) {
    this.#loader = loader;
    this.#arrived = arrived;
  }

  get heights() { return [...this.#heights].sort((a, b) => a - b); }
  get(z) { return this.#slices.get(z) ?? undefined; }

  reset(heights) {
    this.#heights = new Set(heights);
    this.#slices.clear();
    this.#marks.clear();
    for (const z of [...this.#waiting.keys()]) {
      if (this.#heights.has(z)) this.#add(z);
      else this.#answer(z, undefined);
    }
  }

  change(removed, added) {
    for (const z of removed) this.#forget(z);
    for (const z of added) this.#add(z);
  }

  // The slice at a height, when it is there; undefined where there is none any more.
  ask(z) {
    if (this.#slices.get(z)) return Promise.resolve(this.#slices.get(z));
    if (!this.#heights.has(z)) return Promise.resolve(undefined);
    return new Promise((resolve) => {
      this.#waiting.set(z, [...(this.#waiting.get(z) ?? []), resolve]);
      if (!this.#slices.has(z)) this.#fetch(z);
    });
  }

  #forget(z) {
    this.#heights.delete(z);
    this.#slices.delete(z);
    this.#marks.delete(z);
    this.#answer(z, undefined);
  }

  #add(z) {
    this.#heights.add(z);
    this.#slices.delete(z);
    this.#marks.delete(z);
    if (this.#waiting.has(z)) this.#fetch(z);
  }

  #fetch(z) {
    const mark = Symbol();  // another one when the slice changes meanwhile
    this.#slices.set(z, null);
    this.#marks.set(z, mark);
    const isWanted = () => this.#heights.has(z) && this.#marks.get(z) === mark;
    this.#loader.fetch(`slices?z=${encodeURIComponent(z)}`, isWanted, async (response) => {
      const slice = await response.json();
      if (!isWanted()) return;
      this.#slices.set(z, slice);
      this.#answer(z, slice);
      this.#arrived(slice);
    });
  }

  #answer(z, slice) {
    for (const resolve of this.#waiting.get(z) ?? []) resolve(slice);
    this.#waiting.delete(z);
  }
}
