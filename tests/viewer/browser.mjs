// SPDX-License-Identifier: MIT
// A page in Debian's Chromium, and what can be seen on it.
import { chromium } from 'playwright-core';
import { readPng } from './png.mjs';

const patience = 60_000;  // ms; for slow machines: nothing waits that long where all is well

export async function startBrowser(...more) {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
           ...more] });
}

export class Viewer {
  static async open(browser, url, options = {}) {
    const viewer = new Viewer();
    viewer.complaints = [];
    viewer.foreign = [];
    viewer.context = await browser.newContext({ viewport: { width: 900, height: 640 }, ...options });
    viewer.context.setDefaultTimeout(patience);
    viewer.page = await viewer.context.newPage();
    viewer.page.on('pageerror', (error) => viewer.complaints.push(String(error)));
    viewer.page.on('console', (message) => {
      // A slab may be gone before it could be fetched: the next event says so.
      const isGone = message.location().url.includes('/slabs/') && message.text().includes('404');
      if (message.type() === 'error' && !isGone) viewer.complaints.push(message.text());
    });
    viewer.page.on('request', (request) => {
      const address = request.url();
      if (!address.startsWith(url) && !address.startsWith('data:')) viewer.foreign.push(address);
    });
    await viewer.page.goto(url);
    await viewer.page.evaluate(() => { globalThis.isTheSamePage = true; });
    return viewer;
  }

  close() { return this.context.close(); }

  text(id) { return this.page.locator(`#${id}`).innerText(); }
  // The number that an element shows.
  async number(id) { return Number.parseFloat((await this.text(id)).replaceAll(',', '')); }

  // Waits until an element shows a text.
  async waitForText(id, text) {
    await this.page.waitForFunction(
      ([name, wanted]) => document.getElementById(name).textContent.trim() === wanted, [id, text]);
  }

  // Waits until there are so many slabs, and all of them are in the picture.
  async waitForSlabs(count) {
    await this.waitForText('slabs', String(count));
    await this.settle();
  }

  async settle() {
    await this.page.waitForSelector('#canvas[aria-busy="false"]');
    await this.page.evaluate(() => new Promise((resolve) => {
      requestAnimationFrame(() => requestAnimationFrame(resolve));
    }));
  }

  isTheSamePage() { return this.page.evaluate(() => globalThis.isTheSamePage === true); }

  // The canvas as it is seen.
  async picture() {
    return readPng(await this.page.locator('#canvas').screenshot());
  }
}

export function pixel({ width, channels, pixels }, x, y) {
  const at = channels * (y * width + x);
  return [...pixels.subarray(at, at + 3)];
}

export function brightness(colour) {
  return colour.reduce((sum, value) => sum + value, 0) / 3;
}

// How many pixels of two pictures differ by more than a shade.
export function difference(a, b) {
  let count = 0;
  for (let i = 0; i < a.pixels.length; i += a.channels) {
    const isOther = [0, 1, 2].some((k) => Math.abs(a.pixels[i + k] - b.pixels[i + k]) > 12);
    if (isOther) ++count;
  }
  return count;
}
