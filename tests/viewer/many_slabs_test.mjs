// SPDX-License-Identifier: MIT
// Many slabs come with few requests, and look as the surface does. LOFT names the program.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { Viewer, difference, pixel, startBrowser } from './browser.mjs';
import { Loft } from './loft.mjs';

const across = 6;  // labels a side
const slices = 14;
let browser;
let loft;

// A square of each label, at its place.
function slice(z, half, op = 'insert') {
  const places = [...Array(across ** 2).keys()].map((i) => [3 * (i % across), 3 * Math.floor(i / across)]);
  const contours = places.map(([x, y]) => [[x - half, y - half], [x + half, y - half],
                                           [x + half, y + half], [x - half, y + half]]);
  return JSON.stringify({ op, z, contours, labels: places.map((_, i) => `organ ${i}`) });
}

before(async () => {
  browser = await startBrowser();
  loft = await Loft.start('stream', '--no-input', '--port', '0');
  await loft.post(...[...Array(slices).keys()].map((z) => slice(2 * z, 1 + 0.2 * Math.sin(z))));
});
after(async () => {
  await loft.end();
  await browser.close();
});

async function open() {
  const asked = [];
  const viewer = await Viewer.open(browser, loft.url);
  viewer.page.on('request', (request) => asked.push(new URL(request.url())));
  await viewer.page.reload();
  return { viewer, slabRequests: () => asked.filter(({ pathname }) => pathname.startsWith('/slabs')) };
}

async function slabCount(viewer, count) {
  await viewer.waitForText('slabs', String(count));
  await viewer.settle();
}

test('All slabs come with a request or two, and what changes is shown', async () => {
  const { viewer, slabRequests } = await open();
  const count = across ** 2 * (slices - 1);
  await slabCount(viewer, count);
  assert.ok(slabRequests().length <= 2, slabRequests().join('\n'));
  const before = await viewer.picture();
  const background = pixel(before, 3, before.height - 4);
  assert.notDeepEqual(pixel(before, before.width >> 1, before.height >> 1), background);
  await loft.post(slice(2 * slices - 2, 0.4, 'replace'));
  await viewer.waitForText('edits', String(slices + 1));
  await viewer.settle();
  assert.ok(difference(before, await viewer.picture()) > 300);
  await loft.post(slice(2 * slices - 2, 1 + 0.2 * Math.sin(slices - 1), 'replace'));
  await viewer.waitForText('edits', String(slices + 2));
  for (let i = 0; i < 100 && difference(before, await viewer.picture()) > 50; ++i) await viewer.settle();
  assert.ok(difference(before, await viewer.picture()) <= 50, 'it does not look as before');
  assert.deepEqual(viewer.complaints, []);
  await viewer.close();
});

test('Slabs that are drawn together have colours of their own', async () => {
  const { viewer } = await open();
  await slabCount(viewer, across ** 2 * (slices - 1));
  const byLabel = await viewer.picture();
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('l');  // by age
  await viewer.settle();
  const byAge = await viewer.picture();
  assert.ok(difference(byLabel, byAge) > 1000);
  const isSurface = (colour) => Math.abs(colour[0] - colour[2]) > 24;  // the background is grey
  const column = [...Array(byAge.height).keys()].map((y) => pixel(byAge, byAge.width >> 1, y))
    .filter(isSurface);
  const turns = column.map(([r, , b]) => Math.sign(r - b));  // from yellow to blue
  assert.ok(turns[0] > 0 && turns.at(-1) < 0, 'ages look alike');
  await viewer.page.keyboard.press('l');
  await viewer.page.keyboard.press('l');
  await viewer.settle();
  assert.ok(difference(byLabel, await viewer.picture()) < 50);
  await viewer.close();
});

test('A slab is picked out of its bundle', async () => {
  const { viewer } = await open();
  await slabCount(viewer, across ** 2 * (slices - 1));
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('p');
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent.includes('Confidence'));
  const words = await viewer.text('pick');
  const [, label] = /organ (\d+)/.exec(words);
  const [, part] = /(\d+)-\d+/.exec(words);
  assert.equal(part, label);
  const [, x, y] = /Place\s+(-?[\d.]+), (-?[\d.]+)/.exec(words);
  assert.equal(Math.round(x / 3) + across * Math.round(y / 3), Number(label));
  await viewer.close();
});
