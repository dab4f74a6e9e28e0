// SPDX-License-Identifier: MIT
// Many slabs in few draw calls: slabs of a label that come at the same time are a bundle, which is
// drawn at once; bundles share buffers, in which each has a slot with room to spare, so that one of
// about the same size can take the slot of one that is gone. What is said of slabs is done ahead of
// the next frame, by flush().
import { BatchedMesh, Box3, BufferAttribute, BufferGeometry, Color, Vector3, Vector4 } from 'three';

const mostIndices = 196_608;  // of a bundle of several slabs

function withRoom(count) {
  return Math.ceil((count * 1.25 + 16) / 64) * 64;
}

// Slots are kept by that.
function sizeClass(vertices) {
  return Math.ceil(Math.log2(vertices));
}

// The slabs in the order given, label by label, in groups that are bundles.
function grouped(places) {
  const open = new Map();
  const groups = [];
  for (const place of places) {
    let group = open.get(place.label);
    if (!group || group.indices + place.indexCount > mostIndices) {
      group = { places: [], vertices: 0, indices: 0 };
      open.set(place.label, group);
      groups.push(group);
    }
    group.places.push(place);
    group.vertices += place.vertexCount;
    group.indices += place.indexCount;
  }
  return groups;
}

// One geometry of all that is in a group; says where in it each is.
function geometryOf({ places, vertices, indices }) {
  const positions = new Float32Array(3 * vertices);
  const normals = new Float32Array(3 * vertices);
  const index = new Uint32Array(indices);
  let [vertex, at] = [0, 0];
  for (const place of places) {
    positions.set(place.content.positions, 3 * vertex);
    normals.set(place.content.normals, 3 * vertex);
    for (let i = 0; i < place.indexCount; ++i) index[at + i] = place.content.indices[i] + vertex;
    [place.firstVertex, place.firstIndex] = [vertex, at];
    vertex += place.vertexCount;
    at += place.indexCount;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.setAttribute('color', new BufferAttribute(new Uint8Array(4 * vertices).fill(255), 4, true));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return geometry;
}

// A slab in a bundle; what users may look at are `box` and, after flush(), `instance`.
class Place {
  isVisible = true;
  isDrawn = true;      // its indices are in the buffer
  isGone = false;
  colour = new Color();
  opacity = 1;

  constructor(slab) {
    this.label = slab.label;
    this.content = slab;  // until it is in the buffers
    this.vertexCount = slab.positions.length / 3;
    this.indexCount = slab.indices.length;
    this.box = new Box3().setFromArray(slab.positions);
  }

  get instance() { return this.bundle?.slot.instance; }
}

export class Batch {
  #mesh;
  #slots = 256;
  #vertices = 1 << 16;
  #indices = 1 << 18;
  #used = { slots: 0, vertices: 0, indices: 0 };
  #free = new Map();      // slots by the class of their size
  #waiting = new Set();   // places that are in no bundle yet
  #bundles = new Set();
  #stale = new Set();     // bundles that are to be shown otherwise

  constructor(scene, material) {
    material.vertexColors = true;
    this.#mesh = new BatchedMesh(this.#slots, this.#vertices, this.#indices, material);
    this.#mesh.sortObjects = false;
    this.#mesh.frustumCulled = false;  // its bundles are, one by one
    scene.add(this.#mesh);
  }

  get mesh() { return this.#mesh; }

  // Puts a slab into the batch; returns its place there.
  add({ label, positions, normals, indices }) {
    const place = new Place({ label, positions, normals, indices });
    this.#waiting.add(place);
    return place;
  }

  remove(place) {
    place.isGone = true;
    this.#waiting.delete(place);
    this.#touch(place);
  }

  // `opacity` counts where the material is transparent.
  setColour(place, colour, opacity = 1) {
    if (place.colour.equals(colour) && place.opacity === opacity) return;
    place.colour.copy(colour);
    place.opacity = opacity;
    this.#touch(place);
  }

  setVisible(place, isVisible) {
    if (place.isVisible === isVisible) return;
    place.isVisible = isVisible;
    this.#touch(place);
  }

  // Whether a hit of the raycaster is in the slab.
  isHit(place, { object, batchId, face }) {
    if (object !== this.#mesh || batchId !== place.instance || !place.bundle) return false;
    const first = this.#rangeOf(place.bundle).vertexStart + place.firstVertex;
    return face.a >= first && face.a < first + place.vertexCount;
  }

  // What add() was given, as another batch can take it.
  contentOf(place) {
    if (place.content) return place.content;
    const { attributes: { position, normal } } = this.#mesh.geometry;
    const first = this.#rangeOf(place.bundle).vertexStart + place.firstVertex;
    const [from, to] = [3 * first, 3 * (first + place.vertexCount)];
    return { label: place.label, positions: position.array.slice(from, to),
             normals: normal.array.slice(from, to), indices: this.#indicesOf(place) };
  }

  // Does all that was asked for. To be called before the mesh is drawn or picked from.
  flush() {
    if (this.#waiting.size > 0) this.#bundle();
    for (const bundle of this.#stale) this.#update(bundle);
    this.#stale.clear();
  }

  #touch(place) {
    if (place.bundle) this.#stale.add(place.bundle);
  }

  #bundle() {
    let groups = grouped(this.#waiting);
    if (!this.#hasRoom(groups)) {
      this.#compact();
      groups = grouped(this.#waiting);
    }
    if (!this.#hasRoom(groups)) this.#grow(groups);
    this.#waiting.clear();
    for (const group of groups) {
      const geometry = geometryOf(group);
      const slot = this.#reuse(geometry) ?? this.#make(geometry);
      const bundle = { slot, places: group.places, isCoarse: true };
      for (const place of group.places) Object.assign(place, { bundle, content: undefined, isDrawn: true });
      this.#bundles.add(bundle);
      this.#stale.add(bundle);
    }
  }

  // Brings what is drawn of a bundle up to date.
  #update(bundle) {
    const { instance } = bundle.slot;
    const there = bundle.places.filter(({ isGone }) => !isGone);
    if (there.length === 0) return this.#dissolve(bundle);
    const isVisible = there.some((place) => place.isVisible);
    this.#mesh.setVisibleAt(instance, isVisible);
    if (!isVisible) return undefined;
    for (const place of bundle.places) this.#draw(place, place.isVisible && !place.isGone);
    bundle.places = there;
    return this.#colour(bundle);
  }

  // Takes the faces of a slab out of the buffer, or puts them back.
  #draw(place, isDrawn) {
    if (place.isDrawn === isDrawn) return;
    const { vertexStart, indexStart } = this.#rangeOf(place.bundle);
    const { index } = this.#mesh.geometry;
    const first = indexStart + place.firstIndex;
    if (!isDrawn) {
      place.kept = this.#indicesOf(place);
      index.array.fill(vertexStart, first, first + place.indexCount);
    } else {
      const shift = vertexStart + place.firstVertex;
      for (let i = 0; i < place.indexCount; ++i) index.array[first + i] = place.kept[i] + shift;
      place.kept = undefined;
    }
    place.isDrawn = isDrawn;
    index.addUpdateRange(first, place.indexCount);
    index.needsUpdate = true;
  }

  // One colour for all, where they have the same; else a colour a vertex.
  #colour(bundle) {
    const [{ colour, opacity }] = bundle.places;
    const isOne = bundle.places.every((place) => place.colour.equals(colour));
    const { r, g, b } = isOne ? colour : { r: 1, g: 1, b: 1 };
    this.#mesh.setColorAt(bundle.slot.instance, new Vector4(r, g, b, opacity));
    if (isOne && bundle.isCoarse) return;
    bundle.isCoarse = isOne;
    const white = { r: 1, g: 1, b: 1 };
    for (const place of bundle.places) this.#paint(place, isOne ? white : place.colour);
  }

  #paint(place, { r, g, b }) {
    const { color } = this.#mesh.geometry.attributes;
    const first = 4 * (this.#rangeOf(place.bundle).vertexStart + place.firstVertex);
    const end = first + 4 * place.vertexCount;
    const bytes = [r, g, b].map((value) => Math.round(255 * value));
    for (let i = first; i < end; i += 4)
      [color.array[i], color.array[i + 1], color.array[i + 2]] = bytes;
    color.addUpdateRange(first, end - first);
    color.needsUpdate = true;
  }

  #rangeOf({ slot }) {
    return this.#mesh.getGeometryRangeAt(slot.geometry);
  }

  // As they came, counted from the slab's first vertex.
  #indicesOf(place) {
    if (place.kept) return place.kept;
    const { vertexStart, indexStart } = this.#rangeOf(place.bundle);
    const first = indexStart + place.firstIndex;
    const shift = vertexStart + place.firstVertex;
    return this.#mesh.geometry.index.array.slice(first, first + place.indexCount)
      .map((vertex) => vertex - shift);
  }

  #dissolve(bundle) {
    const { slot } = bundle;
    this.#bundles.delete(bundle);
    this.#mesh.setVisibleAt(slot.instance, false);
    const size = sizeClass(slot.vertices);
    if (!this.#free.has(size)) this.#free.set(size, []);
    this.#free.get(size).push(slot);
  }

  #reuse(geometry) {
    const vertices = geometry.attributes.position.count;
    const indices = geometry.index.count;
    const least = sizeClass(vertices);
    for (let size = least; size < least + 3; ++size) {
      const slots = this.#free.get(size) ?? [];
      const at = slots.findIndex((slot) => slot.vertices >= vertices && slot.indices >= indices);
      if (at < 0) continue;
      const [slot] = slots.splice(at, 1);
      this.#mesh.setGeometryAt(slot.geometry, geometry);
      this.#mesh.setVisibleAt(slot.instance, true);
      return slot;
    }
    return undefined;
  }

  #make(geometry) {
    const vertices = withRoom(geometry.attributes.position.count);
    const indices = withRoom(geometry.index.count);
    const id = this.#mesh.addGeometry(geometry, vertices, indices);
    ++this.#used.slots;
    this.#used.vertices += vertices;
    this.#used.indices += indices;
    return { geometry: id, instance: this.#mesh.addInstance(id), vertices, indices };
  }

  // Of so many, if none of them takes the slot of another one.
  #need(groups) {
    const need = { ...this.#used };
    for (const { vertices, indices } of groups) {
      ++need.slots;
      need.vertices += withRoom(vertices);
      need.indices += withRoom(indices);
    }
    return need;
  }

  #hasRoom(groups) {
    const { slots, vertices, indices } = this.#need(groups);
    return slots <= this.#slots && vertices <= this.#vertices && indices <= this.#indices;
  }

  #grow(groups) {
    const { slots, vertices, indices } = this.#need(groups);
    this.#slots = Math.max(this.#slots, 2 * slots);
    this.#vertices = Math.max(this.#vertices, Math.ceil(1.5 * vertices));
    this.#indices = Math.max(this.#indices, Math.ceil(1.5 * indices));
    this.#mesh.setInstanceCount(this.#slots);
    this.#mesh.setGeometrySize(this.#vertices, this.#indices);
  }

  // Gives up the slots that nothing fitted into, and bundles of which little is left: that is
  // bundled anew.
  #compact() {
    for (const bundle of this.#bundles) {
      const there = bundle.places.filter(({ isGone }) => !isGone);
      const left = there.reduce((sum, { vertexCount }) => sum + vertexCount, 0);
      if (2.5 * left > bundle.slot.vertices) continue;
      for (const place of there) {
        Object.assign(place, { content: this.contentOf(place), bundle: undefined, kept: undefined });
        this.#waiting.add(place);
      }
      this.#stale.delete(bundle);
      this.#dissolve(bundle);
    }
    const slots = [...this.#free.values()].flat();
    for (const slot of slots) {
      this.#mesh.deleteGeometry(slot.geometry);
      --this.#used.slots;
      this.#used.vertices -= slot.vertices;
      this.#used.indices -= slot.indices;
    }
    if (slots.length > 0) this.#mesh.optimize();
    this.#free.clear();
  }
}

export function diagonal(positions) {
  const box = new Box3().setFromArray(positions);
  return box.isEmpty() ? 0 : box.getSize(new Vector3()).length();
}
