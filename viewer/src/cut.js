// SPDX-License-Identifier: MIT
// Where a cut is: planes of the input's space, and the same in the scene.
import { Plane, Vector3 } from 'three';

// A plane by the side of it that goes: `normal` (input, unit length) points there, `offset` is its
// distance from the origin along it. With a thickness a second plane that far behind the first
// keeps only what is between them.
export function planesOf({ normal, offset, thickness }) {
  const first = { normal, offset };
  if (thickness === undefined) return [first];
  return [first, { normal: normal.map((value) => -value), offset: thickness - offset }];
}

// In the scene, where three.js keeps what is on the positive side.
export function toScene({ normal, offset }, frame) {
  const [x, y, z] = normal;
  const place = frame.toScene(...normal.map((value) => value * offset));
  return new Plane().setFromNormalAndCoplanarPoint(new Vector3(-x, -z, y), place);
}

// From the scene's directions to the input's, and back.
export function directionToInput({ x, y, z }) { return [x, -z, y]; }
export function directionToScene([x, y, z]) { return new Vector3(x, z, -y); }

// From the lowest to the highest place of a box along a normal.
export function extentOf([low, high], normal) {
  const ends = [0, 0];
  for (const [axis, value] of normal.entries()) {
    ends[0] += value * (value > 0 ? low : high)[axis];
    ends[1] += value * (value > 0 ? high : low)[axis];
  }
  return ends;
}

// A normal by two angles in degrees: `tilt` away from +z, `turn` about it. Up to 90 degrees of tilt
// are all planes there are.
export function normalOf(tilt, turn) {
  const [t, a] = [tilt, turn].map((angle) => (angle * Math.PI) / 180);
  const clean = (value) => (Math.abs(value) < 1e-15 ? 0 : value);
  return [Math.sin(t) * Math.cos(a), Math.sin(t) * Math.sin(a), Math.cos(t)].map(clean);
}

export function anglesOf([x, y, z]) {
  const degrees = 180 / Math.PI;
  const tilt = Math.acos(Math.min(Math.max(z, -1), 1)) * degrees;
  return [tilt, Math.hypot(x, y) < 1e-9 ? 0 : Math.atan2(y, x) * degrees];
}
