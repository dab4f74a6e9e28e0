// SPDX-License-Identifier: MIT
// The picture of the surface: what the server says goes in, frames come out.
import { Box3 } from 'three';
import { diagonal } from './batch.js';
import { fetchMany } from './bundles.js';
import { colouring, explain, hexOf } from './colours.js';
import { Contours } from './contours.js';
import { CutView } from './cut_view.js';
import { Frame, nameOf } from './frame.js';
import { Highlight } from './highlight.js';
import { Layers } from './layers.js';
import { Lines } from './lines.js';
import { Loader } from './loader.js';
import { hitAt, nearestPoint } from './pick.js';
import { parseSlab } from './glb.js';
import { trianglesOf } from './section.js';
import { integralsOf } from './solid.js';
import { Slabs } from './slabs.js';
import { Stage } from './scene.js';
import { Surroundings } from './surroundings.js';

const settleEvery = 100;  // ms
const quiet = 200;        // ms without an edit
const lossAfter = 2000;   // ms for which an event may be behind
const loadingStep = 500;  // ms from frame to frame while much is loaded
const many = 8;           // slabs that are worth a request for all of them
const slicesAtOnce = 64;  // whose contours are drawn anew in a frame

export class View {
  #panel;
  #labels;
  #layers;
  #slabs;
  #slots = new Map();  // by slab, if it is shown and not empty
  #contours;
  #lines;
  #surroundings;
  #cut;
  #chosen;             // the slice
  #picked;             // contour and point
  #worn = new Set();   // slabs with normals that are no longer right
  #renewal;            // timer
  #redrawing;          // another
  #lose;
  #picks = 0;          // asked for: only the last one is answered
  #pickedZ;            // height of the contour point that is marked
  #loader = new Loader();
  #frame;
  #unit = '';
  #metresPerUnit = 0.001;
  #mode = 'label';
  #wasMoved = false;   // by the user: then nothing is fitted any more
  #isStale = false;    // box and colours
  #nextFrame;          // timer
  #settings;
  #legend = document.getElementById('legend');

  // `lengths` are texts for the box's sides; lose() is called when what is shown here is not what
  // the server has.
  constructor(canvas, lengths, panel, labels, lose) {
    this.#panel = panel;
    this.#labels = labels;
    this.#lose = lose;
    this.stage = new Stage(canvas);
    this.#layers = new Layers(this.stage.scene, this.stage.material, labels);
    this.#slabs = new Slabs((slab) => this.#show(slab), (slab) => this.#hide(slab));
    this.#contours = new Contours(this.#loader, (slice) => this.#draw(slice));
    this.#lines = new Lines(this.stage.scene);
    this.#surroundings = new Surroundings(this.stage.scene, lengths);
    this.#cut = new CutView(this.stage, { surfaces: this.#layers.materials, lines: [this.#lines.material] },
                            async (z) => this.#shownPart(await this.#contours.ask(z)));
    this.#chosen = new Highlight(this.stage.scene, 2.5);
    this.#picked = new Highlight(this.stage.scene, 4);
    this.stage.controls.addEventListener('start', () => { this.#wasMoved = true; });
    this.stage.onFrame(() => this.#prepare());
    this.stage.onResize(() => { if (!this.#wasMoved && this.#frame) this.fit(); });
    setInterval(() => this.#settle(), settleEvery);
    labels.addEventListener('look', ({ detail }) => this.#applyLook(detail));
    labels.addEventListener('list', () => this.#applyLook('opacity'));
  }

  get heights() { return this.#contours.heights; }
  get unit() { return this.#unit; }
  get frame() { return this.#frame; }
  // From the lowest to the highest height.
  get range() { return this.#slabs.range; }

  setColours({ background, grid, lines, accent }) {
    this.stage.background = background;
    this.#surroundings.colour = grid;
    this.#lines.material.color.set(lines);
    this.#cut.lineColour = lines;
    this.#cut.colour = accent;
    this.#chosen.colour = accent;
    this.#picked.colour = accent;
  }

  // All that the server has.
  reset(state) {
    this.#unit = nameOf(state.unit);
    const isOtherUnit = this.#metresPerUnit !== state.metres_per_unit;
    if (this.#slots.size === 0 || isOtherUnit) this.#frame = undefined;
    this.#metresPerUnit = state.metres_per_unit;
    this.#contours.reset(state.slices);
    this.forgetPick();
    this.#lines.clear();
    this.#fetchMany(this.#slabs.reset(state.slabs, performance.now()));
    this.#panel.showDownloads(state.downloads);
    this.#tell(state);
  }

  // What an edit changed. False where that does not go together with what is known here.
  change(edit) {
    if (!edit.removed.every((id) => this.#slabs.has(id))) return false;
    if (edit.added.some(({ id }) => this.#slabs.has(id))) return false;
    if ([...edit.slices_removed, ...edit.slices_added].includes(this.#pickedZ)) this.forgetPick();
    for (const z of edit.slices_removed) this.#lines.delete(z);
    for (const z of edit.slices_added) this.#lines.delete(z);
    this.#contours.change(edit.slices_removed, edit.slices_added);
    const added = this.#slabs.change(edit.removed, edit.added, performance.now());
    this.#fetch(added);
    this.#wear(this.#slabs.beside(added));
    this.#tell(edit);
    return true;
  }

  // Shows what the controls ask for.
  apply(settings) {
    this.#settings = settings;
    this.#mode = settings.colour;
    this.#isStale = true;
    if (!this.#frame) return this.#beginBare();
    this.#applyContours(settings.hasContours);
    this.#applySlice(settings.slice);
    this.stage.invalidate();
  }

  get cut() { return this.#cut; }

  fit() {
    this.#wasMoved = this.#labels.isAnyHidden;  // what is hidden does not matter now
    this.stage.fit(this.#box(({ label }) => this.#labels.isShown(label)));
  }

  // What lies under a place of the screen (-1 to 1): its slab, the point in the scene, the place in
  // the input's coordinates.
  hitAt(x, y) {
    if (!this.#frame) return undefined;
    this.#layers.flush();
    const { cap, volumes } = this.#cut;
    const labelOf = this.#layers.labelling();
    // What is solid goes before what is seen through.
    const hit = this.#layers.meshes.map((mesh) =>
      hitAt(this.stage, [mesh], [x, y], { cap, volumes, labelOf })).find(Boolean);
    const slab = hit && [...this.#slots].find(([, slot]) => this.#layers.isHit(slot, hit))?.[0];
    if (!slab) return undefined;
    const place = this.#frame.toInput(hit.point);
    return { point: hit.point, place, slab: this.#slabAround(slab, place[2]) };
  }

  // All triangles of a label that are in the picture.
  trianglesOf(label) {
    return trianglesOf(this.#layers.contentsOf(label));
  }

  // Says what lies under a place (-1 to 1), and marks the contour point next to it. Resolves to
  // that point, if there is any.
  async pick(x, y) {
    const hit = this.hitAt(x, y);
    this.forgetPick();
    if (!hit) return undefined;
    const { slab, place } = hit;
    this.#labels.choose(slab.label);
    const pick = this.#picks;
    const slices = await Promise.all([slab.low, slab.high].map((z) => this.#contours.ask(z)));
    if (pick !== this.#picks) return undefined;
    const nearest = nearestPoint(slices.filter(Boolean), place, slab.label);
    this.#panel.showPick(slab, place, nearest, this.unit, this.range);
    this.#mark(nearest);
    return nearest;
  }

  forgetPick() {
    ++this.#picks;
    this.#mark(undefined);
    this.#panel.forgetPick();
  }

  // Inside of a label it is the slab at that height: a hit is of what lies beyond it.
  #slabAround(slab, z) {
    const isAround = ({ low, high }) => low <= z && z <= high;
    if (isAround(slab)) return slab;
    return [...this.#slots.keys()].find((other) => other.label === slab.label && isAround(other)) ?? slab;
  }

  #fetch(slabs) {
    if (slabs.length >= many) return this.#fetchMany(slabs);
    for (const slab of slabs)
      this.#ask(slab, () => this.#slabs.isPending(slab), (content) => {
        Object.assign(slab, content);
        this.#slabs.arrive(slab, performance.now());
        this.#showPending();
      }, () => this.#miss(slab));
  }

  #fetchMany(slabs) {
    fetchMany(this.#loader, slabs, {
      isKnown: (id) => this.#slabs.has(id),
      isWanted: (slab) => this.#slabs.isPending(slab),
      take: (slab, content) => {
        Object.assign(slab, content);
        this.#slabs.arrive(slab, performance.now());
      },
      miss: (slab) => this.#miss(slab),
      done: () => this.#showPending(),
    });
  }

  // A slab may be gone before it could be fetched: then an event says so soon, or was lost.
  #miss(slab) {
    setTimeout(() => { if (this.#slabs.isPending(slab)) this.#lose(); }, lossAfter);
  }

  #ask(slab, isWanted, take, miss) {
    this.#loader.fetch(`slabs/${encodeURIComponent(slab.id)}.glb`, isWanted, async (response) => {
      take({ ...parseSlab(await response.arrayBuffer()), id: slab.id });
    }, miss);
  }

  // The normals of slabs beside an edit are not those they were: they are fetched anew as soon as
  // nothing else is.
  #wear(slabs) {
    for (const slab of slabs) this.#worn.add(slab);
    clearTimeout(this.#renewal);
    if (this.#worn.size > 0) this.#renewal = setTimeout(() => this.#renew(), quiet);
  }

  #renew() {
    if (this.#slabs.pending > 0) return this.#wear([]);
    for (const slab of this.#worn) {
      const isInPlace = () => this.#slabs.isInPlace(slab);
      this.#ask(slab, isInPlace, (content) => {
        if (!isInPlace()) return;
        this.#hide(slab);
        Object.assign(slab, content);
        this.#show(slab);
      });
    }
    this.#worn.clear();
  }

  #settle() {
    if (this.#slabs.pending > 0) this.#slabs.settle(performance.now());
  }

  #show(slab) {
    if (!slab.positions) return;
    if (this.#frame?.isFarFrom(slab.translation)) this.#leave();
    if (!this.#frame) this.#begin(slab);
    slab.positions = this.#frame.place(slab.positions, slab.translation);
    slab.integrals = integralsOf(slab.positions, slab.indices);
    this.#labels.enter(slab.label, hexOf(slab));
    this.#slots.set(slab, this.#layers.add(slab));
    for (const bulk of ['positions', 'normals', 'indices']) delete slab[bulk];
    this.#refreshLater();
  }

  #hide(slab) {
    const slot = this.#slots.get(slab);
    if (!slot) return;
    this.#slots.delete(slab);
    this.#layers.remove(slot);
    this.#labels.leave(slab.label);
    this.#refreshLater();
  }

  // What comes is so far away that both can't be shown: the old is what goes.
  #leave() {
    this.forgetPick();
    for (const [slab, slot] of this.#slots) {
      this.#layers.remove(slot);
      this.#labels.leave(slab.label);
    }
    this.#slots.clear();
    this.#frame = undefined;
    this.#wasMoved = false;
  }

  #begin(slab) {
    this.#frame = new Frame(this.#metresPerUnit, slab.translation, diagonal(slab.positions));
    if (this.#settings) this.apply(this.#settings);
  }

  // There are slices and no surface: then they are what is to be seen.
  get #isBare() { return this.#slabs.size === 0 && this.heights.length > 0; }

  #beginBare() {
    if (this.#isBare) this.heights.forEach((z) => this.#contours.ask(z));
  }

  #beginWith(slice) {
    const { heights } = this;
    this.#frame = Frame.around(slice, heights.at(-1) - heights[0], this.#metresPerUnit);
    if (this.#frame && this.#settings) this.apply(this.#settings);
  }

  // While much is on its way frames are few: each of them holds up the rest.
  #refreshLater() {
    this.#isStale = true;
    if (this.#slabs.pending < many) return this.stage.invalidate();
    this.#nextFrame ??= setTimeout(() => {
      this.#nextFrame = undefined;
      this.stage.invalidate();
    }, loadingStep);
  }

  // Ahead of a frame.
  #prepare() {
    this.#layers.flush();
    if (this.#isStale) this.#refresh();
    this.#layers.flush();
    this.#lines.refresh();
    for (const highlight of [this.#chosen, this.#picked])
      highlight.keepSize(this.stage);
    this.#surroundings.lookFrom(this.stage.camera, this.stage);
    this.#cut.prepare();
  }

  #refresh() {
    this.#isStale = false;
    const colours = colouring(this.#mode, [...this.#slots.keys()], this.#labels);
    for (const [slab, slot] of this.#slots) this.#layers.setColour(slot, colours.of(slab));
    explain(this.#legend, colours);
    this.#cut.fill(this.#pieces(), this.#box(), this.#frame);
    if (!this.#frame) return;
    const box = this.#box();
    this.#panel.showGrid(this.#surroundings.surround(box, this.#frame, this.#unit), this.#unit);
    if (this.#wasMoved) this.stage.setRange(box);
    else this.stage.fit(box);
  }

  // For the caps of a cut; what is hidden gets none, as it is not drawn.
  #pieces() {
    const { of: colourOf } = colouring('label', [], this.#labels);
    return [...this.#slots].map(([slab, slot]) => ({ label: slab.label, integrals: slab.integrals,
      colour: colourOf(slab), opacity: slot.opacity, ...this.#layers.placeOf(slot) }));
  }

  #box(isIn = () => true) {
    const all = new Box3();
    for (const slot of this.#slots.values()) if (isIn(slot)) all.union(slot.box);
    return this.#isBare ? all.union(this.#lines.box) : all;
  }

  #applyLook(what) {
    if (what === 'visibility') this.#layers.applyVisibility();
    if (what === 'visibility') this.#redrawLater();
    if (what === 'opacity') this.#layers.applyOpacity();
    if (what !== 'visibility') this.#isStale = true;
    this.stage.invalidate();
  }

  // Contours without those of hidden labels: some slices a frame, as soon as nothing changes.
  #redrawLater() {
    clearTimeout(this.#redrawing);
    if (!this.#settings) return;
    this.#redrawing = setTimeout(() => {
      if (this.#lines.isShown) this.#redraw(this.heights);
      else this.#lines.clear();
      this.#cut.renewContours();
      this.#applySlice(this.#settings.slice);
    }, quiet);
  }

  #redraw(heights) {
    for (const z of heights.slice(0, slicesAtOnce))
      if (this.#contours.get(z)) this.#draw(this.#contours.get(z));
    const rest = heights.slice(slicesAtOnce);
    if (rest.length > 0) this.#redrawing = setTimeout(() => this.#redraw(rest));
  }

  // What is to be seen of a slice.
  #shownPart(slice) {
    const isShown = (_, contour) => this.#labels.isShown(slice.labels?.[contour] ?? '');
    return slice && { ...slice, contours: slice.contours.filter(isShown) };
  }

  #applyContours(areShown) {
    this.#lines.isShown = areShown || this.#isBare;
    if (!this.#lines.isShown) return;
    for (const z of this.heights) {
      const slice = this.#contours.get(z);
      if (!slice) this.#contours.ask(z);
      else if (!this.#lines.has(z)) this.#draw(slice);
    }
  }

  #draw(slice) {
    if (!this.#frame && this.#isBare) return this.#beginWith(slice);
    if (!this.#frame || !this.#lines.isShown) return;
    this.#lines.set(this.#shownPart(slice), this.#frame);
    if (this.#isBare) this.#isStale = true;  // so is the box
    this.stage.invalidate();
  }

  async #applySlice(z) {
    const slice = z === undefined ? undefined : await this.#contours.ask(z);
    const isOutdated = z !== this.#settings.slice;
    if (!this.#frame || isOutdated) return;
    this.#chosen.showSlice(this.#shownPart(slice), this.#frame);
    this.stage.invalidate();
  }

  #mark(nearest) {
    this.#pickedZ = nearest?.slice.z;
    if (!this.#frame) return;
    const points = nearest?.slice.contours[nearest.contour];
    this.#picked.showSlice(points && { z: nearest.slice.z, contours: [points] }, this.#frame);
    const place = points && this.#frame.toScene(...points[nearest.point], nearest.slice.z);
    this.#picked.showPoint(place, this.stage);
    this.stage.invalidate();
  }

  #tell(state) {
    this.#panel.showCounts({ ...state, unit: this.unit });
    this.#showPending();
  }

  #showPending() {
    this.#panel.showPending(this.#slabs.pending, this.#slabs.size === 0 && !this.#isBare);
  }
}
