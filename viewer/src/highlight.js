// SPDX-License-Identifier: MIT
// What is pointed at: a slice or a contour as broad lines, a point as a dot; over everything else,
// unless it is told to be hidden by what is nearer.
import { Group, Mesh, MeshBasicMaterial, SphereGeometry } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { segmentsOf } from './lines.js';

export class Highlight {
  #lines;
  #dot;

  constructor(scene, width, { isHidden = false } = {}) {
    const over = { depthTest: isHidden, depthWrite: false, transparent: true };
    const broad = new LineMaterial({ linewidth: width, ...over });
    this.#lines = new LineSegments2(new LineSegmentsGeometry(), broad);
    this.#dot = new Mesh(new SphereGeometry(1, 24, 16), new MeshBasicMaterial(over));
    const group = new Group();
    for (const object of [this.#lines, this.#dot]) {
      object.renderOrder = 10;
      object.frustumCulled = false;
      object.visible = false;
      group.add(object);
    }
    scene.add(group);
  }

  set colour(colour) {
    this.#lines.material.color.set(colour);
    this.#dot.material.color.set(colour);
  }

  showSlice(slice, frame) {
    const numbers = slice ? segmentsOf(slice, frame) : [];
    this.#lines.visible = numbers.length > 0;
    if (numbers.length === 0) return;
    this.#lines.geometry.dispose();
    this.#lines.geometry = new LineSegmentsGeometry().setPositions(numbers);
  }

  showPoint(place, stage) {
    this.#dot.visible = place !== undefined;
    if (place) this.#dot.position.copy(place);
    this.keepSize(stage);
  }

  // The dot is five pixels in radius wherever it is.
  keepSize(stage) {
    if (this.#dot.visible) this.#dot.scale.setScalar(5 * stage.unitsPerPixel(this.#dot.position));
  }
}
