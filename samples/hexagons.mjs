// SPDX-License-Identifier: MIT
// Prints 960 regular hexagons at random in the unit square, as figure 7a of Kallmann, Bieri and
// Thalmann, "Fully Dynamic Constrained Delaunay Triangulations" (2003), has them:
//   node samples/hexagons.mjs > hexagons.txt
const count = 960;
const smallest = 0.009;
const largest = 0.0215;
const decimals = 7;

// The numbers must be the same everywhere: a xorshift generator (Marsaglia 2003).
let state = 20030817;
function random() {
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) / 2 ** 32;
}

const between = (low, high) => low + (high - low) * random();

function hexagon() {
  const radius = between(smallest, largest);
  const [x, y] = [between(radius, 1 - radius), between(radius, 1 - radius)];
  const turn = between(0, Math.PI / 3);
  return Array.from({ length: 6 }, (_, corner) => {
    const angle = turn + (corner * Math.PI) / 3;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

for (let i = 0; i < count; ++i) {
  const lines = hexagon().map((point) => point.map((x) => x.toFixed(decimals)).join(' '));
  console.log(['6 1', ...lines].join('\n'));
}
