// SPDX-License-Identifier: MIT
// The picture as a PNG of one, two or four times the canvas, with what is written over it.

// Everything that is written over the picture, where it is; `bar` is drawn as a line.
function paintWords(context, canvas, { words, bar }, factor) {
  const { left, top } = canvas.getBoundingClientRect();
  const place = (element) => {
    const box = element.getBoundingClientRect();
    return [box.left - left, box.top - top, box.width, box.height];
  };
  context.scale(factor, factor);
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const element of words) {
    if (!element.checkVisibility() || !element.textContent) continue;
    const style = getComputedStyle(element);
    const [x, y, width, height] = place(element);
    context.fillStyle = style.backgroundColor;
    context.fillRect(x, y, width, height);
    context.fillStyle = style.color;
    context.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
    context.fillText(element.textContent, x + width / 2, y + height / 2);
  }
  if (!bar.checkVisibility()) return;
  const [x, y, width, height] = place(bar);
  context.fillStyle = getComputedStyle(bar).color;
  context.fillRect(x, y + height - 2, width, 2);
  for (const end of [x, x + width - 2]) context.fillRect(end, y + height - 8, 2, 8);
}

// Draws once at another resolution: what graphics cards allow, if `factor` is more.
function render(stage, factor) {
  const { renderer, canvas, width, height } = stage;
  const ratio = renderer.getPixelRatio();
  const most = renderer.getContext().getParameter(renderer.getContext().MAX_RENDERBUFFER_SIZE);
  const own = Math.min(factor, most / Math.max(width, height));
  renderer.setPixelRatio(own);
  renderer.setSize(width, height, false);
  stage.hasHandles = false;
  stage.draw();
  const picture = document.createElement('canvas');
  [picture.width, picture.height] = [canvas.width, canvas.height];
  const context = picture.getContext('2d');
  context.drawImage(canvas, 0, 0);
  stage.hasHandles = true;
  renderer.setPixelRatio(ratio);
  renderer.setSize(width, height, false);
  stage.draw();
  return { picture, context, factor: own };
}

// Resolves to a PNG. `overlay`: { words, bar }, elements over the canvas.
export function takePicture(stage, factor, overlay) {
  const { picture, context, factor: own } = render(stage, factor);
  paintWords(context, stage.canvas, overlay, own);
  return new Promise((resolve) => { picture.toBlob(resolve, 'image/png'); });
}

export async function savePicture(stage, factor, overlay, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await takePicture(stage, factor, overlay));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
