// SPDX-License-Identifier: MIT
// A surface through values: samples, lines that shape it, and a profile. The picture is asked for after
// each change: values in rows, isolines, the profile.

import { button, figures, make, section, short, slider } from './make.js';
import { TabWithLines } from './lines.js';

// Viridis (Smith, van der Walt, Firing; CC0).
const palette = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725']
  .map((text) => [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16)));

function colourOf(part) {
  const place = Math.min(0.9999, Math.max(0, part)) * (palette.length - 1);
  const i = Math.floor(place);
  return palette[i].map((value, k) => value + (place - i) * (palette[i + 1][k] - value));
}

export class Fields extends TabWithLines {
  #picture;      // { canvas, box, low, high }
  #isolines = [];
  #profile;
  #isOld = false;
  #isAsking = false;

  constructor(page) { super(page, 'field', 'Field'); }

  // --- What the program says ---

  reset(state) {
    this.profileLine = state.profile;
    this.#takeAll(state);
  }
  change(change) { this.#takeAll(change); }

  #takeAll({ samples = [], lines = [], removed = [], moved = [], cubic }) {
    for (const sample of samples) {
      const known = this.things.get(sample.id);
      if (!known) this.addThing({ ...sample, isSpot: true });
      else {
        known.value = sample.value;
        this.placeThing(sample.id, sample.at);
      }
    }
    for (const line of lines) this.takeLine(line);
    for (const id of removed) this.removeThing(id);
    for (const { id, at } of moved) this.placeThing(id, at);
    this.isCubic = cubic ?? this.isCubic;
    this.#refresh();
  }

  async #refresh() {
    this.#isOld = true;
    if (this.#isAsking || !this.page.isShown(this)) return;
    this.#isAsking = true;
    while (this.#isOld) {
      this.#isOld = false;
      await new Promise((done) => { queueMicrotask(done); });
      const { event } = this;
      try {
        const { link } = this.page;
        const [numbers, { lines }, profile] =
          await Promise.all([link.numbers('raster'), link.ask('isolines'), link.ask('profile')]);
        this.#takePicture(numbers);
        this.#isolines = lines.map((line) => ({ ...line, path: this.#pathOf(line) }));
        this.#profile = profile;
      } catch { break; }
      this.pictured = event;
      this.#drawProfile();
      this.board.invalidate();
    }
    this.#isAsking = false;
  }
  // The last event that is in the picture.
  get shownEvent() { return this.pictured ?? 0; }

  #takePicture(numbers) {
    const [columns, rows, low, high, ...box] = numbers.slice(0, 8);
    const canvas = this.#picture?.canvas ?? document.createElement('canvas');
    canvas.width = columns;
    canvas.height = rows;
    const image = new ImageData(columns, rows);
    const range = high > low ? high - low : 1;
    const table = Array.from({ length: 512 }, (_, i) => colourOf(i / 511));
    for (let i = 0; i < columns * rows; ++i) {
      const value = numbers[8 + i];
      if (Number.isNaN(value)) continue;
      const [r, g, b] = table[Math.min(511, Math.max(0, Math.round(511 * (value - low) / range)))];
      image.data.set([r, g, b, 255], 4 * i);
    }
    canvas.getContext('2d').putImageData(image, 0, 0);
    this.#picture = { canvas, box, low, high };
  }

  #pathOf({ points, is_closed: isClosed }) {
    const [ox, oy] = this.board.origin;
    const path = new Path2D();
    for (let i = 0; i < points.length; i += 2) path.lineTo(points[i] - ox, points[i + 1] - oy);
    if (isClosed) path.closePath();
    return path;
  }

  // --- What is done ---

  nameOf(id) {
    const thing = this.things.get(id);
    return thing?.isSpot ? `sample ${short(thing.value)}` : thing?.kind ?? '';
  }
  insert(p) { this.page.send({ do: 'insert', points: [p] }); }
  #insertLine(name) {
    const [x, y] = this.board.view.middle;
    const size = 2 * this.size();
    this.page.send({ do: 'insert', name, points: [[x, y - size], [x + size / 3, y], [x, y + size]] });
  }
  #setValue(value) {
    const thing = this.things.get(this.chosen);
    if (!thing?.isSpot) return;
    this.page.send({ do: 'set', name: 'value', id: this.chosen, value }, `value ${this.chosen}`);
  }
  get keys() {
    const step = () => (this.#picture ? (this.#picture.high - this.#picture.low) / 40 : 1);
    return { '[': () => this.#setValue(this.things.get(this.chosen)?.value - step()),
             ']': () => this.#setValue(this.things.get(this.chosen)?.value + step()) };
  }

  // --- Picture ---

  draw(board) {
    const { pen } = board;
    if (this.#picture) {
      const [left, low, right, high] = this.#picture.box;
      board.enterPage();
      const [x0, y0] = board.toPage([left, high]);
      const [x1, y1] = board.toPage([right, low]);
      pen.imageSmoothingEnabled = true;
      pen.drawImage(this.#picture.canvas, x0, y0, x1 - x0, y1 - y0);
    }
    board.enterPlane();
    board.setThinLine('isoline');
    for (const { path } of this.#isolines) pen.stroke(path);
    this.#drawSamples(board);
    for (const line of this.things.values()) if (line.isLine && line.kind !== 'profile') this.#drawLine(board, line);
  }

  #drawSamples(board) {
    const { pen } = board;
    board.enterPage();
    pen.fillStyle = board.colour('sample');
    pen.beginPath();
    for (const { at, isSpot } of this.things.seen(board)) {
      if (!isSpot) continue;
      const [x, y] = board.toPage(at);
      pen.moveTo(x + 2, y);
      pen.arc(x, y, 2, 0, 2 * Math.PI);
    }
    pen.fill();
  }

  #drawLine(board, line) {
    if (line.kind === 'barrier' || line.kind === 'wall') this.drawLine(board, line, 'barrier', 5);
    else this.drawLine(board, line, line.kind === 'feature' ? 'river' : 'soft', 3);
  }

  drawFront(board) {
    const line = this.things.get(this.profileLine);
    if (line) {
      this.drawLine(board, line, 'profile', 2, [7, 5]);
      this.drawHandles(board, line, 'profile');
    }
    super.drawFront(board);
  }

  hover(p) {
    this.#askForValue(p);
    return this.words ?? '';
  }
  async #askForValue(p) {
    this.wanted = p;
    if (this.isAskingHere) return;
    this.isAskingHere = true;
    try {
      const { value } = await this.page.link.ask(`value?at=${p[0]},${p[1]}`);
      this.words = value === null ? 'no value' : short(value, 5);
      if (this.wanted) this.page.showHover(this.words);
    } catch { /* the next move asks again */ }
    this.isAskingHere = false;
    if (this.wanted && this.wanted !== p) this.#askForValue(this.wanted);
  }
  leave() { this.wanted = undefined; }

  // --- Panel ---

  show(panel) {
    this.chart = make('canvas', { id: 'profile', role: 'img', 'aria-label': 'Profile along the dashed line' });
    const climbs = figures('Up', 'Down');
    this.climbs = climbs.values;
    this.smooth = make('input', { type: 'checkbox', id: 'cubic', checked: Boolean(this.isCubic),
      onchange: () => this.page.send({ do: 'set', name: 'cubic', value: Number(this.smooth.checked) }) });
    const low = this.#picture?.low ?? 0;
    const high = this.#picture?.high ?? 1;
    this.value = slider('Value', 1000, 1, (part) => {
      const { low: least, high: most } = this.#picture ?? { low, high };
      this.#setValue(least + part / 1000 * (most - least));
    });
    this.kind = make('p', { className: 'hint' });
    panel.replaceChildren(
      section('Profile along the dashed line', this.chart, climbs.list),
      section('Surface', make('label', { className: 'switch' }, this.smooth, ' Smooth (cubic)')),
      section('Chosen', this.kind, this.value.element),
      section('New and chosen', make('p', { className: 'buttons' },
        button('+ sample', 'In the middle (I)', () => this.insert(this.board.view.middle)),
        button('+ barrier', 'A line that nothing crosses', () => this.#insertLine('barrier')),
        button('Remove', 'Take it away (Del)', () => this.remove()))));
    this.showChosen();
    this.#drawProfile();
    if (this.hasBegun) this.#refresh();
  }

  showFigures() {
    if (this.smooth) this.smooth.checked = Boolean(this.isCubic);
    this.showChosen();
  }

  showChosen() {
    if (!this.kind) return;
    const thing = this.things.get(this.chosen);
    const words = { feature: 'A river, or a shore: its own values, a crease. Drag its corners.',
                    wall: 'A dam: a value on each of its sides. Drag it, or its corners.',
                    barrier: 'A barrier: nothing crosses it. Drag its corners.',
                    soft: 'A line on the surface.', profile: 'The line of the profile. Drag its corners.' };
    const isSample = Boolean(thing?.isSpot);
    this.value.element.hidden = !isSample;
    this.kind.textContent = isSample ? 'A sample: drag it, or give it another value ([ and ]).'
      : words[thing?.kind] ?? 'Drag samples, the river, the dam, or the ends of the dashed line.';
    if (!isSample) return;
    const { low, high } = this.#picture ?? { low: 0, high: 1 };
    this.value.set(Math.round(1000 * (thing.value - low) / (high - low || 1)), short(thing.value));
  }

  // Values upwards, the way to the right; where there is a jump, a step; where there is none, a hole.
  #drawProfile() {
    if (!this.chart || !this.#profile) return;
    const { points, up, down } = this.#profile;
    this.climbs.Up.textContent = short(up);
    this.climbs.Down.textContent = short(down);
    const ratio = devicePixelRatio;
    const [width, height] = [this.chart.clientWidth, this.chart.clientHeight];
    this.chart.width = width * ratio;
    this.chart.height = height * ratio;
    const pen = this.chart.getContext('2d');
    const values = points.flatMap(([, before, after]) => [before, after]).filter((value) => value !== null);
    if (values.length === 0) return;
    const low = Math.min(...values);
    const high = Math.max(...values, low + 1e-12);
    const length = points.at(-1)[0] || 1;
    const x = (distance) => 2 + (width - 4) * distance / length;
    const y = (value) => height - 16 - (height - 32) * (value - low) / (high - low);
    const { board } = this.page;
    pen.scale(ratio, ratio);
    this.#tracePiece(pen, points, x, y);
    pen.strokeStyle = board.colour('profile');
    pen.lineWidth = 2;
    pen.stroke();
    pen.fillStyle = board.colour('quiet');
    pen.font = '11px system-ui, sans-serif';
    pen.fillText(short(high), 4, 11);
    pen.fillText(short(low), 4, height - 3);
  }

  #tracePiece(pen, points, x, y) {
    pen.beginPath();
    let isDown = false;
    for (const [distance, before, after] of points) {
      if (before !== null && isDown) pen.lineTo(x(distance), y(before));
      isDown = after !== null;
      if (!isDown) continue;
      if (before === null) pen.moveTo(x(distance), y(after));
      else pen.lineTo(x(distance), y(after));
    }
  }
}
