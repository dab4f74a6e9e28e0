// SPDX-License-Identifier: MIT
// Views along the axes of the input.
import { directionToScene } from './cut.js';

// From where each is looked along, as a drawing has it: x from its far end, y from its near end
// (x goes right then, z up), z from above.
const sides = { x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1] };

export function lookAlong(stage, axis, isFromOtherSide = false) {
  const sign = isFromOtherSide ? -1 : 1;
  stage.lookFrom(directionToScene(sides[axis].map((value) => sign * value)));
}
