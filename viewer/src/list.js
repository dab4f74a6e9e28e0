// SPDX-License-Identifier: MIT
// A list to choose from, of any length: only the rows that are seen are in the page. Arrows, Home,
// End and Page Up and Down choose while it has the focus.

const more = 4;  // rows above and below those that are seen

const steps = { ArrowDown: () => 1, ArrowUp: () => -1, PageDown: (page) => page,
                PageUp: (page) => -page, Home: () => -Infinity, End: () => Infinity };

export class List {
  #element;
  #room;
  #draw;
  #choose;
  #items = [];
  #chosen = -1;
  #rows = [];
  #isStale = false;
  #height = 1;  // of a row
  #page = 1;    // rows that are seen

  // `element` is an empty listbox; draw(row, item) fills a row; choose(item) is called where an item
  // is chosen here.
  constructor(element, draw, choose) {
    this.#element = element;
    this.#draw = draw;
    this.#choose = choose;
    this.#room = element.appendChild(document.createElement('div'));
    this.#room.setAttribute('role', 'presentation');
    element.addEventListener('scroll', () => this.refresh());
    element.addEventListener('keydown', (event) => this.#step(event));
    element.addEventListener('click', ({ target }) => this.#click(target));
    new ResizeObserver(() => this.refresh()).observe(element);
  }

  show(items) {
    this.#items = items;
    this.refresh();
  }

  // Marks an item as chosen, and scrolls to it; -1: none.
  mark(index) {
    const isOther = index !== this.#chosen;
    this.#chosen = index;
    if (isOther && index >= 0) this.#reveal(index);
    this.refresh();
  }

  // The item of a row, or of anything in it.
  itemOf(target) {
    return this.#items[target.closest('[role="option"]')?.dataset.index];
  }

  // Draws its rows anew, ahead of the next frame.
  refresh() {
    if (this.#isStale) return;
    this.#isStale = true;
    requestAnimationFrame(() => this.#refresh());
  }

  #refresh() {
    this.#isStale = false;
    this.#measure();
    const first = Math.max(0, Math.floor(this.#element.scrollTop / this.#height) - more);
    const last = Math.min(this.#items.length, first + this.#page + 2 * more);
    while (this.#rows.length < last - first) this.#rows.push(this.#makeRow());
    for (const [i, row] of this.#rows.entries()) this.#place(row, first + i, first + i < last);
    const isThere = this.#chosen >= first && this.#chosen < last;
    if (isThere) this.#element.setAttribute('aria-activedescendant', this.#rows[this.#chosen - first].id);
    else this.#element.removeAttribute('aria-activedescendant');
  }

  #measure() {
    this.#height = Number.parseFloat(getComputedStyle(this.#element).getPropertyValue('--row'));
    this.#room.style.height = `${this.#items.length * this.#height}px`;
    this.#page = Math.ceil(this.#element.clientHeight / this.#height);
  }

  #makeRow() {
    const row = this.#room.appendChild(document.createElement('div'));
    row.setAttribute('role', 'option');
    row.id = `${this.#element.id}-${this.#rows.length}`;
    return row;
  }

  #place(row, index, isUsed) {
    row.hidden = !isUsed;
    if (!isUsed) return;
    row.dataset.index = index;
    row.style.transform = `translateY(${index * this.#height}px)`;
    row.setAttribute('aria-selected', String(index === this.#chosen));
    row.setAttribute('aria-posinset', index + 1);
    row.setAttribute('aria-setsize', this.#items.length);
    this.#draw(row, this.#items[index]);
  }

  #step(event) {
    const step = steps[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey || this.#items.length === 0) return;
    event.preventDefault();
    event.stopPropagation();  // the arrows turn the surface elsewhere
    const index = this.#chosen + step(Math.max(this.#page - 1, 1));
    this.#take(Math.min(Math.max(index, 0), this.#items.length - 1));
  }

  #click(target) {
    const item = this.itemOf(target);
    if (item !== undefined) this.#take(this.#items.indexOf(item));
  }

  #take(index) {
    this.mark(index);
    this.#choose(this.#items[index]);
  }

  #reveal(index) {
    this.#measure();
    const top = index * this.#height;
    const bottom = top + this.#height;
    const { scrollTop, clientHeight } = this.#element;
    if (clientHeight === 0 || (top >= scrollTop && bottom <= scrollTop + clientHeight)) return;
    const isNear = bottom > scrollTop - 2 * this.#height && top < scrollTop + clientHeight + 2 * this.#height;
    if (!isNear) this.#element.scrollTop = top - (clientHeight - this.#height) / 2;
    else this.#element.scrollTop = top < scrollTop ? top : bottom - clientHeight;
  }
}
