// SPDX-License-Identifier: MIT
// Renderer, camera, light; a frame is drawn only when something has changed.
import { Color, DirectionalLight, DoubleSide, HemisphereLight, MeshStandardMaterial,
         PerspectiveCamera, Plane, Scene, Sphere, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

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

  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true,
                                        powerPreference: 'high-performance' });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.01, 1000);
    this.camera.position.set(6, 5, 9);
    this.material = new MeshStandardMaterial({ roughness: 0.62, metalness: 0, side: DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    this.material.onBeforeCompile = showInside;
    this.cut = new Plane(new Vector3(0, -1, 0), 0);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !isStill.matches;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.invalidate());
    this.#light();
    canvas.addEventListener('webglcontextrestored', () => this.invalidate());
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement);
    this.#resize();
  }

  // after() is called when the canvas has another size.
  onResize(after) { this.#afterResize = after; }
  // before() is called ahead of each frame.
  onFrame(before) { this.#beforeFrame.push(before); }

  invalidate() {
    if (this.#isStale) return;
    this.#isStale = true;
    requestAnimationFrame(() => this.#draw());
  }

  set background(colour) {
    this.scene.background = new Color(colour);
    this.invalidate();
  }

  // Cuts away what lies on the far side of the plane.
  setCut(materials, isOn) {
    this.renderer.localClippingEnabled = isOn;
    for (const material of materials) material.clippingPlanes = isOn ? [this.cut] : null;
    this.invalidate();
  }

  // Whether the cut leaves a place.
  keeps(place) {
    return !this.renderer.localClippingEnabled || this.cut.distanceToPoint(place) >= 0;
  }

  // Looks at all of a box, from where it looks now.
  fit(box) {
    if (box.isEmpty()) return;
    const sphere = box.getBoundingSphere(new Sphere());
    const narrow = Math.min(1, this.camera.aspect);
    const distance = (1.12 * sphere.radius) / Math.sin((this.camera.fov * Math.PI) / 360) / narrow;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance);
    this.setRange(box);
    this.controls.update();
    this.invalidate();
  }

  // Near and far for all of a box, from anywhere.
  setRange(box) {
    if (box.isEmpty()) return;
    const size = box.getSize(new Vector3()).length();
    this.camera.near = size / 500;
    this.camera.far = 40 * size;
    this.controls.minDistance = size / 200;
    this.controls.maxDistance = 20 * size;
    this.camera.updateProjectionMatrix();
  }

  #light() {
    this.scene.add(new HemisphereLight(0xffffff, 0x8d8a86, 1.7));
    const key = new DirectionalLight(0xfffaf0, 1.9);
    key.position.set(-0.7, 1.1, 1);
    const rim = new DirectionalLight(0xe8f0ff, 0.5);
    rim.position.set(1, -0.2, -0.6);
    this.camera.add(key, key.target, rim, rim.target);  // the light goes with the eye
    this.scene.add(this.camera);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.#afterResize();
    this.invalidate();
  }

  #draw() {
    this.#isStale = false;
    this.controls.update();
    for (const before of this.#beforeFrame) before();
    this.renderer.render(this.scene, this.camera);
  }
}
