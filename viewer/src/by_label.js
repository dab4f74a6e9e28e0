// SPDX-License-Identifier: MIT
// A set of slabs in which those of one label are found together.

const none = new Set();

export class ByLabel {
  #sets = new Map();
  #size = 0;

  get size() { return this.#size; }
  has(slab) { return this.of(slab.label).has(slab); }
  // Those with that label.
  of(label) { return this.#sets.get(label) ?? none; }

  add(slab) {
    if (!this.#sets.has(slab.label)) this.#sets.set(slab.label, new Set());
    const own = this.#sets.get(slab.label);
    this.#size += own.has(slab) ? 0 : 1;
    own.add(slab);
  }

  // Whether it was there.
  delete(slab) {
    const own = this.of(slab.label);
    if (!own.delete(slab)) return false;
    --this.#size;
    if (own.size === 0) this.#sets.delete(slab.label);
    return true;
  }

  *[Symbol.iterator]() {
    for (const own of this.#sets.values()) yield* own;
  }
}
