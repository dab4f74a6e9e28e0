// SPDX-License-Identifier: MIT
// Lines whose corners can be dragged: what the tabs with such lines have in common.

import { Tab } from './tab.js';

const handle = 4.5;  // pixels

export class TabWithLines extends Tab {
  #bent;  // the line whose corner is being dragged
  #kept;  // what the program has said of it meanwhile

  // A line as the program has it, or a new one.
  takeLine({ id, at, points, ...rest }) {
    if (id === this.#bent) this.#kept = { id, at, points, ...rest };
    else this.addThing({ ...this.things.get(id), ...rest, id, at, rings: [points], isLine: true });
  }

  // The corners of a line, where they are.
  cornersOf({ rings: [ring], at }) {
    const corners = [];
    for (let i = 0; i < ring.length; i += 2) corners.push([ring[i] + at[0], ring[i + 1] + at[1]]);
    return corners;
  }

  grab(p, near) {
    const bend = this.#bend(p, near);
    return bend ?? super.grab(p, near);
  }

  #bend(p, near) {
    for (const line of this.things.values()) {
      if (!line.isLine) continue;
      const corners = this.cornersOf(line);
      const corner = corners.findIndex(([x, y]) => Math.hypot(x - p[0], y - p[1]) <= 1.5 * near);
      if (corner < 0) continue;
      this.choose(line.id);
      return this.#bending(line.id, corners, corner);
    }
    return undefined;
  }

  #bending(id, corners, corner) {
    let sent = Promise.resolve(0);
    this.#bent = id;
    const { at, rings: [points] } = this.things.get(id);
    this.#kept = { id, at, points };
    return {
      move: (to) => {
        corners[corner] = to;
        this.addThing({ ...this.things.get(id), at: [0, 0], rings: [corners.flat()] });
        sent = this.page.send({ do: 'reshape', id, points: corners }, `reshape ${id}`);
      },
      end: async () => {
        const event = await sent;
        this.#bent = undefined;
        if (event === undefined) this.takeLine(this.#kept);  // it was refused
      },
    };
  }

  // What is chosen: a line with its corners, or a ring around a point.
  drawFront(board) {
    const chosen = this.things.get(this.chosen);
    if (!chosen) return;
    if (chosen.isLine) {
      this.drawLine(board, chosen, 'accent', 3);
      return this.drawHandles(board, chosen, 'accent');
    }
    board.enterPage();
    board.pen.strokeStyle = board.colour('accent');
    board.pen.lineWidth = 2.5;
    board.pen.beginPath();
    board.pen.arc(...board.toPage(chosen.at), 7, 0, 2 * Math.PI);
    board.pen.stroke();
  }

  drawHandles(board, line, colour) {
    const { pen } = board;
    board.enterPage();
    pen.fillStyle = board.colour('page');
    pen.strokeStyle = board.colour(colour);
    pen.lineWidth = 1.5;
    for (const corner of this.cornersOf(line)) {
      const [x, y] = board.toPage(corner);
      pen.beginPath();
      pen.arc(x, y, handle, 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
  }

  drawLine(board, line, colour, width, dash = []) {
    const { pen } = board;
    const path = this.things.enter(board, line);
    pen.strokeStyle = board.colour(colour);
    pen.lineWidth = board.px(width);
    pen.lineJoin = pen.lineCap = 'round';
    pen.setLineDash(dash.map((length) => board.px(length)));
    pen.stroke(path);
    pen.setLineDash([]);
  }
}
