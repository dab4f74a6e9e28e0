// SPDX-License-Identifier: MIT
// Many slabs with few requests: the server sends as many of them at once as fit into an answer.
import { parseBundles } from './glb.js';

const mostSlabs = 2048;       // in a request
const mostCharacters = 6000;  // in its address
const widestGap = 64;         // between ids that are asked for as a range

function partsOf(id) {
  return id.split('-').map(Number);
}

// `ids` sorted, of one part: those that follow one another as ranges, unless one is known between
// them that is not wanted.
function rangesOf(part, ids, isKnown) {
  const isFree = (from, to) => {
    if (to - from > widestGap) return false;
    for (let id = from + 1; id < to; ++id) if (isKnown(`${part}-${id}`)) return false;
    return true;
  };
  const ranges = [];
  for (const id of ids) {
    const last = ranges.at(-1);
    if (last && isFree(last[1], id)) last[1] = id;
    else ranges.push([id, id]);
  }
  return ranges.map(([from, to]) => (from === to ? `${part}-${from}` : `${part}-${from}..${to}`));
}

// The slabs by their parts, those of a part in the order of their numbers.
function sorted(slabs) {
  const parts = new Map();
  for (const slab of slabs) {
    const [part, id] = partsOf(slab.id);
    if (!parts.has(part)) parts.set(part, []);
    parts.get(part).push({ slab, id });
  }
  for (const own of parts.values()) own.sort((a, b) => a.id - b.id);
  return parts;
}

// In requests of a bounded length each: { ranges, slabs }.
export function requestsFor(slabs, isKnown) {
  const requests = [];
  let open;
  for (const [part, own] of sorted(slabs)) {
    for (let begin = 0; begin < own.length;) {
      if (!open || open.slabs.length >= mostSlabs || open.ranges.join().length > mostCharacters) {
        open = { ranges: [], slabs: [] };
        requests.push(open);
      }
      const some = own.slice(begin, begin + Math.min(mostSlabs - open.slabs.length, 256));
      open.ranges.push(...rangesOf(part, some.map(({ id }) => id), isKnown));
      open.slabs.push(...some.map(({ slab }) => slab));
      begin += some.length;
    }
  }
  return requests;
}

// Asks for slabs; isWanted(slab) is asked before and after, isKnown(id) tells of those that there
// are. take(slab, content) is called for each that has come, miss(slab) for those that are gone,
// and done() after each answer.
export function fetchMany(loader, slabs, { isKnown, isWanted, take, miss, done }) {
  const ask = (wanted) => {
    // Turned round, as what is wished for last comes first.
    for (const request of requestsFor(wanted, isKnown).reverse()) fetchThese(request);
  };
  const fetchThese = (request) => {
    const left = new Map(request.slabs.map((slab) => [slab.id, slab]));
    const wanted = () => [...left.values()].filter(isWanted);
    loader.fetch(`slabs?ids=${request.ranges.join()}`, () => wanted().length > 0, async (response) => {
      const before = left.size;
      for (const content of parseBundles(await response.arrayBuffer())) {
        const slab = left.get(content.id);
        left.delete(content.id);
        if (slab && isWanted(slab)) take(slab, content);
      }
      done();
      if (left.size < before) ask(wanted());
      else wanted().forEach(miss);
    }, () => wanted().forEach(miss));
  };
  ask(slabs.filter(isWanted));
}
