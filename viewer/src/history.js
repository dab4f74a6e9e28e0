// SPDX-License-Identifier: MIT
// The edits of a capture, the last one first, and the way back and forth between them.
import { List } from './list.js';
import { ask, change } from './requests.js';
import { count, exact } from './text.js';

const element = (id) => document.getElementById(id);
const often = 500;  // ms between two looks at the history while edits come

export class History {
  #list;
  #timer;
  #isThere = true;  // until the server says that it has none
  #unit = '';
  #name;  // of the file
  #isKept = false;  // it is a session

  constructor() {
    this.#list = new List(element('history'), (row, edit) => this.#draw(row, edit),
                          (edit) => this.#choose(edit));
    for (const way of ['undo', 'redo']) element(way).addEventListener('click', () => this[way]());
    element('history-section').addEventListener('toggle', () => this.look());
  }

  undo() { return this.#go('undo'); }
  redo() { return this.#go('redo'); }

  // Another surface: in a capture there are `edits`.
  reset({ edits, name, kind }, unit) {
    this.#unit = unit;
    this.#name = name;
    this.#isKept = kind === 'session';
    element('history-then').textContent = '';
    this.#isThere = edits !== undefined;
    element('history-section').hidden = true;
    this.look();
  }

  // What the server says of itself: whether a capture is kept in a session.
  showStatus({ session }) {
    this.#isKept ||= session === true;
  }

  // Edits were made: has a look at the history soon, however many come.
  wear() {
    this.#timer ??= setTimeout(() => this.look(), often);
  }

  async look() {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    if (!this.#isThere) return;
    const history = await ask('history').catch(() => null);
    if (history === undefined) this.#isThere = false;
    if (history) this.#show(history);
  }

  #show({ edits, can_undo: canUndo, can_redo: canRedo }) {
    element('history-section').hidden = false;
    element('undo').disabled = !canUndo;
    element('redo').disabled = !canRedo;
    element('history-count').textContent = count(edits.length);
    this.#list.show([...edits].reverse());
  }

  async #go(way) {
    if (element('history-section').hidden || element(way).disabled) return;
    element('history-said').textContent = await change(way).catch(() => 'No connection.') ?? '';
    this.look();
  }

  #draw(row, { number, op, z, is_undone: isUndone }) {
    const words = `${count(number)} ${op}${z === undefined || z === null ? '' : ` z ${exact(z)} ${this.#unit}`}`;
    row.classList.toggle('undone', isUndone);
    row.setAttribute('aria-label', `${words}${isUndone ? ', undone' : ''}`);
    if (row.textContent !== words) row.textContent = words;
  }

  // How to look at the surface as it was after that edit.
  #choose({ number }) {
    if (this.#isKept && this.#name)
      element('history-then').textContent = `What there was then: loft view ${this.#name} --at ${number}`;
  }
}
