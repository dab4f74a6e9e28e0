// SPDX-License-Identifier: MIT
import { Board } from './board.js';
import { Classes } from './classes.js';
import { listenToKeys } from './keys.js';
import { Fields } from './field.js';
import { Link } from './link.js';
import { counted, make, microseconds } from './make.js';
import { Atlas } from './map.js';
import { Rooms } from './paths.js';
import { listenToPointers } from './pointer.js';
import { Shapes } from './shapes.js';
import { Theme } from '../src/theme.js';
import { Triangles } from './triangles.js';

const mostDelays = 1000;

const element = (id) => document.getElementById(id);

const link = new Link();
const theme = new Theme();
let tab;

// What tabs see of the page.
const page = {
  link,
  board: new Board(element('canvas'), element('front'), { draw, drawFront }),
  send,
  say: (words) => { element('announcement').textContent = words; },
  isShown: (one) => one === tab,
  showPanel: () => tab.show(element('panel')),
  showHover,
  drawn: 0,      // the last event that is in the picture
  delays: [],    // ms from what a pointer or key did to the picture
};
globalThis.live = page;  // for tests

const triangles = new Triangles(page);
const tabs = [new Shapes(page), new Atlas(page), new Rooms(page), new Fields(page), new Classes(page)];
const waiting = new Map();  // events that are not in the picture yet: when they were asked for

function draw(board) {
  if (!tab?.hasBegun) return;
  tab.draw(board);
  triangles.draw(board);
}

function drawFront(board, now) {
  if (!tab?.hasBegun) return false;
  const goesOn = tab.drawFront(board, now);
  page.drawn = tab.shownEvent;
  measureDelays();
  return goesOn;
}

// --- Edits, and how long they take to be seen ---

async function send(edit, key) {
  const begin = performance.now();
  complain('');
  const event = await link.send(edit, key);
  if (event !== undefined) {
    waiting.set(event, begin);
    page.board.invalidateFront();
  }
  return event;
}

function measureDelays() {
  for (const [event, begin] of waiting) {
    if (event > page.drawn) continue;
    waiting.delete(event);
    page.delays.push(performance.now() - begin);
    if (page.delays.length > mostDelays) page.delays.shift();
    element('delay').textContent = `in the picture after ${page.delays.at(-1).toFixed(0)} ms`;
  }
}

function complain(words) {
  element('complaint').hidden = !words;
  element('complaint').textContent = words;
}

// --- What the program says ---

function take(kind, { content, event }) {
  tab.take(kind, content, event);
  tab.last = link.last;
  element('canvas').setAttribute('aria-busy', 'false');
  showCost(content);
  triangles.refresh();
  page.board.invalidateFront();
}

function showCost({ microseconds: took, made, triangles: count, vertices }) {
  if (took === undefined) return;
  if (took > 0) element('cost').textContent = microseconds(took);
  const all = `${counted(count)} triangles, ${counted(vertices)} vertices`;
  element('made').textContent = made > 0 ? `${counted(made)} new of ${all}` : all;
}

function listenToLink() {
  link.addEventListener('reset', ({ detail }) => take('reset', detail));
  link.addEventListener('change', ({ detail }) => take('change', detail));
  link.addEventListener('refused', ({ detail }) => complain(detail.why));
  link.addEventListener('connected', () => showState('live', 'Live'));
  link.addEventListener('lost', () => showState('lost', 'Lost'));
}
function showState(state, words) {
  element('state').dataset.state = state;
  element('state').textContent = words;
  element('banner').hidden = state !== 'lost';
}

// --- Tabs ---

function makeTabs() {
  tabs.forEach((one, i) => {
    one.button = make('button', { type: 'button', id: `tab-${one.name}`, role: 'tab', title: `${one.title} (${i + 1})`,
      'aria-controls': 'stage', onclick: () => show(one) }, one.title);
    element('tabs').append(one.button);
  });
}

function show(next) {
  if (next === tab) return;
  tab = next;
  for (const one of tabs) one.button.setAttribute('aria-selected', String(one === tab));
  history.replaceState(null, '', `#${tab.name}`);
  element('canvas').setAttribute('aria-busy', String(!tab.hasBegun));
  element('cost').textContent = '–';
  showHover('');
  complain('');
  waiting.clear();
  triangles.forget();
  page.board.show(tab.view);
  page.showPanel();
  link.follow(tab.name, tab.last);
  triangles.refresh();
}

async function firstTab() {
  const named = tabs.find((one) => `#${one.name}` === location.hash);
  if (named) return named;
  const { first } = await (await fetch('tabs')).json();
  return tabs.find((one) => one.name === first) ?? tabs[0];
}

// --- Pointer and keys ---

function showHover(words, at) {
  const hover = element('hover');
  if (at) hover.style.transform = `translate(${at[0] + 14}px, ${at[1] + 16}px)`;
  hover.hidden = !words;
  hover.textContent = words ?? '';
}

const target = {
  grab: (p, near) => { showHover(''); return tab.grab(p, near); },
  choose: (id) => tab.choose(id),
  insert: (p) => { if (tab.find(p, 0) === undefined) tab.insert(p); },
  hover: (p, near, at) => showHover(tab.hover(p, near), at),
  leave: () => { showHover(''); tab.leave?.(); },
};

function listenToControls() {
  const { board } = page;
  const toggleTriangles = () => {
    triangles.toggle();
    element('triangles').setAttribute('aria-pressed', String(triangles.isShown));
    board.invalidate();
  };
  const help = () => element('help').showModal();
  element('fit').addEventListener('click', () => board.fit());
  element('triangles').addEventListener('click', toggleTriangles);
  element('theme').addEventListener('click', () => theme.toggle());
  element('help-open').addEventListener('click', help);
  theme.addEventListener('change', showTheme);
  listenToPointers(element('canvas'), board, target);
  listenToKeys(board, () => tab, {
    t: toggleTriangles, d: () => theme.toggle(), f: () => board.fit(), '?': help,
    tab: (number) => { if (tabs[number]) show(tabs[number]); },
  });
}
function showTheme() {
  element('theme').setAttribute('aria-pressed', String(theme.isDark));
  page.board.forgetColours();
  tab?.showTheme?.();
  page.board.invalidate();
}

makeTabs();
listenToLink();
listenToControls();
showTheme();
show(await firstTab());
