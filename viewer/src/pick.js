// SPDX-License-Identifier: MIT
// What lies under a place of the screen.
import { Raycaster, Vector2 } from 'three';

export function hitAt(stage, mesh, clientX, clientY) {
  const box = stage.canvas.getBoundingClientRect();
  const place = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
  const raycaster = new Raycaster();
  raycaster.setFromCamera(place, stage.camera);
  const isCut = (point) => stage.renderer.localClippingEnabled && stage.cut.distanceToPoint(point) < 0;
  return raycaster.intersectObject(mesh).find((hit) => !isCut(hit.point));
}

// Calls back for clicks that are not the end of a drag.
export function onClick(canvas, call) {
  let start;
  canvas.addEventListener('pointerdown', (event) => {
    start = event.button === 0 ? [event.clientX, event.clientY] : undefined;
  });
  canvas.addEventListener('pointerup', (event) => {
    if (!start || Math.hypot(event.clientX - start[0], event.clientY - start[1]) > 4) return;
    call(event.clientX, event.clientY);
  });
}
