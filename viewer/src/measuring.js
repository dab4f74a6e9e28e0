// SPDX-License-Identifier: MIT
// Measures between places of the picture: clicks become places, measures become lines and figures.
import { Vector3 } from 'three';
import { MeasureControls } from './measure_controls.js';
import { MeasureLines } from './measure_lines.js';
import { Measures } from './measures.js';
import { wayAlong } from './section.js';

export class Measuring {
  #view;
  #measures = new Measures();
  #controls = new MeasureControls(this.#measures);
  #lines;
  #frame;  // that the lines are drawn in

  // `figures`: the element that the figures are put into.
  constructor(view, figures) {
    this.#view = view;
    this.#lines = new MeasureLines(view.stage.scene, figures);
    this.#measures.addEventListener('change', () => this.#draw());
    view.stage.onFrame(() => this.#follow());
  }

  set colour(colour) { this.#lines.colour = colour; }
  get isOn() { return this.#controls.isOn; }

  toggle() { this.#controls.toggle(); }
  nextKind() { this.#controls.nextKind(); }
  removeLast() { this.#measures.remove(); }
  drop() { this.#measures.drop(); }

  // Takes what lies under a place of the screen (-1 to 1).
  add(x, y) {
    const hit = this.#view.hitAt(x, y);
    if (!hit) return this.#controls.say('Nothing is there.');
    if (this.#measures.add(hit, this.#view.unit, (hits) => this.#along(hits))) return;
    this.#controls.say('No line along one surface leads from the first place to the second.');
  }

  // In the plane through two places that holds the view direction.
  #along([from, to]) {
    if (from.slab.label !== to.slab.label) return undefined;
    const { stage, frame } = this.#view;
    const toEye = stage.toEye(from.point.clone().lerp(to.point, 0.5));
    const normal = to.point.clone().sub(from.point).cross(toEye).normalize();
    if (normal.lengthSq() < 0.5) return undefined;  // one place is behind the other
    const plane = { normal: normal.toArray(), offset: normal.dot(from.point) };
    const triangles = this.#view.trianglesOf(from.slab.label);
    const way = wayAlong(triangles, plane, from.point.toArray(), to.point.toArray());
    return way?.points.map((point) => frame.toInput(new Vector3(...point)));
  }

  #draw() {
    this.#frame = this.#view.frame;
    if (!this.#frame) return this.#lines.show([], []);
    const toScene = (place) => this.#frame.toScene(...place);
    const measures = this.#measures.list.map((measure) =>
      ({ ...measure, line: measure.line.map(toScene), places: measure.places.map(toScene) }));
    this.#lines.show(measures, this.#measures.places.map(toScene));
    this.#view.stage.invalidate();
  }

  #follow() {
    if (this.#frame !== this.#view.frame) this.#draw();
    this.#lines.follow(this.#view.stage);
  }
}
