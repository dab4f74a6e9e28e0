// SPDX-License-Identifier: MIT
// The surface in two layers, a draw call each: what is solid, and over it what is seen through.
import { Color } from 'three';
import { Batch } from './batch.js';

// A material like another one, that lets through what its colours' alpha says.
function clearOf(material) {
  const clear = material.clone();
  clear.onBeforeCompile = material.onBeforeCompile;
  clear.transparent = true;
  clear.depthWrite = false;
  clear.forceSinglePass = true;  // back and front of a skin have the same colour
  // Where a skin and what is in it lie in one plane the latter is seen.
  clear.polygonOffsetFactor = clear.polygonOffsetUnits = 2;
  return clear;
}

export class Layers {
  #solid;
  #clear;
  #looks;
  #groups = new Map();  // by label: its slots, and whether they are shown

  // `looks`: what labels look like (labels.js).
  constructor(scene, material, looks) {
    const clear = clearOf(material);
    this.materials = [material, clear];
    this.#solid = new Batch(scene, material);
    this.#clear = new Batch(scene, clear);
    this.#clear.mesh.sortObjects = true;
    this.#clear.mesh.renderOrder = 1;
    this.#looks = looks;
  }

  // Those to be picked from; what is solid goes before what is in front of it.
  get meshes() { return [this.#solid.mesh, this.#clear.mesh]; }

  // Puts a slab into the picture; returns its slot.
  add(slab) {
    const group = this.#groupOf(slab.label);
    const slot = { label: slab.label, colour: new Color(), opacity: this.#looks.opacity(slab.label) };
    this.#put(slot, slab, group);
    group.slots.add(slot);
    return slot;
  }

  remove(slot) {
    slot.batch.remove(slot.place);
    const { slots } = this.#groupOf(slot.label);
    slots.delete(slot);
    if (slots.size === 0) this.#groups.delete(slot.label);
  }

  // Whether a hit of the raycaster is in the slot.
  isHit(slot, hit) {
    return slot.batch.isHit(slot.place, hit);
  }

  // To be called before what was said here is drawn or picked from.
  flush() {
    this.#solid.flush();
    this.#clear.flush();
  }

  // Where it is drawn.
  placeOf({ batch, place }) {
    return { mesh: batch.mesh, instance: place.instance };
  }

  // A function that says whose a hit of the raycaster is.
  labelling() {
    const labels = new Map(this.meshes.map((mesh) => [mesh, new Map()]));
    for (const [label, { slots }] of this.#groups)
      for (const { batch, place } of slots) labels.get(batch.mesh).set(place.instance, label);
    return ({ object, batchId }) => labels.get(object).get(batchId);
  }

  // What add() was given of a label.
  contentsOf(label) {
    return [...(this.#groups.get(label)?.slots ?? [])].map(({ batch, place }) => batch.contentOf(place));
  }

  setColour(slot, colour) {
    slot.colour.copy(colour);
    slot.batch.setColour(slot.place, slot.colour, slot.opacity);
  }

  // Shows and hides as the labels now say: a flag a slab, for those labels that changed.
  applyVisibility() {
    for (const [label, group] of this.#groups) {
      const isShown = this.#looks.isShown(label);
      if (isShown === group.isShown) continue;
      group.isShown = isShown;
      for (const { batch, place } of group.slots) batch.setVisible(place, isShown);
    }
  }

  applyOpacity() {
    for (const [label, group] of this.#groups) {
      const opacity = this.#looks.opacity(label);
      for (const slot of group.slots) if (slot.opacity !== opacity) this.#fade(slot, opacity, group);
    }
  }

  #groupOf(label) {
    if (!this.#groups.has(label))
      this.#groups.set(label, { slots: new Set(), isShown: this.#looks.isShown(label) });
    return this.#groups.get(label);
  }

  #put(slot, content, { isShown }) {
    slot.batch = slot.opacity < 1 ? this.#clear : this.#solid;
    slot.place = slot.batch.add(content);
    slot.box = slot.place.box;
    slot.batch.setVisible(slot.place, isShown);
  }

  // From one layer to the other, if need be.
  #fade(slot, opacity, group) {
    const isSame = (slot.opacity < 1) === (opacity < 1);
    slot.opacity = opacity;
    if (!isSame) {
      const content = slot.batch.contentOf(slot.place);
      slot.batch.remove(slot.place);
      this.#put(slot, content, group);
    }
    slot.batch.setColour(slot.place, slot.colour, opacity);
  }
}
