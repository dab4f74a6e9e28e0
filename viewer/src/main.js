// SPDX-License-Identifier: MIT
import { Drawer } from './drawer.js';
import { Events } from './events.js';
import { Figures } from './figures.js';
import { nameOf } from './frame.js';
import { History } from './history.js';
import { listenToKeys } from './keys.js';
import { LabelList } from './label_list.js';
import { Labels } from './labels.js';
import { Panel } from './panel.js';
import { onClick } from './pick.js';
import { Settings } from './settings.js';
import { Table } from './table.js';
import { Theme } from './theme.js';
import { View } from './view.js';

const element = (id) => document.getElementById(id);

const panel = new Panel();
const theme = new Theme();
const settings = new Settings();
const events = new Events();
const figures = new Figures();
const history = new History();
const drawer = new Drawer();
const labels = new Labels();
const labelList = new LabelList(labels);
const table = new Table(figures, labels);
const view = makeView();

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
  element('theme').setAttribute('aria-pressed', String(theme.isDark));
}

function help() {
  element('help').showModal();
}

function listen() {
  events.addEventListener('connected', () => panel.showConnected());
  events.addEventListener('lost', () => panel.showLost());
  events.addEventListener('status', ({ detail }) => panel.showStatus(detail));
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

function showSurface() {
  events.addEventListener('reset', ({ detail }) => {
    view.reset(detail);
    settings.setHeights(view.heights, view.range, view.unit);
    view.apply(settings);
  });
  events.addEventListener('change', ({ detail }) => {
    panel.addLatency(detail.latency_ms);
    if (!view.change(detail)) return events.restart();  // something was missed
    settings.setHeights(view.heights, view.range, view.unit);
    view.apply(settings);
  });
}

async function pick(x, y) {
  const nearest = await view.pick(x, y);
  if (nearest) settings.choose(nearest.slice.z);
  view.apply(settings);
  showFiguresOf(panel.pickedLabel);
}

async function showFiguresOf(label) {
  const found = label === undefined ? undefined : await figures.of(label);
  if (found) panel.addFigures(label, found, figures.measure);
}

function forgetPick() {
  view.forgetPick();
  labels.choose(undefined);
}

function connectControls() {
  settings.addEventListener('change', () => view.apply(settings));
  theme.addEventListener('change', applyTheme);
  element('fit').addEventListener('click', () => view.fit());
  element('theme').addEventListener('click', () => theme.toggle());
  element('help-open').addEventListener('click', help);
  onClick(element('canvas'), pick);
  listenToKeys(view.stage, {
    f: () => view.fit(),
    c: () => settings.toggle('contours'),
    s: () => settings.reach('slice'),
    x: () => settings.reach('cut'),
    v: () => settings.toggle('cut-below'),
    l: () => settings.nextColour(),
    p: () => pick(0, 0),
    t: () => theme.toggle(),
    '?': help,
    h: () => labelList.toggleChosen(),
    i: () => labelList.isolateChosen(),
    '/': () => labelList.search(),
    g: () => table.open(),
    'ctrl+z': () => history.undo(),
    'ctrl+shift+z': () => history.redo(),
    escape: forgetPick,
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
