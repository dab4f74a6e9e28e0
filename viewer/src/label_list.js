// SPDX-License-Identifier: MIT
// The labels on the page: the list with its search, and what can be done with the chosen one.
import { List } from './list.js';
import { count } from './text.js';

const element = (id) => document.getElementById(id);
const nameOf = (name) => name || 'no label';

// An eye, a swatch and a name; filled anew for each label that the row is for.
function parts(row) {
  if (row.childElementCount === 0) {
    row.append(element('label-row').content.cloneNode(true));
  }
  return row.children;
}

export class LabelList {
  #labels;
  #list;

  constructor(labels) {
    this.#labels = labels;
    this.#list = new List(element('labels'), (row, label) => this.#draw(row, label),
                          ({ name }) => labels.choose(name));
    labels.addEventListener('list', () => this.#show());
    labels.addEventListener('look', () => this.#showLook());
    labels.addEventListener('choice', () => this.#showChoice());
    element('label-search').addEventListener('input', () => this.#show());
    element('label-search').addEventListener('keydown', (event) => this.#leaveSearch(event));
    this.#connect();
    this.#show();
  }

  search() {
    if (element('labels-section').hidden) return;
    element('label-search').focus();
    element('label-search').select();
  }

  // Hides or isolates the chosen label.
  toggleChosen() {
    this.#do((name) => {
      this.#labels.toggle(name);
      this.#say(`${nameOf(name)}: ${this.#labels.isShown(name) ? 'shown' : 'hidden'}`);
    });
  }
  isolateChosen() {
    this.#do((name) => {
      this.#labels.isolate(name);
      this.#say(this.#labels.isIsolated(name) ? `${nameOf(name)} alone` : 'As before');
    });
  }

  #connect() {
    element('labels').addEventListener('click', ({ target }) => {
      const label = target.closest('.eye') && this.#list.itemOf(target);
      if (label) this.#labels.toggle(label.name);
    });
    element('labels').addEventListener('keydown', (event) => {
      if (event.key !== ' ') return;
      event.preventDefault();
      this.toggleChosen();
    });
    element('label-colour').addEventListener('input', ({ target }) =>
      this.#do((name) => this.#labels.setColour(name, target.value)));
    element('label-opacity').addEventListener('input', ({ target }) =>
      this.#do((name) => this.#labels.setOpacity(name, target.value / 100)));
    element('label-hide').addEventListener('click', () => this.toggleChosen());
    element('label-isolate').addEventListener('click', () => this.isolateChosen());
    element('label-restore').addEventListener('click', () => this.#do((name) => this.#labels.restore(name)));
    element('labels-all').addEventListener('click', () => this.#labels.showAll());
  }

  #do(action) {
    if (this.#labels.chosen !== undefined) action(this.#labels.chosen);
  }

  // For those who do not see it.
  #say(words) {
    element('announcement').textContent = words;
  }

  // From the search into what was found.
  #leaveSearch(event) {
    if (event.key === 'Escape' && event.target.value) event.stopPropagation();  // it empties the field
    if (event.key !== 'ArrowDown' && event.key !== 'Enter') return;
    event.preventDefault();
    event.stopPropagation();
    const [first] = this.#found;
    if (!first) return;
    element('labels').focus();
    if (!this.#found.some(({ name }) => name === this.#labels.chosen)) this.#labels.choose(first.name);
  }

  get #found() { return this.#labels.list(element('label-search').value); }

  #show() {
    const all = this.#labels.list();
    const isNothingToTell = all.length === 0 || (all.length === 1 && all[0].name === '');
    element('labels-section').hidden = isNothingToTell;
    const found = this.#found;
    element('labels-count').textContent =
      found.length < all.length ? `${count(found.length)} of ${count(all.length)}` : count(all.length);
    element('labels-none').hidden = found.length > 0;
    this.#list.show(found);
    this.#showChoice();
  }

  #showChoice() {
    const { chosen } = this.#labels;
    this.#list.mark(this.#found.findIndex(({ name }) => name === chosen));
    element('label-tools').disabled = chosen === undefined;
    element('label-name').textContent = chosen === undefined ? 'None chosen' : nameOf(chosen);
    this.#showTools();
  }

  #showLook() {
    this.#list.refresh();
    this.#showTools();
  }

  #showTools() {
    const { chosen } = this.#labels;
    element('labels-all').hidden = !this.#labels.isAnyHidden;
    element('label-restore').hidden = !this.#labels.isChanged(chosen);
    element('label-hide-word').textContent = this.#labels.isShown(chosen) ? 'Hide' : 'Show';
    element('label-isolate').setAttribute('aria-pressed', String(this.#labels.isIsolated(chosen)));
    const percent = Math.round(100 * this.#labels.opacity(chosen));
    element('label-colour').value = this.#labels.colour(chosen) ?? '#99a8b8';
    element('label-opacity').value = percent;
    element('label-opacity').setAttribute('aria-valuetext', `${percent} %`);
    element('label-percent').textContent = `${percent} %`;
  }

  #draw(row, { name }) {
    const [eye, swatch, words] = parts(row);
    const isShown = this.#labels.isShown(name);
    row.classList.toggle('off', !isShown);
    row.setAttribute('aria-label', `${nameOf(name)}${isShown ? '' : ', hidden'}`);
    eye.title = isShown ? 'Hide' : 'Show';
    swatch.style.backgroundColor = this.#labels.colour(name) ?? '';
    swatch.style.opacity = Math.max(this.#labels.opacity(name), 0.25);
    if (words.textContent === nameOf(name)) return;
    words.textContent = nameOf(name);
    words.title = nameOf(name);
  }
}
