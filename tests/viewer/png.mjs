// SPDX-License-Identifier: MIT
// Reads the PNG files that browsers write: 8 bits a channel, RGB or RGBA, not interlaced.
import assert from 'node:assert/strict';
import { inflateSync } from 'node:zlib';

function* chunks(file) {
  for (let place = 8; place < file.length;) {
    const size = file.readUInt32BE(place);
    yield { type: file.toString('latin1', place + 4, place + 8), data: file.subarray(place + 8, place + 8 + size) };
    place += size + 12;
  }
}

// What filter type 4 takes for likely.
function paeth(left, above, corner) {
  const guess = left + above - corner;
  const [a, b, c] = [left, above, corner].map((value) => Math.abs(guess - value));
  if (a <= b && a <= c) return left;
  return b <= c ? above : corner;
}

function guess(filter, left, above, corner) {
  return [0, left, above, (left + above) >> 1, filter === 4 ? paeth(left, above, corner) : 0][filter];
}

// { width, height, channels, pixels }
export function readPng(file) {
  const all = [...chunks(file)];
  const header = all[0].data;
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  const channels = { 2: 3, 6: 4 }[header[9]];
  assert.ok(header[8] === 8 && channels && header[12] === 0, 'a kind of PNG that is not known here');
  const packed = inflateSync(Buffer.concat(all.filter(({ type }) => type === 'IDAT').map(({ data }) => data)));
  const row = width * channels;
  const pixels = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = packed[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const at = y * row + x;
      const left = x < channels ? 0 : pixels[at - channels];
      const above = y === 0 ? 0 : pixels[at - row];
      const corner = x < channels || y === 0 ? 0 : pixels[at - row - channels];
      pixels[at] = packed[y * (row + 1) + 1 + x] + guess(filter, left, above, corner);
    }
  }
  return { width, height, channels, pixels };
}
