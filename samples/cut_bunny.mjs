// SPDX-License-Identifier: MIT
// Cuts the mesh of the npm package `bunny` into 60 slices and prints them, one a line:
//   npm ci --prefix samples && node samples/cut_bunny.mjs > samples/data/bunny.ndjson
import bunny from 'bunny';

const slice_count = 60;
const scale = 10; // the bunny is then about 100 high
const decimals = 1e4;

// The package has y up; slices go across z.
const vertices = bunny.positions.map(([x, y, z]) => [x * scale, -z * scale, y * scale]);
const heights = vertices.map((vertex) => vertex[2]);
const lowest = Math.min(...heights);
const gap = (Math.max(...heights) - lowest) / slice_count;

const round = (value) => Math.round(value * decimals) / decimals + 0; // + 0: no negative zero

// The point at height z on the edge between two vertices, the same from both sides.
function point_on_edge(from, to, z) {
  const [a, b] = [vertices[Math.min(from, to)], vertices[Math.max(from, to)]];
  const t = (z - a[2]) / (b[2] - a[2]);
  return [round(a[0] + t * (b[0] - a[0])), round(a[1] + t * (b[1] - a[1]))];
}

const edge_name = (from, to) => `${Math.min(from, to)}-${Math.max(from, to)}`;

// A triangle that crosses the plane has one edge going up through it and one going down: the cut
// leads from the one to the other.
function cut(z) {
  const next = new Map();
  const points = new Map();
  for (const cell of bunny.cells) {
    let up, down;
    for (const corner of [0, 1, 2]) {
      const [from, to] = [cell[corner], cell[(corner + 1) % 3]];
      const [below, after] = [heights[from] < z, heights[to] < z];
      if (below === after) continue;
      const edge = edge_name(from, to);
      points.set(edge, point_on_edge(from, to, z));
      if (below) up = edge;
      else down = edge;
    }
    if (up) next.set(down, up);
  }
  return follow(next).map((loop) => without_repeats(loop.map((edge) => points.get(edge))));
}

function follow(next) {
  const loops = [];
  while (next.size > 0) {
    const loop = [];
    let edge = next.keys().next().value;
    while (next.has(edge)) {
      loop.push(edge);
      const following = next.get(edge);
      next.delete(edge);
      edge = following;
    }
    loops.push(loop);
  }
  return loops;
}

// Rounding may bring neighbours together.
function without_repeats(loop) {
  return loop.filter((point, i) => {
    const before = loop[(i + loop.length - 1) % loop.length];
    return point[0] !== before[0] || point[1] !== before[1];
  });
}

for (let i = 0; i < slice_count; ++i) {
  const z = round(lowest + (i + 0.5) * gap);
  const contours = cut(z).filter((loop) => loop.length >= 3);
  console.log(JSON.stringify({ z, contours }));
}
