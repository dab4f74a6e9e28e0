// SPDX-License-Identifier: MIT
// On a narrow page the scene comes first: figures and controls are in a drawer, which the bar below
// the scene opens.

const element = (id) => document.getElementById(id);

export class Drawer {
  constructor() {
    element('drawer').addEventListener('click', () => this.#set(!this.#isOpen));
    element('side').addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.#isOpen) return;
      event.stopPropagation();  // what was clicked stays
      this.#close();
    });
  }

  // What was picked, on the bar.
  showPicked(label) {
    element('drawer-picked').textContent = label ?? '';
  }

  get #isOpen() { return document.body.dataset.drawer === 'open'; }

  #set(isOpen) {
    document.body.dataset.drawer = isOpen ? 'open' : 'closed';
    element('drawer').setAttribute('aria-expanded', String(isOpen));
  }

  #close() {
    const wasWithin = element('side').contains(document.activeElement);
    this.#set(false);
    if (wasWithin) element('drawer').focus();
  }
}
