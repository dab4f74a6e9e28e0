// SPDX-License-Identifier: MIT
// Renderer, cameras, light; a frame is drawn only when something has changed.
import { Color, DirectionalLight, DoubleSide, HemisphereLight, MeshStandardMaterial,
         Scene, Sphere, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Cameras } from './cameras.js';

export const handleLayer = 1;

const isStill = matchMedia('(prefers-reduced-motion: reduce)');

// Inside of the surface, where a cut opens it, the colour is deeper.
function showInside(shader) {
  const colour = '#include <color_fragment>';
  const inside = `#if NUM_CLIPPING_PLANES > 0
    if (!gl_FrontFacing) diffuseColor.rgb *= vec3(0.62, 0.52, 0.5);
  #endif`;
  shader.fragmentShader = shader.fragmentShader.replace(colour, `${colour}\n${inside}`);
}

export class Stage {
  #isStale = false;
  #beforeFrame = [];
  #afterResize = () => {};
  #cameras = new Cameras();
  #cuts = [];      // of surfaces
  #lineCuts = [];  // of the lines on them
  #size = 1;       // of all there is
  width = 1;       // of the canvas, in pixels of the page: asking it may cost a layout
  height = 1;

  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true,
                                        powerPreference: 'high-performance' });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.material = this.makeMaterial();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !isStill.matches;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.invalidate());
    this.#light();
    this.hasHandles = true;
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.#resize();
  }

  // Perspective or parallel.
  get camera() { return this.#cameras.current; }
  get isParallel() { return this.camera.isOrthographicCamera === true; }

  // Whether what things are dragged by is drawn: it is on a layer of its own.
  set hasHandles(areShown) {
    for (const camera of this.#cameras.all)
      camera.layers[areShown ? 'enable' : 'disable'](handleLayer);
  }

  // Of surfaces.
  makeMaterial(more = {}) {
    const material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, ...more });
    material.onBeforeCompile = showInside;
    return material;
  }

  // after() is called when the canvas has another size.
  onResize(after) { this.#afterResize = after; }
  // before() is called ahead of each frame.
  onFrame(before) { this.#beforeFrame.push(before); }

  invalidate() {
    if (this.#isStale) return;
    this.#isStale = true;
    requestAnimationFrame(() => { if (this.#isStale) this.draw(); });
  }

  draw() {
    this.#isStale = false;
    this.controls.update();
    this.camera.updateMatrixWorld();
    for (const before of this.#beforeFrame) before();
    this.renderer.render(this.scene, this.camera);
  }

  set background(colour) {
    this.scene.background = new Color(colour);
    this.invalidate();
  }

  // Cuts away what lies on the negative side of any of the planes.
  setCut(planes, linePlanes) {
    this.renderer.localClippingEnabled = planes.length > 0;
    this.#cuts = planes;
    this.#lineCuts = linePlanes;
    this.invalidate();
  }

  // Makes the cut go through materials.
  clip(surfaces, lines) {
    for (const [materials, planes] of [[surfaces, this.#cuts], [lines, this.#lineCuts]])
      for (const material of materials) material.clippingPlanes = planes.length > 0 ? planes : null;
  }

  // Whether the cut leaves a place.
  keeps(place) {
    return this.#cuts.every((plane) => plane.distanceToPoint(place) >= 0);
  }

  // Whether the eye is on the negative side of a plane.
  isBehind(plane) {
    return this.toEye(plane.coplanarPoint(new Vector3())).dot(plane.normal) < 0;
  }

  // From a place towards the eye.
  toEye(place) {
    if (this.isParallel) return this.camera.getWorldDirection(new Vector3()).negate();
    return this.camera.position.clone().sub(place);
  }

  // How long a pixel of the page is at a place.
  unitsPerPixel(place) {
    return this.#cameras.heightAt(place) / this.height;
  }

  // Where a place is on the canvas, in the page's pixels from its upper left corner.
  toPixels(place) {
    const { x, y } = place.clone().project(this.camera);
    return [((x + 1) / 2) * this.width, ((1 - y) / 2) * this.height];
  }

  // Looks at all of a box, from where it looks now.
  fit(box) {
    if (box.isEmpty()) return;
    const sphere = box.getBoundingSphere(new Sphere());
    this.#cameras.fit(sphere, this.controls.target);
    this.setRange(box);
    this.controls.update();
    this.invalidate();
  }

  // Near and far for all of a box, from anywhere.
  setRange(box) {
    if (box.isEmpty()) return;
    this.#size = box.getSize(new Vector3()).length();
    this.#cameras.setRange(this.#size, this.controls);
  }

  // Looks at the same things from a direction of the scene.
  lookFrom(direction) {
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
    this.controls.update();
    this.invalidate();
  }

  // Perspective or parallel, from the same place and, at the target, as large as before.
  toggleParallel() {
    this.#cameras.swap(this.controls.target);
    this.controls.object = this.camera;
    this.#cameras.setRange(this.#size, this.controls);
    this.controls.update();
    this.invalidate();
  }

  #light() {
    this.scene.add(new HemisphereLight(0xffffff, 0x8d8a86, 1.7));
    const key = new DirectionalLight(0xfffaf0, 1.9);
    key.position.set(-0.7, 1.1, 1);
    const rim = new DirectionalLight(0xe8f0ff, 0.5);
    rim.position.set(1, -0.2, -0.6);
    this.#cameras.carry([key, key.target, rim, rim.target]);  // the light goes with the eye
    this.scene.add(...this.#cameras.all);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    [this.width, this.height] = [clientWidth, clientHeight];
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.#cameras.aspect = clientWidth / clientHeight;
    this.#afterResize();
    this.invalidate();
  }
}
