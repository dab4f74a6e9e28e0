// SPDX-License-Identifier: MIT
// The viewer in a real browser. LOFT names the program; see run.sh.
import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, beforeEach, test } from 'node:test';
import { Viewer, brightness, difference, pixel, startBrowser } from './browser.mjs';
import { Loft, square } from './loft.mjs';

let browser;
let folder;
let loft;
let viewer;

before(async () => { browser = await startBrowser(); });
after(() => browser.close());
beforeEach(async () => {
  folder = await mkdtemp(join(tmpdir(), 'loft-viewer-'));
  loft = await stream();
  viewer = await Viewer.open(browser, loft.url);
});
afterEach(async () => {
  await viewer.close();
  await loft.end();
  await rm(folder, { recursive: true });
});

function stream(port = 0) {
  return Loft.start('stream', '--no-input', '--session', join(folder, 'session'), '--view', '--port',
                    String(port));
}

async function isSurfaceInTheMiddle() {
  const picture = await viewer.picture();
  const middle = pixel(picture, picture.width >> 1, picture.height >> 1);
  const background = pixel(picture, 3, picture.height - 4);
  return Math.max(...middle.map((value, i) => Math.abs(value - background[i]))) > 20;
}

test('a posted slice appears without a reload', async () => {
  await viewer.page.waitForSelector('#empty', { state: 'visible' });
  await loft.post(square(0, 5));
  await viewer.waitForText('slices', '1');
  assert.equal(await isSurfaceInTheMiddle(), false);
  await loft.post(square(4, 5));
  await viewer.waitForSlabs(1);
  assert.equal(await viewer.page.locator('#empty').isVisible(), false);
  assert.equal(await isSurfaceInTheMiddle(), true);
  assert.equal(await viewer.number('volume'), 400);
  await loft.post(square(6, 5), square(8, 5));
  await viewer.waitForSlabs(3);
  assert.equal(await viewer.number('volume'), 800);
  assert.equal(await viewer.isTheSamePage(), true);
  assert.deepEqual(viewer.complaints, []);
  assert.deepEqual(viewer.foreign, []);
});

test('replacing a slice changes the volume and the picture', async () => {
  await loft.post(square(0, 5), square(4, 5), square(8, 5));
  await viewer.waitForSlabs(2);
  const first = await viewer.picture();
  await loft.post(square(8, 2, 'replace'));
  await viewer.waitForText('edits', '4');
  await viewer.settle();
  assert.ok(Math.abs(await viewer.number('volume') - (400 + 4 / 3 * (100 + 40 + 16))) < 0.1);
  assert.ok(difference(first, await viewer.picture()) > 500);
});

test('what is beside a change looks as on a new page', async () => {
  await loft.post(square(0, 5), square(4, 5), square(8, 5), square(12, 5));
  await viewer.waitForSlabs(3);
  await loft.post(square(12, 3, 'replace'));  // the normals of the slab below change, too
  await viewer.waitForText('edits', '5');
  const fitted = async (page) => {
    await page.waitForSlabs(3);
    await page.page.locator('#canvas').focus();
    await page.page.keyboard.press('f');
    await page.settle();
    return page.picture();
  };
  const other = await Viewer.open(browser, loft.url);
  const expected = await fitted(other);
  await other.close();
  for (let i = 0; i < 100; ++i)
    if (difference(await fitted(viewer), expected) < 10) return;
  assert.fail('it goes on looking as before');
});

test('a lost connection is told, and mends itself', async () => {
  await loft.post(square(0, 5), square(4, 6), square(8, 5));
  await viewer.waitForSlabs(2);
  await loft.end('SIGKILL');
  await viewer.page.waitForSelector('#banner', { state: 'visible' });
  assert.equal(await viewer.page.locator('#banner').getAttribute('role'), 'alert');
  assert.equal(await isSurfaceInTheMiddle(), true);  // what was seen last stays
  loft = await stream(loft.port);
  await viewer.page.waitForSelector('#banner', { state: 'hidden' });
  await viewer.waitForSlabs(2);
  assert.equal(await isSurfaceInTheMiddle(), true);
  await loft.post(square(12, 4));
  await viewer.waitForSlabs(3);
  assert.equal(await viewer.isTheSamePage(), true);
});

test('a click shows the contour point under the cursor, exactly', async () => {
  await loft.post(square(0.125, 5.000000000000001), square(4.3, 5.000000000000001));
  await viewer.waitForSlabs(1);
  const { width, height } = await viewer.page.locator('#canvas').boundingBox();
  await viewer.page.locator('#canvas').click({ position: { x: width / 2, y: height / 2 } });
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent.includes('Point'));
  const words = await viewer.text('pick');
  assert.match(words, /z (0\.125|4\.3) mm/);
  assert.match(words, /-?5\.000000000000001, -?5\.000000000000001/);
  assert.match(words, /box/);
});

test('contours, slices and the cut can be shown by keys', async () => {
  await loft.post(square(0, 5), square(2, 5), square(4, 5));
  await viewer.waitForSlabs(2);
  const pictures = [await viewer.picture()];
  for (const key of ['c', 's', 'x']) {
    const asked = key === 'c' ? viewer.page.waitForResponse((response) => response.url().includes('slices?z=')) : null;
    await viewer.page.locator('#canvas').focus();
    await viewer.page.keyboard.press(key);
    await asked;
    await assertChange(pictures.at(-1), pictures, key);
  }
  assert.match(await viewer.text('slice-height'), /^(0|2|4) mm$/);
  assert.equal(await viewer.page.locator('#cut-on').isChecked(), true);
});

// Waits for a picture that differs from one.
async function assertChange(from, pictures, what) {
  for (let i = 0; i < 100; ++i) {
    await viewer.settle();
    const picture = await viewer.picture();
    if (difference(from, picture) > 30) return pictures.push(picture);
  }
  return assert.fail(`nothing changes by ${what}`);
}

// How many pixels show the surface, or anything else but the background.
function coverage({ width, height, channels, pixels }) {
  const background = [...pixels.subarray(0, 3)];
  let count = 0;
  for (let i = 0; i < width * height * channels; i += channels)
    if ([0, 1, 2].some((k) => Math.abs(pixels[i + k] - background[k]) > 12)) ++count;
  return count;
}

test('plus goes nearer, minus farther', async () => {
  await loft.post(square(0, 5), square(4, 5));
  await viewer.waitForSlabs(1);
  await viewer.page.locator('#canvas').focus();
  const pictures = [await viewer.picture()];
  for (const key of ['-', '+', '+', '+']) {
    await viewer.page.keyboard.press(key);
    await assertChange(pictures.at(-1), pictures, key);
  }
  const sizes = pictures.map(coverage);
  assert.ok(sizes[1] < sizes[0] && sizes[2] > sizes[1] && sizes[4] > sizes[3], String(sizes));
});

test('another session, far away, takes the place of the first', async () => {
  await loft.post(...[0, 2, 4, 6, 8, 10].map((z) => square(z, 5)));
  await viewer.waitForSlabs(5);
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('ArrowLeft');  // the view belongs to the user from here on
  await loft.end('SIGKILL');
  await viewer.page.waitForSelector('#banner', { state: 'visible' });
  await rm(join(folder, 'session'));
  await rm(join(folder, 'session-wal'), { force: true });
  await rm(join(folder, 'session-shm'), { force: true });
  loft = await stream(loft.port);
  await viewer.page.waitForSelector('#banner', { state: 'hidden' });
  await loft.post(square(1e7, 5), square(1e7 + 4, 5));
  await viewer.waitForSlabs(1);
  await viewer.page.waitForFunction(() => document.getElementById('slice').max === '1');
  for (let i = 0; i < 50 && !(await isSurfaceInTheMiddle()); ++i) await viewer.settle();
  assert.equal(await isSurfaceInTheMiddle(), true);
  assert.equal(await viewer.isTheSamePage(), true);
});

test('a page that knows all asks for nothing again', async () => {
  await loft.post(square(0, 5), square(4, 5), square(8, 5));
  await viewer.waitForSlabs(2);
  await viewer.page.waitForTimeout(500);  // slabs beside an edit are renewed
  const asked = [];
  viewer.page.on('request', (request) => asked.push(request.url()));
  await viewer.page.evaluate(() => dispatchEvent(new Event('online')));
  await loft.post(square(8, 4, 'replace'));
  await viewer.waitForText('edits', '4');
  await viewer.settle();
  assert.ok(asked.every((url) => !url.includes('events')), String(asked));
  assert.equal(asked.filter((url) => url.includes('/slabs/0-0.glb')).length, 0);
});

test('what was picked is forgotten when its slice changes', async () => {
  await loft.post(square(0, 5), square(4, 5));
  await viewer.waitForSlabs(1);
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('p');
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent.includes('Point'));
  const z = /z (\S+)/.exec(await viewer.text('pick'))[1];
  await loft.post(square(Number(z), 4, 'replace'));
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent === '');
});

test('without WebGL there are figures and downloads', async () => {
  await loft.post(square(0, 5), square(4, 5));
  const plain = await startBrowser('--disable-3d-apis');
  try {
    const page = await Viewer.open(plain, loft.url);
    await page.page.waitForSelector('#no-picture', { state: 'visible' });
    await page.waitForText('slices', '2');
    assert.equal(await page.number('volume'), 400);
    assert.equal(await page.page.locator('#downloads a').count(), 2);
  } finally {
    await plain.close();
  }
});

test('the keyboard turns, zooms, fits and helps', async () => {
  await loft.post(square(0, 5), square(4, 2));
  await viewer.waitForSlabs(1);
  const pictures = [await viewer.picture()];
  await viewer.page.locator('#canvas').focus();
  for (const key of ['ArrowLeft', '+']) {
    await viewer.page.keyboard.press(key);
    await assertChange(pictures.at(-1), pictures, key);
  }
  await viewer.page.keyboard.press('f');
  await assertChange(pictures.at(-1), pictures, 'f');
  await viewer.page.keyboard.press('?');
  await viewer.page.waitForSelector('dialog#help[open]');
  await viewer.page.keyboard.press('Escape');
  await viewer.page.waitForSelector('dialog#help', { state: 'hidden' });
});

test('every control has a name and can be reached by the keyboard', async () => {
  await loft.post(square(0, 5), square(4, 2));
  await viewer.waitForSlabs(1);
  const session = await viewer.context.newCDPSession(viewer.page);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  const roles = new Set(['button', 'checkbox', 'slider', 'combobox', 'link', 'image', 'dialog']);
  const controls = nodes.filter((node) => !node.ignored && roles.has(node.role?.value));
  assert.ok(controls.length >= 10, `only ${controls.length} controls`);
  for (const { role, name } of controls) assert.ok(name?.value, `a ${role.value} without a name`);

  const wanted = await viewer.page.evaluate(() => [...document.querySelectorAll(
    'button, input, select, a, canvas')].filter((control) => control.checkVisibility() && !control.matches(':disabled'))
    .map((control) => control.id || control.getAttribute('href')));
  const reached = new Set();
  for (let i = 0; i < 2 * wanted.length; ++i) {
    await viewer.page.keyboard.press('Tab');
    reached.add(await viewer.page.evaluate(() => document.activeElement.id || document.activeElement.getAttribute('href')));
  }
  assert.deepEqual(wanted.filter((control) => !reached.has(control)), []);
});

test('dark and light: as the system has it, and by the button', async () => {
  const corner = async () => brightness(pixel(await viewer.picture(), 3, 3));
  await viewer.close();
  viewer = await Viewer.open(browser, loft.url, { colorScheme: 'dark' });
  assert.ok(await corner() < 80);
  await viewer.page.locator('#theme').click();
  await viewer.page.waitForSelector('#theme[aria-pressed="false"]');
  await viewer.settle();
  assert.ok(await corner() > 160);
});

test('after a resume there is no latency until an edit comes', async () => {
  await loft.post(square(0, 5), square(4, 5));
  await viewer.waitForSlabs(1);
  assert.match(await viewer.text('latency'), / ms$/);
  await viewer.close();
  await loft.end('SIGINT');
  loft = await stream();
  viewer = await Viewer.open(browser, loft.url);
  await viewer.waitForSlabs(1);
  await viewer.waitForText('state', 'Live');
  assert.equal(await viewer.text('latency'), '–');
  await loft.post(square(8, 5));
  await viewer.waitForSlabs(2);
  assert.match(await viewer.text('latency'), / ms$/);
});

test('a file is shown in the same page', async () => {
  await loft.post(square(0, 5), square(4, 5));
  await viewer.close();
  await loft.end('SIGINT');
  loft = await Loft.start('view', join(folder, 'session'), '--port', '0');
  viewer = await Viewer.open(browser, loft.url);
  await viewer.waitForSlabs(1);
  await viewer.waitForText('state', 'Recorded');
  assert.equal(await viewer.page.title(), 'session – Loft');
  assert.equal(await viewer.number('volume'), 400);
  assert.equal(await isSurfaceInTheMiddle(), true);
});
