// SPDX-License-Identifier: MIT
// What lies under a place of the screen.
import { DoubleSide, Raycaster, Vector2, Vector3 } from 'three';

// All that a ray meets, whichever side of a surface it is.
function meet(raycaster, meshes) {
  const sides = meshes.map(({ material }) => material.side);
  for (const { material } of meshes) material.side = DoubleSide;
  const hits = raycaster.intersectObjects(meshes, false);
  for (const [i, { material }] of meshes.entries()) material.side = sides[i];
  return hits;
}

// The hits whose labels contain a place at that distance: the ray leaves them more often beyond it
// than it enters them.
function around(hits, distance, ray, labelOf) {
  const counts = new Map();
  for (const hit of hits) {
    if (hit.distance <= distance) continue;
    const label = labelOf(hit);
    const { sum, first } = counts.get(label) ?? { sum: 0, first: hit };
    counts.set(label, { sum: sum + Math.sign(hit.face.normal.dot(ray.direction)), first });
  }
  return counts;
}

// The nearest place that is not cut away: of a surface, or of the cut where it is filled. `x` and
// `y` from -1 to 1; `volumes` of the labels that close and are filled, by label; `labelOf` says
// whose a hit is.
export function hitAt(stage, meshes, [x, y], { cap, volumes, labelOf }) {
  const raycaster = new Raycaster();
  raycaster.setFromCamera(new Vector2(x, y), stage.camera);
  const hits = meet(raycaster, meshes);
  const hit = hits.find(({ point }) => stage.keeps(point));
  const place = cap && raycaster.ray.intersectPlane(cap, new Vector3());
  if (!place) return hit;
  const distance = raycaster.ray.origin.distanceTo(place);
  if (hit && hit.distance < distance) return hit;
  const filled = [...around(hits, distance, raycaster.ray, labelOf)]
    .filter(([label, { sum }]) => volumes.get(label) !== undefined && sum !== 0)
    .sort(([a], [b]) => Math.abs(volumes.get(a)) - Math.abs(volumes.get(b)));
  return filled.length > 0 ? { ...filled[0][1].first, point: place, isOfCut: true } : hit;
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
