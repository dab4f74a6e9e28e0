// SPDX-License-Identifier: MIT
// The colour of a slab: by its label, by how long ago it was made, by how sure it is.
import { Color } from 'three';

// Told apart by those who do not see red or green, too.
const ages = ['#31456b', '#3f7f93', '#7db58d', '#f2dd83'];
const confidences = ['#b3452c', '#e2a45e', '#d9dcdc', '#3f7ea6'];

function onRamp(colours, share) {
  const place = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const lower = Math.min(Math.floor(place), colours.length - 2);
  return new Color(colours[lower]).lerp(new Color(colours[lower + 1]), place - lower);
}

function gradient(colours) {
  return `linear-gradient(to right, ${colours.join(', ')})`;
}

const unnamed = [0.6, 0.66, 0.72];

// `#rrggbb` of what a slab came with.
export function hexOf({ colour }) {
  return colour && `#${new Color(...colour).getHexString()}`;
}

function byLabel(labels) {
  const colours = new Map();
  const make = (label) => {
    const colour = labels.colour(label);
    return colour ? new Color(colour) : new Color(...unnamed);
  };
  return { of: ({ label }) => {
    if (!colours.has(label)) colours.set(label, make(label));
    return colours.get(label);
  } };
}

function byAge(slabs) {
  let [oldest, newest] = [Infinity, -Infinity];
  for (const { edit = 0 } of slabs) {
    oldest = Math.min(oldest, edit);
    newest = Math.max(newest, edit);
  }
  const share = (edit = 0) => (newest > oldest ? (edit - oldest) / (newest - oldest) : 1);
  const ends = slabs.length > 0 ? [`edit ${oldest}`, `edit ${newest}`] : ['oldest', 'newest'];
  return { of: (slab) => onRamp(ages, share(slab.edit)), gradient: gradient(ages), ends };
}

function byConfidence() {
  return { of: ({ confidence = 1 }) => onRamp(confidences, confidence),
           gradient: gradient(confidences), ends: ['unsure', 'sure'] };
}

// What gives slabs their colour (`of`), and what the legend has to say about it.
export function colouring(mode, slabs, labels) {
  if (mode === 'age') return byAge(slabs);
  if (mode === 'confidence') return byConfidence();
  return byLabel(labels);
}

function add(parent, className, text = '') {
  const element = parent.appendChild(document.createElement('span'));
  element.className = className;
  element.textContent = text;
  return element;
}

// Fills `legend` with what the colours mean; those of labels are told by their list.
export function explain(legend, { gradient: bar, ends }) {
  legend.hidden = !bar;
  legend.replaceChildren();
  if (!bar) return;
  add(legend, 'bar').style.backgroundImage = bar;
  for (const end of ends) add(legend, '', end);
}
