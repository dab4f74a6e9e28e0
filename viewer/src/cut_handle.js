// SPDX-License-Identifier: MIT
// What a cut is dragged by: an arrow towards the side that goes moves it, the ball at its end turns
// it. Both are the same size on the screen wherever they are; the outline of the plane goes along.
import { BufferGeometry, ConeGeometry, CylinderGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
         LineLoop, Mesh, MeshBasicMaterial, Raycaster, Sphere, SphereGeometry, Vector2,
         Vector3 } from 'three';
import { handleLayer } from './scene.js';

const reach = { cone: 54, ball: 84 };  // pixels from the plane
const grip = { mouse: 14, pen: 14, touch: 26 };  // pixels around them
const mostCorners = 6;                 // where a plane meets a box
const up = new Vector3(0, 1, 0);

// Where a plane meets the edges of a box, in order around it.
export function sectionOf({ min, max }, { normal, constant }) {
  const corner = (i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
  const places = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4].filter((one) => !(i & one))) {
      const [a, b] = [corner(i), corner(i | bit)];
      const [from, to] = [a, b].map((place) => normal.dot(place) + constant);
      if (from < 0 !== to < 0) places.push(a.lerp(b, from / (from - to)));
    }
  }
  const middle = places.reduce((sum, place) => sum.add(place), new Vector3()).divideScalar(places.length || 1);
  const across = (places[0] ?? middle).clone().sub(middle).normalize();
  const along = normal.clone().cross(across);
  const angle = (place) => Math.atan2(place.clone().sub(middle).dot(along), place.clone().sub(middle).dot(across));
  return places.sort((a, b) => angle(a) - angle(b));
}

export class CutHandle extends EventTarget {
  #stage;
  #group = new Group();
  #outline = new LineLoop(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.7 }));
  #material = new MeshBasicMaterial({ depthTest: false, depthWrite: false, transparent: true, opacity: 0.9 });
  #middle = new Vector3();
  #normal = new Vector3(0, 1, 0);  // towards the side that goes
  #scale = 1;                      // of a pixel, where it is
  #drag;                           // { part, pointer, ... } while there is one

  // Dispatches `shift` (detail: a distance in the scene) and `turn` (detail: { direction, pivot }).
  constructor(stage) {
    super();
    this.#stage = stage;
    const shaft = new Mesh(new CylinderGeometry(1.2, 1.2, reach.ball, 12).translate(0, reach.ball / 2, 0), this.#material);
    const cone = new Mesh(new ConeGeometry(7, 18, 24).translate(0, reach.cone, 0), this.#material);
    const ball = new Mesh(new SphereGeometry(7, 24, 16).translate(0, reach.ball, 0), this.#material);
    for (const part of [shaft, cone, ball]) {
      part.renderOrder = 11;
      part.layers.set(handleLayer);
      part.frustumCulled = false;
      this.#group.add(part);
    }
    const room = new Float32BufferAttribute(new Float32Array(3 * mostCorners), 3);
    this.#outline.geometry.setAttribute('position', room);
    this.#outline.frustumCulled = false;
    this.#outline.layers.set(handleLayer);
    this.#group.visible = this.#outline.visible = false;
    stage.scene.add(this.#group, this.#outline);
    this.#listen(stage.canvas);
  }

  set colour(colour) {
    this.#material.color.set(colour);
    this.#outline.material.color.set(colour);
  }

  // The plane (three.js's: its positive side is kept) within a box; without it nothing is shown.
  show(plane, box) {
    this.#group.visible = this.#outline.visible = plane !== undefined && !box.isEmpty();
    if (!this.#group.visible) return;
    const places = sectionOf(box, plane);
    const { geometry } = this.#outline;
    const position = geometry.getAttribute('position');
    for (const [i, { x, y, z }] of places.entries()) position.setXYZ(i, x, y, z);
    position.needsUpdate = true;
    geometry.setDrawRange(0, places.length);
    plane.projectPoint(this.#drag?.pivot ?? box.getCenter(new Vector3()), this.#middle);
    this.#normal.copy(plane.normal).negate();
    this.#group.position.copy(this.#middle);
    this.#group.quaternion.setFromUnitVectors(up, this.#normal);
  }

  // Ahead of a frame.
  keepSize() {
    if (!this.#group.visible) return;
    this.#scale = this.#stage.unitsPerPixel(this.#middle);
    this.#group.scale.setScalar(this.#scale);
  }

  #listen(canvas) {
    const options = { capture: true };  // ahead of what turns the scene
    canvas.addEventListener('pointerdown', (event) => this.#begin(event), options);
    canvas.addEventListener('pointermove', (event) => this.#move(event), options);
    for (const kind of ['pointerup', 'pointercancel'])
      canvas.addEventListener(kind, (event) => this.#end(event), options);
  }

  #begin(event) {
    const part = event.isPrimary && event.button === 0 ? this.#partAt(event) : undefined;
    if (!part) return;
    event.stopImmediatePropagation();
    this.#stage.canvas.setPointerCapture(event.pointerId);
    this.#stage.canvas.focus();
    this.#drag = { part, pointer: event.pointerId, along: this.#along(event),
                   pivot: this.#middle.clone(), isNear: this.#facesEye() };
  }

  #move(event) {
    if (this.#drag?.pointer !== event.pointerId) return this.#hover(event);
    event.stopImmediatePropagation();
    if (this.#drag.part === 'cone') {
      const distance = this.#along(event) - this.#drag.along;
      if (distance) this.dispatchEvent(new CustomEvent('shift', { detail: distance }));
    } else {
      const detail = { direction: this.#directionAt(event), pivot: this.#drag.pivot };
      this.dispatchEvent(new CustomEvent('turn', { detail }));
    }
  }

  #end(event) {
    if (this.#drag?.pointer !== event.pointerId) return;
    event.stopImmediatePropagation();
    this.#drag = undefined;
  }

  #hover(event) {
    if (event.buttons === 0) this.#stage.canvas.style.cursor = this.#partAt(event) ? 'grab' : '';
  }

  #partAt(event) {
    if (!this.#group.visible) return undefined;
    const { left, top } = this.#stage.canvas.getBoundingClientRect();
    const distance = (part) => {
      const [x, y] = this.#stage.toPixels(this.#at(reach[part]));
      return Math.hypot(event.clientX - left - x, event.clientY - top - y);
    };
    const parts = ['ball', 'cone'].filter((part) => distance(part) <= (grip[event.pointerType] ?? grip.mouse));
    return parts.sort((a, b) => distance(a) - distance(b))[0];
  }

  // A place on the arrow, so many pixels from the plane.
  #at(pixels) {
    return this.#middle.clone().addScaledVector(this.#normal, pixels * this.#scale);
  }

  #rayOf(event) {
    const { left, top, width, height } = this.#stage.canvas.getBoundingClientRect();
    const raycaster = new Raycaster();
    raycaster.setFromCamera(new Vector2((2 * (event.clientX - left)) / width - 1,
                                        1 - (2 * (event.clientY - top)) / height), this.#stage.camera);
    return raycaster.ray;
  }

  // How far along the arrow, from the plane, the pointer is.
  #along(event) {
    const { origin, direction } = this.#rayOf(event);
    const across = direction.dot(this.#normal);
    const square = 1 - across * across;
    if (square < 1e-3) return this.#drag?.along ?? 0;  // it points at the eye
    const way = this.#middle.clone().sub(origin);
    return (across * direction.dot(way) - this.#normal.dot(way)) / square;
  }

  #facesEye() {
    return this.#stage.toEye(this.#middle).dot(this.#normal) >= 0;
  }

  // From the middle to where the pointer is on the sphere that the ball moves on.
  #directionAt(event) {
    const ray = this.#rayOf(event);
    const sphere = new Sphere(this.#middle, reach.ball * this.#scale);
    const place = ray.closestPointToPoint(this.#middle, new Vector3());
    const depth = Math.sqrt(Math.max(sphere.radius ** 2 - place.distanceToSquared(this.#middle), 0));
    place.addScaledVector(ray.direction, this.#drag.isNear ? -depth : depth);
    return place.sub(this.#middle).normalize();
  }
}
