// SPDX-License-Identifier: MIT
// Fills a cut with the labels' colours, whatever their number, in one more pass: of all surfaces
// the part beyond the plane, as the eye has it, is added up pixel by pixel, what faces away as
// +code, what faces the eye as -code. Of a closed surface the ray from the plane outwards leaves
// more often than it enters exactly if it began inside: what is left is the sum of the codes of the
// labels that contain the point of the plane. The plane is then drawn in their colours.
import { AddEquation, CustomBlending, DataTexture, DoubleSide, FloatType, GLSL3, HalfFloatType,
         Mesh, NearestFilter, OneFactor, PlaneGeometry, RGBAFormat, ShaderMaterial, Vector2,
         Vector4, WebGLRenderTarget } from 'three';
import { codeOf, decoding, layOut } from './cap_codes.js';
import { total, volumeOf } from './solid.js';

const width = 128;  // of the textures that are tables

// Where floats can't be added up, half of them may do; else caps are not drawn.
function accuracyOf({ extensions }) {
  const has = (name) => extensions.has(name);
  if (has('EXT_color_buffer_float') && has('EXT_float_blend'))
    return { type: FloatType, exact: 24, room: 6 };
  const isHalf = has('EXT_color_buffer_half_float') || has('EXT_color_buffer_float');
  return isHalf ? { type: HalfFloatType, exact: 11, room: 4 } : undefined;
}

function table(array, type) {
  const texture = new DataTexture(array, width, array.length / (4 * width), RGBAFormat, type);
  texture.needsUpdate = true;
  return texture;
}

function rowsFor(count) {
  return Math.max(Math.ceil(count / width), 1);
}

// The items by what `keyOf` says of them.
function groups(items, keyOf) {
  const all = new Map();
  for (const item of items) {
    const key = keyOf(item);
    if (!all.has(key)) all.set(key, []);
    all.get(key).push(item);
  }
  return all;
}

const place = `ivec2(i % ${width}, i / ${width})`;

function summing() {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    side: DoubleSide,
    blending: CustomBlending, blendEquation: AddEquation, blendSrc: OneFactor, blendDst: OneFactor,
    depthTest: false,
    depthWrite: false,
    uniforms: { codes: { value: null }, plane: { value: new Vector4() } },
    vertexShader: `
      #include <batching_pars_vertex>
      uniform highp sampler2D codes;
      uniform vec4 plane;
      flat out vec4 code;
      out float beyond;
      void main() {
        int i = int(getIndirectIndex(gl_DrawID));
        code = texelFetch(codes, ${place}, 0);
        vec4 world = modelMatrix * vec4(position, 1.0);
        beyond = dot(plane.xyz, world.xyz) + plane.w;
        gl_Position = projectionMatrix * (viewMatrix * world);
      }`,
    fragmentShader: `
      flat in vec4 code;
      in float beyond;
      out vec4 sum;
      void main() {
        if (beyond < 0.0) discard;
        sum = gl_FrontFacing ? -code : code;
      }` });
}

function painting() {
  return new ShaderMaterial({
    glslVersion: GLSL3,
    side: DoubleSide,
    transparent: true,
    polygonOffset: true, polygonOffsetFactor: 0.5, polygonOffsetUnits: 0.5,
    uniforms: { sums: { value: null }, palette: { value: null }, own: { value: 4 },
                perChannel: { value: 1 }, bits: { value: 1 } },
    vertexShader: `
      out vec3 toEye;
      out vec3 across;
      void main() {
        vec4 place = modelViewMatrix * vec4(position, 1.0);
        toEye = projectionMatrix[3].w == 1.0 ? vec3(0, 0, 1) : -place.xyz;
        across = normalMatrix * normal;
        gl_Position = projectionMatrix * place;
      }`,
    fragmentShader: `
      uniform highp sampler2D sums;
      uniform sampler2D palette;
      in vec3 toEye;
      in vec3 across;
      out vec4 colour;
      vec4 seen;
      ${decoding}
      bool visit(int i) {
        vec4 next = i < 0 ? vec4(0.5, 0.5, 0.5, 1) : texelFetch(palette, ${place}, 0);
        seen.rgb += (1.0 - seen.a) * next.a * next.rgb;
        seen.a += (1.0 - seen.a) * next.a;
        return seen.a > 0.99;
      }
      vec4 at(ivec2 pixel) { return texelFetch(sums, pixel, 0); }
      void main() {
        ivec2 pixel = ivec2(gl_FragCoord.xy);
        vec4 sum = at(pixel);
        seen = vec4(0);
        decode(sum);
        if (seen.a == 0.0) discard;
        float borders = 0.0;
        for (int i = -1; i <= 1; i += 2) {
          if (at(pixel + ivec2(i, 0)) != sum) borders += 1.0;
          if (at(pixel + ivec2(0, i)) != sum) borders += 1.0;
        }
        float light = mix(0.88, 1.0, abs(dot(normalize(across), normalize(toEye))));
        float ink = 1.0 - 0.35 * min(borders, 1.0);
        colour = vec4(light * ink * seen.rgb / seen.a, seen.a);
      }` });
}

export class Caps {
  #renderer;
  #accuracy;
  #target;
  #summing = new Map();  // by mesh
  #quad;
  #areDrawn = false;     // the caps of all closed labels can be
  #tell;                 // what writes the codes of what is there now, as soon as they are needed

  constructor({ renderer, scene }) {
    this.#renderer = renderer;
    this.#accuracy = accuracyOf(renderer);
    this.#quad = new Mesh(new PlaneGeometry(1, 1), painting());
    this.#quad.renderOrder = -1;
    this.#quad.frustumCulled = false;
    this.#quad.visible = false;
    scene.add(this.#quad);
  }

  // Who has which code: `pieces` are { label, colour, opacity, mesh, instance, integrals } of all
  // slabs in the picture. Returns the volumes of the labels that are closed and get a cap, by
  // label; undefined instead of a volume for those that get none.
  assign(pieces) {
    const labels = groups(pieces, ({ label }) => label);
    const volumes = new Map();
    for (const [label, own] of labels)
      volumes.set(label, volumeOf(total(own.map(({ integrals }) => integrals))));
    const closed = [...volumes.keys()].filter((label) => volumes.get(label) !== undefined)
      .sort((a, b) => Math.abs(volumes.get(b)) - Math.abs(volumes.get(a)));
    const layout = this.#accuracy && layOut(closed.length, this.#accuracy);
    this.#areDrawn = layout !== undefined && closed.length > 0;
    if (!layout) return new Map([...labels.keys()].map((label) => [label, undefined]));
    for (const name of ['own', 'perChannel', 'bits'])
      this.#quad.material.uniforms[name].value = layout[name];
    this.#tell = () => {
      this.#paint(closed.map((label) => labels.get(label)[0]));
      this.#write(pieces, new Map(closed.map((label, i) =>
        [label, codeOf(i, layout, Math.sign(volumes.get(label)))])));
    };
    return volumes;
  }

  // Ahead of a frame. What is on the negative side of the plane is cut away, and the eye is there;
  // without a plane nothing is filled. `size` is that of the quad.
  draw(plane, centre, size, camera) {
    for (const mesh of this.#summing.keys()) mesh.perObjectFrustumCulled = true;
    this.#quad.visible = plane !== undefined && this.#areDrawn;
    if (!this.#quad.visible) return;
    this.#tell?.();
    this.#tell = undefined;
    this.#lay(plane, centre, size);
    this.#add(plane, camera);
  }

  #lay(plane, centre, size) {
    plane.projectPoint(centre, this.#quad.position);
    this.#quad.scale.set(size, size, 1);
    this.#quad.lookAt(this.#quad.position.clone().sub(plane.normal));
  }

  #add(plane, camera) {
    const renderer = this.#renderer;
    const { autoClear } = renderer;
    renderer.setRenderTarget(this.#fitTarget());
    renderer.setClearColor(0x000000, 0);
    renderer.clear(true, false, false);
    camera.updateMatrixWorld();
    renderer.autoClear = false;
    for (const [mesh, material] of this.#summing) {
      if (!mesh.visible) continue;
      material.uniforms.plane.value.set(...plane.normal.toArray(), plane.constant);
      const { material: own } = mesh;
      mesh.material = material;
      renderer.render(mesh, camera);
      mesh.material = own;
      mesh.perObjectFrustumCulled = false;  // what is in sight is known for the rest of this frame
    }
    renderer.autoClear = autoClear;
    renderer.setRenderTarget(null);
  }

  #fitTarget() {
    const size = this.#renderer.getDrawingBufferSize(new Vector2());
    this.#target ??= new WebGLRenderTarget(size.x, size.y, { type: this.#accuracy.type,
      minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: false });
    this.#target.setSize(size.x, size.y);
    this.#quad.material.uniforms.sums.value = this.#target.texture;
    return this.#target;
  }

  #paint(pieces) {
    const colours = new Uint8Array(4 * width * rowsFor(pieces.length));
    for (const [i, { colour, opacity }] of pieces.entries()) {
      const { r, g, b } = colour.clone().convertLinearToSRGB();
      colours.set([r, g, b, opacity].map((value) => Math.round(255 * value)), 4 * i);
    }
    this.#quad.material.uniforms.palette.value?.dispose();
    this.#quad.material.uniforms.palette.value = table(colours);
  }

  #write(pieces, codes) {
    for (const [mesh, own] of groups(pieces, ({ mesh }) => mesh)) {
      if (!this.#summing.has(mesh)) this.#summing.set(mesh, summing());
      const { codes: texture } = this.#summing.get(mesh).uniforms;
      const count = 1 + own.reduce((most, { instance }) => Math.max(most, instance), 0);
      const numbers = new Float32Array(4 * width * rowsFor(count));
      for (const { label, instance } of own) numbers.set(codes.get(label) ?? [0, 0, 0, 0], 4 * instance);
      texture.value?.dispose();
      texture.value = table(numbers, FloatType);
    }
  }
}
