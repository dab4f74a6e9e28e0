// SPDX-License-Identifier: MIT
// Contours without a surface, and the page that needs no server. LOFT names the program.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { Viewer, difference, startBrowser } from './browser.mjs';
import { Loft, square } from './loft.mjs';

const run = (...words) => promisify(execFile)(process.env.LOFT, words);
let browser;
let folder;

before(async () => {
  browser = await startBrowser();
  folder = await mkdtemp(join(tmpdir(), 'loft-contours-'));
  await writeFile(join(folder, 'box.ndjson'), [0, 2, 4, 6].map((z) => square(z, 5 - 0.5 * z)).join('\n'));
  await run('reconstruct', join(folder, 'box.ndjson'), '-o', join(folder, 'box.ply'), '-o', join(folder, 'box.glb'),
            '--with-contours', '-q');
});
after(async () => {
  await rm(folder, { recursive: true });
  await browser.close();
});

// How many pixels are neither background nor grid: dark or coloured.
async function inkOf(viewer) {
  await viewer.settle();
  const { pixels, channels } = await viewer.picture();
  let count = 0;
  for (let i = 0; i < pixels.length; i += channels) {
    const [r, g, b] = pixels.subarray(i, i + 3);
    if (Math.max(r, g, b) < 140 || Math.max(r, g, b) - Math.min(r, g, b) > 40) ++count;
  }
  return count;
}

async function waitForInk(viewer, least) {
  for (let i = 0; i < 100; ++i) if (await inkOf(viewer) >= least) return;
  assert.fail(`there is nothing to be seen: ${await inkOf(viewer)}`);
}

test('The first slice of a capture is seen, then the surface', async () => {
  const loft = await Loft.start('stream', '--no-input', '--port', '0');
  const viewer = await Viewer.open(browser, loft.url);
  await viewer.page.waitForSelector('#empty', { state: 'visible' });
  await loft.post(square(3, 5));
  await viewer.waitForText('slices', '1');
  await waitForInk(viewer, 200);
  assert.equal(await viewer.page.locator('#empty').isVisible(), false);
  const first = await viewer.picture();
  await loft.post(square(6, 5));
  await viewer.waitForSlabs(1);
  assert.ok(difference(first, await viewer.picture()) > 5000);
  assert.deepEqual(viewer.complaints, []);
  await viewer.close();
  await loft.end();
});

test('A stack is seen before there is a surface', async () => {
  const loft = await Loft.start('view', join(folder, 'box.ndjson'), '--port', '0');
  const viewer = await Viewer.open(browser, loft.url);
  await viewer.waitForText('slices', '4');
  await waitForInk(viewer, 500);
  assert.equal(await viewer.page.locator('#contours').isDisabled(), false);
  assert.equal(await viewer.page.locator('#downloads a').count(), 0);
  assert.equal(await viewer.text('volume'), '–');
  assert.deepEqual(viewer.complaints, []);
  await viewer.close();
  await loft.end();
});

for (const file of ['box.ply', 'box.glb']) test(`${file} has its contours`, async () => {
  const loft = await Loft.start('view', join(folder, file), '--port', '0');
  const viewer = await Viewer.open(browser, loft.url);
  await viewer.page.waitForFunction(() => !document.getElementById('contours').disabled);
  assert.equal(await viewer.page.locator('#no-contours').isVisible(), false);
  await viewer.settle();
  const before = await viewer.picture();
  await viewer.page.locator('#contours').check();
  for (let i = 0; i < 100 && difference(before, await viewer.picture()) < 200; ++i) await viewer.settle();
  assert.ok(difference(before, await viewer.picture()) >= 200);
  await viewer.close();
  await loft.end();
});

test('An exported page opened from the disk looks as the served one', async () => {
  const page = join(folder, 'page');
  await run('view', join(folder, 'box.ply'), '--export', page);
  const loft = await Loft.start('view', join(folder, 'box.ply'), '--port', '0');
  const served = await Viewer.open(browser, loft.url);
  const exported = await Viewer.open(browser, `${pathToFileURL(page)}/index.html`);
  for (const viewer of [served, exported]) {
    await viewer.page.waitForFunction(() => !document.getElementById('contours').disabled);
    await viewer.settle();
  }
  for (let i = 0; i < 50 && difference(await served.picture(), await exported.picture()) > 30; ++i)
    await exported.settle();
  assert.ok(difference(await served.picture(), await exported.picture()) <= 30);
  assert.equal(await exported.text('faces'), await served.text('faces'));
  assert.deepEqual(exported.complaints, []);
  const foreign = exported.foreign.filter((url) => !url.startsWith('file:') && !url.startsWith('blob:'));
  assert.deepEqual(foreign, []);
  await exported.close();
  await served.close();
  await loft.end();
});
