// SPDX-License-Identifier: MIT
// What tabs have in common: things that are dragged, chosen, taken away. What the pointer moves is drawn
// where the pointer has it, until the program has said so, too.

import { Board } from './board.js';
import { Things } from './things.js';

export class Tab {
  #known = new Map();     // places as the program has said
  #pending = new Map();   // things that are on their way: the number of the edit
  #settling = new Map();  // those whose last edit is done: its event
  #serial = 0;

  // `page`: board, link, say(words), panel.
  constructor(page, name, title, things = new Things()) {
    this.page = page;
    this.name = name;
    this.title = title;
    this.things = things;
    this.view = Board.view();
    this.last = '';  // the last event that is known
    this.event = 0;
    this.hasBegun = false;
    this.chosen = undefined;
  }

  get board() { return this.page.board; }

  // --- What the program says ---

  take(kind, content, event) {
    if (kind === 'reset') {
      this.things.clear();
      this.#known.clear();
      this.#settling.clear();
      const isFirst = !this.hasBegun;
      if (isFirst && content.box) this.board.setBox(content.box);
      this.hasBegun = true;
      this.reset(content);
      this.board.invalidate();
      if (isFirst) this.page.showPanel();
      if (this.chosen !== undefined && !this.has(this.chosen)) this.choose(undefined);
    } else {
      this.change(content);
    }
    this.event = event;
    for (const [id, done] of this.#settling) if (done <= event) this.#settle(id);
    this.showFigures(content);
  }

  addThing(thing) {
    this.#known.set(thing.id, { at: thing.at, map: thing.map });
    this.things.add(thing);
    this.board.invalidate(this.things.boxOf(thing));
  }
  removeThing(id) {
    this.#known.delete(id);
    if (this.things.has(id)) this.board.invalidate(this.things.boxOf(this.things.get(id)));
    this.things.remove(id);
    if (this.chosen === id) this.choose(undefined);
  }
  // Where a thing is now; `map` as in things.js.
  placeThing(id, at, map) {
    this.#known.set(id, { at, map });
    if (!this.#pending.has(id)) this.#show(id, at, map);
  }
  // Draws what was there and what is there.
  #show(id, at, map) {
    const thing = this.things.get(id);
    if (!thing) return;
    this.board.invalidate(this.things.boxOf(thing));
    this.things.place(id, at, map);
    this.board.invalidate(this.things.boxOf(thing));
  }

  // --- What is done with things ---

  has(id) { return this.things.has(id); }

  find(p, near) { return this.things.find(p, near)?.id; }

  // A drag that begins at a place: { move(p), end() }; nothing where there is no thing.
  grab(p, near) {
    const id = this.find(p, near);
    if (id === undefined) return undefined;
    this.choose(id);
    const begin = this.things.get(id).at;
    return {
      move: ([x, y]) => this.move(id, [begin[0] + x - p[0], begin[1] + y - p[1]]),
      end: () => {},
    };
  }

  move(id, at) {
    const number = ++this.#serial;
    this.#pending.set(id, number);
    this.#settling.delete(id);
    this.#show(id, at);
    this.page.send({ do: 'move', id, at }, `move ${id}`).then((event) => {
      if (this.#pending.get(id) !== number) return;
      if (event === undefined || event <= this.event) this.#settle(id);
      else this.#settling.set(id, event);
    });
  }

  #settle(id) {
    this.#settling.delete(id);
    this.#pending.delete(id);
    const known = this.#known.get(id);
    if (known) this.#show(id, known.at, known.map);
  }

  moveBy(id, [dx, dy]) {
    const { at } = this.things.get(id);
    this.move(id, [at[0] + dx, at[1] + dy]);
  }

  choose(id) {
    this.chosen = id;
    this.showChosen();
    this.board.invalidateFront();
  }

  // The next thing, or the one before.
  chooseNext(step) {
    const ids = this.choices();
    if (ids.length === 0) return;
    const at = ids.indexOf(this.chosen);
    this.choose(ids[at < 0 ? 0 : (at + step + ids.length) % ids.length]);
    this.page.say(this.nameOf(this.chosen));
  }
  choices() { return this.things.ids; }
  nameOf(id) { return String(id); }

  remove() {
    if (this.chosen !== undefined) this.page.send({ do: 'remove', id: this.chosen });
  }
  insert(p) { this.page.send({ do: 'insert', points: this.somethingNew(p) }); }

  // A size that looks right in the picture.
  size() { return this.board.px(Math.min(this.board.width, this.board.height) / 16); }

  // --- For tabs to say ---
  get shownEvent() { return this.event; }  // the last one that is in the picture
  reset() {}
  change() {}
  draw() {}          // the ground
  drawFront() {}     // what is before it; true where it is to be drawn again in the next frame
  showFigures() {}
  showChosen() {}
  hover() {}         // of a place, or nothing; words
  show() {}          // fills the panel
}

// Corners around a place.
export function disc([x, y], radius, corners = 48) {
  return Array.from({ length: corners }, (_, i) => {
    const angle = 2 * Math.PI * i / corners;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}
export function box([x, y], width, height) {
  return [[x - width, y - height], [x + width, y - height], [x + width, y + height], [x - width, y + height]];
}
