// SPDX-License-Identifier: MIT
// The surface in the scene: slabs are fetched, put into the batch, coloured, and found under a ray.
import { Box3, Color } from 'three';
import { Batch } from './batch.js';
import { colouring } from './colours.js';
import { Frame } from './frame.js';
import { parseSlab } from './glb.js';
import { Slabs } from './slabs.js';

export class Surface {
  #stage;
  #loader;
  #batch;
  #slabs;
  #slots = new Map();      // of the slabs that are shown
  #ofInstance = new Map();
  #unit = { name: 'mm', metres: 0.001 };
  #isRecoloured = true;
  #hasNewBox = true;
  #mode = 'label';
  #edits = 0;
  box = new Box3();
  labels = new Map();      // the colour of each label
  frame = undefined;

  constructor(stage, loader) {
    this.#stage = stage;
    this.#loader = loader;
    this.#batch = new Batch(stage.scene, stage.material);
    this.#slabs = new Slabs((slab) => this.#show(slab), (slab) => this.#hide(slab));
    stage.onFrame(() => this.#refresh());
  }

  get pending() { return this.#slabs.pending; }
  get mode() { return this.#mode; }

  set mode(mode) {
    this.#mode = mode;
    this.#recolour();
  }

  reset({ slabs, edits = 0, unit, metres_per_unit: metres }) {
    this.#unit = { name: unit, metres };
    this.#edits = edits;
    this.#fetch(this.#slabs.reset(slabs, performance.now()));
  }

  change({ removed, added, edits = 0 }) {
    this.#edits = edits;
    this.#fetch(this.#slabs.change(removed, added, performance.now()));
    this.#recolour();
  }

  // The scene's coordinates are about the first thing that there is.
  frameFor(origin, size) {
    this.frame ??= new Frame(this.#unit, origin, size);
    return this.frame;
  }

  // What a ray meets first and can be seen: { slab, place }.
  pick(raycaster, isVisible) {
    for (const { batchId, point } of raycaster.intersectObject(this.#batch.mesh))
      if (isVisible(point)) return { slab: this.#ofInstance.get(batchId), place: point };
    return undefined;
  }

  #fetch(slabs) {
    for (const slab of slabs) {
      slab.edit ??= this.#edits;
      this.#loader.fetch(`slabs/${slab.id}.glb`, () => this.#slabs.isPending(slab), async (response) => {
        this.#arrive(slab, parseSlab(await response.arrayBuffer()));
      });
    }
    this.#stage.invalidate();
  }

  #arrive(slab, { positions, normals, indices, translation, colour, confidence }) {
    Object.assign(slab, { colour, confidence });
    if (positions) {
      const frame = this.frameFor(translation, sizeOf(positions));
      slab.shape = { positions: frame.place(positions, translation), normals, indices };
    }
    this.labels.set(slab.label, colour);
    this.#slabs.arrive(slab, performance.now());
    this.#stage.invalidate();
  }

  #show(slab) {
    if (!slab.shape) return;
    const slot = this.#batch.add(slab.shape);
    slab.shape = undefined;  // the batch has it
    this.#slots.set(slab, slot);
    this.#ofInstance.set(slot.instance, slab);
    this.#hasNewBox = true;
    this.#recolour();
  }

  #hide(slab) {
    const slot = this.#slots.get(slab);
    if (!slot) return;
    this.#batch.remove(slot);
    this.#slots.delete(slab);
    this.#ofInstance.delete(slot.instance);
    this.#hasNewBox = true;
    this.#stage.invalidate();
  }

  #recolour() {
    this.#isRecoloured = true;
    this.#stage.invalidate();
  }

  #refresh() {
    this.#slabs.settle(performance.now());
    if (this.#slabs.pending > 0) setTimeout(() => this.#stage.invalidate(), 100);
    if (this.#hasNewBox) this.#measure();
    if (this.#isRecoloured) this.#colour();
  }

  #measure() {
    this.#hasNewBox = false;
    this.box = new Box3();
    for (const slot of this.#slots.values()) this.box.union(slot.box);
  }

  #colour() {
    this.#isRecoloured = false;
    const paint = colouring(this.#mode, this.#slots.keys(), this.#edits);
    const colour = new Color();
    for (const [slab, slot] of this.#slots) this.#batch.setColour(slot, paint(slab, colour));
  }
}

function sizeOf(positions) {
  let size = 0;
  for (const value of positions) size = Math.max(size, Math.abs(value - positions[0]));
  return size;
}
