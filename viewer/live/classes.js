// SPDX-License-Identifier: MIT
// Points in the classes that separators make: a colour a class, lighter or darker by value.

import { button, counted, make, section } from './make.js';
import { TabWithLines } from './lines.js';

const hues = [212, 28, 152, 330, 92, 268, 52, 186];
const shades = 5;

export class Classes extends TabWithLines {
  #faces = [];
  #values = [0, 1];
  #changed = 0;

  constructor(page) { super(page, 'classes', 'Classes'); }

  // --- What the program says ---

  reset(state) {
    this.#values = state.points.reduce(([low, high], point) => [Math.min(low, point[3]), Math.max(high, point[3])],
                                       [Infinity, -Infinity]);
    this.#takeAll(state);
    this.#changed = 0;
  }
  change(change) { this.#takeAll(change); }

  #takeAll({ points = [], separators = [], faces, removed = [] }) {
    for (const [id, x, y, value, name] of points) {
      const known = this.things.get(id);
      if (!known) this.addThing({ id, at: [x, y], value, name, isSpot: true });
      else {
        known.name = name;
        this.placeThing(id, [x, y]);
      }
    }
    for (const line of separators) this.takeLine(line);
    for (const id of removed) this.removeThing(id);
    this.#changed = points.length;
    if (!faces) return;
    this.#faces = faces.map((face) => ({ name: face.class, path: this.#pathOf(face.rings) }));
    this.board.invalidate();
  }

  #pathOf(rings) {
    const [ox, oy] = this.board.origin;
    const path = new Path2D();
    for (const ring of rings) {
      for (let i = 0; i < ring.length; i += 2) {
        if (i === 0) path.moveTo(ring[0] - ox, ring[1] - oy);
        else path.lineTo(ring[i] - ox, ring[i + 1] - oy);
      }
      path.closePath();
    }
    return path;
  }

  // The same for each class: + is 1, all else 0, of each separator.
  #hue(name) {
    let number = 0;
    for (const sign of name) number = 2 * number + (sign === '+' ? 1 : 0);
    return hues[number % hues.length];
  }

  // --- What is done ---

  nameOf(id) {
    const thing = this.things.get(id);
    return thing?.isLine ? 'separator' : `point in ${thing?.name}`;
  }
  insert(p) {
    const value = (this.#values[0] + this.#values[1]) / 2;
    this.page.send({ do: 'insert', points: [p], value: Number.isFinite(value) ? value : 0 });
  }
  #insertLine() {
    const [x, y] = this.board.view.middle;
    const size = 3 * this.size();
    this.page.send({ do: 'insert', name: 'separator', points: [[x - size, y - size], [x, y], [x + size, y + size / 2]] });
  }

  // --- Picture ---

  draw(board) {
    const { pen } = board;
    board.enterPlane();
    for (const { name, path } of this.#faces) {
      pen.fillStyle = `hsl(${this.#hue(name)} ${board.colour('class-face')})`;
      pen.fill(path, 'evenodd');
    }
    this.#drawPoints(board);
    board.enterPlane();
    board.setThinLine('quiet');
    for (const { path } of this.#faces) pen.stroke(path);
    for (const line of this.things.values()) {
      if (!line.isLine) continue;
      this.drawLine(board, line, 'text', 2.5);
      this.drawHandles(board, line, 'text');
    }
  }

  #drawPoints(board) {
    const { pen } = board;
    const paths = new Map();
    const [low, high] = this.#values;
    const radius = this.things.size > 4000 ? 1.5 : 2.6;
    board.enterPage();
    for (const { at, name, value, isSpot } of this.things.seen(board)) {
      if (!isSpot) continue;
      const shade = high > low ? Math.min(shades - 1, Math.floor(shades * (value - low) / (high - low))) : 2;
      const key = `${this.#hue(name)} ${shade}`;
      if (!paths.has(key)) paths.set(key, new Path2D());
      const [x, y] = board.toPage(at);
      paths.get(key).moveTo(x + radius, y);
      paths.get(key).arc(x, y, radius, 0, 2 * Math.PI);
    }
    for (const [key, path] of paths) {
      const [hue, shade] = key.split(' ').map(Number);
      pen.fillStyle = `hsl(${hue} ${board.colour('class-saturation')} ${board.isDark() ? 42 + 9 * shade : 66 - 10 * shade}%)`;
      pen.fill(path);
    }
  }

  hover(p, near) {
    const id = this.find(p, near);
    return id === undefined ? '' : this.nameOf(id);
  }

  // --- Panel ---

  show(panel) {
    this.total = make('output', { className: 'big', id: 'changed' }, '–');
    this.list = make('ul', { className: 'list', id: 'classes' });
    panel.replaceChildren(
      section('Points that changed class in the last edit', this.total),
      section('Classes: + left of a separator, − right', this.list),
      section('New and chosen', make('p', { className: 'buttons' },
        button('+ point', 'In the middle (I)', () => this.insert(this.board.view.middle)),
        button('+ separator', 'Through the middle', () => this.#insertLine()),
        button('Remove', 'Take it away (Del)', () => this.remove()))));
    this.showFigures();
  }

  showFigures() {
    if (!this.list) return;
    this.total.textContent = counted(this.#changed);
    const counts = new Map();
    for (const { name, isSpot } of this.things.values()) if (isSpot) counts.set(name, (counts.get(name) ?? 0) + 1);
    const rows = [...counts].sort(([a], [b]) => (a < b ? -1 : 1)).map(([name, count]) => {
      const swatch = make('span', { className: 'swatch' });
      swatch.style.background = `hsl(${this.#hue(name)} 55% 52%)`;
      return make('li', {}, swatch, make('span', { className: 'sign' }, name.replaceAll('-', '−')),
                  make('span', { className: 'value' }, counted(count)));
    });
    this.list.replaceChildren(...rows);
  }
}
