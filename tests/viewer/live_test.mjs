// SPDX-License-Identifier: MIT
// The page of `loft live` in a real browser: each tab's main gesture, reconnecting, and how long an edit
// takes to be seen. LOFT names the program; see run.sh.
import assert from 'node:assert/strict';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { Viewer, difference, startBrowser } from './browser.mjs';
import { Loft } from './loft.mjs';

let browser;
let folder;
let loft;
let viewer;

before(async () => {
  browser = await startBrowser('--disable-gpu');
  folder = await mkdtemp(join(tmpdir(), 'loft-live-'));
});
after(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
afterEach(async () => {
  await viewer?.close();
  await loft?.end();
  viewer = loft = undefined;
});

async function open(tab, words = [], options = {}) {
  loft = await Loft.start('live', '--port', '0', ...words);
  viewer = await Viewer.open(browser, `${loft.url}#${tab}`, options);
  await viewer.page.waitForSelector('#canvas[aria-busy="false"]');
}

// Pixels of the page where a place of the plane is.
async function pixels(place) {
  const { x, y } = await viewer.page.locator('#canvas').boundingBox();
  const [px, py] = await viewer.page.evaluate((at) => globalThis.live.board.toPage(at), place);
  return [x + px, y + py];
}

async function drag(from, to, steps = 10) {
  const { mouse } = viewer.page;
  await mouse.move(...await pixels(from));
  await mouse.down();
  await mouse.move(...await pixels(to), { steps });
  await mouse.up();
}

// Until no edit is under way and all is in the picture.
async function settle() {
  await viewer.page.waitForTimeout(400);
  await viewer.settle();
}

const number = (selector) => viewer.page.locator(selector).innerText().then(Number.parseFloat);
const area = () => number('#panel .big');
const overlaps = () => number('#overlap-area');

// Polls until a number is as it should be.
async function until(value, isRight) {
  for (let i = 0; i < 600; ++i) {
    if (isRight(await value())) return;
    await viewer.page.waitForTimeout(50);
  }
  assert.fail(`it stays ${await value()}`);
}

async function complaints() {
  assert.deepEqual(viewer.complaints, []);
  assert.deepEqual(viewer.foreign.filter((address) => !address.startsWith(loft.url)), []);
}

test('a hole of the gasket is dragged, and its area follows', async () => {
  await open('shapes');
  const before = await area();
  const picture = await viewer.picture();
  await drag([52, 0], [90, 10]);  // out of the plate
  await until(area, (now) => now > before + 150);
  assert.ok(difference(picture, await viewer.picture()) > 500);
  assert.match(await viewer.text('cost'), /[0-9.]+ (µs|ms)/);
  await drag([90, 10], [52, 0]);
  await until(area, (now) => Math.abs(now - before) < 20);
  await complaints();
});

test('an expression is typed, refused where it is none, and the tree comes back', async () => {
  await open('shapes');
  const before = await area();
  const field = viewer.page.locator('#expression');
  await field.fill('bore & (body');
  await field.press('Enter');
  await viewer.page.waitForSelector('#complaint', { state: 'visible' });
  await field.fill('bore & body');
  await field.press('Enter');
  await until(area, (now) => Math.abs(now - 1254.6) < 1);
  assert.equal(await viewer.page.locator('#complaint').isVisible(), false);
  await viewer.page.getByRole('button', { name: 'Back to the tree' }).click();
  await until(area, (now) => now === before);
  await viewer.page.getByLabel('Operation of gasket').selectOption('unite');
  await until(area, (now) => now > before + 1000);
});

test('the keyboard chooses, moves, adds and takes away', async () => {
  await open('shapes');
  const before = await area();
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('.');
  await viewer.page.keyboard.press('Shift+ArrowRight');
  await until(area, (now) => now !== before);
  await viewer.page.keyboard.press('Escape');
  const rows = await viewer.page.locator('#tree li').count();
  await viewer.page.keyboard.press('i');
  await until(() => viewer.page.locator('#tree li').count(), (now) => now === rows + 1);
  await viewer.page.keyboard.press('.');
  await viewer.page.keyboard.press('Delete');
  await until(() => viewer.page.locator('#tree li').count(), (now) => now === rows);
  const plain = await viewer.picture();
  await viewer.page.keyboard.press('t');
  await settle();
  assert.ok(difference(plain, await viewer.picture()) > 1000);
  await viewer.page.keyboard.press('2');
  await viewer.page.waitForSelector('#tab-map[aria-selected="true"]');
  await complaints();
});

test('a finger drags, two zoom', async () => {
  await open('shapes', [], { hasTouch: true });
  const before = await area();
  const client = await viewer.context.newCDPSession(viewer.page);
  const touch = (type, ...points) => client.send('Input.dispatchTouchEvent',
    { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const from = await pixels([52, 0]);
  await touch('touchStart', from);
  for (let i = 1; i <= 5; ++i) await touch('touchMove', [from[0] + 20 * i, from[1]]);
  await touch('touchEnd');
  await until(area, (now) => now > before + 100);
  const scale = () => viewer.page.evaluate(() => globalThis.live.board.scale);
  const first = await scale();
  const [x, y] = await pixels([0, 45]);
  await touch('touchStart', [x - 20, y], [x + 20, y]);
  for (let i = 1; i <= 4; ++i) await touch('touchMove', [x - 20 - 10 * i, y], [x + 20 + 10 * i, y]);
  await touch('touchEnd');
  assert.ok(await scale() > 2 * first);
});

test('an island over a border lights up, and the owners are told', async () => {
  await open('map');
  const before = await overlaps();
  await drag([108, 117], [72, 60]);
  await until(overlaps, (now) => now > before + 50);
  await until(() => viewer.page.locator('#faults .overlap').count(), (count) => count >= 2);
  await viewer.page.mouse.move(...await pixels([72, 60]));
  await until(() => viewer.page.locator('#owners').innerText(), (words) => words.includes('Zelos') && words.includes(' and '));
  await complaints();
});

test('agents walk, and a box in the way of one is walked around', async () => {
  await open('paths');
  const first = await viewer.picture();
  await viewer.page.waitForTimeout(700);
  assert.ok(difference(first, await viewer.picture()) > 100);
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('.');
  await until(() => viewer.page.locator('#way').innerText(), (words) => Number.parseFloat(words) > 0);
  await viewer.page.getByRole('button', { name: '+ box' }).click();
  await until(() => viewer.text('cost'), (words) => words !== '–');
  await viewer.page.getByLabel('Radius').fill('4');
  await until(() => viewer.page.locator('.slider .value').first().innerText(), (words) => words === '4');
  await complaints();
});

test('a dam is dragged: the surface and the profile follow', async () => {
  await open('field');
  await until(() => viewer.page.locator('#profile').evaluate((chart) => chart.width), (width) => width > 100);
  await settle();
  const before = await viewer.picture();
  const vertex = [65, 50 + 14 * Math.sin(65 / 26) + 4 * Math.sin(65 / 9)];  // of the dam
  await drag(vertex, [vertex[0] + 12, vertex[1] + 4]);
  await until(() => viewer.text('cost'), (words) => words !== '–');
  await settle();
  assert.ok(difference(before, await viewer.picture()) > 300);
  await viewer.page.locator('#cubic').check();
  await settle();
  await complaints();
});

test('a separator is bent, and points change their class', async () => {
  await open('classes');
  const counts = () => viewer.page.locator('#classes').innerText();
  const before = await counts();
  await drag([48, 36], [52, 48]);
  await until(counts, (now) => now !== before);
  assert.equal(await viewer.page.locator('#classes li').count(), 4);
  await complaints();
});

test('a page that was away gets what it has missed, and no more', async () => {
  await open('shapes');
  const before = await area();
  await viewer.page.evaluate(() => {
    const { link } = globalThis.live;
    globalThis.kinds = [];
    for (const kind of ['reset', 'change']) link.addEventListener(kind, () => globalThis.kinds.push(kind));
    link.close();
  });
  const other = await Viewer.open(browser, `${loft.url}#shapes`);
  await other.page.waitForSelector('#canvas[aria-busy="false"]');
  for (const x of [20, 10, 0])  // the port, into the bore
    await other.page.evaluate((at) => globalThis.live.send({ do: 'move', id: 8, at: [at, 0] }), x);
  await other.close();
  assert.equal(await area(), before);
  await viewer.page.evaluate(() => globalThis.live.link.follow('shapes', globalThis.live.link.last));
  await until(area, (now) => now > before + 150);
  assert.deepEqual(await viewer.page.evaluate(() => globalThis.kinds), ['change', 'change', 'change']);
});

test('a program that was started anew is shown as it is', async () => {
  await open('shapes');
  const before = await area();
  await drag([52, 0], [90, 10]);
  await until(area, (now) => now > before + 150);
  await settle();  // a move that is under way would be told again
  const { port } = loft;
  await loft.end();
  await viewer.page.waitForSelector('#banner', { state: 'visible' });
  loft = await Loft.start('live', '--port', port);
  await until(area, (now) => now === before);
  await viewer.page.waitForSelector('#banner', { state: 'hidden' });
});

test('dark and light follow the system', async () => {
  await open('map', [], { colorScheme: 'dark' });
  const corner = (picture) => picture.pixels.slice(0, 3).reduce((sum, value) => sum + value);
  const dark = corner(await viewer.picture());
  await viewer.page.emulateMedia({ colorScheme: 'light' });
  await settle();
  assert.ok(corner(await viewer.picture()) > dark + 300);
});

// --- How long an edit takes to be seen ---

const circle = (x, y, radius, corners) => Array.from({ length: corners + 1 }, (_, i) => {
  const angle = 2 * Math.PI * (i % corners) / corners;
  return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
});

async function writeScene(name, features) {
  const file = join(folder, name);
  await writeFile(file, JSON.stringify({ type: 'FeatureCollection', features }));
  return file;
}
const feature = (type, coordinates) => ({ type: 'Feature', properties: {}, geometry: { type, coordinates } });

// Moves the pointer for a while, one step a frame; prints and returns the delays, sorted.
async function measure(what, from, to) {
  const { mouse } = viewer.page;
  const a = await pixels(from);
  const b = await pixels(to);
  await mouse.move(...a);
  await mouse.down();
  await viewer.page.evaluate(() => {
    globalThis.live.delays.length = 0;
    globalThis.frames = [];
    const count = (now) => { if (globalThis.frames) { globalThis.frames.push(now); requestAnimationFrame(count); } };
    requestAnimationFrame(count);
  });
  const begin = performance.now();
  for (let i = 1; i <= 120; ++i) {
    const part = (1 - Math.cos(i / 120 * 4 * Math.PI)) / 2;
    await mouse.move(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]));
    await viewer.page.waitForTimeout(8);
  }
  const seconds = (performance.now() - begin) / 1000;
  const between = await viewer.page.evaluate(() => {
    const gaps = globalThis.frames.slice(1).map((at, i) => at - globalThis.frames[i]).sort((a, b) => a - b);
    globalThis.frames = undefined;
    return gaps[gaps.length >> 1];
  });
  await mouse.up();
  await settle();
  const delays = await viewer.page.evaluate(() => globalThis.live.delays);
  delays.sort((x, y) => x - y);
  const at = (part) => delays[Math.min(delays.length - 1, Math.floor(part * delays.length))];
  console.log(`${what}: ${delays.length} edits in ${seconds.toFixed(1)} s; edit to picture median ${at(0.5).toFixed(1)} ms, ` +
              `95% ${at(0.95).toFixed(1)} ms; ${between.toFixed(1)} ms from frame to frame; last edit ${await viewer.text('cost')}, ${await viewer.page.locator('#made').innerText()}`);
  return at(0.5);
}

// Frames a second while all of the view is moved, which draws everything anew.
async function framesPerSecond() {
  return viewer.page.evaluate(async () => {
    const { board } = globalThis.live;
    const begin = performance.now();
    let frames = 0;
    while (performance.now() - begin < 1500) {
      board.pan(frames % 2 ? 1 : -1, 0);
      await new Promise(requestAnimationFrame);
      ++frames;
    }
    return 1000 * frames / (performance.now() - begin);
  });
}

test('a polygon among 2,000 is dragged', async () => {
  const discs = Array.from({ length: 2000 }, (_, i) =>
    feature('Polygon', [circle(10 * (i % 50) + 3 * Math.sin(i), 10 * Math.floor(i / 50) + 3 * Math.cos(3 * i), 4.6, 8)]));
  await open('shapes', [await writeScene('discs.geojson', discs), '--tab', 'shapes']);
  const delay = await measure('a polygon among 2,000', [253, 203 - 3], [300, 240]);
  console.log(`${(await framesPerSecond()).toFixed(0)} frames a second`);
  assert.ok(delay < 150, `${delay} ms`);
});

test('a box among 1,000 with 100 agents is dragged', async () => {
  const boxes = Array.from({ length: 1000 }, (_, i) =>
    feature('Polygon', [circle(10 * (i % 40) + 2 * Math.sin(i), 10 * Math.floor(i / 40) + 2 * Math.cos(3 * i), 3, 4)]));
  const agents = Array.from({ length: 100 }, (_, i) => feature('Point', [10 * (i % 40) + 5, 10 * (i % 25) + 5]));
  await open('paths', [await writeScene('boxes.geojson', [...boxes, ...agents]), '--tab', 'paths']);
  const delay = await measure('a box among 1,000 with 100 agents', [200 + 2 * Math.sin(500), 120 + 2 * Math.cos(1500)], [240, 150]);
  console.log(`${(await framesPerSecond()).toFixed(0)} frames a second`);
  assert.ok(delay < 250, `${delay} ms`);
});
