// SPDX-License-Identifier: MIT
// Shapes in a tree of operations; its result, or that of an expression.

import { Border } from './border.js';
import { button, counted, make, section } from './make.js';
import { Things } from './things.js';
import { Tab, box, disc } from './tab.js';

const mostRows = 400;
const signs = { unite: '∪', intersect: '∩', subtract: '−', exclude: '⊕' };
const one = [1, 0, 0, 1];

// Linear maps as [xx, xy, yx, yy].
const turned = (angle) => [Math.cos(angle), -Math.sin(angle), Math.sin(angle), Math.cos(angle)];
const times = (a, b) => [a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3],
                         a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3]];
const apply = (m, [x, y]) => [m[0] * x + m[1] * y, m[2] * x + m[3] * y];
const inverse = ([a, b, c, d]) => {
  const size = a * d - b * c;
  return [d / size, -b / size, -c / size, a / size];
};

export class Shapes extends Tab {
  #nodes = new Map();
  #result = new Border();
  #kind = 'disc';
  #held;  // the node that is being dragged, as the program has it

  constructor(page) { super(page, 'shapes', 'Shapes', new Things(true)); }

  // --- What the program says ---

  reset(state) {
    this.#nodes.clear();
    for (const node of state.nodes) this.#addNode(node);
    this.root = state.root;
    for (const node of state.nodes) if (node.rings) this.#addShape(node);
    this.#takeResult(state);
    this.#showTree();
  }

  change(change) {
    for (const node of change.shapes ?? []) {
      this.#addNode(node);
      this.#addShape(node);
    }
    for (const id of change.removed ?? []) {
      this.#nodes.delete(id);
      this.removeThing(id);
    }
    for (const node of change.nodes ?? []) {
      if (node.id === this.#held?.id) this.#held = node;
      else this.#takeNode(node);
    }
    this.#takeResult(change);
    if (change.shapes || change.removed || change.expression !== undefined) this.#showTree();
  }

  #takeNode(node) {
    Object.assign(this.#nodes.get(node.id), node);
    this.#placeBelow(node.id);
  }
  #addNode(node) {
    const { rings, ...rest } = node;
    this.#nodes.set(node.id, rest);
  }
  #addShape({ id, rings }) {
    const { at, map } = this.#place(id);
    this.addThing({ id, rings, at, map });
  }
  #takeResult(content) {
    if (content.result) {
      const changed = this.#result.take(content.result, this.board.origin);
      if (changed) this.board.invalidate(changed);
    }
    if (content.expression === undefined || !this.field) return;
    if (document.activeElement !== this.field) this.field.value = content.expression;
    this.field.classList.toggle('typed', content.is_typed);
    this.back.hidden = !content.is_typed;
    this.expression = content;
  }

  // Where a node lies in the plane.
  #place(id) {
    let at = [0, 0];
    let map = one;
    for (let node = this.#nodes.get(id); node; node = this.#nodes.get(node.parent)) {
      const own = turned(node.angle);
      at = apply(own, at).map((value, i) => value + node.at[i]);
      map = times(own, map);
    }
    return { at, map };
  }
  #placeBelow(id) {
    for (const shape of this.#shapesBelow(id)) {
      const { at, map } = this.#place(shape);
      this.placeThing(shape, at, map);
    }
  }
  #isBelow(id, above) {
    for (let at = id; at !== undefined && at !== null; at = this.#nodes.get(at)?.parent) if (at === above) return true;
    return false;
  }
  #shapesBelow(id) { return this.things.ids.filter((shape) => this.#isBelow(shape, id)); }

  // --- What is done ---

  has(id) { return this.#nodes.has(id); }
  nameOf(id) { return this.#nodes.get(id)?.name ?? ''; }

  // A shape, or the chosen operation that it belongs to.
  find(p, near) {
    const id = super.find(p, near);
    const chosen = this.#nodes.get(this.chosen);
    return id !== undefined && chosen?.operation && this.chosen !== this.root && this.#isBelow(id, this.chosen)
      ? this.chosen : id;
  }

  grab(p, near) {
    const id = this.find(p, near);
    if (id === undefined) return undefined;
    this.choose(id);
    const begin = this.#nodes.get(id).at;
    let sent = Promise.resolve(0);
    this.#held = { ...this.#nodes.get(id) };
    return {
      move: ([x, y]) => { sent = this.#moveNode(id, begin, [x - p[0], y - p[1]]); },
      end: async () => {
        const event = await sent;
        const held = this.#held;
        this.#held = undefined;
        if (event === undefined && this.has(id)) this.#takeNode(held);  // it was refused
      },
    };
  }

  // By a vector of the plane, from where the node was.
  #moveNode(id, begin, by) {
    const node = this.#nodes.get(id);
    const above = node.parent === null || node.parent === undefined ? one : this.#place(node.parent).map;
    const [dx, dy] = apply(inverse(above), by);
    node.at = [begin[0] + dx, begin[1] + dy];
    this.#placeBelow(id);
    return this.page.send({ do: 'move', id, at: node.at }, `move ${id}`);
  }
  moveBy(id, by) { this.#moveNode(id, this.#nodes.get(id).at, by); }

  turn(by) {
    const node = this.#nodes.get(this.chosen);
    if (node) this.page.send({ do: 'set', name: 'angle', id: this.chosen, value: node.angle + by }, `turn ${this.chosen}`);
  }

  insert(p) {
    const size = this.size();
    const chosen = this.#nodes.get(this.chosen);
    const parent = chosen?.operation ? this.chosen : chosen?.parent ?? this.root;
    const { at, map } = this.#place(parent);
    const points = this.#kind === 'disc' ? disc(p, size) : box(p, 1.4 * size, 0.8 * size);
    const back = inverse(map);
    this.page.send({ do: 'insert', id: parent, name: this.#kind,
      points: points.map(([x, y]) => apply(back, [x - at[0], y - at[1]])) });
  }

  get keys() {
    return { '[': () => this.turn(Math.PI / 36), ']': () => this.turn(-Math.PI / 36) };
  }

  // --- Picture ---

  draw(board) {
    const { pen } = board;
    const loops = this.#result.loops.filter(({ box: one }) => board.isSeen(one));
    board.enterPlane();
    for (const { path, area } of loops) {
      pen.fillStyle = board.colour(area > 0 ? 'result' : 'stage');
      pen.fill(path);
    }
    board.setThinLine('outline');
    for (const thing of this.things.seen(board)) pen.stroke(this.things.enter(board, thing));
    // Two of a pixel each.
    board.setThinLine('result-edge');
    for (const [dx, dy] of [[0, 0], [0.6, 0.6]]) {
      board.enterPlane([0, 0], dx, dy);
      for (const { path } of loops) pen.stroke(path);
    }
  }

  drawFront(board) {
    if (this.chosen === undefined) return;
    board.pen.strokeStyle = board.colour('accent');
    board.pen.lineWidth = board.px(2);
    for (const id of this.#shapesBelow(this.chosen))
      board.pen.stroke(this.things.enter(board, this.things.get(id)));
  }

  hover(p, near) { return this.nameOf(super.find(p, near)); }

  // --- Panel ---

  show(panel) {
    this.area = make('output', { className: 'big' }, '–');
    this.field = make('textarea', { id: 'expression', rows: 3, spellcheck: false, 'aria-label': 'Expression',
      onkeydown: (event) => {
        if (event.key === 'Enter' && !event.shiftKey) {
          event.preventDefault();
          this.#sendExpression(this.field.value);
        }
        event.stopPropagation();
      } });
    this.back = button('Back to the tree', 'Shows what the tree says', () => this.#sendExpression(''));
    this.back.hidden = true;
    this.tree = make('ul', { id: 'tree', role: 'tree', 'aria-label': 'Operations and shapes' });
    const kinds = ['disc', 'box'].map((kind) => button(`+ ${kind}`, `A ${kind} in the chosen operation`, () => {
      this.#kind = kind;
      this.insert(this.board.view.middle);
    }));
    const sign = (text, title, act) => button(text, title, act);
    panel.replaceChildren(
      section('Area of the result, rounded once', this.area),
      section('Expression', this.field, make('p', { className: 'hint' },
        'Enter shows it: a | b, a & b, a - b, a ^ b, ~a, at_least(2, a, b, c)'), this.back),
      section('Tree', this.tree),
      section('New and chosen', make('p', { className: 'buttons' }, ...kinds,
        sign('⟲', 'Turn it ([)', () => this.turn(Math.PI / 36)),
        sign('⟳', 'Turn it (])', () => this.turn(-Math.PI / 36)),
        sign('Remove', 'Take it away (Del)', () => this.remove()))));
    this.#showTree();
    if (this.expression) this.#takeResult({ expression: this.expression.expression, is_typed: this.expression.is_typed });
    this.showFigures();
  }

  showFigures() { this.area.textContent = String(this.#result.area); }

  #sendExpression(text) {
    this.field.blur();
    this.page.send({ do: 'set', name: 'expression', text });
  }

  #showTree() {
    if (!this.tree) return;
    const below = new Map();
    for (const node of this.#nodes.values()) {
      const parent = node.parent ?? 0;
      below.set(parent, [...(below.get(parent) ?? []), node]);
    }
    let left = mostRows;
    const row = (node) => {
      if (left-- <= 0) return [];
      const item = make('li', { role: 'treeitem', 'aria-selected': 'false' }, this.#row(node));
      item.dataset.id = node.id;
      const children = (below.get(node.id) ?? []).flatMap(row);
      if (children.length > 0) item.append(make('ul', { role: 'group' }, ...children));
      return [item];
    };
    this.tree.replaceChildren(...(this.#nodes.has(this.root) ? row(this.#nodes.get(this.root)) : []));
    if (left < 0) this.tree.append(make('li', { className: 'hint' }, `and ${counted(-left)} more`));
    this.showChosen();
  }

  #row(node) {
    const name = make('button', { type: 'button', className: 'name', onclick: () => this.choose(node.id) }, node.name);
    if (!node.operation) return make('div', { className: 'row' }, name);
    const choice = make('select', { 'aria-label': `Operation of ${node.name}`, title: 'Operation',
      onchange: () => this.page.send({ do: 'set', name: 'operation', id: node.id, text: choice.value }) });
    for (const [word, text] of Object.entries(signs))
      choice.append(make('option', { value: word, selected: word === node.operation }, `${text} ${word}`));
    return make('div', { className: 'row' }, name, choice);
  }

  showChosen() {
    for (const item of this.tree?.querySelectorAll('li[role]') ?? [])
      item.setAttribute('aria-selected', String(Number(item.dataset.id) === this.chosen));
  }
}
