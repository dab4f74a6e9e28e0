// SPDX-License-Identifier: MIT
// What lies under a place of the screen.
import { Raycaster, Vector2 } from 'three';

// The nearest place of the mesh that is not cut away; `x` and `y` from -1 to 1.
export function hitAt(stage, mesh, x, y) {
  const raycaster = new Raycaster();
  raycaster.setFromCamera(new Vector2(x, y), stage.camera);
  return raycaster.intersectObject(mesh).find(({ point }) => stage.keeps(point));
}

// The contour point nearest to a place in the input's coordinates; contours with that label first.
export function nearestPoint(slices, [x, y, z], label) {
  let best;
  for (const slice of slices) {
    for (const [contour, points] of slice.contours.entries()) {
      const isOther = (slice.labels?.[contour] ?? '') !== label;
      for (const [point, [px, py]] of points.entries()) {
        const distance = Math.hypot(px - x, py - y, slice.z - z);
        const isWorse = best && (best.isOther === isOther ? best.distance <= distance : isOther);
        if (!isWorse) best = { slice, contour, point, distance, isOther };
      }
    }
  }
  return best;
}

// Calls back, with -1 to 1 in both directions, for clicks that are not the end of a drag.
export function onClick(canvas, call) {
  let start;
  canvas.addEventListener('pointerdown', (event) => {
    const isAlone = event.isPrimary && event.button === 0;  // no second finger
    start = isAlone ? [event.clientX, event.clientY] : undefined;
  });
  canvas.addEventListener('pointercancel', () => { start = undefined; });
  canvas.addEventListener('pointerup', ({ clientX, clientY }) => {
    if (!start || Math.hypot(clientX - start[0], clientY - start[1]) > 4) return;
    const { left, top, width, height } = canvas.getBoundingClientRect();
    call((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
  });
}
