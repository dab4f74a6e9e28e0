// SPDX-License-Identifier: MIT
// The section of the panel for measures: whether clicks measure, what, and what has been measured.
import { kinds } from './measures.js';

const hints = {
  distance: ['Click two places.', 'Click the second place.'],
  section: ['Click two places of one label: the way along it, in the plane of your view through both.',
            'Click the second place.'],
  angle: ['Click three places; the angle is at the second.', 'Click the place of the angle.',
          'Click the third place.'],
};

function element(id) {
  return document.getElementById(id);
}

export class MeasureControls {
  #measures;

  constructor(measures) {
    this.#measures = measures;
    element('measure-on').addEventListener('change', () => this.#turn());
    element('measure-kind').addEventListener('change', () => {
      this.#measures.kind = element('measure-kind').value;
      this.#reach();
    });
    measures.addEventListener('change', () => this.#show());
    this.#show();
  }

  get isOn() { return element('measure-on').checked; }

  toggle() {
    element('measure-on').checked = !this.isOn;
    this.#turn();
  }

  nextKind() {
    const select = element('measure-kind');
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    this.#measures.kind = select.value;
    this.#reach();
  }

  say(words) { element('measure-hint').textContent = words; }

  #reach() {
    element('measure-on').checked = true;
    this.#turn();
  }

  #turn() {
    this.#measures.drop();
  }

  #show() {
    const { kind, list, places } = this.#measures;
    this.say(this.isOn ? hints[kind][places.length] : '');
    element('canvas').classList.toggle('measures', this.isOn);
    element('measures').replaceChildren(...list.map((measure) => this.#row(measure)));
  }

  #row(measure) {
    const row = document.createElement('li');
    row.append(`${kinds[measure.kind].name} `);
    row.appendChild(document.createElement('strong')).textContent = measure.text;
    const button = row.appendChild(document.createElement('button'));
    button.type = 'button';
    button.textContent = '×';
    button.setAttribute('aria-label', `Remove: ${kinds[measure.kind].name} ${measure.text}`);
    button.addEventListener('click', () => this.#measures.remove(measure));
    return row;
  }
}
