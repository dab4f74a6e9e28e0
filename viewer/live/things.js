// SPDX-License-Identifier: MIT
// Things with rings that lie somewhere: found under the pointer, each with its path.

import { grow } from './border.js';

// Rings are x, y, x, y, ...; `at` is how far they are from where they were given. `map`, where there is
// one, is [xx, xy, yx, yy]: it turns them before. With `isLocal` rings are around a place of their own,
// not where they are in the plane. Lines have `isLine`; points `isSpot`, they are where `at` says.
export class Things {
  #things = new Map();
  #isLocal;

  constructor(isLocal = false) { this.#isLocal = isLocal; }

  clear() { this.#things.clear(); }

  get size() { return this.#things.size; }
  get ids() { return [...this.#things.keys()]; }
  has(id) { return this.#things.has(id); }
  get(id) { return this.#things.get(id); }
  values() { return this.#things.values(); }

  add(thing) {
    thing.rings = (thing.rings ?? [[0, 0]]).map((ring) => Float64Array.from(ring));
    forgetShape(thing);
    this.#things.set(thing.id, thing);
  }
  remove(id) { this.#things.delete(id); }

  place(id, at, map) {
    const thing = this.#things.get(id);
    if (!thing) return;
    thing.at = at;
    if (!map || thing.map?.every((value, i) => value === map[i])) return;
    thing.map = map;
    forgetShape(thing);
  }

  // Where it is in the plane.
  boxOf({ box, at: [x, y] }) { return [box[0] + x, box[1] + y, box[2] + x, box[3] + y]; }

  // What is to be drawn, where a board has entered the plane for it.
  enter(board, thing) {
    const { origin } = board;
    thing.shape ??= pathOf(thing, this.#isLocal ? [0, 0] : origin);
    board.enterPlane(this.#isLocal ? [thing.at[0] - origin[0], thing.at[1] - origin[1]] : thing.at);
    return thing.shape;
  }

  // Those that are seen.
  * seen(board) {
    for (const thing of this.#things.values()) if (board.isSeen(this.boxOf(thing))) yield thing;
  }

  // The smallest thing at a place, or near to it where it is a line.
  find([x, y], near) {
    let best;
    for (const thing of this.#things.values()) {
      const p = [x - thing.at[0], y - thing.at[1]];
      const [left, low, right, high] = thing.box;
      if (p[0] < left - near || p[0] > right + near || p[1] < low - near || p[1] > high + near) continue;
      const size = (right - left) * (high - low);
      if (best && size >= best.size) continue;
      if (isHit(thing, p, near)) best = { thing, size };
    }
    return best?.thing;
  }
}

function forgetShape(thing) {
  thing.shape = undefined;
  thing.box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const ring of thing.rings)
    for (let i = 0; i < ring.length; i += 2) grow(thing.box, ...mapped(thing, ring[i], ring[i + 1]));
}

function mapped(thing, x, y) {
  const m = thing.map;
  return m ? [m[0] * x + m[1] * y, m[2] * x + m[3] * y] : [x, y];
}

function pathOf(thing, [ox, oy]) {
  const path = new Path2D();
  for (const ring of thing.rings) {
    for (let i = 0; i < ring.length; i += 2) {
      const [x, y] = mapped(thing, ring[i], ring[i + 1]);
      if (i === 0) path.moveTo(x - ox, y - oy);
      else path.lineTo(x - ox, y - oy);
    }
    if (!thing.isLine || thing.is_closed) path.closePath();
  }
  return path;
}

function sidesOf(thing, see) {
  for (const ring of thing.rings) {
    const count = ring.length / 2;
    for (let i = thing.isLine ? 1 : 0; i < count; ++i) {
      const j = (i + count - 1) % count;
      see(mapped(thing, ring[2 * j], ring[2 * j + 1]), mapped(thing, ring[2 * i], ring[2 * i + 1]));
    }
  }
}

function isHit(thing, p, near) {
  if (thing.isSpot) return Math.hypot(...p) <= near;
  return thing.isLine ? isNear(thing, p, near) : isInside(thing, p);
}

function isInside(thing, [x, y]) {
  let inside = false;
  sidesOf(thing, ([ax, ay], [bx, by]) => {
    if ((ay > y) !== (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay)) inside = !inside;
  });
  return inside;
}

function isNear(thing, p, near) {
  let found = false;
  sidesOf(thing, (a, b) => { found ||= distanceToSegment(p, a, b) <= near; });
  return found;
}

export function distanceToSegment([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const part = square > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - part * dx, y - ay - part * dy);
}
