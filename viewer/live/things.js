// SPDX-License-Identifier: MIT
// Things with rings that lie somewhere: found under the pointer, drawn all at once. What is being
// moved is drawn by itself, so that the path of all others stays as it is.

// Rings are x, y, x, y, ...; `at` is how far they are from where they were given. `map`, where there is
// one, is [xx, xy, yx, yy]: it turns them before.
// With `isLocal` rings are around a place of their own, not where they are in the plane.
export class Things {
  #things = new Map();
  #path;
  #pathWithout = new Set();
  #moving = new Set();
  #isLocal;

  constructor(isLocal = false) { this.#isLocal = isLocal; }

  clear() {
    this.#things.clear();
    this.#path = undefined;
    this.#moving.clear();
  }

  get size() { return this.#things.size; }
  get ids() { return [...this.#things.keys()]; }
  has(id) { return this.#things.has(id); }
  get(id) { return this.#things.get(id); }
  values() { return this.#things.values(); }

  add(thing) {
    thing.rings = thing.rings.map((ring) => Float64Array.from(ring));
    thing.box = boxOf(thing);
    thing.shape = undefined;
    this.#things.set(thing.id, thing);
    if (!this.#pathWithout.has(thing.id)) this.#path = undefined;
  }
  remove(id) {
    this.#things.delete(id);
    this.#path = undefined;
  }

  place(id, at, map) {
    const thing = this.#things.get(id);
    if (!thing) return;
    thing.at = at;
    if (map) {
      thing.map = map;
      thing.shape = undefined;
      thing.box = boxOf(thing);
    }
    if (!this.#pathWithout.has(id)) this.#path = undefined;
  }

  // From now on these are drawn by themselves; with none, all at once again.
  setMoving(ids) {
    this.#moving = new Set(ids);
    for (const id of ids) if (!this.#pathWithout.has(id)) this.#path = undefined;
    if (ids.length === 0 && this.#pathWithout.size > 0) this.#path = undefined;
  }
  get moving() { return [...this.#moving].map((id) => this.#things.get(id)).filter(Boolean); }

  // Of one thing, to be drawn at its place.
  shape(thing, origin) {
    thing.shape ??= pathOf(thing, this.#isLocal ? [0, 0] : origin);
    return thing.shape;
  }
  // Where it is drawn, from the origin.
  offset({ at }, origin) { return this.#isLocal ? [at[0] - origin[0], at[1] - origin[1]] : at; }

  // All but those that are moving, relative to the origin.
  path(origin) {
    if (this.#path) return this.#path;
    this.#pathWithout = new Set(this.#moving);
    this.#path = new Path2D();
    for (const thing of this.#things.values()) {
      if (this.#pathWithout.has(thing.id)) continue;
      const [x, y] = this.offset(thing, origin);
      this.#path.addPath(this.shape(thing, origin), new DOMMatrix([1, 0, 0, 1, x, y]));
    }
    return this.#path;
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
      if (thing.isLine ? isNear(thing, p, near) : isInside(thing, p)) best = { thing, size };
    }
    return best?.thing;
  }
}

export function mapped(thing, x, y) {
  const m = thing.map;
  return m ? [m[0] * x + m[1] * y, m[2] * x + m[3] * y] : [x, y];
}

function visit(thing, see) {
  thing.rings.forEach((ring, number) => {
    for (let i = 0; i < ring.length; i += 2) see(mapped(thing, ring[i], ring[i + 1]), i, number);
  });
}

function boxOf(thing) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  visit(thing, ([x, y]) => {
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  });
  return box;
}

function pathOf(thing, [ox, oy]) {
  const path = new Path2D();
  for (const ring of thing.rings) {
    for (let i = 0; i < ring.length; i += 2) {
      const [x, y] = mapped(thing, ring[i], ring[i + 1]);
      if (i === 0) path.moveTo(x - ox, y - oy);
      else path.lineTo(x - ox, y - oy);
    }
    if (!thing.isLine) path.closePath();
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
