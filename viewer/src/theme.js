// SPDX-License-Identifier: MIT
// Dark or light: as the system has it, until it is chosen here; that is remembered.

const preference = matchMedia('(prefers-color-scheme: dark)');
const key = 'loft-theme';

// A browser may keep nothing, and says so by an exception.
function remembered() {
  try {
    return localStorage.getItem(key) ?? undefined;
  } catch {
    return undefined;
  }
}

function remember(theme) {
  try {
    localStorage.setItem(key, theme);
  } catch {
    // It lasts as long as the page.
  }
}

export class Theme extends EventTarget {
  #chosen = remembered();

  constructor() {
    super();
    preference.addEventListener('change', () => this.#apply());
    this.#apply();
  }

  get isDark() { return this.#chosen ? this.#chosen === 'dark' : preference.matches; }

  toggle() {
    this.#chosen = this.isDark ? 'light' : 'dark';
    remember(this.#chosen);
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
