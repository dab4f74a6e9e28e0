// SPDX-License-Identifier: MIT
// What the viewer shows while slabs come and go: node --test slabs_test.mjs
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { requestsFor } from '../../viewer/src/bundles.js';
import { Slabs } from '../../viewer/src/slabs.js';

// A stack's slabs and a picture of what is shown.
class Picture {
  shown = new Set();
  slabs = new Slabs((slab) => this.shown.add(slab), (slab) => this.shown.delete(slab));
  now = 0;

  change(removed, added) { return this.slabs.change(removed, added, this.now); }
  arrive(slab) {
    this.slabs.arrive(slab, this.now);
    this.slabs.settle(this.now);
  }
  get ids() { return [...this.shown].map((slab) => slab.id).sort(); }
}

const slab = (id, low, high, label = '') => ({ id, low, high, label });

test('A slab is shown when it has arrived', () => {
  const picture = new Picture();
  const [only] = picture.change([], [slab('0-1', 0, 1)]);
  assert.deepEqual(picture.ids, []);
  picture.arrive(only);
  assert.deepEqual(picture.ids, ['0-1']);
  assert.equal(picture.slabs.pending, 0);
});

test('A slab stays until all that replace it are there, which then come at once', () => {
  const picture = new Picture();
  picture.change([], [slab('0-1', 0, 2)]).forEach((one) => picture.arrive(one));
  const [lower, upper] = picture.change(['0-1'], [slab('0-2', 0, 1), slab('0-3', 1, 2)]);
  assert.deepEqual(picture.ids, ['0-1']);
  picture.arrive(upper);
  assert.deepEqual(picture.ids, ['0-1']);
  picture.arrive(lower);
  assert.deepEqual(picture.ids, ['0-2', '0-3']);
});

test('Slabs beside others touch them and have their label', () => {
  const picture = new Picture();
  const [, , upper] = picture.change([], [slab('0-1', 0, 1), slab('0-2', 1, 2), slab('0-3', 2, 3),
                                          slab('0-4', 3, 4), slab('1-1', 1, 2, 'b')]);
  const beside = picture.slabs.beside([upper]);
  assert.deepEqual(beside.map(({ id }) => id), ['0-2', '0-4']);
});

test('A slab that nothing replaces goes at once', () => {
  const picture = new Picture();
  picture.change([], [slab('0-1', 0, 1), slab('0-2', 1, 2)]).forEach((one) => picture.arrive(one));
  picture.change(['0-2'], []);
  assert.deepEqual(picture.ids, ['0-1']);
});

test('Labels do not wait for one another', () => {
  const picture = new Picture();
  picture.change([], [slab('0-1', 0, 1, 'a'), slab('1-1', 0, 1, 'b')])
    .forEach((one) => picture.arrive(one));
  picture.change(['0-1'], []);
  picture.change(['1-1'], [slab('1-2', 0, 1, 'b')]);
  assert.deepEqual(picture.ids, ['1-1']);
});

test('Where slabs change faster than they arrive the newest that did is shown', () => {
  const picture = new Picture();
  picture.change([], [slab('0-1', 0, 1)]).forEach((one) => picture.arrive(one));
  const [second] = picture.change(['0-1'], [slab('0-2', 0, 1)]);
  picture.change(['0-2'], [slab('0-3', 0, 1)]);
  picture.now = 10_000;
  picture.arrive(second);
  assert.deepEqual(picture.ids, ['0-2']);
});

test('After a reset what is shown stays until the new slabs are there', () => {
  const picture = new Picture();
  picture.change([], [slab('0-1', 0, 1)]).forEach((one) => picture.arrive(one));
  const before = [...picture.shown];
  const [again] = picture.slabs.reset([slab('0-1', 0, 1)], picture.now);
  assert.deepEqual([...picture.shown], before);
  picture.arrive(again);
  assert.deepEqual([...picture.shown], [again]);
});

test('Many slabs are asked for in ranges that have none of the others', () => {
  const known = new Set(['0-1', '0-3', '0-4', '0-5', '7-2', '7-3']);
  const wanted = ['7-2', '0-5', '0-1', '0-3', '7-3'].map((id) => ({ id }));
  const [only, ...more] = requestsFor(wanted, (id) => known.has(id));
  assert.deepEqual(more, []);
  assert.equal(only.ranges.join(), '7-2..3,0-1..3,0-5');
  assert.deepEqual(new Set(only.slabs), new Set(wanted));
});

test('Requests for many slabs are short, and all together they are for all', () => {
  const wanted = [];
  for (let part = 0; part < 900; ++part)
    for (let id = 0; id < 40; ++id) wanted.push({ id: `${part}-${3 * id + 7}` });
  const ids = new Set(wanted.map(({ id }) => id));
  const requests = requestsFor(wanted, (id) => ids.has(id));
  assert.deepEqual(new Set(requests.flatMap(({ slabs }) => slabs)), new Set(wanted));
  assert.equal(requests.reduce((sum, { slabs }) => sum + slabs.length, 0), wanted.length);
  for (const { ranges, slabs } of requests)
    assert.ok(slabs.length <= 2048 && ranges.join().length < 7000);
  assert.ok(requests.length < 24);
});

// A small generator: the same numbers for the same seed.
function random(seed) {
  let state = seed >>> 0;
  return (below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
}

test('Once all have arrived, in any order, exactly the slabs that there are are shown', () => {
  for (let seed = 1; seed <= 200; ++seed) {
    const pick = random(seed);
    const picture = new Picture();
    const heights = [0, 16];
    const underway = [];
    let [id, live] = [0, []];
    const rebuild = (from, to, levels) => {
      const gone = live.filter((one) => one.low < to && one.high > from);
      live = live.filter((one) => !gone.includes(one));
      const made = levels.slice(1).map((high, i) => slab(`0-${++id}`, levels[i], high));
      live.push(...made);
      underway.push(...picture.change(gone.map((one) => one.id), made));
    };
    rebuild(0, 16, heights);
    for (let step = 0; step < 60; ++step) {
      picture.now += pick(200);
      const z = 1 + pick(15);
      if (pick(2) === 0) {
        const below = Math.max(...heights.filter((height) => height < z));
        const above = Math.min(...heights.filter((height) => height > z));
        const isThere = heights.includes(z);
        const isRemoved = isThere && pick(2) === 0;
        if (!isThere) heights.push(z);
        if (isRemoved) heights.splice(heights.indexOf(z), 1);
        rebuild(below, above, isRemoved ? [below, above] : [below, z, above]);
      } else if (underway.length > 0) {
        picture.arrive(...underway.splice(pick(underway.length), 1));
      }
    }
    while (underway.length > 0) picture.arrive(...underway.splice(pick(underway.length), 1));
    assert.equal(picture.slabs.pending, 0);
    assert.deepEqual(picture.ids, live.map((one) => one.id).sort(), `seed ${seed}`);
  }
});
