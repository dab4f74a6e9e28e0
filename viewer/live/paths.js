// SPDX-License-Identifier: MIT
// A room with boxes and walls, and agents that walk. The program says what way each has, and since when:
// from that the page knows where they are at any time.

import { button, figures, make, section, short, slider } from './make.js';
import { Tab, box } from './tab.js';

const channelPause = 120;  // ms between two looks at the channel

export class Rooms extends Tab {
  #agents = new Map();
  #time = 0;    // of the program
  #since = 0;   // of the page, when it was that
  #radius = 0;
  #pace = 0;
  #channel;
  #channelTime = 0;
  #pointer;     // and the clearance there

  constructor(page) { super(page, 'paths', 'Paths'); }

  // --- What the program says ---

  reset(state) {
    this.#agents.clear();
    this.box = state.box;
    this.largest = state.largest_radius;
    for (const item of state.items) this.#addItem(item);
    for (const agent of state.agents) this.#addAgent(agent);
    this.#takeSettings(state);
  }
  change(change) {
    for (const item of change.items ?? []) this.#addItem(item);
    for (const id of change.removed ?? []) {
      if (this.#agents.delete(id)) this.choose(undefined);
      else this.removeThing(id);
    }
    for (const { id, at } of change.moved ?? []) this.placeThing(id, at);
    for (const agent of change.agents ?? []) this.#addAgent(agent);
    this.#takeSettings(change);
  }
  #addItem(item) { this.addThing({ ...item, isLine: item.kind === 'wall' }); }
  #takeSettings({ time, radius, pace }) {
    if (time !== undefined) {
      this.#time = time;
      this.#since = performance.now();
    }
    this.#radius = radius ?? this.#radius;
    this.#pace = pace ?? this.#pace;
  }

  #addAgent(agent) {
    const way = Float64Array.from(agent.way);
    const lengths = new Float64Array(way.length / 2);
    for (let i = 1; i < lengths.length; ++i)
      lengths[i] = lengths[i - 1] + Math.hypot(way[2 * i] - way[2 * i - 2], way[2 * i + 1] - way[2 * i - 1]);
    this.#agents.set(agent.id, { ...agent, way, lengths });
  }

  get now() { return this.#time + (performance.now() - this.#since) / 1000; }

  // Where an agent is: the place, and the piece of its way.
  #place(agent) {
    const { way, lengths } = agent;
    const distance = Math.max(0, (this.now - agent.since) * this.#pace);
    let i = 1;
    while (i < lengths.length && lengths[i] < distance) ++i;
    if (i >= lengths.length) return { at: [way[way.length - 2], way[way.length - 1]], next: lengths.length };
    const part = (distance - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return { at: [way[2 * i - 2] + part * (way[2 * i] - way[2 * i - 2]),
                  way[2 * i - 1] + part * (way[2 * i + 1] - way[2 * i - 1])], next: i };
  }

  // --- What is done ---

  has(id) { return this.#agents.has(id) || super.has(id); }
  choices() { return [...this.#agents.keys(), ...this.things.ids]; }
  nameOf(id) { return this.#agents.has(id) ? `agent ${id}` : `${this.things.get(id)?.kind ?? ''} ${id}`; }

  find(p, near) {
    for (const [id, agent] of this.#agents) {
      const { at } = this.#place(agent);
      if (Math.hypot(p[0] - at[0], p[1] - at[1]) <= Math.max(this.#radius, near)) return id;
    }
    return super.find(p, near);
  }

  // Of an agent, its goal.
  grab(p, near) {
    const id = this.find(p, near);
    const chosen = this.#agents.get(this.chosen);
    const isAtGoal = chosen && Math.hypot(p[0] - chosen.goal[0], p[1] - chosen.goal[1]) <= 2 * near;
    if (!isAtGoal && !this.#agents.has(id)) return super.grab(p, near);
    if (!isAtGoal) this.choose(id);
    const agent = this.chosen;
    return {
      move: (at) => {
        this.#agents.get(agent).goal = at;
        this.page.send({ do: 'move', id: agent, at }, `move ${agent}`);
      },
      end: () => {},
    };
  }
  moveBy(id, by) {
    const agent = this.#agents.get(id);
    if (!agent) return super.moveBy(id, by);
    this.page.send({ do: 'move', id, at: [agent.goal[0] + by[0], agent.goal[1] + by[1]] }, `move ${id}`);
    return undefined;
  }
  insert(p) { this.page.send({ do: 'insert', points: box(p, 0.8 * this.size(), 0.5 * this.size()) }); }

  // --- Picture ---

  draw(board) {
    const { pen } = board;
    board.enterPlaneItself();
    const [left, low, right, high] = this.box ?? [0, 0, 0, 0];
    pen.fillStyle = board.colour('floor');
    pen.fillRect(left, low, right - left, high - low);
    const seen = [...this.things.seen(board)];
    const walls = seen.filter(({ isLine }) => isLine);
    pen.fillStyle = board.colour('box');
    board.setThinLine('outline');
    for (const thing of seen) {
      if (thing.isLine) continue;
      const path = this.things.enter(board, thing);
      pen.fill(path, 'nonzero');
      pen.stroke(path);
    }
    this.#drawWalls(board, walls);
  }

  #drawWalls(board, walls) {
    board.pen.strokeStyle = board.colour('wall');
    board.pen.lineWidth = board.px(4);
    for (const wall of walls) board.pen.stroke(this.things.enter(board, wall));
  }

  drawFront(board) {
    board.enterPlaneItself();
    this.#drawChannel(board);
    const { pen } = board;
    const chosen = this.things.get(this.chosen);
    if (chosen) {
      const path = this.things.enter(board, chosen);
      pen.strokeStyle = board.colour('accent');
      pen.lineWidth = board.px(chosen.isLine ? 4 : 2);
      pen.stroke(path);
      board.enterPlaneItself();
    }
    this.#drawClearance(board);
    for (const agent of this.#agents.values()) this.#drawAgent(board, agent);
    pen.globalAlpha = 1;
    return this.#agents.size > 0 && this.#pace > 0;
  }

  #drawChannel(board) {
    const agent = this.#agents.get(this.chosen);
    if (!agent) return;
    this.#askForChannel(agent.id);
    const triangles = this.#channel?.id === agent.id ? this.#channel.triangles : [];
    const { pen } = board;
    pen.fillStyle = board.colour('channel');
    pen.strokeStyle = board.colour('channel-edge');
    pen.lineWidth = board.px(1);
    pen.beginPath();
    for (let i = 0; i < triangles.length; i += 6) {
      pen.moveTo(triangles[i], triangles[i + 1]);
      pen.lineTo(triangles[i + 2], triangles[i + 3]);
      pen.lineTo(triangles[i + 4], triangles[i + 5]);
      pen.closePath();
    }
    pen.fill();
    pen.stroke();
  }

  #drawClearance(board) {
    if (!this.#pointer?.clearance) return;
    const { pen } = board;
    pen.beginPath();
    pen.arc(...this.#pointer.at, this.#pointer.clearance, 0, 2 * Math.PI);
    pen.setLineDash([board.px(4), board.px(4)]);
    pen.lineWidth = board.px(1);
    pen.strokeStyle = board.colour('quiet');
    pen.stroke();
    pen.setLineDash([]);
  }

  #drawAgent(board, agent) {
    const { pen } = board;
    const { at, next } = this.#place(agent);
    const isChosen = agent.id === this.chosen;
    const isOne = isChosen || this.#agents.size <= 20;
    const hue = `hsl(${agent.id * 137.508 % 360} ${board.colour('agent')})`;
    pen.strokeStyle = isChosen ? board.colour('accent') : hue;
    pen.globalAlpha = isOne ? 0.9 : 0.4;
    pen.lineWidth = board.px(isChosen ? 2.5 : isOne ? 1.4 : 1 / devicePixelRatio);
    pen.beginPath();
    pen.moveTo(...at);
    for (let i = next; i < agent.lengths.length; ++i) pen.lineTo(agent.way[2 * i], agent.way[2 * i + 1]);
    pen.stroke();
    pen.globalAlpha = 1;
    pen.fillStyle = agent.status === 'found' ? (isChosen ? board.colour('accent') : hue) : board.colour('lost');
    pen.beginPath();
    pen.arc(...at, Math.max(this.#radius, board.px(3.5)), 0, 2 * Math.PI);
    pen.fill();
    pen.lineWidth = board.px(isOne ? 1.6 : 1 / devicePixelRatio);
    pen.beginPath();
    pen.arc(...agent.goal, board.px(isChosen ? 6 : 3), 0, 2 * Math.PI);
    pen.stroke();
  }

  // --- What the program knows ---

  async #askForChannel(id) {
    if (this.isAsking || performance.now() - this.#channelTime < channelPause) return;
    this.isAsking = true;
    try {
      this.#channel = { id, ...await this.page.link.ask(`channel?id=${id}`) };
      this.#showAgent();
    } catch { /* it is gone */ }
    this.#channelTime = performance.now();
    this.isAsking = false;
  }

  hover(p) {
    this.#askForClearance(p);
    return this.#pointer ? `clearance ${short(this.#pointer.clearance)}` : '';
  }
  async #askForClearance(p) {
    this.wanted = p;
    if (this.isAskingHere) return;
    this.isAskingHere = true;
    try {
      const { clearance } = await this.page.link.ask(`clearance?at=${p[0]},${p[1]}`);
      this.#pointer = { at: p, clearance };
      this.page.showHover(`clearance ${short(clearance)}`);
      this.board.invalidateFront();
    } catch { /* the next move asks again */ }
    this.isAskingHere = false;
    if (this.wanted !== p && this.wanted) this.#askForClearance(this.wanted);
  }
  leave() {
    this.wanted = undefined;
    this.#pointer = undefined;
    this.board.invalidateFront();
  }

  // --- Panel ---

  show(panel) {
    const set = (name) => (value) => this.page.send({ do: 'set', name, value }, `set ${name}`);
    const largest = this.largest ?? 1;
    this.radius = slider('Radius', largest, largest / 200, set('radius'));
    this.pace = slider('Pace', 4 * largest, largest / 50, set('pace'));
    const all = figures('On their way', 'Waiting');
    this.counts = all.values;
    const own = figures('Way', 'Clearance here', 'Widest disc to the goal');
    this.figures = own.values;
    own.values.Way.id = 'way';
    this.hint = make('p', { className: 'hint' }, 'Choose an agent: its channel and clearance are shown, its goal can be dragged.');
    panel.replaceChildren(
      section('All agents', this.radius.element, this.pace.element, all.list),
      section('Chosen agent', this.hint, own.list),
      section('New and chosen', make('p', { className: 'buttons' },
        button('+ box', 'In the middle (I)', () => this.insert(this.board.view.middle)),
        button('+ wall', 'In the middle', () => this.#insertWall()),
        button('+ agent', 'In the middle', () => this.page.send({ do: 'insert', name: 'agent', points: [this.board.view.middle] })),
        button('Remove', 'Take it away (Del)', () => this.remove()))));
    this.showFigures({});
    this.#showAgent();
  }
  #insertWall() {
    const [x, y] = this.board.view.middle;
    const size = this.size();
    this.page.send({ do: 'insert', name: 'wall', points: [[x, y - 1.5 * size], [x, y + 1.5 * size]] });
  }

  showFigures() {
    if (!this.counts) return;
    let waiting = 0;
    for (const agent of this.#agents.values()) if (agent.status !== 'found') ++waiting;
    this.counts['On their way'].textContent = String(this.#agents.size - waiting);
    this.counts.Waiting.textContent = String(waiting);
    this.radius.set(this.#radius);
    this.pace.set(this.#pace);
    this.#showAgent();
  }
  showChosen() { this.#showAgent(); }
  #showAgent() {
    if (!this.figures) return;
    const agent = this.#agents.get(this.chosen);
    this.hint.hidden = agent !== undefined;
    this.figures.Way.textContent = agent ? (agent.status === 'found' ? short(agent.length, 6) : agent.status) : '–';
    const channel = agent && this.#channel?.id === agent.id ? this.#channel : undefined;
    this.figures['Clearance here'].textContent = channel ? short(channel.clearance) : '–';
    this.figures['Widest disc to the goal'].textContent = channel ? (channel.widest < 0 ? 'none' : short(channel.widest)) : '–';
  }
}
