// SPDX-License-Identifier: MIT
// The keyboard. Letters belong to the page unless something is written; arrows to sliders and lists that
// have the focus.

const near = 8;   // pixels
const far = 40;
const zooms = { '+': 1.25, '=': 1.25, '-': 0.8 };
const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

const writes = (target) => target instanceof HTMLTextAreaElement || target.type === 'text';
const takesArrows = (target) => target instanceof HTMLSelectElement || target.type === 'range' || writes(target);

// `tab()` is the one that is shown; `actions`: what to do, by key; `tab(number)` of them shows another.
export function listenToKeys(board, tab, actions) {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]')) return;
    if (writes(event.target) || (event.target instanceof HTMLSelectElement && event.key.length === 1)) return;
    if (act(event)) event.preventDefault();
  });

  function act(event) {
    const { key } = event;
    if (key in ways) return !takesArrows(event.target) && move(ways[key], event.shiftKey ? far : near);
    if (key in zooms) board.zoom(zooms[key]);
    else if (key >= '1' && key <= '9') actions.tab(Number(key) - 1);
    else if (key === ',' || key === '.') tab().chooseNext(key === ',' ? -1 : 1);
    else if (key === 'Escape') tab().choose(undefined);
    else if (key === 'Delete' || key === 'Backspace') tab().remove();
    else if (key.toLowerCase() === 'i') tab().insert(board.view.middle);
    else return run(tab().keys?.[key] ?? actions[key.toLowerCase()]);
    return true;
  }

  function run(action) {
    action?.();
    return action !== undefined;
  }

  function move([x, y], pixels) {
    const current = tab();
    if (current.chosen === undefined) board.pan(-x * pixels, y * pixels);
    else current.moveBy(current.chosen, [board.px(x * pixels), board.px(y * pixels)]);
    return true;
  }
}
