// SPDX-License-Identifier: MIT
// Two canvases, one before the other: where the plane is on them, how that is moved, and what is drawn
// anew: of the ground only what has changed, of what moves before it all. y goes up.

const margin = 0.07;   // of the canvas, around all that there is
const wheelStep = 1.0016;
const around = 8;      // pixels around what has changed: widths of lines, and more

export class Board {
  #ground;
  #front;
  #pens;
  #isDue = false;
  #colours = new Map();
  #isOld = true;        // all of the ground
  #old;                 // a part of it: a box of the plane
  #isFrontOld = true;

  // `picture`: draw(board), drawFront(board, now); what the latter returns says whether it is to be
  // called for the next frame, too.
  constructor(ground, front, picture) {
    this.#ground = ground;
    this.#front = front;
    // Drawn by the processor: thousands of small paths take a graphics card longer.
    this.#pens = [ground, front].map((canvas) => canvas.getContext('2d', { willReadFrequently: true }));
    [this.pen] = this.#pens;
    this.picture = picture;
    this.view = Board.view();
    new ResizeObserver(() => this.#resize()).observe(ground);
    this.#resize();
  }

  // Of a scene: what is where. `scale` is pixels of the page a unit; paths are relative to `origin`, as
  // canvases work with small numbers; `isFitted`: nobody has moved it.
  static view() {
    return { box: [0, 0, 1, 1], origin: [0.5, 0.5], middle: [0.5, 0.5], scale: 1, isFitted: true };
  }
  show(view) {
    this.view = view;
    if (view.isFitted) this.fit();
    this.invalidate();
  }

  get origin() { return this.view.origin; }
  get scale() { return this.view.scale; }
  get width() { return this.#ground.clientWidth; }
  get height() { return this.#ground.clientHeight; }

  // All of it is to be drawn, or what is in a box of the plane.
  invalidate(box) {
    if (box && this.#old) {
      const old = this.#old;
      this.#old = [Math.min(old[0], box[0]), Math.min(old[1], box[1]), Math.max(old[2], box[2]), Math.max(old[3], box[3])];
    } else if (box) {
      this.#old = box;
    } else {
      this.#isOld = true;
    }
    this.invalidateFront();
  }
  invalidateFront() {
    this.#isFrontOld = true;
    if (this.#isDue) return;
    this.#isDue = true;
    requestAnimationFrame((now) => this.#redraw(now));
  }

  // What there is, from which the view is fitted.
  setBox(box) {
    this.view.box = box;
    this.view.origin = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
    this.fit();
  }

  fit() {
    const view = this.view;
    const [left, low, right, high] = view.box;
    const width = Math.max(right - left, 1e-300);
    const height = Math.max(high - low, 1e-300);
    view.middle = [(left + right) / 2, (low + high) / 2];
    view.scale = (1 - 2 * margin) * Math.min(Math.max(this.width, 1) / width,
                                             Math.max(this.height - 90, 1) / height);
    view.isFitted = true;
    this.invalidate();
  }

  // Pixels of the page to the plane, and back.
  toPlane(x, y) {
    const { middle, scale } = this.view;
    return [middle[0] + (x - this.width / 2) / scale, middle[1] - (y - this.height / 2) / scale];
  }
  toPage([x, y]) {
    const { middle, scale } = this.view;
    return [this.width / 2 + (x - middle[0]) * scale, this.height / 2 - (y - middle[1]) * scale];
  }

  pan(dx, dy) {
    const { middle, scale } = this.view;
    this.view.middle = [middle[0] - dx / scale, middle[1] + dy / scale];
    this.view.isFitted = false;
    this.invalidate();
  }

  // Keeps what is at a pixel there.
  zoom(factor, x = this.width / 2, y = this.height / 2) {
    const [px, py] = this.toPlane(x, y);
    const view = this.view;
    view.scale *= factor;
    view.middle = [px - (x - this.width / 2) / view.scale, py + (y - this.height / 2) / view.scale];
    view.isFitted = false;
    this.invalidate();
  }
  wheel(event) {
    const lines = event.deltaMode === 1 ? 16 : 1;
    this.zoom(wheelStep ** (-event.deltaY * lines), event.offsetX, event.offsetY);
  }

  // --- For those who draw ---

  // Pixels as a length of the plane: for widths of lines.
  px(pixels) { return pixels / this.scale; }

  // Whether a box of the plane is where something is drawn.
  isSeen([left, low, right, high]) {
    const seen = this.seen;
    return left <= seen[2] && right >= seen[0] && low <= seen[3] && high >= seen[1];
  }

  // From here on what is drawn is in the plane, relative to the origin and `at`, and moved by pixels.
  enterPlane(at = [0, 0], dx = 0, dy = 0) {
    const ratio = devicePixelRatio;
    const [x, y] = this.toPage([this.origin[0] + at[0], this.origin[1] + at[1]]);
    this.pen.setTransform(ratio * this.scale, 0, 0, -ratio * this.scale, ratio * (x + dx), ratio * (y + dy));
  }
  // In pixels of the page.
  enterPage() { this.pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0); }
  // The same, for coordinates as they are.
  enterPlaneItself() { this.enterPlane([-this.origin[0], -this.origin[1]]); }

  // Lines of one pixel are drawn many times faster than wider ones.
  setThinLine(colour) {
    this.pen.strokeStyle = this.colour(colour);
    this.pen.lineWidth = this.px(1 / devicePixelRatio);
  }

  // Of the style sheet.
  colour(name) {
    let found = this.#colours.get(name);
    if (found === undefined) {
      found = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
      this.#colours.set(name, found);
    }
    return found;
  }
  forgetColours() { this.#colours.clear(); }
  isDark() { return document.documentElement.dataset.theme === 'dark'; }

  // --- Frames ---

  #redraw(now) {
    this.#isDue = false;
    this.#drawGround();
    if (!this.#isFrontOld) return;
    this.#isFrontOld = false;
    const pen = this.#begin(1);
    pen.clearRect(0, 0, this.#front.width, this.#front.height);
    this.seen = this.#boxOf(0, 0, this.width, this.height);
    if (this.picture.drawFront(this, now)) this.invalidateFront();
  }

  #drawGround() {
    if (!this.#isOld && !this.#old) return;
    const [left, top, right, bottom] = this.#isOld ? [0, 0, this.width, this.height] : this.#pixelsOf(this.#old);
    this.#isOld = false;
    this.#old = undefined;
    if (left >= right || top >= bottom) return;
    this.seen = this.#boxOf(left, top, right, bottom);
    const pen = this.#begin(0);
    const ratio = devicePixelRatio;
    pen.save();
    pen.beginPath();
    pen.rect(ratio * left, ratio * top, ratio * (right - left), ratio * (bottom - top));
    pen.clip();
    pen.clearRect(0, 0, this.#ground.width, this.#ground.height);
    this.picture.draw(this);
    pen.restore();
  }

  #begin(number) {
    this.pen = this.#pens[number];
    this.pen.setTransform(1, 0, 0, 1, 0, 0);
    this.pen.globalAlpha = 1;
    return this.pen;
  }

  #boxOf(left, top, right, bottom) {
    return [...this.toPlane(left, bottom), ...this.toPlane(right, top)];
  }
  // Whole pixels, and some around.
  #pixelsOf([left, low, right, high]) {
    const [x0, y0] = this.toPage([left, high]);
    const [x1, y1] = this.toPage([right, low]);
    return [Math.max(0, Math.floor(x0) - around), Math.max(0, Math.floor(y0) - around),
            Math.min(this.width, Math.ceil(x1) + around), Math.min(this.height, Math.ceil(y1) + around)];
  }

  #resize() {
    for (const canvas of [this.#ground, this.#front]) {
      canvas.width = Math.round(this.width * devicePixelRatio);
      canvas.height = Math.round(this.height * devicePixelRatio);
    }
    if (this.view.isFitted) this.fit();
    this.invalidate();
  }
}
