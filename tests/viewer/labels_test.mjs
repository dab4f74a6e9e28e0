// SPDX-License-Identifier: MIT
// Labels in the viewer, in a real browser: list, table, history, narrow pages. LOFT names the
// program; see run.sh.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { Viewer, difference, startBrowser } from './browser.mjs';
import { Loft } from './loft.mjs';

let browser;
let loft;
let viewer;

// A body with a liver in its middle and forty nodes around that.
const nodes = Array.from({ length: 40 }, (_, i) => `node ${i + 1}`);
const names = ['BODY', 'liver', ...nodes];

function box(x, y, half) {
  return [[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]];
}

function slice(z) {
  const around = nodes.map((_, i) => {
    const angle = (2 * Math.PI * i) / nodes.length;
    return box(30 * Math.cos(angle), 30 * Math.sin(angle), 1.5);
  });
  return JSON.stringify({ op: 'insert', z, contours: [box(0, 0, 50), box(0, 0, 10), ...around], labels: names });
}

before(async () => {
  browser = await startBrowser();
  loft = await Loft.start('stream', '--no-input', '--view', '--port', '0');
  await loft.post(slice(0), slice(10), slice(20));
});
after(async () => {
  await browser.close();
  await loft.end();
});
afterEach(() => viewer.close());

async function open(options = {}, isReady = (page) => page) {
  viewer = await Viewer.open(browser, loft.url, { viewport: { width: 640, height: 640 }, ...options });
  await isReady(viewer.page);
  await viewer.page.waitForFunction((count) => document.getElementById('labels-count').textContent === count,
                                    String(names.length));
  await viewer.settle();
}

const shown = (selector) => viewer.page.locator(selector).isVisible();
const rows = () => viewer.page.locator('#labels [role="option"]:visible').allInnerTexts();
const chosen = () => viewer.page.locator('#labels [aria-selected="true"]:visible').innerText();

// Presses a key; the picture must change by it, and is returned.
async function press(key, from) {
  await viewer.page.keyboard.press(key);
  for (let i = 0; i < 100; ++i) {
    await viewer.settle();
    const picture = await viewer.picture();
    if (difference(from, picture) > 30) return picture;
  }
  return assert.fail(`nothing changes by ${key}`);
}

async function assertCalm() {
  assert.deepEqual(viewer.complaints, []);
  assert.deepEqual(viewer.foreign, []);
}

const wide = { viewport: { width: 900, height: 640 } };

test('a click goes through the skin, marks the label in the list, and H and I act on it', async () => {
  await open(wide);
  const before = await viewer.picture();
  const { width, height } = await viewer.page.locator('#canvas').boundingBox();
  await viewer.page.locator('#canvas').click({ position: { x: width / 2, y: height / 2 } });
  await viewer.page.waitForFunction(() => document.getElementById('pick').textContent.includes('Volume'));
  assert.equal(await chosen(), 'liver');
  assert.match(await viewer.text('pick'), /Label\s+liver/);
  assert.match(await viewer.text('pick'), /Volume\s+8 cm³\s+Area\s+24 cm²/);
  await viewer.page.keyboard.press('Escape');
  assert.equal(await viewer.text('label-name'), 'None chosen');

  await viewer.page.locator('#canvas').click({ position: { x: width / 2, y: height / 2 } });
  await viewer.page.waitForFunction(() => document.getElementById('label-name').textContent === 'liver');
  await viewer.page.locator('#canvas').focus();
  const picked = await viewer.picture();
  const without = await press('h', picked);
  assert.equal(await shown('#labels-all'), true);
  const alone = await press('i', without);
  const again = await press('i', alone);
  assert.ok(difference(again, without) < 30);
  await viewer.page.locator('#labels-all').click();
  assert.equal(await shown('#labels-all'), false);
  assert.ok(difference(before, picked) > 0);
  await assertCalm();
});

test('the list is searched, and its arrows choose; few rows are in the page', async () => {
  await open(wide);
  assert.ok(await viewer.page.locator('#labels [role="option"]').count() < names.length);
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('/');
  await viewer.page.keyboard.type('E 3');  // letters are no keys of the page here
  await viewer.waitForText('labels-count', '11 of 42');
  await viewer.settle();
  assert.equal((await rows())[0], 'node 3');
  await viewer.page.keyboard.press('ArrowDown');
  await viewer.waitForText('label-name', 'node 3');
  await viewer.page.keyboard.press('End');
  await viewer.waitForText('label-name', 'node 39');
  await viewer.settle();
  assert.equal(await chosen(), 'node 39');
  const active = await viewer.page.locator('#labels').getAttribute('aria-activedescendant');
  assert.equal(await viewer.page.locator(`#${active}`).getAttribute('aria-posinset'), '11');
  await viewer.page.keyboard.press(' ');
  await viewer.settle();
  assert.equal(await viewer.page.locator(`#${active}`).getAttribute('aria-label'), 'node 39, hidden');
  await assertCalm();
});

test('colour and opacity are chosen, and taken back', async () => {
  await open(wide);
  await viewer.page.locator('#labels').focus();
  await viewer.page.keyboard.press('Home');
  await viewer.waitForText('label-name', 'BODY');
  assert.equal(await viewer.text('label-percent'), '25 %');
  const before = await viewer.picture();
  await viewer.page.locator('#label-opacity').focus();
  const solid = await press('End', before);
  assert.equal(await viewer.text('label-percent'), '100 %');
  assert.ok(difference(before, solid) > 5000);
  await viewer.page.locator('#label-colour').fill('#ff2020');
  await viewer.settle();
  assert.ok(difference(solid, await viewer.picture()) > 5000);
  await viewer.page.locator('#label-restore').click();
  await viewer.settle();
  assert.ok(difference(before, await viewer.picture()) < 30);
  await assertCalm();
});

test('the table sorts by each column and copies as CSV', async () => {
  await open({ ...wide, permissions: ['clipboard-read', 'clipboard-write'] });
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('g');
  await viewer.page.waitForSelector('#table[open]');
  const first = () => viewer.page.locator('#table-body tr').first().innerText();
  assert.match(await first(), /^BODY\s+3\s/);
  for (const [column, wanted] of [[/^Volume/, /^BODY/], [/^Area/, /^BODY/], [/^Triangles/, /./], [/^Slices/, /./]]) {
    await viewer.page.locator('#table-head').getByRole('button', { name: column }).press('Enter');
    assert.match(await first(), wanted);
  }
  await viewer.page.getByRole('button', { name: 'Volume (cm³)' }).click();
  await viewer.page.getByRole('button', { name: 'Volume (cm³)' }).click();
  assert.match(await first(), /^node 1\s/);
  assert.equal(await viewer.page.locator('th[aria-sort]').getAttribute('aria-sort'), 'ascending');
  await viewer.page.locator('#table-copy').click();
  await viewer.waitForText('table-said', 'Copied as CSV.');
  const lines = (await viewer.page.evaluate(() => navigator.clipboard.readText())).trim().split(/\r?\n/);
  assert.equal(lines[0], 'label,slices,volume_cm3,area_cm2,triangles');
  assert.equal(lines.length, 1 + names.length);
  assert.match(lines[1], /^node 1,3,0\.1[78]/);
  await viewer.page.keyboard.press('Escape');
  await viewer.page.waitForSelector('#table', { state: 'hidden' });
  await assertCalm();
});

// Whether any two of the elements have a part of the page in common.
async function overlaps(selector) {
  const boxes = await viewer.page.locator(selector).evaluateAll((all) => all
    .filter((element) => element.checkVisibility() && !element.closest('[hidden]'))
    .map((element) => [element.id || element.textContent, element.getBoundingClientRect().toJSON()]));
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  return boxes.flatMap(([name, one], i) => boxes.slice(i + 1)
    .filter(([, other]) => meet(one, other)).map(([other]) => `${name} and ${other}`));
}

test('on a narrow page the scene comes first, and nothing overlaps', async () => {
  await open({ viewport: { width: 320, height: 640 }, hasTouch: true });
  assert.equal(await shown('#side'), false);
  assert.ok((await viewer.page.locator('#canvas').boundingBox()).height > 500);
  assert.deepEqual(await overlaps('#tools button, #downloads a, #drawer'), []);
  await viewer.page.locator('#drawer').tap();
  assert.equal(await shown('#labels'), true);
  assert.equal(await viewer.page.locator('#drawer').getAttribute('aria-expanded'), 'true');
  assert.deepEqual(await overlaps('main, #drawer, #side'), []);
  assert.deepEqual(await overlaps('#side button, #side input, #side select, #side dd, #side h2, #labels'), []);
  assert.ok(await viewer.page.evaluate(() => document.documentElement.scrollWidth <= 320 &&
                                             document.getElementById('side').scrollWidth <= 320));
  await viewer.page.locator('#labels').press('Escape');
  assert.equal(await shown('#side'), false);
  await viewer.page.locator('#help-open').tap();
  assert.match(await viewer.text('help'), /Two fingers/);
  await assertCalm();
});

test('the theme is remembered', async () => {
  await open({ ...wide, colorScheme: 'light' });
  await viewer.page.keyboard.press('t');
  await viewer.page.reload();
  await viewer.page.waitForSelector(':root[data-theme="dark"] #theme[aria-pressed="true"]');
  await assertCalm();
});

test('edits are undone by button and key, with the token of the address', async () => {
  await open(wide, async (page) => {
    await page.goto(`${loft.url}#token=secret`);
    await page.reload();
  });
  const asked = [];
  viewer.page.on('request', async (request) => {
    if (request.method() === 'POST')
      asked.push([new URL(request.url()).pathname, request.headers().authorization]);
  });
  await viewer.page.waitForSelector('#history [role="option"]');
  assert.equal(await viewer.page.locator('#history [role="option"]').first().innerText(), '3 insert z 20 mm');
  assert.equal(await viewer.page.locator('#redo').isDisabled(), true);
  await viewer.page.locator('#undo').click();
  await viewer.waitForText('slices', '2');
  await viewer.page.waitForSelector('#history .undone');
  await viewer.page.waitForSelector('#redo:enabled');
  await viewer.page.locator('#canvas').focus();
  await viewer.page.keyboard.press('Control+Shift+Z');
  await viewer.waitForText('slices', '3');
  await viewer.page.waitForSelector('#redo:disabled');
  assert.deepEqual(asked, [['/undo', 'Bearer secret'], ['/redo', 'Bearer secret']]);
  await assertCalm();
});
