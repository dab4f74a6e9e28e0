// SPDX-License-Identifier: MIT
// Many slabs in one draw call: they share buffers, in which each has a slot with room to spare, so
// that a slab of about the same size can take the slot of one that is gone.
import { BatchedMesh, Box3, BufferAttribute, BufferGeometry, Vector3, Vector4 } from 'three';

function withRoom(count) {
  return Math.ceil((count * 1.25 + 16) / 64) * 64;
}

function geometryOf(slab) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(slab.positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(slab.normals, 3));
  geometry.setIndex(new BufferAttribute(slab.indices, 1));
  geometry.computeBoundingBox();
  geometry.computeBoundingSphere();
  return geometry;
}

export class Batch {
  #mesh;
  #slots = 256;
  #vertices = 1 << 16;
  #indices = 1 << 18;
  #used = { slots: 0, vertices: 0, indices: 0 };
  #free = [];

  constructor(scene, material) {
    this.#mesh = new BatchedMesh(this.#slots, this.#vertices, this.#indices, material);
    this.#mesh.sortObjects = false;
    this.#mesh.frustumCulled = false;  // its slabs are, one by one
    scene.add(this.#mesh);
  }

  get mesh() { return this.#mesh; }

  // Puts a slab into the batch; what it has in the batch is returned.
  add(slab) {
    const geometry = geometryOf(slab);
    const slot = this.#reuse(geometry) ?? this.#make(geometry);
    slot.box = geometry.boundingBox.clone();
    this.#mesh.setVisibleAt(slot.instance, true);
    return slot;
  }

  remove(slot) {
    this.#mesh.setVisibleAt(slot.instance, false);
    this.#free.push(slot);
  }

  // `opacity` counts where the material is transparent.
  setColour(slot, { r, g, b }, opacity = 1) {
    this.#mesh.setColorAt(slot.instance, new Vector4(r, g, b, opacity));
  }

  setVisible(slot, isVisible) {
    this.#mesh.setVisibleAt(slot.instance, isVisible);
  }

  // What add() was given, as another batch can take it.
  contentOf(slot) {
    const { attributes: { position, normal }, index } = this.#mesh.geometry;
    const { vertexStart, vertexCount, indexStart, indexCount } =
      this.#mesh.getGeometryRangeAt(slot.geometry);
    const [from, to] = [3 * vertexStart, 3 * (vertexStart + vertexCount)];
    return { positions: position.array.slice(from, to), normals: normal.array.slice(from, to),
             indices: index.array.slice(indexStart, indexStart + indexCount)
               .map((vertex) => vertex - vertexStart) };
  }

  #reuse(geometry) {
    const vertices = geometry.attributes.position.count;
    const indices = geometry.index.count;
    const fits = (slot) => slot.vertices >= vertices && slot.indices >= indices &&
                           slot.vertices <= withRoom(4 * vertices);
    const index = this.#free.findIndex(fits);
    if (index < 0) return undefined;
    const [slot] = this.#free.splice(index, 1);
    this.#mesh.setGeometryAt(slot.geometry, geometry);
    return slot;
  }

  #make(geometry) {
    const vertices = withRoom(geometry.attributes.position.count);
    const indices = withRoom(geometry.index.count);
    this.#makeRoom(vertices, indices);
    const id = this.#mesh.addGeometry(geometry, vertices, indices);
    ++this.#used.slots;
    this.#used.vertices += vertices;
    this.#used.indices += indices;
    return { geometry: id, instance: this.#mesh.addInstance(id), vertices, indices };
  }

  #makeRoom(vertices, indices) {
    if (!this.#isFull(vertices, indices)) return;
    this.#compact();
    if (!this.#isFull(vertices, indices)) return;
    this.#slots = Math.max(this.#slots, 2 * this.#used.slots + 2);
    this.#vertices = Math.max(this.#vertices, 2 * (this.#used.vertices + vertices));
    this.#indices = Math.max(this.#indices, 2 * (this.#used.indices + indices));
    this.#mesh.setInstanceCount(this.#slots);
    this.#mesh.setGeometrySize(this.#vertices, this.#indices);
  }

  #isFull(vertices, indices) {
    return this.#used.slots + 1 > this.#slots ||
           this.#used.vertices + vertices > this.#vertices ||
           this.#used.indices + indices > this.#indices;
  }

  // Gives up the slots that nothing fitted into.
  #compact() {
    for (const slot of this.#free) {
      this.#mesh.deleteGeometry(slot.geometry);
      --this.#used.slots;
      this.#used.vertices -= slot.vertices;
      this.#used.indices -= slot.indices;
    }
    if (this.#free.length > 0) this.#mesh.optimize();
    this.#free = [];
  }
}

export function diagonal(positions) {
  const box = new Box3().setFromArray(positions);
  return box.isEmpty() ? 0 : box.getSize(new Vector3()).length();
}
