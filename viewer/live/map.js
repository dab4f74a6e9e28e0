// SPDX-License-Identifier: MIT
// Areas that should belong to one owner each: where several claim a place, and what nobody does.

import { Border } from './border.js';
import { button, counted, figures, make, section, short } from './make.js';
import { Tab, disc } from './tab.js';

const golden = 137.508;  // degrees from hue to hue
const rest = 250;        // ms without a change until faults are asked for

export class Atlas extends Tab {
  #land = new Border();
  #overlaps = new Border();
  #faultTimer;

  constructor(page) { super(page, 'map', 'Map'); }

  // --- What the program says ---

  reset(state) {
    for (const part of state.parts) this.addThing(part);
    this.#takeResults(state);
  }
  change(change) {
    for (const part of change.parts ?? []) this.addThing(part);
    for (const id of change.removed ?? []) this.removeThing(id);
    for (const { id, at } of change.moved ?? []) this.placeThing(id, at);
    this.#takeResults(change);
  }
  #takeResults({ land, overlaps }) {
    const changed = [this.#land.take(land, this.board.origin), this.#overlaps.take(overlaps, this.board.origin)];
    for (const box of changed) if (box) this.board.invalidate(box);
    clearTimeout(this.#faultTimer);
    this.#faultTimer = setTimeout(() => this.#showFaults(), rest);
  }

  nameOf(id) { return this.things.get(id)?.name ?? ''; }

  insert(p) {
    this.page.send({ do: 'insert', name: `new ${counted(this.things.size)}`, points: disc(p, this.size(), 40) });
  }

  // --- Picture ---

  draw(board) {
    const { pen } = board;
    const gaps = this.#land.gaps.filter(({ box }) => board.isSeen(box));
    const overlaps = this.#overlaps.loops.filter(({ box }) => board.isSeen(box));
    board.enterPlane();
    pen.fillStyle = board.colour('gap');
    for (const { path } of gaps) pen.fill(path);
    const parts = [...this.things.seen(board)];
    for (const part of parts) {
      pen.fillStyle = this.#colour(board, part.owner);
      pen.fill(this.things.enter(board, part), 'evenodd');
    }
    board.setThinLine('border');
    for (const part of parts) pen.stroke(this.things.enter(board, part));
    board.enterPlane();
    this.#light(board, gaps, 'gap');
    pen.fillStyle = board.colour('overlap');
    pen.fill(joined(overlaps), 'evenodd');
    this.#light(board, overlaps, 'overlap-edge');
  }

  #light(board, loops, colour) {
    board.pen.strokeStyle = board.colour(colour);
    board.pen.lineWidth = board.px(2.5);
    for (const { path } of loops) board.pen.stroke(path);
  }

  drawFront(board) {
    const chosen = this.things.get(this.chosen);
    if (!chosen) return;
    const path = this.things.enter(board, chosen);
    board.pen.strokeStyle = board.colour('accent');
    board.pen.lineWidth = board.px(2);
    board.pen.stroke(path);
  }

  #colour(board, owner) { return `hsl(${owner * golden % 360} ${board.colour('land')})`; }

  // --- Who is where ---

  hover(p) {
    this.#ask(p);
    return this.words ?? '';
  }

  async #ask(p) {
    this.wanted = p;
    if (this.isAsking) return;
    this.isAsking = true;
    try {
      const { inside, on_border_of: border } = await this.page.link.ask(`owners?at=${p[0]},${p[1]}`);
      const words = [...inside, ...border.map((name) => `border of ${name}`)];
      this.words = words.join(' and ') || 'nobody';
    } catch {
      this.words = '';
    }
    this.isAsking = false;
    if (this.owner) this.owner.textContent = this.words || '–';
    this.page.showHover(this.words);
    if (this.wanted !== p) this.#ask(this.wanted);
  }

  // --- Panel ---

  show(panel) {
    this.owner = make('output', { className: 'big', id: 'owners' }, '–');
    const { list, values } = figures('Overlaps', 'Gaps');
    values.Overlaps.id = 'overlap-area';
    values.Gaps.id = 'gap-area';
    this.values = values;
    this.faults = make('ul', { className: 'list', id: 'faults' });
    panel.replaceChildren(
      section('Who owns what is under the pointer', this.owner),
      section('Areas', list),
      section('Overlaps and gaps', this.faults),
      section('New and chosen', make('p', { className: 'buttons' },
        button('+ island', 'In the middle (I)', () => this.insert(this.board.view.middle)),
        button('Remove', 'Take it away (Del)', () => this.remove()))));
    this.showFigures();
    if (this.hasBegun) this.#showFaults();
  }

  showFigures() {
    this.values.Overlaps.textContent = short(this.#overlaps.area, 10);
    this.values.Gaps.textContent = short(this.#land.gaps.reduce((sum, { area }) => sum - area, 0), 10);
  }

  async #showFaults() {
    if (!this.page.isShown(this)) return;
    try {
      const found = await this.page.link.ask('faults');
      const row = (kind, { owners, area, width, at }) => make('li', { className: kind },
        make('button', { type: 'button', className: 'name', title: 'Go there', onclick: () => this.#goTo(at) },
          `${owners.join(kind === 'overlap' ? ' ∩ ' : ', ')}`),
        make('span', { className: 'value' }, `${short(area)}, width ${short(width, 3)}`));
      const rows = [...found.overlaps.map((one) => row('overlap', one)), ...found.gaps.map((one) => row('gap', one))];
      this.faults.replaceChildren(...rows.slice(0, 100));
      if (rows.length === 0) this.faults.append(make('li', { className: 'hint' }, 'None: each place has one owner.'));
    } catch { /* the next change asks again */ }
  }

  #goTo(at) {
    this.board.view.middle = at;
    this.board.zoom(1);
  }
}

function joined(loops) {
  const all = new Path2D();
  for (const { path } of loops) all.addPath(path);
  return all;
}
