// SPDX-License-Identifier: MIT
// The colour of a slab: by its label, by how long ago it was made, by how sure it is.
import { Color } from 'three';

// Told apart by those who do not see red or green, too.
const ages = ['#31456b', '#3f7f93', '#7db58d', '#f2dd83'];
const confidences = ['#b3452c', '#e2a45e', '#d9dcdc', '#3f7ea6'];

export function ramp(colours, share) {
  const place = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const lower = Math.min(Math.floor(place), colours.length - 2);
  return new Color(colours[lower]).lerp(new Color(colours[lower + 1]), place - lower);
}

function gradient(colours) {
  return `linear-gradient(to right, ${colours.join(', ')})`;
}

function byLabel(slab) {
  return new Color(...(slab.colour ?? [0.6, 0.66, 0.72]));
}

// A function that gives slabs their colour, and the legend that explains it.
export function colouring(mode, slabs) {
  if (mode === 'age') {
    const edits = slabs.map((slab) => slab.edit);
    const oldest = edits.reduce((a, b) => Math.min(a, b), Infinity);
    const newest = edits.reduce((a, b) => Math.max(a, b), -Infinity);
    const share = (edit) => (newest > oldest ? (edit - oldest) / (newest - oldest) : 1);
    const ends = slabs.length > 0 ? [`edit ${oldest}`, `edit ${newest}`] : ['oldest', 'newest'];
    return { of: (slab) => ramp(ages, share(slab.edit)), gradient: gradient(ages), ends };
  }
  if (mode === 'confidence') {
    return { of: (slab) => ramp(confidences, slab.confidence), gradient: gradient(confidences),
             ends: ['0 unsure', '1 sure'] };
  }
  const labels = new Map();
  for (const slab of slabs) if (slab.colour) labels.set(slab.label, byLabel(slab));
  return { of: byLabel, labels: [...labels].sort(([a], [b]) => (a < b ? -1 : 1)) };
}

// Fills `list` with what the colours mean.
export function explain(list, { gradient: bar, ends, labels }) {
  list.replaceChildren();
  if (bar) {
    const item = list.appendChild(document.createElement('li'));
    item.className = 'ramp';
    const swatch = item.appendChild(document.createElement('span'));
    swatch.className = 'bar';
    swatch.style.backgroundImage = bar;
    for (const end of ends) item.appendChild(document.createElement('span')).textContent = end;
    return;
  }
  for (const [label, colour] of labels) {
    const item = list.appendChild(document.createElement('li'));
    const swatch = item.appendChild(document.createElement('span'));
    swatch.className = 'swatch';
    swatch.style.backgroundColor = `#${colour.getHexString()}`;
    item.append(label || 'without a label');
  }
}
