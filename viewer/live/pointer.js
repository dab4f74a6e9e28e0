// SPDX-License-Identifier: MIT
// Mouse, pen and fingers: one drags a thing, or the view; two zoom. With the pointer still, words about
// the place.

const reach = { mouse: 5, pen: 8, touch: 16 };  // pixels around the pointer

// `target` says which tab it is: { board, grab(p, near), choose(), hover(p, near), leave(), insert(p) }.
export function listenToPointers(canvas, board, target) {
  const down = new Map();  // pointers: where they are
  let drag;
  let pinch;

  const place = (event) => [event.offsetX, event.offsetY];
  const near = (event) => board.px(reach[event.pointerType] ?? reach.mouse);

  function beginPinch() {
    drag?.end();
    drag = undefined;
    pinch = spanOf([...down.values()]);
  }

  canvas.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
    if (down.size === 2) return beginPinch();
    drag = target.grab(board.toPlane(...place(event)), near(event)) ?? panning(target, board, place(event));
  });

  canvas.addEventListener('pointermove', (event) => {
    const p = place(event);
    if (!down.has(event.pointerId)) return target.hover(board.toPlane(...p), near(event), p);
    down.set(event.pointerId, p);
    if (pinch) {
      const now = spanOf([...down.values()]);
      board.pan(now.middle[0] - pinch.middle[0], now.middle[1] - pinch.middle[1]);
      board.zoom(now.length / pinch.length, ...now.middle);
      pinch = now;
    } else {
      drag?.move(board.toPlane(...p), p);
    }
  });

  function up(event) {
    if (!down.delete(event.pointerId)) return;
    if (down.size < 2) pinch = undefined;
    if (down.size > 0) return;
    drag?.end();
    drag = undefined;
  }
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('pointerleave', () => target.leave());
  canvas.addEventListener('dblclick', (event) => target.insert(board.toPlane(...place(event))));
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    board.wheel(event);
  }, { passive: false });
}

// A drag of the view; where it did not go anywhere, nothing is chosen any more.
function panning(target, board, begin) {
  let last = begin;
  let far = 0;
  return {
    move: (_, p) => {
      board.pan(p[0] - last[0], p[1] - last[1]);
      far += Math.hypot(p[0] - last[0], p[1] - last[1]);
      last = p;
    },
    end: () => { if (far < 4) target.choose(undefined); },
  };
}

function spanOf([a, b]) {
  return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], length: Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1])) };
}
