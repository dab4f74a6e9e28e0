// SPDX-License-Identifier: MIT
import { CutControls } from './cut_controls.js';
import { Events } from './events.js';
import { onClick } from './pick.js';
import { nameOf } from './frame.js';
import { listenToKeys } from './keys.js';
import { Panel } from './panel.js';
import { Settings } from './settings.js';
import { Theme } from './theme.js';
import { View } from './view.js';

const element = (id) => document.getElementById(id);

const panel = new Panel();
const theme = new Theme();
const settings = new Settings();
const cut = new CutControls();
const events = new Events();
const view = makeView();

// None where the browser has no WebGL.
function makeView() {
  const lengths = [...document.querySelectorAll('#lengths span')];
  try {
    return new View(element('canvas'), lengths, panel, () => events.restart());
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
}

// Figures alone.
function showFigures() {
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
  const nearest = await view.pick(x, y);
  if (nearest) settings.choose(nearest.slice.z);
  view.apply(settings);
}

function connectControls() {
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
    p: () => pick(0, 0),
    t: () => theme.toggle(),
    '?': help,
    escape: () => view.forgetPick(),
  });
}

listen();
if (view) {
  applyTheme();
  connectControls();
  showSurface();
} else {
  showFigures();
}
events.start();
