// SPDX-License-Identifier: MIT
// Dark or light: as the system has it, until it is chosen here.

const preference = matchMedia('(prefers-color-scheme: dark)');

export class Theme extends EventTarget {
  #chosen;

  constructor() {
    super();
    preference.addEventListener('change', () => this.#apply());
    this.#apply();
  }

  get isDark() { return this.#chosen ?? preference.matches; }

  toggle() {
    this.#chosen = !this.isDark;
    this.#apply();
  }

  // A colour of the style sheet, as CSS has it.
  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  }

  #apply() {
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
    this.dispatchEvent(new Event('change'));
  }
}
