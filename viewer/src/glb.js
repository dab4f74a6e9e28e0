// SPDX-License-Identifier: MIT
// Reads what slabs are: one node with extras, one mesh with normals and indices, in one buffer.

const magic = 0x46546c67;
const arrays = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const widths = { SCALAR: 1, VEC3: 3 };

function read(document, binary, index) {
  const accessor = document.accessors[index];
  const view = document.bufferViews[accessor.bufferView];
  const start = binary + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
  const count = accessor.count * widths[accessor.type];
  return new arrays[accessor.componentType](document.bytes, start, count).slice();
}

// What a renderer needs of a slab; without `positions` where nothing lies between its slices.
export function parseSlab(bytes) {
  const view = new DataView(bytes);
  if (view.byteLength < 20 || view.getUint32(0, true) !== magic) throw new Error('no GLB');
  const length = view.getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length)));
  document.bytes = bytes;
  const node = document.nodes[0];
  const slab = { ...node.extras, translation: node.translation ?? [0, 0, 0] };
  if (node.mesh === undefined) return slab;
  const primitive = document.meshes[node.mesh].primitives[0];
  const binary = 20 + length + 8;
  slab.positions = read(document, binary, primitive.attributes.POSITION);
  slab.normals = read(document, binary, primitive.attributes.NORMAL);
  slab.indices = read(document, binary, primitive.indices);
  const material = document.materials?.[primitive.material];
  slab.colour = material?.pbrMetallicRoughness?.baseColorFactor?.slice(0, 3);
  return slab;
}
