// SPDX-License-Identifier: MIT
// Cuts in a real browser. LOFT names the program; see run.sh.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { Viewer, brightness, difference, pixel, startBrowser } from './browser.mjs';
import { Loft } from './loft.mjs';

let browser;
let loft;
let viewer;

before(async () => { browser = await startBrowser(); });
after(() => browser.close());
afterEach(async () => {
  await viewer.close();
  await loft.end();
});

function square(half, [x, y] = [0, 0]) {
  return [[-half, -half], [half, -half], [half, half], [-half, half]].map(([a, b]) => [a + x, b + y]);
}

function line(z, contours, labels) {
  return JSON.stringify({ op: 'insert', z, contours, labels });
}

async function show(...lines) {
  loft = await Loft.start('stream', '--no-input', '--view', '--port', '0');
  await loft.post(...lines);
  viewer = await Viewer.open(browser, loft.url);
  await viewer.page.waitForFunction(() => Number(document.getElementById('slabs').textContent) > 0);
  await viewer.settle();
}

async function press(...keys) {
  for (const key of keys) {
    await viewer.page.locator('#canvas').focus();
    await viewer.page.keyboard.press(key);
    await viewer.settle();
  }
}

// Of a label, as the list has it.
async function colourOf(label) {
  const item = viewer.page.locator('#labels [role="option"]:visible', { hasText: label }).locator('.swatch');
  const text = await item.evaluate((swatch) => getComputedStyle(swatch).backgroundColor);
  return text.match(/\d+/g).map(Number);
}

// How many pixels have a colour.
function area({ channels, pixels }, colour) {
  let count = 0;
  for (let i = 0; i < pixels.length; i += channels)
    if (colour.every((value, k) => Math.abs(pixels[i + k] - value) <= 3)) ++count;
  return count;
}

// Waits for a picture in which two labels have areas.
async function areas(colours) {
  for (let i = 0; i < 50; ++i) {
    await viewer.settle();
    const picture = await viewer.picture();
    const found = colours.map((colour) => area(picture, colour));
    if (found.every((count) => count > 0)) return found;
  }
  return assert.fail('the cut is not filled');
}

test('a cut at a slice is filled as its contours are, seen from either side', async () => {
  await show(...[0, 4, 8].map((z) => line(z, [square(10), square(4), square(2, [7, 7])], ['block', 'organ', 'node'])));
  const colours = await Promise.all(['block', 'organ'].map(colourOf));
  await press('o', '3', 'x');
  assert.equal(await viewer.text('cut-text'), 'slice 4 mm');
  const above = await areas(colours);
  assert.ok(Math.abs(above[0] / above[1] - (400 - 64 - 16) / 64) < 0.3, String(above));
  const { width, height } = await viewer.page.locator('#canvas').boundingBox();
  await viewer.page.locator('#canvas').click({ position: { x: width / 2 + 30, y: height / 2 + 30 } });
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent.includes('organ'));
  await press('h');  // what is hidden is not in the cut: the body is around it
  const [whole] = await areas(colours.slice(0, 1));
  assert.equal(area(await viewer.picture(), colours[1]), 0);
  assert.ok(Math.abs(whole / above[0] - (400 - 16) / (400 - 64 - 16)) < 0.05, `${whole} ${above}`);
  await press('h', 'v', 'Shift+3');
  const below = await areas(colours);
  assert.ok(Math.abs(below[0] / below[1] - (400 - 64 - 16) / 64) < 0.3, String(below));
  await press('v');  // what is kept is on this side now, and is closed
  const picture = await viewer.picture();
  assert.equal(area(picture, colours[1]), 0);
  assert.deepEqual(viewer.complaints, []);

  await press('1', 'Shift+X');
  const [body, organ] = await areas(colours);
  assert.ok(Math.abs(body / organ - 12 / 8) < 0.15, `${body} : ${organ}`);
  assert.equal(await viewer.text('cut-text'), '0 mm');
  await press('b');
  const thin = await viewer.picture();
  await viewer.page.locator('#along-z').click();
  await viewer.settle();
  const fromAbove = await viewer.picture();
  assert.ok(difference(thin, fromAbove) > 100);
  await viewer.page.locator('#along-x').click();
  await viewer.settle();
  assert.ok(difference(fromAbove, await viewer.picture()) > 100);
});

test('the cut goes where it is dragged, and turns', async () => {
  await show(...[0, 4, 8].map((z) => line(z, [square(5)], ['box'])));
  await press('o', '2', 'x');
  const { width, height } = await viewer.page.locator('#canvas').boundingBox();
  const drag = async (from, to) => {
    await viewer.page.mouse.move(width / 2 + from[0], height / 2 + from[1]);
    await viewer.page.mouse.down();
    await viewer.page.mouse.move(width / 2 + to[0], height / 2 + to[1], { steps: 3 });
    await viewer.page.mouse.up();
    await viewer.settle();
  };
  await drag([0, -54], [0, -90]);  // the arrow
  const z = Number.parseFloat((await viewer.text('cut-text')).replace('slice', ''));
  assert.ok(z > 4.3 && z < 8, String(z));
  const tilt = () => viewer.page.locator('#cut-tilt').evaluate((slider) => Number(slider.value));
  assert.equal(await tilt(), 0);
  await drag([0, -36 - 84], [84, -36]);  // the ball
  assert.ok(await tilt() > 45, String(await tilt()));
  await viewer.page.locator('#cut-tilt').focus();
  await viewer.page.keyboard.press('Home');
  assert.equal(await tilt(), 0);
  await press(',');
  assert.match(await viewer.text('cut-text'), /^slice (0|4) mm$/);
});

// Pixels where what is purple begins below the background, and those of them that are darker than
// what is below them, though between what is lit and what is light.
function dotsAtOutline(picture) {
  const isPurple = ([red, green, blue]) => Math.min(red, blue) - green > 15;
  let [dots, outline] = [0, 0];
  for (let x = 5; x < picture.width - 5; ++x) {
    for (let y = 5; y < picture.height - 5; ++y) {
      const [above, here, below] = [-1, 0, 1].map((k) => pixel(picture, x, y + k));
      if (isPurple(above) || !isPurple(here) || !isPurple(below)) continue;
      ++outline;
      if (brightness(here) < brightness(below) - 8) ++dots;
    }
  }
  return { dots, outline };
}

test('a slanted tube has no dark dots at its outline', async () => {
  const ring = (x) => Array.from({ length: 48 }, (_, i) =>
    [x + 2 * Math.cos((i * Math.PI) / 24), 2 * Math.sin((i * Math.PI) / 24)]);
  await show(...Array.from({ length: 12 }, (_, k) => line(k, [ring(3 * k)], ['tube'])));
  await press('ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'ArrowLeft', '+', '+');
  let found;
  for (let i = 0; i < 20; ++i) {  // until all normals are those of neighbours, too
    await viewer.settle();
    found = dotsAtOutline(await viewer.picture());
    if (found.dots <= 6) break;
  }
  assert.ok(found.outline > 300, `${found.outline} pixels of outline`);
  assert.ok(found.dots <= 6, `${found.dots} dots`);
});
