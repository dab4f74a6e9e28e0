// SPDX-License-Identifier: MIT
// Measures in the picture: a line, dots at its places, and the figure beside it.
import { Group, Mesh, MeshBasicMaterial, SphereGeometry } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

const over = { depthTest: false, depthWrite: false, transparent: true };
const radius = 3.5;  // pixels

// The place half along a line.
function middleOf(points) {
  const lengths = points.slice(1).map((point, i) => point.distanceTo(points[i]));
  let rest = lengths.reduce((sum, length) => sum + length, 0) / 2;
  const i = lengths.findIndex((length) => (rest -= length) <= 0);
  if (i < 0) return points[0].clone();
  return points[i + 1].clone().lerp(points[i], lengths[i] > 0 ? -rest / lengths[i] : 0);
}

export class MeasureLines {
  #group = new Group();
  #lines = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 2, ...over }));
  #dot = new SphereGeometry(1, 16, 12);
  #material = new MeshBasicMaterial(over);
  #list;
  #figures = [];  // { element, place }

  // Figures become children of `list`.
  constructor(scene, list) {
    this.#list = list;
    this.#lines.renderOrder = 12;
    this.#lines.frustumCulled = false;
    scene.add(this.#lines, this.#group);
    this.show([], []);
  }

  set colour(colour) {
    this.#material.color.set(colour);
    this.#lines.material.color.set(colour);
  }

  // `measures`: { text, line, places } with places of the scene; `places`: more of them.
  show(measures, places) {
    const segments = measures.flatMap(({ line }) =>
      line.slice(1).flatMap((point, i) => [...line[i].toArray(), ...point.toArray()]));
    this.#lines.visible = segments.length > 0;
    if (segments.length > 0) {
      this.#lines.geometry.dispose();
      this.#lines.geometry = new LineSegmentsGeometry().setPositions(segments);
    }
    this.#group.clear();
    for (const place of [...measures.flatMap((measure) => measure.places), ...places]) {
      const dot = new Mesh(this.#dot, this.#material);
      dot.position.copy(place);
      dot.renderOrder = 12;
      this.#group.add(dot);
    }
    this.#figures = measures.map(({ text, line, places: [, corner], kind }) => {
      const element = document.createElement('span');
      element.textContent = text;
      return { element, place: kind === 'angle' ? corner : middleOf(line) };
    });
    this.#list.replaceChildren(...this.#figures.map(({ element }) => element));
  }

  // Ahead of a frame.
  follow(stage) {
    for (const dot of this.#group.children) dot.scale.setScalar(radius * stage.unitsPerPixel(dot.position));
    for (const { element, place } of this.#figures) {
      const [x, y] = stage.toPixels(place);
      element.style.left = `${x}px`;
      element.style.top = `${y - 16}px`;
    }
  }
}
