// SPDX-License-Identifier: MIT
// What the scene computes, without a browser: node --test scene_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { codeOf, layOut } from '../../viewer/src/cap_codes.js';
import { lettersOf } from '../../viewer/src/letters.js';
import { angleOf, Measures } from '../../viewer/src/measures.js';
import { wayAlong } from '../../viewer/src/section.js';
import { integralsOf, total, volumeOf } from '../../viewer/src/solid.js';

// A box from `low` to `high` with outward triangles, without the sides named in `left`.
function box(low, high, left = []) {
  const corners = Array.from({ length: 8 }, (_, i) => [0, 1, 2].map((k) => (i & (1 << k) ? high : low)[k]));
  const sides = { x0: [0, 4, 6, 2], x1: [1, 3, 7, 5], y0: [0, 1, 5, 4], y1: [2, 6, 7, 3], z0: [0, 2, 3, 1], z1: [4, 5, 7, 6] };
  const quads = Object.entries(sides).filter(([name]) => !left.includes(name)).map(([, quad]) => quad);
  const indices = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  return { positions: corners.flat(), indices, corners };
}

function trianglesOf({ indices, corners }) {
  return Array.from({ length: indices.length / 3 }, (_, i) => [0, 1, 2].map((k) => corners[indices[3 * i + k]]));
}

test('What closes has a volume, what is open has none', () => {
  const volume = (...boxes) => volumeOf(total(boxes.map((one) => integralsOf(one.positions, one.indices))));
  assert.ok(Math.abs(volume(box([5, 6, 7], [7, 9, 11])) - 24) < 1e-9);
  assert.equal(volume(box([5, 6, 7], [7, 9, 11], ['z1'])), undefined);
  assert.equal(volume(box([5, 6, 7], [7, 9, 11], ['z0', 'z1'])), undefined);  // an open tube
  const halves = [box([0, 0, 0], [1, 1, 1], ['z1']), box([0, 0, 1], [1, 1, 2], ['z0'])];
  assert.ok(Math.abs(volume(...halves) - 2) < 1e-9);
  const inside = box([0, 0, 0], [1, 1, 1]);
  inside.indices.reverse();
  assert.ok(Math.abs(volume(inside) + 1) < 1e-9);
});

// The labels in a sum of codes, as the shader finds them; -1 for several.
function decode(sum, { own, perChannel, bits }) {
  const labels = [];
  if (own < 4 && sum[3] >= 8192) {
    const count = Math.floor(sum[3] / 8192);
    labels.push(count > 1 ? -1 : own * perChannel + sum[3] - 8192 * count);
  }
  for (let channel = own - 1; channel >= 0; --channel) {
    for (let rest = sum[channel]; rest >= 1;) {
      const slot = Math.floor(Math.floor(Math.log2(rest)) / bits);
      labels.push(channel * perChannel + slot);
      rest %= 2 ** (slot * bits);
    }
  }
  return labels;
}

test('Sums of codes tell which labels are in them, the smallest first', () => {
  const float = { exact: 24, room: 6 };
  for (const [count, inside] of [[1, [0]], [2, [1, 0]], [9, [8, 4, 3, 0]], [72, [71, 36, 35, 1]], [500, [499, 53, 7]]]) {
    const layout = layOut(count, float);
    const sum = [0, 0, 0, 0];
    for (const label of inside) codeOf(label, layout, 1).forEach((value, i) => { sum[i] += value; });
    assert.deepEqual(decode(sum, layout), inside);
    assert.ok(Math.max(...sum) < 2 ** 18);
  }
  assert.ok(layOut(28, { exact: 11, room: 4 }));
  assert.equal(layOut(29, { exact: 11, room: 4 }), undefined);
});

test('Of two ways around a surface the shorter is taken, over all pieces', () => {
  const triangles = [box([0, 0, 0], [4, 4, 1], ['z1']), box([0, 0, 1], [4, 4, 2], ['z0'])].flatMap(trianglesOf);
  const plane = { normal: [0, 1, 0], offset: 1.5 };
  const way = wayAlong(triangles, plane, [1, 1.5, 2], [4, 1.5, 0.5]);
  assert.ok(Math.abs(way.length - (3 + 1.5)) < 1e-12, String(way.length));
  assert.deepEqual(way.points[0], [1, 1.5, 2]);
  assert.deepEqual(way.points.at(-1), [4, 1.5, 0.5]);
  const apart = [...triangles, ...trianglesOf(box([9, 0, 0], [10, 4, 1]))];
  assert.equal(wayAlong(apart, plane, [1, 1.5, 2], [9.5, 1.5, 1]), undefined);
});

test('An angle is that at the second place', () => {
  assert.ok(Math.abs(angleOf([[1, 0, 0], [0, 0, 0], [0, 5, 0]]) - 90) < 1e-12);
  assert.ok(Math.abs(angleOf([[1, 0, 0], [0, 0, 0], [-1, 1e-9, 0]]) - 180) < 1e-6);
});

test('Measures can be removed', () => {
  const measures = new Measures();
  for (const place of [[0, 0, 0], [3, 4, 0], [0, 0, 0], [0, 0, 2]]) measures.add({ place }, 'mm');
  assert.deepEqual(measures.list.map(({ text }) => text), ['5 mm', '2 mm']);
  measures.remove(measures.list[0]);
  assert.deepEqual(measures.list.map(({ text }) => text), ['2 mm']);
});

test('Letters of directions are those of DICOM', () => {
  assert.equal(lettersOf([1, 0, 0]), 'L');
  assert.equal(lettersOf([-1, 0, 0]), 'R');
  assert.equal(lettersOf([0, -1, 0]), 'A');
  assert.equal(lettersOf([0, 0.6, -0.8]), 'IP');
});
