// SPDX-License-Identifier: MIT
// What the colour of a slab says: its label, how long ago it changed, how sure it is.
import { Color } from 'three';

// From low to high; every step differs in lightness, too.
const ramps = {
  age: ['#f6c445', '#e07b54', '#a4507d', '#5b4a8a', '#39466b'],
  confidence: ['#c0392b', '#e08a4f', '#e9d69a', '#7fb8a4', '#2f7f8f'],
};
const unknown = new Color('#9aa3ab');

function onRamp(ramp, share, target) {
  const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
  const step = Math.min(Math.floor(place), ramp.length - 2);
  return target.set(ramp[step]).lerp(new Color(ramp[step + 1]), place - step);
}

function byLabel(slab, target) {
  return slab.colour ? target.setRGB(...slab.colour) : target.copy(unknown);
}

// The newest edits are told apart best.
function byAge(slab, target, { edits, first }) {
  const share = Math.log2(1 + edits - slab.edit) / Math.log2(2 + edits - first);
  return onRamp(ramps.age, share, target);
}

function byConfidence(slab, target) {
  if (!Number.isFinite(slab.confidence)) return target.copy(unknown);
  return onRamp(ramps.confidence, slab.confidence, target);
}

// A function (slab, target) for one way of colouring.
export function colouring(mode, slabs, edits) {
  if (mode === 'confidence') return byConfidence;
  if (mode !== 'age') return byLabel;
  let first = edits;
  for (const slab of slabs) first = Math.min(first, slab.edit);
  return (slab, target) => byAge(slab, target, { edits, first });
}

function element(name, className, text = '') {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text;
  return made;
}

function swatches(labels) {
  const list = document.createElement('ul');
  for (const [label, colour] of labels) {
    const item = element('li', '');
    const swatch = element('span', 'swatch');
    swatch.style.background = `#${byLabel({ colour }, new Color()).getHexString()}`;
    item.append(swatch, label || 'no label');
    list.append(item);
  }
  return list;
}

function ramp(mode) {
  const bar = element('div', 'ramp');
  bar.style.background = `linear-gradient(to right, ${ramps[mode].join(', ')})`;
  const ends = element('div', 'ends');
  const texts = mode === 'age' ? ['newest', 'oldest'] : ['unsure', 'sure'];
  ends.append(...texts.map((text) => element('span', '', text)));
  return [bar, ends];
}

// `labels`: the colour of each.
export function fillLegend(legend, mode, labels) {
  legend.replaceChildren(...(mode === 'label' ? [swatches(labels)] : ramp(mode)));
}
