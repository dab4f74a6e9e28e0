// SPDX-License-Identifier: MIT
// The keyboard. Arrows belong to the control that has the focus, letters to the page.

const turn = Math.PI / 24;
const zooms = { '+': 'dollyIn', '=': 'dollyIn', '-': 'dollyOut' };
const nearer = 1 / 1.15;  // what dollyIn multiplies the distance by

// Arrows move sliders and choose in lists; letters choose in lists.
function takesArrows(target) {
  return target instanceof HTMLSelectElement || target.type === 'range';
}
function takesLetters(target) {
  return target instanceof HTMLSelectElement;
}

function move(controls, event) {
  const step = 40;
  const ways = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const [x, y] = ways[event.key];
  controls.dispatchEvent({ type: 'start' });
  if (event.shiftKey) {
    controls.pan(x * step, y * step);
  } else {
    controls.rotateLeft(x * turn);
    controls.rotateUp(y * turn);
  }
}

// Digits by their keys: with Shift they are other characters.
function nameOf({ key, code, shiftKey }) {
  const name = /^Digit\d$/.test(code) ? code.at(-1) : key.toLowerCase();
  return shiftKey && /^[a-z\d]$/.test(name) ? `shift+${name}` : name;
}

// `actions`: what to do, by key ('x', 'shift+x').
export function listenToKeys(stage, actions) {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector('dialog[open]')) return;
    if (event.key.startsWith('Arrow') && !takesArrows(event.target)) {
      move(stage.controls, event);
    } else if (event.key in zooms) {
      stage.controls.dispatchEvent({ type: 'start' });
      stage.controls[zooms[event.key]](nearer);
    } else {
      const action = actions[nameOf(event)];
      if (!action || (takesLetters(event.target) && event.key !== 'Escape')) return;
      action();
    }
    event.preventDefault();
    stage.invalidate();
  });
}
