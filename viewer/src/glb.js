// SPDX-License-Identifier: MIT
// Reads what slabs are: one node with extras, one mesh with normals and indices, in one buffer; and
// bundles of slabs, which are several such files one behind the other, each with many slabs.

const magic = 0x46546c67;
const arrays = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const widths = { SCALAR: 1, VEC3: 3 };

function read(document, index) {
  const accessor = document.accessors[index];
  const view = document.bufferViews[accessor.bufferView];
  const start = document.binary + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
  const count = accessor.count * widths[accessor.type];
  return new arrays[accessor.componentType](document.bytes, start, count).slice();
}

// The file that begins at a byte, and its length.
function parse(bytes, start = 0) {
  const view = new DataView(bytes, start);
  if (view.byteLength < 20 || view.getUint32(0, true) !== magic) throw new Error('no GLB');
  const length = view.getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, start + 20, length)));
  return Object.assign(document, { bytes, binary: start + 20 + length + 8,
                                   length: view.getUint32(8, true) });
}

// What a renderer needs of its one node; without `positions` where that has no faces.
function contentOf(document) {
  const node = document.nodes[0];
  const content = { ...node.extras, translation: node.translation ?? [0, 0, 0] };
  if (node.mesh === undefined) return content;
  const primitive = document.meshes[node.mesh].primitives[0];
  content.positions = read(document, primitive.attributes.POSITION);
  content.normals = read(document, primitive.attributes.NORMAL);
  content.indices = read(document, primitive.indices);
  const material = document.materials?.[primitive.material];
  content.colour = material?.pbrMetallicRoughness?.baseColorFactor?.slice(0, 3);
  return content;
}

// The slabs of a bundle, each with what is its.
function apart({ slabs, positions, normals, indices, ...common }) {
  let [vertex, index] = [0, 0];
  return slabs.map(({ vertices, indices: count, ...own }) => {
    const slab = { ...common, ...own };
    if (count > 0) {
      slab.positions = positions.slice(3 * vertex, 3 * (vertex + vertices));
      slab.normals = normals.slice(3 * vertex, 3 * (vertex + vertices));
      const first = vertex;
      slab.indices = indices.slice(index, index + count).map((corner) => corner - first);
    }
    vertex += vertices;
    index += count;
    return slab;
  });
}

// What a renderer needs of a slab; without `positions` where nothing lies between its slices.
export function parseSlab(bytes) {
  return contentOf(parse(bytes));
}

// The same of all slabs in bundles.
export function parseBundles(bytes) {
  const slabs = [];
  for (let start = 0; start < bytes.byteLength;) {
    const document = parse(bytes, start);
    slabs.push(...apart(contentOf(document)));
    start += document.length;
  }
  return slabs;
}
