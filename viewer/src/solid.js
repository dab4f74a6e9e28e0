// SPDX-License-Identifier: MIT
// Whether pieces of surface close: integrals over the triangles, which add up over the pieces.

const none = () => ({ size: 0, area: [0, 0, 0], volume: [0, 0, 0] });

// Of one piece: the sum of the triangles' areas, of their area vectors, and the volume under the
// piece as each of the three axes sees it.
export function integralsOf(positions, indices) {
  const sum = none();
  const side = [[0, 0, 0], [0, 0, 0]];
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    for (let k = 0; k < 3; ++k) {
      side[0][k] = positions[b + k] - positions[a + k];
      side[1][k] = positions[c + k] - positions[a + k];
    }
    let square = 0;
    for (let k = 0; k < 3; ++k) {
      const [l, m] = [(k + 1) % 3, (k + 2) % 3];
      const area = (side[0][l] * side[1][m] - side[0][m] * side[1][l]) / 2;
      square += area * area;
      sum.area[k] += area;
      sum.volume[k] += (area * (positions[a + k] + positions[b + k] + positions[c + k])) / 3;
    }
    sum.size += Math.sqrt(square);
  }
  return sum;
}

export function total(pieces) {
  const sum = none();
  for (const { size, area, volume } of pieces) {
    sum.size += size;
    for (let k = 0; k < 3; ++k) {
      sum.area[k] += area[k];
      sum.volume[k] += volume[k];
    }
  }
  return sum;
}

// The volume of what the pieces close, negative where they are inside out; undefined where they do
// not close: then the area vectors do not cancel, or the axes see different volumes (an open tube
// has none along itself).
export function volumeOf({ size, area, volume }) {
  const mean = (volume[0] + volume[1] + volume[2]) / 3;
  const rounding = 1e-6 * size * Math.sqrt(size);
  const isEven = volume.every((value) => Math.abs(value - mean) <= 1e-3 * Math.abs(mean) + rounding);
  return isEven && Math.hypot(...area) <= 1e-4 * size ? mean : undefined;
}
