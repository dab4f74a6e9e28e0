// SPDX-License-Identifier: MIT
// What is measured between places that were clicked: kept in the input's coordinates, so that it
// stays right however the scene is scaled.
import { number } from './text.js';

export const kinds = {
  distance: { places: 2, name: 'Distance' },
  section: { places: 2, name: 'Along the surface' },
  angle: { places: 3, name: 'Angle' },
};

const minus = (a, b) => a.map((value, i) => value - b[i]);

export function distanceOf([a, b]) { return Math.hypot(...minus(a, b)); }

// At the second of three places, in degrees.
export function angleOf([a, b, c]) {
  const [u, v] = [minus(a, b), minus(c, b)];
  const cross = [0, 1, 2].map((i) => u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
  const along = u.reduce((sum, value, i) => sum + value * v[i], 0);
  return (Math.atan2(Math.hypot(...cross), along) * 180) / Math.PI;
}

export class Measures extends EventTarget {
  #list = [];
  #places = [];  // clicked for the next one
  #kind = 'distance';

  // All that there are: { kind, places, line (places to be drawn), value, text }.
  get list() { return this.#list; }
  get places() { return this.#places.map(({ place }) => place); }
  get kind() { return this.#kind; }
  set kind(kind) {
    this.#kind = kind;
    this.drop();
  }

  // A place that was clicked (`hit`: { place, label, ... }). `along(hits)` gives the places of the
  // way between two along the surface, or undefined. Returns false where nothing can be measured.
  add(hit, unit, along) {
    this.#places.push(hit);
    if (this.#places.length < kinds[this.#kind].places) return this.#tell(true);
    const hits = this.#places;
    this.#places = [];
    const measure = this.#measure(hits, unit, along);
    if (measure) this.#list = [...this.#list, measure];
    return this.#tell(measure !== undefined);
  }

  remove(measure = this.#list.at(-1)) {
    this.#list = this.#list.filter((other) => other !== measure);
    this.#tell();
  }

  // Forgets what was clicked for the next one.
  drop() {
    this.#places = [];
    this.#tell();
  }

  #measure(hits, unit, along) {
    const places = hits.map(({ place }) => place);
    const kind = this.#kind;
    if (kind === 'angle') {
      const value = angleOf(places);
      return { kind, places, line: places, value, text: `${value.toFixed(1)}°` };
    }
    const line = kind === 'section' ? along(hits) : places;
    if (!line) return undefined;
    const value = line.slice(1).reduce((sum, place, i) => sum + distanceOf([line[i], place]), 0);
    return { kind, places, line, value, text: `${number(value)} ${unit}` };
  }

  #tell(result) {
    this.dispatchEvent(new Event('change'));
    return result;
  }
}
