// SPDX-License-Identifier: MIT
// What the live page makes of borders that change: loops, without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';

globalThis.Path2D = class {
  moveTo() {}
  lineTo() {}
  closePath() {}
};
const { Border } = await import('../../viewer/live/border.js');

// The edges of an outline, in its direction.
const edges = (...corners) => corners.flatMap((corner, i) => [...corner, ...corners[(i + 1) % corners.length]]);
const square = (x, y, size) => edges([x, y], [x + size, y], [x + size, y + size], [x, y + size]);
const hole = (x, y, size) => edges([x, y], [x, y + size], [x + size, y + size], [x + size, y]);
const areas = (border) => border.loops.map(({ area }) => area);

function borderOf(...outlines) {
  const border = new Border();
  border.take({ come: outlines.flat(), area: 0 }, [0, 0]);
  return border;
}

test('loops come from edges, the largest first, gaps with an area below 0', () => {
  const border = borderOf(square(0, 0, 1), square(5, 5, 4), hole(6, 6, 2));
  assert.deepEqual(areas(border), [16, -4, 1]);
  assert.deepEqual(border.gaps.map(({ box }) => box), [[6, 6, 8, 8]]);
});

test('a change makes anew what it touches, and says where', () => {
  const border = borderOf(square(0, 0, 1), square(5, 5, 4));
  const [kept] = border.loops;
  const box = border.take({ gone: square(0, 0, 1), come: square(2, 0, 2), area: 0 });
  assert.deepEqual(areas(border), [16, 4]);
  assert.equal(border.loops[0], kept);
  assert.deepEqual(box, [0, 0, 4, 2]);
});

test('loops that touch in a place have no gap between them', () => {
  const sum = (border) => areas(border).reduce((all, area) => all + area, 0);
  const border = borderOf(square(0, 0, 2), square(2, 2, 2));
  assert.equal(sum(border), 8);
  border.take({ gone: [], come: square(4, 4, 1), area: 0 });
  assert.equal(sum(border), 9);
  assert.deepEqual(border.gaps, []);
  border.take({ gone: square(2, 2, 2), come: [], area: 0 });
  assert.deepEqual(areas(border), [4, 1]);
});

test('a gap that touches the outside is a loop of its own', () => {
  // A square of 4 with a gap whose corner is on its rim.
  const rim = edges([0, 0], [2, 0], [4, 0], [4, 4], [0, 4]);
  const border = borderOf(rim, edges([2, 0], [1, 1], [2, 2], [3, 1]));
  assert.deepEqual(areas(border), [16, -2]);
});

test('an edge that is cut, and whole again, leaves the loop as it was', () => {
  const border = borderOf(square(0, 0, 2));
  border.take({ gone: [0, 0, 2, 0], come: [0, 0, 1, 0, 1, 0, 2, 0], area: 4 });
  assert.equal(border.loops[0].numbers.length, 5);
  border.take({ gone: [0, 0, 1, 0, 1, 0, 2, 0], come: [0, 0, 2, 0], area: 4 });
  assert.deepEqual(areas(border), [4]);
  assert.equal(border.loops[0].numbers.length, 4);
});
