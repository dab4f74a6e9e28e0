// SPDX-License-Identifier: MIT
// Two cameras, perspective and parallel, of which one is in use.
import { OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';

const farAway = 10;  // of the box: a parallel eye is always outside

export class Cameras {
  #perspective = new PerspectiveCamera(35, 1, 0.01, 1000);
  #parallel = new OrthographicCamera(-1, 1, 1, -1, 0.01, 1000);
  #carried = [];
  #size = 1;    // of what there is
  #aspect = 1;

  constructor() {
    this.current = this.#perspective;
    this.current.position.set(6, 5, 9);
  }

  get all() { return [this.#perspective, this.#parallel]; }

  // What goes along with the eye.
  carry(objects) {
    this.#carried = objects;
    this.current.add(...objects);
  }

  set aspect(aspect) {
    this.#aspect = aspect;
    this.#shape();
  }

  // Of what is seen, where a place is.
  heightAt(place) {
    const { current } = this;
    if (current === this.#parallel) return (current.top - current.bottom) / current.zoom;
    const depth = place.clone().sub(current.position).dot(current.getWorldDirection(new Vector3()));
    return 2 * Math.max(depth, current.near) * this.#slope;
  }

  // All of a sphere, from where the eye is now about the target, which becomes its centre.
  fit({ center, radius }, target) {
    const direction = this.current.position.clone().sub(target).normalize();
    const narrow = Math.min(1, this.#aspect);
    const distance = (1.12 * radius) / Math.sin(Math.atan(this.#slope)) / narrow;
    target.copy(center);
    if (this.current === this.#parallel) this.#setHeight((2.24 * radius) / narrow);
    this.current.position.copy(center).addScaledVector(direction, distance);
    this.#stepBack(target);
  }

  setRange(size, controls) {
    this.#size = size;
    this.#perspective.near = size / 500;
    this.#parallel.near = size / 100;
    for (const camera of this.all) camera.far = 40 * size;
    const isParallel = this.current === this.#parallel;
    controls.minDistance = size / 200;
    controls.maxDistance = 20 * size;
    const { top, bottom } = this.#parallel;
    controls.minZoom = isParallel ? (top - bottom) / (20 * size) : 0;
    controls.maxZoom = isParallel ? (200 * (top - bottom)) / size : Infinity;
    this.#stepBack(controls.target);
    this.#shape();
  }

  // The other one looks from the same side, at what is as large at the target.
  swap(target) {
    const [old, next] = this.current === this.#perspective ? this.all : this.all.reverse();
    const height = this.heightAt(target);
    const direction = old.position.clone().sub(target).normalize();
    this.current = next;
    const isParallel = next === this.#parallel;
    next.position.copy(target).addScaledVector(direction, height / 2 / this.#slope);
    next.quaternion.copy(old.quaternion);
    if (isParallel) this.#setHeight(height);
    this.#stepBack(target);
    this.carry(this.#carried);
    this.#shape();
  }

  get #slope() { return Math.tan((this.#perspective.fov * Math.PI) / 360); }

  #setHeight(height) {
    this.#parallel.zoom = 1;
    this.#parallel.top = height / 2;
    this.#parallel.bottom = -height / 2;
  }

  #stepBack(target) {
    if (this.current !== this.#parallel) return;
    const direction = this.current.position.clone().sub(target).normalize();
    this.current.position.copy(target).addScaledVector(direction, farAway * this.#size);
  }

  #shape() {
    this.#perspective.aspect = this.#aspect;
    this.#parallel.right = this.#parallel.top * this.#aspect;
    this.#parallel.left = -this.#parallel.right;
    for (const camera of this.all) camera.updateProjectionMatrix();
  }
}
