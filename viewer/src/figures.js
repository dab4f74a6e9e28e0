// SPDX-License-Identifier: MIT
// The server's figures of the labels: asked for when they are needed, and again after an edit.
import { ask } from './requests.js';
import { Measure } from './units.js';

const quiet = 1000;  // ms without an edit until they are asked for again

// Nothing stays nothing: contours alone have no volume.
const measured = (value, measure) => (Number.isFinite(value) ? measure(value) : undefined);

export class Figures extends EventTarget {
  #timer;
  #answer;  // a promise of the list, or undefined where the server has none
  measure = new Measure();

  // Another surface, in another unit.
  reset({ metres_per_unit: metresPerUnit }) {
    this.measure = new Measure(metresPerUnit);
    this.#answer = undefined;
    this.list();
  }

  // They are no longer right.
  wear() {
    this.#answer = undefined;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.list(), quiet);
  }

  // { label, colour, is_skin, slices, volume, area, faces } of each label, volume and area in the
  // measure, or undefined; undefined where the server has none. Dispatches `known` with those of a new answer.
  list() {
    this.#answer ??= this.#fetch();
    return this.#answer;
  }

  async of(label) {
    return (await this.list())?.find((figures) => figures.label === label);
  }

  async #fetch() {
    const { measure } = this;
    const answer = await ask('labels').catch(() => undefined);
    const list = answer?.labels.map((figures) => ({ ...figures, volume: measured(figures.volume, (volume) => measure.volume(volume)),
                                                    area: measured(figures.area, (area) => measure.area(area)) }));
    this.dispatchEvent(new CustomEvent('known', { detail: list }));
    return list;
  }
}
