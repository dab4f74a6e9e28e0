// SPDX-License-Identifier: MIT
// The border of a result, of which the program sends what has come and what is gone: edges with the
// result on their left. Kept as numbers, so that a change costs its own size, and a path its length.

export class Border {
  #numbers = new Map();  // places, by their coordinates as text
  #places = [];          // x, y, of each number
  #out = [];             // edges from each place: the places that they lead to
  #path;
  #gaps;

  constructor() { this.area = 0; }

  // All of it anew, or a change.
  take({ come, gone, area }) {
    if (!gone) this.#forget();
    for (let i = 0; gone && i < gone.length; i += 4) {
      const out = this.#out[this.#number(gone[i], gone[i + 1])];
      const at = out.indexOf(this.#number(gone[i + 2], gone[i + 3]));
      if (at >= 0) out.splice(at, 1);
    }
    for (let i = 0; i < come.length; i += 4)
      this.#out[this.#number(come[i], come[i + 1])].push(this.#number(come[i + 2], come[i + 3]));
    this.area = area;
    if (!gone || come.length + gone.length > 0) this.#path = this.#gaps = undefined;
    if (this.#places.length > 400_000) this.#tidy();
  }

  // To be filled, by whatever rule.
  path(origin) {
    if (!this.#path) this.#trace(origin);
    return this.#path;
  }
  // Those loops that go round what is not in the result.
  gaps(origin) {
    if (!this.#path) this.#trace(origin);
    return this.#gaps;
  }

  #forget() {
    this.#numbers.clear();
    this.#places = [];
    this.#out = [];
  }

  // Places that nothing starts from any more go.
  #tidy() {
    const edges = [];
    this.#out.forEach((out, from) => {
      for (const to of out)
        edges.push(this.#places[2 * from], this.#places[2 * from + 1], this.#places[2 * to], this.#places[2 * to + 1]);
    });
    this.take({ come: edges, area: this.area });
  }

  #number(x, y) {
    const key = `${x},${y}`;
    let number = this.#numbers.get(key);
    if (number === undefined) {
      number = this.#out.length;
      this.#numbers.set(key, number);
      this.#places.push(x, y);
      this.#out.push([]);
    }
    return number;
  }

  #trace([ox, oy]) {
    const left = this.#out.map((out) => [...out]);
    const path = new Path2D();
    const gaps = new Path2D();
    let gapArea = 0;
    let gapCount = 0;
    for (let start = 0; start < left.length; ++start) {
      while (left[start].length > 0) {
        const loop = this.#loop(left, start);
        const area = this.#areaOf(loop);
        append(path, loop, this.#places, ox, oy);
        if (area >= 0) continue;
        append(gaps, loop, this.#places, ox, oy);
        gapArea -= area;
        ++gapCount;
      }
    }
    this.#path = path;
    this.#gaps = { path: gaps, area: gapArea, count: gapCount };
  }

  // Where several edges go on, the one furthest to the right: so a loop goes round one gap only.
  #loop(left, start) {
    const loop = [start];
    let at = start;
    let before;
    do {
      const out = left[at];
      const next = out.length > 1 && before !== undefined ? this.#rightmost(out, before, at) : out.length - 1;
      before = at;
      [at] = out.splice(next, 1);
      if (at === undefined) break;
      loop.push(at);
    } while (at !== start);
    loop.pop();
    return loop;
  }

  #rightmost(out, before, at) {
    const back = this.#angle(at, before);
    const turns = out.map((to) => (this.#angle(at, to) - back + 4 * Math.PI) % (2 * Math.PI));
    return turns.indexOf(Math.min(...turns));
  }

  #angle(from, to) {
    const p = this.#places;
    return Math.atan2(p[2 * to + 1] - p[2 * from + 1], p[2 * to] - p[2 * from]);
  }

  #areaOf(loop) {
    const p = this.#places;
    const [x0, y0] = [p[2 * loop[0]], p[2 * loop[0] + 1]];
    let twice = 0;
    for (let i = 0; i < loop.length; ++i) {
      const a = loop[i];
      const b = loop[(i + 1) % loop.length];
      twice += (p[2 * a] - x0) * (p[2 * b + 1] - y0) - (p[2 * b] - x0) * (p[2 * a + 1] - y0);
    }
    return twice / 2;
  }
}

function append(path, loop, places, ox, oy) {
  path.moveTo(places[2 * loop[0]] - ox, places[2 * loop[0] + 1] - oy);
  for (let i = 1; i < loop.length; ++i) path.lineTo(places[2 * loop[i]] - ox, places[2 * loop[i] + 1] - oy);
  path.closePath();
}
