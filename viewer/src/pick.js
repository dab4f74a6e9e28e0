// SPDX-License-Identifier: MIT
// What is under the cursor: the slab, and the contour point nearest to the place.
import { Raycaster, Vector2 } from 'three';

const raycaster = new Raycaster();

// The nearest contour point of some slices to a place in the input's coordinates, among the contours
// with a label if there are any.
export function nearestPoint(slices, [x, y, z], label) {
  let best;
  for (const slice of slices) {
    for (const [contour, points] of slice.contours.entries()) {
      const isOther = (slice.labels?.[contour] ?? '') !== label;
      for (const [point, [px, py]] of points.entries()) {
        const distance = Math.hypot(px - x, py - y, slice.z - z);
        const isFarther = best && (best.isOther === isOther ? best.distance <= distance : isOther);
        if (!isFarther) best = { slice, contour, point, distance, isOther };
      }
    }
  }
  return best;
}

export class Picker {
  #stage;
  #surface;
  #contours;

  constructor(stage, surface, contours) {
    this.#stage = stage;
    this.#surface = surface;
    this.#contours = contours;
  }

  // `x`, `y` in pixels of the canvas. The slab, the place in the input's coordinates, and once its
  // slices have come the nearest point; undefined where there is nothing.
  async pick(x, y) {
    const { clientWidth, clientHeight } = this.#stage.canvas;
    const place = new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
    raycaster.setFromCamera(place, this.#stage.camera);
    const hit = this.#surface.pick(raycaster, (point) => this.#stage.isKept(point));
    if (!hit?.slab) return undefined;
    const at = this.#surface.frame.toInput(hit.place);
    const { low, high, label } = hit.slab;
    const slices = await Promise.all([...new Set([low, high])].map((z) => this.#contours.ask(z)));
    const nearest = nearestPoint(slices.filter(Boolean), at, label);
    return { slab: hit.slab, at, place: hit.place, nearest };
  }
}
