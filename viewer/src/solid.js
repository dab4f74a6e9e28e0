// SPDX-License-Identifier: MIT
// Whether pieces of surface close: integrals over the triangles, which add up over the pieces.

const none = () => ({ size: 0, area: [0, 0, 0], volume: [0, 0, 0] });

// Of one piece: the sum of the triangles' areas, of their area vectors, and the volume under the
// piece as each of the three axes sees it. Written out, as there are many triangles.
export function integralsOf(positions, indices) {
  let [size, areaX, areaY, areaZ, volumeX, volumeY, volumeZ] = [0, 0, 0, 0, 0, 0, 0];
  for (let i = 0; i < indices.length; i += 3) {
    const a = 3 * indices[i];
    const b = 3 * indices[i + 1];
    const c = 3 * indices[i + 2];
    const ax = positions[a];
    const ay = positions[a + 1];
    const az = positions[a + 2];
    const ux = positions[b] - ax;
    const uy = positions[b + 1] - ay;
    const uz = positions[b + 2] - az;
    const vx = positions[c] - ax;
    const vy = positions[c + 1] - ay;
    const vz = positions[c + 2] - az;
    const x = (uy * vz - uz * vy) / 2;
    const y = (uz * vx - ux * vz) / 2;
    const z = (ux * vy - uy * vx) / 2;
    size += Math.sqrt(x * x + y * y + z * z);
    areaX += x;
    areaY += y;
    areaZ += z;
    volumeX += x * (ax + (ux + vx) / 3);
    volumeY += y * (ay + (uy + vy) / 3);
    volumeZ += z * (az + (uz + vz) / 3);
  }
  return { size, area: [areaX, areaY, areaZ], volume: [volumeX, volumeY, volumeZ] };
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
