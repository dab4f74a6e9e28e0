// SPDX-License-Identifier: MIT
// The cut in the picture: what goes is clipped, what is cut is filled, and where the plane is a
// slice's its contours are drawn.
import { Box3, DoubleSide, FrontSide, Vector3 } from 'three';
import { Caps } from './caps.js';
import { directionToInput, planesOf, toScene } from './cut.js';
import { axes } from './cut_controls.js';
import { CutHandle } from './cut_handle.js';
import { Highlight } from './highlight.js';

// Of the box: so much of what is kept goes, too, that flat parts in the very plane do, all of them
// rather than some of their pixels.
const margin = 1e-5;

export class CutView {
  #stage;
  #caps;
  #handle;
  #contours;
  #ask;
  #materials;
  #controls;
  #frame;
  #box = new Box3();
  #planes = [];
  #slice;  // whose contours are shown; null where they are to be shown anew
  #volumes = new Map();

  // `materials`: { surfaces, lines } that the cut goes through; ask(z) resolves to the contours of
  // a slice.
  constructor(stage, materials, ask) {
    this.#stage = stage;
    this.#materials = materials;
    this.#ask = ask;
    this.#caps = new Caps(stage);
    this.#handle = new CutHandle(stage);
    this.#contours = new Highlight(stage.scene, 1.5, { isHidden: true });
    this.#handle.addEventListener('shift', ({ detail }) => this.#controls.shift(this.#frame.length(detail)));
    this.#handle.addEventListener('turn', ({ detail: { direction, pivot } }) =>
      this.#controls.turnAway(directionToInput(direction), this.#frame.toInput(pivot)));
  }

  // The plane that is filled, as the eye sees it; undefined where there is none.
  get cap() { return this.#planes.find((plane) => this.#stage.isBehind(plane)); }
  // Of the labels that close, by label; undefined instead of a volume for those that do not.
  get volumes() { return this.#volumes; }

  set colour(accent) { this.#handle.colour = accent; }
  set lineColour(colour) { this.#contours.colour = colour; }

  control(controls) {
    this.#controls = controls;
    controls.addEventListener('change', () => this.apply());
  }

  // All slabs in the picture: see Caps.assign().
  fill(pieces, box, frame) {
    this.#box = box;
    this.#frame = frame;
    this.#volumes = this.#caps.assign(pieces);
    this.#showInsides();
    this.#slice = null;  // it may have changed
    if (!frame || box.isEmpty()) return;
    const ends = [box.min, box.max].map((corner) => frame.toInput(corner));
    const bounds = [Math.min, Math.max].map((pick) => ends[0].map((value, i) => pick(value, ends[1][i])));
    this.#controls.setBox(bounds);
    this.apply();
  }

  apply() {
    const cut = this.#frame && !this.#box.isEmpty() ? this.#controls.cut : undefined;
    const inset = margin * this.#box.getSize(new Vector3()).length();
    const exact = cut ? planesOf(cut).map((plane) => toScene(plane, this.#frame)) : [];
    this.#planes = exact.map((plane) => plane.clone());
    for (const plane of this.#planes) plane.constant -= inset;
    for (const plane of exact) plane.constant += inset;
    this.#stage.setCut(this.#planes, exact);
    this.#stage.clip(this.#materials.surfaces, this.#materials.lines);
    this.#handle.show(this.#planes[0], this.#box);
    this.#showContours(cut?.slice);
    this.#stage.invalidate();
  }

  // Their slice, or what is shown of it, has changed.
  renewContours() {
    this.#slice = null;
    this.apply();
  }

  // Cuts across one of the input's axes; what is on the eye's side goes.
  cutAcross(axis) {
    const normal = axes[axis];
    const toEye = directionToInput(this.#stage.toEye(this.#box.getCenter(new Vector3())));
    const isTowardsEye = normal.reduce((sum, value, i) => sum + value * toEye[i], 0) > 0;
    this.#controls.turnAway(isTowardsEye ? normal : normal.map((value) => 0 - value));
  }

  // Turns the plane so that it is seen from the front.
  faceEye() {
    const { camera } = this.#stage;
    if (this.#frame) this.#controls.turnAway(directionToInput(camera.getWorldDirection(new Vector3()).negate()));
  }

  // Ahead of a frame.
  prepare() {
    this.#handle.keepSize();
    const { camera } = this.#stage;
    const size = 4 * this.#box.getSize(new Vector3()).length();
    this.#caps.draw(this.cap, this.#box.getCenter(new Vector3()), size, camera);
  }

  // Where all labels close, and cuts are filled, nothing is to be seen from inside: at outlines
  // bits of it would show through.
  #showInsides() {
    const side = [...this.#volumes.values()].includes(undefined) ? DoubleSide : FrontSide;
    for (const material of this.#materials.surfaces) {
      if (material.side === side) continue;
      material.side = side;
      material.needsUpdate = true;
    }
  }

  async #showContours(z) {
    if (z === this.#slice) return;
    this.#slice = z;
    const slice = z === undefined ? undefined : await this.#ask(z);
    if (z !== this.#slice) return;
    this.#contours.showSlice(slice, this.#frame);
    this.#stage.invalidate();
  }
}
