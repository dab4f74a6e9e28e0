// SPDX-License-Identifier: MIT
// Measures, projections and pictures in a real browser. LOFT names the program; see run.sh.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before, test } from 'node:test';
import { Viewer, startBrowser } from './browser.mjs';
import { Loft, square } from './loft.mjs';
import { readPng } from './png.mjs';

let browser;
let loft;
let viewer;

before(async () => {
  browser = await startBrowser();
  loft = await Loft.start('stream', '--no-input', '--view', '--port', '0');
  await loft.post(square(0, 5), square(4, 5), square(8, 5));
  // The view stands still between clicks.
  viewer = await Viewer.open(browser, loft.url, { reducedMotion: 'reduce' });
  await viewer.waitForSlabs(2);
});
after(async () => {
  await loft.end();
  await browser.close();
});

async function press(...keys) {
  for (const key of keys) {
    await viewer.page.locator('#canvas').focus();
    await viewer.page.keyboard.press(key);
    await viewer.settle();
  }
}

async function click(x, y) {
  const canvas = viewer.page.locator('#canvas');
  const { width, height } = await canvas.boundingBox();
  await canvas.click({ position: { x: width / 2 + x, y: height / 2 + y } });
}

// How many millimetres a pixel is, by the scale bar.
async function scale() {
  const { width } = await viewer.page.locator('#scale').boundingBox();
  return Number.parseFloat(await viewer.text('scale')) / width;
}

async function lastMeasure() {
  return Number.parseFloat(await viewer.page.locator('#measures strong').last().innerText());
}

function isNear(value, wanted, share) {
  assert.ok(Math.abs(value - wanted) <= share * wanted, `${value}, not ${wanted}`);
}

test('what is measured is what the scale bar says', async () => {
  assert.match(await viewer.text('scale'), /at the middle/);
  await press('o', '2', 'm');
  assert.match(await viewer.text('scale'), /mm$/);
  const millimetres = await scale();
  await click(-60, 0);
  await click(60, -40);
  isNear(await lastMeasure(), Math.hypot(120, 40) * millimetres, 0.01);
  await press('Shift+M');  // along the surface: flat here
  await click(-60, 0);
  await click(60, 0);
  isNear(await lastMeasure(), 120 * millimetres, 0.01);
  await press('Shift+M');
  for (const [x, y] of [[60, 0], [0, 0], [0, -50]]) await click(x, y);
  isNear(await lastMeasure(), 90, 0.001);
  assert.equal(await viewer.page.locator('#figures span').count(), 3);
  assert.deepEqual(viewer.complaints, []);
});

test('around an edge the way along the surface is longer than the straight one', async () => {
  await press('o', 'f', '1', 'ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'Shift+M', 'Shift+M');
  await viewer.page.locator('#measure-kind').selectOption('distance');
  await click(-140, 10);  // beyond the edge
  await click(70, 10);
  const straight = await lastMeasure();
  await viewer.page.locator('#measure-kind').selectOption('section');
  await click(-140, 10);  // beyond the edge
  await click(70, 10);
  assert.ok(await lastMeasure() > 1.02 * straight, `${await lastMeasure()} ${straight}`);
});

test('measures are removed by a button and by a key', async () => {
  const count = () => viewer.page.locator('#measures li').count();
  const before = await count();
  await viewer.page.locator('#measures button').first().click();
  assert.equal(await count(), before - 1);
  await press('Delete');
  assert.equal(await count(), before - 2);
});

test('at the borders stands where they are in a patient', async () => {
  const letters = () => viewer.page.locator('#letters span').allInnerTexts();
  assert.ok((await letters()).every((letter) => letter === ''));
  await viewer.page.addInitScript(() => {
    const parse = JSON.parse;
    JSON.parse = (text) => {
      const value = parse(text);
      return value?.metres_per_unit === undefined ? value : { ...value, is_patient: true };
    };
  });
  await viewer.page.reload();
  await viewer.waitForSlabs(2);
  await press('2');
  assert.deepEqual(await letters(), ['L', 'R', 'S', 'I']);
  await press('Shift+1');
  assert.deepEqual(await letters(), ['A', 'P', 'S', 'I']);
});

test('a picture is a PNG of one, two or four times the canvas', async () => {
  const { width, height } = await viewer.page.locator('#canvas').boundingBox();
  await viewer.page.locator('#picture-size').selectOption('2');
  const download = viewer.page.waitForEvent('download');
  await press('Shift+P');
  const picture = readPng(await readFile(await (await download).path()));
  assert.deepEqual([picture.width, picture.height], [2 * width, 2 * height]);
  const colours = new Set();
  for (let i = 0; i < picture.pixels.length; i += 997 * picture.channels) colours.add(picture.pixels[i]);
  assert.ok(colours.size > 5);
});
