// SPDX-License-Identifier: MIT
// What labels are to look like, and their table as CSV: without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Labels, soundsLikeSkin } from '../../viewer/src/labels.js';
import { columnsIn, inOrder, toCsv } from '../../viewer/src/table.js';
import { Measure } from '../../viewer/src/units.js';

function labelsOf(...names) {
  const labels = new Labels();
  for (const name of names) labels.enter(name, '#102030');
  return labels;
}
const shown = (labels) => labels.list().map(({ name }) => name).filter((name) => labels.isShown(name));

test('labels are in the order of their numbers, and found by a part of their names', () => {
  const labels = labelsOf('rib 10', 'rib 9', 'Liver');
  assert.deepEqual(labels.list().map(({ name }) => name), ['Liver', 'rib 9', 'rib 10']);
  assert.deepEqual(labels.list(' LIV ').map(({ name }) => name), ['Liver']);
});

test('a label alone, and again: what was shown before', () => {
  const labels = labelsOf('a', 'b', 'c');
  labels.toggle('b');
  labels.isolate('c');
  assert.deepEqual(shown(labels), ['c']);
  labels.toggle('a');
  assert.deepEqual(shown(labels), ['a', 'c']);
  labels.isolate('a');
  labels.isolate('a');
  assert.deepEqual(shown(labels), ['a', 'c']);
  labels.showAll();
  assert.deepEqual(shown(labels), ['a', 'b', 'c']);
});

test('a skin is transparent as long as there is something in it', () => {
  const labels = labelsOf('BODY');
  assert.equal(labels.opacity('BODY'), 1);
  labels.enter('liver');
  assert.ok(labels.opacity('BODY') < 0.5);
  assert.equal(labels.opacity('liver'), 1);
  labels.setOpacity('BODY', 0.9);
  assert.equal(labels.opacity('BODY'), 0.9);
  labels.restore('BODY');
  labels.leave('liver');
  assert.equal(labels.opacity('BODY'), 1);
});

test('skins are known by the words of their names, or as the server says', () => {
  for (const name of ['BODY', 'External', 'skin_outer', 'Body contour 2']) assert.ok(soundsLikeSkin(name), name);
  for (const name of ['vertebral body', 'bodywork', 'liver', '']) assert.ok(!soundsLikeSkin(name), name);
  const labels = labelsOf('hull', 'liver');
  labels.learn([{ label: 'hull', is_skin: true }]);
  assert.ok(labels.opacity('hull') < 1);
});

test('what was wished for a label stays while its slabs are replaced', async () => {
  const labels = labelsOf('a', 'b');
  labels.setColour('a', '#ff0000');
  labels.isolate('a');
  labels.choose('a');
  let lists = 0;
  labels.addEventListener('list', () => ++lists);
  labels.leave('a');
  labels.enter('a', '#102030');
  await Promise.resolve();
  assert.equal(lists, 1);
  assert.deepEqual([labels.colour('a'), labels.chosen, shown(labels)], ['#ff0000', 'a', ['a']]);
});

test('figures are in a unit for things of that size', () => {
  const measures = [['mm', 0.001, 'cm³', 1000], ['µm', 1e-6, 'µm³', 1], ['m', 1, 'm³', 1], ['cm', 0.01, 'cm³', 1]];
  for (const [unit, metres, name, one] of measures) {
    const measure = new Measure(metres);
    assert.equal(measure.volumeUnit, name, unit);
    assert.ok(Math.abs(measure.volume(one) - 1) < 1e-12, unit);
  }
});

test('CSV says its units, quotes what needs it, and has the order of the table', () => {
  const rows = [{ label: 'a, "b"', slices: 2, volume: 1.5, area: 2.25, faces: 12 },
                { label: 'c', slices: 0, volume: 9, area: 1, faces: 4 }];
  const sorted = inOrder(rows, { key: 'volume', isDescending: true });
  assert.equal(toCsv(sorted, columnsIn(new Measure(0.001))),
               'label,slices,volume_cm3,area_cm2,triangles\r\nc,,9,1,4\r\n"a, ""b""",2,1.5,2.25,12\r\n');
});
