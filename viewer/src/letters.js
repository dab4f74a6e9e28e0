// SPDX-License-Identifier: MIT
// The letters of a patient's directions.

const clear = 0.4;  // a direction's share from which on its letter is told

// Where a direction (x, y, z) points in a patient: left is +x, posterior +y, superior +z; the
// letter of its largest share first.
export function lettersOf(direction) {
  const names = [['L', 'R'], ['P', 'A'], ['S', 'I']];
  const shares = direction.map((value, axis) => ({ size: Math.abs(value), name: names[axis][value < 0 ? 1 : 0] }));
  return shares.filter(({ size }) => size > clear).sort((a, b) => b.size - a.size)
    .map(({ name }) => name).join('');
}
