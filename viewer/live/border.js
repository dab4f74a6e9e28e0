// SPDX-License-Identifier: MIT
// The border of a result, of which the program sends what has come and what is gone: edges with the
// result on their left. Kept as loops, each with its path: a change costs the loops that it touches.

const none = undefined;

export class Border {
  #numbers = new Map();  // places, by their coordinates as text
  #places = [];          // x, y, of each number
  #out = [];             // edges from each place: { to, loop }
  #loops = new Set();    // { numbers, area, box, path }
  #broken = new Set();   // loops that have lost an edge
  #sorted;
  #origin = [0, 0];

  constructor() { this.area = 0; }

  // All of it anew, or a change. Returns a box around what is other than before.
  take({ come, gone, area }, origin) {
    const old = new Set();
    if (!gone) {
      for (const loop of this.#loops) old.add(loop);
      this.#forget();
      this.#origin = origin;
    }
    const touched = new Set();
    for (let i = 0; gone && i < gone.length; i += 4) this.#removeEdge(gone, i, touched);
    for (let i = 0; i < come.length; i += 4) this.#addEdge(come, i, touched);
    for (const place of touched) for (const { loop } of this.#out[place]) if (loop) old.add(loop);
    for (const loop of this.#broken) old.add(loop);
    this.#broken.clear();
    const starts = [...touched];
    for (const loop of old) if (this.#loops.delete(loop)) starts.push(...this.#unlink(loop));
    const fresh = starts.flatMap((place) => this.#traceFrom(place));
    this.area = area;
    this.#sorted = none;
    return boxAround([...old, ...fresh]);
  }

  // Loops, the largest first: so those around gaps come after what is around them.
  get loops() {
    this.#sorted ??= [...this.#loops].sort((a, b) => Math.abs(b.area) - Math.abs(a.area));
    return this.#sorted;
  }
  // Those that go round what is not in the result.
  get gaps() { return this.loops.filter(({ area }) => area < 0); }

  #forget() {
    this.#numbers.clear();
    this.#places = [];
    this.#out = [];
    this.#loops.clear();
  }

  #number(x, y) {
    const key = `${x},${y}`;
    let number = this.#numbers.get(key);
    if (number === none) {
      number = this.#out.length;
      this.#numbers.set(key, number);
      this.#places.push(x, y);
      this.#out.push([]);
    }
    return number;
  }

  #removeEdge(edges, i, touched) {
    const from = this.#number(edges[i], edges[i + 1]);
    const to = this.#number(edges[i + 2], edges[i + 3]);
    const out = this.#out[from];
    const at = out.findIndex((edge) => edge.to === to);
    if (at < 0) return;
    const [{ loop }] = out.splice(at, 1);
    touched.add(from).add(to);
    if (loop) this.#broken.add(loop);
  }
  #addEdge(edges, i, touched) {
    const from = this.#number(edges[i], edges[i + 1]);
    const to = this.#number(edges[i + 2], edges[i + 3]);
    this.#out[from].push({ to, loop: none });
    touched.add(from).add(to);
  }

  // Its edges belong to no loop any more; where they start.
  #unlink(loop) {
    for (const place of loop.numbers)
      for (const edge of this.#out[place]) if (edge.loop === loop) edge.loop = none;
    return loop.numbers;
  }

  #traceFrom(start) {
    const found = [];
    for (;;) {
      const first = this.#out[start].find(({ loop }) => loop === none);
      if (!first) return found;
      const loop = this.#trace(start, first);
      this.#loops.add(loop);
      found.push(loop);
    }
  }

  // Where several edges go on, the one furthest to the right: so a loop goes round one gap only.
  #trace(start, first) {
    const loop = { numbers: [start] };
    let edge = first;
    edge.loop = loop;
    for (let before = start, at = edge.to; at !== start;) {
      loop.numbers.push(at);
      const out = this.#out[at].filter((one) => one.loop === none);
      if (out.length === 0) break;
      edge = out.length === 1 ? out[0] : this.#rightmost(out, before, at);
      edge.loop = loop;
      before = at;
      at = edge.to;
    }
    this.#measure(loop);
    return loop;
  }

  #rightmost(out, before, at) {
    const back = this.#angle(at, before);
    const turns = out.map(({ to }) => (this.#angle(at, to) - back + 4 * Math.PI) % (2 * Math.PI));
    return out[turns.indexOf(Math.min(...turns))];
  }

  #angle(from, to) {
    const p = this.#places;
    return Math.atan2(p[2 * to + 1] - p[2 * from + 1], p[2 * to] - p[2 * from]);
  }

  #measure(loop) {
    const p = this.#places;
    const [ox, oy] = this.#origin;
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const path = new Path2D();
    const last = loop.numbers.at(-1);
    let [bx, by] = [p[2 * last] - ox, p[2 * last + 1] - oy];
    let twice = 0;
    loop.numbers.forEach((number, i) => {
      const [x, y] = [p[2 * number] - ox, p[2 * number + 1] - oy];
      twice += bx * y - x * by;
      if (i === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
      grow(box, p[2 * number], p[2 * number + 1]);
      [bx, by] = [x, y];
    });
    path.closePath();
    Object.assign(loop, { area: twice / 2, box, path });
  }
}

export function grow(box, x, y) {
  box[0] = Math.min(box[0], x);
  box[1] = Math.min(box[1], y);
  box[2] = Math.max(box[2], x);
  box[3] = Math.max(box[3], y);
}

// Nothing where there is nothing.
export function boxAround(things) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const { box: [left, low, right, high] } of things) {
    grow(box, left, low);
    grow(box, right, high);
  }
  return box[0] <= box[2] ? box : none;
}
