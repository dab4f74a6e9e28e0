// SPDX-License-Identifier: MIT
// The edges of the triangulation, asked for while they are shown, and anew after each change.

export class Triangles {
  #page;
  #path;
  #isAsking = false;
  #isOld = false;

  constructor(page) {
    this.#page = page;
    this.isShown = false;
  }

  toggle() {
    this.isShown = !this.isShown;
    this.#path = undefined;
    this.refresh();
  }

  // Something has changed.
  async refresh() {
    if (!this.isShown) return;
    this.#isOld = true;
    if (this.#isAsking) return;
    this.#isAsking = true;
    while (this.#isOld && this.isShown) {
      this.#isOld = false;
      const { board, link } = this.#page;
      const { origin } = board;
      try { this.#path = pathOf(await link.numbers('edges'), origin); } catch { break; }
      board.invalidate();
    }
    this.#isAsking = false;
  }

  forget() { this.#path = undefined; }

  draw(board) {
    if (!this.isShown || !this.#path) return;
    board.enterPlane();
    board.setThinLine('mesh');
    board.pen.stroke(this.#path);
  }
}

// The numbers: how many edges are free, four times; then x, y, x, y of each edge.
function pathOf(numbers, [ox, oy]) {
  const path = new Path2D();
  for (let i = 4; i < numbers.length; i += 4) {
    path.moveTo(numbers[i] - ox, numbers[i + 1] - oy);
    path.lineTo(numbers[i + 2] - ox, numbers[i + 3] - oy);
  }
  return path;
}
