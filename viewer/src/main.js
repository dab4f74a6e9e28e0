// SPDX-License-Identifier: MIT
import { lookAlong } from './axis_views.js';
import { CutControls } from './cut_controls.js';
import { Drawer } from './drawer.js';
import { Events } from './events.js';
import { Figures } from './figures.js';
import { nameOf } from './frame.js';
import { History } from './history.js';
import { listenToKeys } from './keys.js';
import { LabelList } from './label_list.js';
import { Labels } from './labels.js';
import { Measuring } from './measuring.js';
import { Overlay } from './overlay.js';
import { Panel } from './panel.js';
import { onClick } from './pick.js';
import { savePicture } from './screenshot.js';
import { Settings } from './settings.js';
import { Table } from './table.js';
import { Theme } from './theme.js';
import { View } from './view.js';

const element = (id) => document.getElementById(id);

const panel = new Panel();
const theme = new Theme();
const settings = new Settings();
const cut = new CutControls();
const events = new Events();
const figures = new Figures();
const history = new History();
const drawer = new Drawer();
const labels = new Labels();
const labelList = new LabelList(labels);
const table = new Table(figures, labels);
const view = makeView();
const measuring = view && new Measuring(view, element('figures'));
const overlay = new Overlay();

// None where the browser has no WebGL.
function makeView() {
  const lengths = [...document.querySelectorAll('#lengths span')];
  try {
    return new View(element('canvas'), lengths, panel, labels, () => events.restart());
  } catch {
    element('no-picture').hidden = false;
    return undefined;
  }
}

function applyTheme() {
  view.setColours({ background: theme.colour('stage'), grid: theme.colour('grid'),
                    lines: theme.colour('contour'), accent: theme.colour('accent') });
  measuring.colour = theme.colour('accent');
  element('theme').setAttribute('aria-pressed', String(theme.isDark));
}

function help() {
  element('help').showModal();
}

function listen() {
  events.addEventListener('connected', () => panel.showConnected());
  events.addEventListener('lost', () => panel.showLost());
  events.addEventListener('status', ({ detail }) => {
    panel.showStatus(detail);
    history.showStatus(detail);
  });
  events.addEventListener('reset', ({ detail }) => {
    panel.showKind(detail);
    figures.reset(detail);
    history.reset(detail, nameOf(detail.unit));
  });
  events.addEventListener('change', () => {
    figures.wear();
    history.wear();
  });
  figures.addEventListener('known', ({ detail }) => labels.learn(detail ?? []));
  labels.addEventListener('choice', () => drawer.showPicked(labels.chosen));
}

// Counts alone.
function showCounts() {
  let unit;
  events.addEventListener('reset', ({ detail }) => {
    unit = nameOf(detail.unit);
    panel.showDownloads(detail.downloads);
    panel.showCounts({ ...detail, unit });
    panel.showPending(0, false);
  });
  events.addEventListener('change', ({ detail }) => {
    panel.addLatency(detail.latency_ms);
    panel.showCounts({ ...detail, unit });
  });
}

function setHeights() {
  settings.setHeights(view.heights, view.unit);
  cut.setHeights(view.heights, view.range, view.unit);
}

function showSurface() {
  events.addEventListener('reset', ({ detail }) => {
    view.reset(detail);
    overlay.isPatient = detail.is_patient === true;
    setHeights();
    view.apply(settings);
  });
  events.addEventListener('change', ({ detail }) => {
    panel.addLatency(detail.latency_ms);
    if (!view.change(detail)) return events.restart();  // something was missed
    setHeights();
    view.apply(settings);
  });
}

async function pick(x, y) {
  if (measuring.isOn) return measuring.add(x, y);
  const nearest = await view.pick(x, y);
  if (nearest) settings.choose(nearest.slice.z);
  view.apply(settings);
  showFiguresOf(panel.pickedLabel);
}

async function showFiguresOf(label) {
  const found = label === undefined ? undefined : await figures.of(label);
  if (found) panel.addFigures(label, found, figures.measure);
}

function savePng() {
  const words = document.querySelectorAll('#lengths span, #figures span, #letters span, #scale span');
  return savePicture(view.stage, Number(element('picture-size').value),
                     { words, bar: element('scale') }, 'surface.png');
}

function toggleParallel() {
  view.stage.toggleParallel();
  element('parallel').setAttribute('aria-pressed', String(view.stage.isParallel));
}

function connectPicture() {
  view.stage.onFrame(() => overlay.follow(view.stage, view.frame, view.unit));
  element('parallel').addEventListener('click', toggleParallel);
  for (const axis of ['x', 'y', 'z'])
    element(`along-${axis}`).addEventListener('click', ({ shiftKey }) => {
      lookAlong(view.stage, axis, shiftKey);
      view.stage.invalidate();
    });
  element('picture').addEventListener('click', savePng);
}

function forget() {
  measuring.drop();
  view.forgetPick();
  labels.choose(undefined);
}

function connectControls() {
  connectPicture();
  settings.addEventListener('change', () => view.apply(settings));
  view.cut.control(cut);
  for (const axis of ['x', 'y', 'z'])
    element(`cut-${axis}`).addEventListener('click', () => view.cut.cutAcross(axis));
  element('cut-view').addEventListener('click', () => view.cut.faceEye());
  theme.addEventListener('change', applyTheme);
  element('fit').addEventListener('click', () => view.fit());
  element('theme').addEventListener('click', () => theme.toggle());
  element('help-open').addEventListener('click', help);
  onClick(element('canvas'), pick);
  listenToKeys(view.stage, {
    f: () => view.fit(),
    c: () => settings.toggle('contours'),
    s: () => settings.reach('slice'),
    x: () => cut.reach(),
    'shift+x': () => view.cut.cutAcross('x'),
    'shift+y': () => view.cut.cutAcross('y'),
    'shift+z': () => view.cut.cutAcross('z'),
    n: () => view.cut.faceEye(),
    ',': () => cut.step(false),
    '.': () => cut.step(true),
    v: () => cut.toggle('cut-below'),
    b: () => cut.toggle('cut-slab'),
    l: () => settings.nextColour(),
    m: () => measuring.toggle(),
    'shift+m': () => measuring.nextKind(),
    backspace: () => measuring.removeLast(),
    delete: () => measuring.removeLast(),
    1: () => lookAlong(view.stage, 'x'),
    2: () => lookAlong(view.stage, 'y'),
    3: () => lookAlong(view.stage, 'z'),
    'shift+1': () => lookAlong(view.stage, 'x', true),
    'shift+2': () => lookAlong(view.stage, 'y', true),
    'shift+3': () => lookAlong(view.stage, 'z', true),
    5: toggleParallel,
    o: toggleParallel,
    'shift+p': savePng,
    p: () => pick(0, 0),
    t: () => theme.toggle(),
    '?': help,
    h: () => labelList.toggleChosen(),
    i: () => labelList.isolateChosen(),
    '/': () => labelList.search(),
    g: () => table.open(),
    'ctrl+z': () => history.undo(),
    'ctrl+shift+z': () => history.redo(),
    escape: forget,
  });
}

listen();
if (view) {
  applyTheme();
  connectControls();
  showSurface();
} else {
  showCounts();
}
events.start();
