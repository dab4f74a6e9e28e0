// SPDX-License-Identifier: MIT
// The keyboard. Arrows belong to the control that has the focus, letters to the page but where one
// writes.

const turn = Math.PI / 24;
const zooms = { '+': 'dollyIn', '=': 'dollyIn', '-': 'dollyOut' };
const nearer = 1 / 1.15;  // what dollyIn multiplies the distance by

const plain = new Set(['range', 'checkbox', 'color']);  // inputs without letters

// Letters are written in fields and choose in lists; arrows do, too, and move sliders.
function takesLetters(target) {
  return target instanceof HTMLSelectElement ||
         (target instanceof HTMLInputElement && !plain.has(target.type));
}
function takesArrows(target) {
  return takesLetters(target) || target.type === 'range';
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
function nameOf({ key, code, ctrlKey, metaKey, shiftKey }) {
  const name = /^Digit\d$/.test(code) ? code.at(-1) : key.toLowerCase();
  const isShifted = shiftKey && /^[a-z\d]$/.test(name);
  return `${ctrlKey || metaKey ? 'ctrl+' : ''}${isShifted ? 'shift+' : ''}${name}`;
}

// `actions`: what to do, by key ('x', 'shift+x', 'ctrl+shift+z').
export function listenToKeys(stage, actions) {
  addEventListener('keydown', (event) => {
    if (event.altKey || document.querySelector('dialog[open]')) return;
    const isCommand = event.ctrlKey || event.metaKey;
    if (takesLetters(event.target) && event.key !== 'Escape') return;
    if (!isCommand && event.key.startsWith('Arrow')) {
      if (takesArrows(event.target)) return;
      move(stage.controls, event);
    } else if (!isCommand && event.key in zooms) {
      stage.controls.dispatchEvent({ type: 'start' });
      stage.controls[zooms[event.key]](nearer);
    } else {
      const action = actions[nameOf(event)];
      if (!action) return;
      action();
    }
    event.preventDefault();
    stage.invalidate();
  });
}
