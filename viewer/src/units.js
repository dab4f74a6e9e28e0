// SPDX-License-Identifier: MIT
// Volumes and areas in what people use for things of that size.

// From micrographs to landscapes: the unit by the size of the input's unit in metres.
function measureOf(metresPerUnit) {
  if (metresPerUnit <= 1e-5) return { name: 'µm', metres: 1e-6 };
  if (metresPerUnit <= 0.05) return { name: 'cm', metres: 0.01 };
  return { name: 'm', metres: 1 };
}

export class Measure {
  #factor;

  constructor(metresPerUnit = 0.001) {
    const { name, metres } = measureOf(metresPerUnit);
    this.name = name;
    this.#factor = metresPerUnit / metres;
  }

  // Without letters that not every program reads.
  get plain() { return this.name.replace('µ', 'u'); }
  get volumeUnit() { return `${this.name}³`; }
  get areaUnit() { return `${this.name}²`; }
  volume(value) { return value * this.#factor ** 3; }
  area(value) { return value * this.#factor ** 2; }
}
