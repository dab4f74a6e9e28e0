// SPDX-License-Identifier: MIT
// What three.js makes of the glTF that is smaller: the same picture as of the plain one. Needs LOFT,
// and LOFT_MODULES, where three.js and esbuild are.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { difference, pixel, startBrowser } from './browser.mjs';
import { readPng } from './png.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const samples = join(here, '../../samples/data');
let browser;
let page;
let folder;

async function bundle() {
  const modules = process.env.LOFT_MODULES;
  const { build } = createRequire(join(modules, 'package.json'))('esbuild');
  const made = await build({ entryPoints: [join(here, 'compressed_page.js')], bundle: true,
    format: 'iife', write: false, nodePaths: [modules] });
  return made.outputFiles[0].text;
}

before(async () => {
  folder = await mkdtemp(join(tmpdir(), 'loft-compressed-'));
  browser = await startBrowser();
  page = await browser.newPage({ viewport: { width: 500, height: 500 } });
  await page.setContent('<body style="margin:0"><canvas id="canvas" width="500" height="500">');
  await page.addScriptTag({ content: await bundle() });
});

after(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});

async function draw(stack, options, flat = false) {
  const file = join(folder, 'a.glb');
  execFileSync(process.env.LOFT, ['reconstruct', stack, '-o', file, '-q', ...options], { stdio: 'pipe' });
  const kinds = await page.evaluate(([bytes, isFlat]) => globalThis.draw(bytes, isFlat),
    [(await readFile(file)).toString('base64'), flat]);
  const picture = readPng(await page.locator('#canvas').screenshot());
  return { kinds, picture };
}

function covered({ picture }) {
  let count = 0;
  for (let i = 0; i < picture.pixels.length; i += picture.channels)
    if (picture.pixels[i] !== 0x20 || picture.pixels[i + 1] !== 0x20) ++count;
  return count;
}

for (const name of ['shells.ndjson', 'vessels.ndjson', 'mim_7.0.3_four_rois.dcm'])
  test(`${name} looks the same, quantised and packed`, async () => {
    const stack = join(samples, name);
    const plain = await draw(stack, ['--with-contours']);
    assert.ok(covered(plain) > 2000, 'there is something to see');
    for (const how of ['quantize', 'meshopt']) {
      const small = await draw(stack, ['--with-contours', '--compress', how]);
      assert.deepEqual(small.kinds, plain.kinds);
      const share = difference(plain.picture, small.picture) / covered(plain);
      assert.ok(share < 0.005, `${how}: ${share} of the pixels differ`);
    }
  });

test('colours of a source come out as they went in', async () => {
  const seen = await draw(join(samples, 'mim_7.0.3_four_rois.dcm'), ['--compress', 'meshopt'], true);
  const colours = new Set();
  for (let y = 0; y < 500; ++y)
    for (let x = 0; x < 500; ++x) colours.add(pixel(seen.picture, x, y).join());
  for (const colour of ['255,0,255', '0,235,235', '255,255,0', '255,0,0'])
    assert.ok(colours.has(colour), `${colour} among ${[...colours]}`);
});
