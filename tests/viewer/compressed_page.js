// SPDX-License-Identifier: MIT
// Draws a GLB as any page with three.js does. `flat`: in the colours of its materials, without light.
import { AmbientLight, Box3, DirectionalLight, MeshBasicMaterial, PerspectiveCamera, Scene, Vector3,
         WebGLRenderer } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';

const renderer = new WebGLRenderer({ canvas: document.getElementById('canvas'), antialias: false,
  preserveDrawingBuffer: true });
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

globalThis.draw = async (base64, flat) => {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const { scene: model } = await loader.parseAsync(bytes.buffer, '');
  const scene = new Scene();
  scene.add(model, new AmbientLight(0xffffff, 1));
  const sun = new DirectionalLight(0xffffff, 2);
  sun.position.set(1, 2, 3);
  scene.add(sun);
  const kinds = [];
  model.traverse((node) => {
    if (node.material) kinds.push(`${node.type} ${node.name} ${node.material.opacity}`);
    if (node.isMesh && flat) node.material = new MeshBasicMaterial({ color: node.material.color });
  });
  const box = new Box3().setFromObject(model);
  const size = box.getSize(new Vector3()).length();
  const camera = new PerspectiveCamera(40, 1, size / 100, size * 10);
  camera.position.copy(box.getCenter(new Vector3())).add(new Vector3(size, size * 0.7, size * 0.8));
  camera.lookAt(box.getCenter(new Vector3()));
  renderer.setClearColor(0x202020);
  renderer.render(scene, camera);
  return kinds;
};
