// SPDX-License-Identifier: MIT
// The canvas: where the plane is on it, how that is moved, and when it is drawn anew. y goes up.

const margin = 0.07;  // of the canvas, around all that there is
const wheelStep = 1.0016;

export class Board {
  #canvas;
  #isDue = false;
  #colours = new Map();

  // `draw(board)` draws; what it returns says whether it is to be called for the next frame, too.
  constructor(canvas, draw) {
    this.#canvas = canvas;
    this.draw = draw;
    this.pen = canvas.getContext('2d');
    this.view = Board.view();
    new ResizeObserver(() => this.#resize()).observe(canvas);
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

  get canvas() { return this.#canvas; }
  get origin() { return this.view.origin; }
  get scale() { return this.view.scale; }
  get width() { return this.#canvas.clientWidth; }
  get height() { return this.#canvas.clientHeight; }

  invalidate() {
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

  // Pixels as a length of the plane: for widths of lines.
  px(pixels) { return pixels / this.scale; }

  // From here on what is drawn is in the plane, relative to the origin and `at`.
  enterPlane(at = [0, 0]) {
    const ratio = devicePixelRatio;
    const [x, y] = this.toPage([this.origin[0] + at[0], this.origin[1] + at[1]]);
    this.pen.setTransform(ratio * this.scale, 0, 0, -ratio * this.scale, ratio * x, ratio * y);
  }
  enterPage() { this.pen.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0); }

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

  #redraw(now) {
    this.#isDue = false;
    this.pen.setTransform(1, 0, 0, 1, 0, 0);
    this.pen.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    if (this.draw(this, now)) this.invalidate();
  }

  #resize() {
    this.#canvas.width = Math.round(this.width * devicePixelRatio);
    this.#canvas.height = Math.round(this.height * devicePixelRatio);
    if (this.view.isFitted) this.fit();
    this.invalidate();
  }
}
