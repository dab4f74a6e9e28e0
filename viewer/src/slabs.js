// SPDX-License-Identifier: MIT
// Which slabs there are and which of them are shown. A slab that is gone stays in the picture until
// those in its place have arrived; they come in at the same moment, so that nothing flickers.
import { ByLabel } from './by_label.js';

// For how long a slab that is gone may wait for all that replace it: where a stack changes faster
// than it can be fetched, some of what is new is better than all of what is old.
const patience = 400;  // ms

// Of the same label.
function meet(a, b) {
  return a.low < b.high && b.low < a.high;
}

// Visits those that meet one; returns how many. Without a list: there may be thousands, often.
function visitMeeting(slabs, slab, visit = () => {}) {
  let count = 0;
  for (const other of slabs.of(slab.label)) {
    if (!meet(other, slab)) continue;
    ++count;
    visit(other);
  }
  return count;
}

function isNewerThere(slabs, slab) {
  for (const other of slabs.of(slab.label))
    if (other.order > slab.order && meet(other, slab)) return true;
  return false;
}

export class Slabs {
  #live = new Map();          // by id
  #liveOnes = new ByLabel();  // the same
  #pending = new ByLabel();   // live, not yet here
  #hidden = new ByLabel();    // live and here, but slabs that they replace (`covers`) are still shown
  #retired = new ByLabel();   // shown, though they are gone: so many in their place are `awaited`
  #shown = new ByLabel();     // these, and those that are live
  #free = [];                 // of the hidden and the retired: some that wait for none any more
  #order = 0;
  #show;
  #hide;

  // show(slab) and hide(slab) put what has been loaded into the picture and take it out.
  constructor(show, hide) {
    this.#show = show;
    this.#hide = hide;
  }

  get pending() { return this.#pending.size; }
  get size() { return this.#live.size; }
  // The lowest and the highest height; undefined without slabs.
  get range() {
    if (this.#live.size === 0) return undefined;
    let [low, high] = [Infinity, -Infinity];
    for (const slab of this.#live.values()) {
      low = Math.min(low, slab.low);
      high = Math.max(high, slab.high);
    }
    return [low, high];
  }
  has(id) { return this.#live.has(id); }
  isPending(slab) { return this.#pending.has(slab); }
  isInPlace(slab) { return slab.isShown && this.#live.get(slab.id) === slab; }
  // Those that touch one of some others.
  beside(slabs) {
    const own = new Set(slabs);
    const touching = new Set();
    for (const { label, low, high } of slabs)
      for (const other of this.#liveOnes.of(label))
        if ((low === other.high || high === other.low) && !own.has(other)) touching.add(other);
    return [...touching];
  }

  // The edit in which `removed` (ids) went and `added` came. Returns what is to be fetched.
  change(removed, added, now) {
    for (const id of removed) this.#retire(this.#live.get(id), now);
    const slabs = added.map((slab) => ({ ...slab, order: ++this.#order, isShown: false }));
    for (const slab of slabs) {
      this.#live.set(slab.id, slab);
      this.#liveOnes.add(slab);
      this.#pending.add(slab);
      visitMeeting(this.#retired, slab, (old) => { ++old.awaited; });
    }
    this.#swap();
    return slabs;
  }

  // All slabs are others. What is shown stays until they are there.
  reset(added, now) {
    return this.change([...this.#live.keys()], added, now);
  }

  // The slab has arrived. Not kept where a newer one is in its place already.
  arrive(slab, now) {
    if (this.#stopAwaiting(slab)) {
      this.#hideUntilItsPlaceIsFree(slab);
    } else if (isNewerThere(this.#shown, slab)) {
      return;
    } else {
      this.#put(slab);
      this.#keepOld(slab, now);
    }
    this.#swap();
  }

  // Gives up waiting for what takes too long. To be called now and then while anything is pending.
  settle(now) {
    for (const old of [...this.#retired]) {
      const isOutdone = isNewerThere(this.#hidden, old) || isNewerThere(this.#retired, old);
      if (now - old.retiredAt > patience && isOutdone) this.#drop(old);
    }
    this.#swap();
  }

  // Swaps what can be swapped: what goes makes room for more, which is at the end then.
  #swap() {
    for (const slab of this.#free) {
      if (slab.awaited === 0 && this.#retired.has(slab)) this.#drop(slab);
      else if (slab.covers === 0 && this.#hidden.delete(slab)) this.#put(slab);
    }
    this.#free = [];
  }

  #put(slab) {
    slab.isShown = true;
    this.#shown.add(slab);
    this.#show(slab);
  }

  #hideUntilItsPlaceIsFree(slab) {
    slab.covers = visitMeeting(this.#retired, slab);
    this.#hidden.add(slab);
    if (slab.covers === 0) this.#free.push(slab);
  }

  // A shown slab that is gone stays as long as others are awaited in its place.
  #keepOld(slab, now) {
    slab.retiredAt = now;
    slab.awaited = visitMeeting(this.#pending, slab);
    this.#retired.add(slab);
    visitMeeting(this.#hidden, slab, (hidden) => { ++hidden.covers; });
    if (slab.awaited === 0) this.#free.push(slab);
  }

  #drop(slab) {
    this.#retired.delete(slab);
    this.#shown.delete(slab);
    visitMeeting(this.#hidden, slab, (hidden) => {
      if (--hidden.covers === 0) this.#free.push(hidden);
    });
    slab.isShown = false;
    this.#hide(slab);
  }

  // Whether it was awaited.
  #stopAwaiting(slab) {
    if (!this.#pending.delete(slab)) return false;
    visitMeeting(this.#retired, slab, (old) => { if (--old.awaited === 0) this.#free.push(old); });
    return true;
  }

  #retire(slab, now) {
    if (!slab) return;
    this.#live.delete(slab.id);
    this.#liveOnes.delete(slab);
    this.#stopAwaiting(slab);
    this.#hidden.delete(slab);
    if (slab.isShown) this.#keepOld(slab, now);
  }
}
