// SPDX-License-Identifier: MIT
// How each label is to be shown: whether at all, its colour, its opacity. Skins, which go around
// all the rest, start transparent: what is in them is what people look for.

const skinOpacity = 0.25;
const skinNames = new Set(['external', 'body', 'skin']);
// What may stand beside them, as in io/meshes/skin.h; a vertebral body is no skin.
const skinCompany = new Set(['contour', 'contours', 'outer', 'outline', 'patient', 'surface', 'the',
                             'whole', 'roi']);
const { compare } = new Intl.Collator('en', { numeric: true });

export function soundsLikeSkin(name) {
  const words = name.toLowerCase().split(/[^\p{L}]+/u).filter(Boolean);
  return words.some((word) => skinNames.has(word)) &&
         words.every((word) => skinNames.has(word) || skinCompany.has(word));
}

// Dispatches `list` when there are other labels, `look` when they are to be shown otherwise, with
// what of it (`visibility`, `colour`, `opacity`), and `choice` when another one is chosen.
export class Labels extends EventTarget {
  #all = new Map();  // by name, those that are gone, too: what was wished for them stays
  #present;          // sorted, once asked for
  #isolated;         // names that alone are shown, if it is so
  #chosen;
  #isTelling = false;

  // Those in the picture, by name; `filter` is a part of the names.
  list(filter = '') {
    this.#present ??= [...this.#all.values()].filter(({ slabs }) => slabs > 0)
      .sort((a, b) => compare(a.name, b.name));
    const part = filter.trim().toLowerCase();
    return part ? this.#present.filter(({ name }) => name.toLowerCase().includes(part)) : this.#present;
  }

  get chosen() { return this.#all.get(this.#chosen)?.slabs > 0 ? this.#chosen : undefined; }
  get isAnyHidden() { return this.list().some(({ name }) => !this.isShown(name)); }

  isShown(name) {
    return this.#isolated ? this.#isolated.has(name) : !this.#all.get(name)?.isHidden;
  }
  isIsolated(name) { return this.#isolated?.size === 1 && this.#isolated.has(name); }
  // `#rrggbb`
  colour(name) { return this.#all.get(name)?.chosenColour ?? this.#all.get(name)?.colour; }
  // 0 to 1
  opacity(name) {
    const label = this.#all.get(name);
    return label?.opacity ?? (label?.isSkin && this.#hasOrgans() ? skinOpacity : 1);
  }
  isChanged(name) {
    const label = this.#all.get(name);
    return label?.chosenColour !== undefined || label?.opacity !== undefined;
  }

  // A slab with that label is in the picture; `colour` is what it came with.
  enter(name, colour) {
    const label = this.#of(name);
    if (colour && label.colour !== colour) this.#tellLook('colour');
    label.colour = colour ?? label.colour;
    if (++label.slabs === 1) this.#tellList();
  }

  leave(name) {
    if (--this.#of(name).slabs === 0) this.#tellList();
  }

  // What the server says of them.
  learn(figures) {
    for (const { label, is_skin: isSkin } of figures)
      if (isSkin !== undefined) this.#of(label).isSkin = isSkin;
    this.#tellLook('opacity');
  }

  choose(name) {
    if (this.#chosen === name) return;
    this.#chosen = name;
    this.dispatchEvent(new Event('choice'));
  }

  // Shows it, or no longer.
  toggle(name) {
    if (!this.#isolated) this.#of(name).isHidden = !this.#of(name).isHidden;
    else if (!this.#isolated.delete(name)) this.#isolated.add(name);
    this.#tellLook('visibility');
  }

  // Shows nothing else; where that is so already, all that was shown before.
  isolate(name) {
    this.#isolated = this.isIsolated(name) ? undefined : new Set([name]);
    this.#tellLook('visibility');
  }

  showAll() {
    this.#isolated = undefined;
    for (const label of this.#all.values()) label.isHidden = false;
    this.#tellLook('visibility');
  }

  setColour(name, colour) {
    this.#of(name).chosenColour = colour;
    this.#tellLook('colour');
  }

  setOpacity(name, opacity) {
    this.#of(name).opacity = opacity;
    this.#tellLook('opacity');
  }

  // Colour and opacity as they came.
  restore(name) {
    this.setColour(name, undefined);
    this.setOpacity(name, undefined);
  }

  #of(name) {
    if (!this.#all.has(name))
      this.#all.set(name, { name, slabs: 0, isHidden: false, isSkin: soundsLikeSkin(name) });
    return this.#all.get(name);
  }

  #hasOrgans() {
    for (const { slabs, isSkin } of this.#all.values()) if (slabs > 0 && !isSkin) return true;
    return false;
  }

  #tellLook(what) {
    this.dispatchEvent(new CustomEvent('look', { detail: what }));
  }

  // Once for all that changes at the same time: a label whose slabs are replaced is not gone.
  #tellList() {
    this.#present = undefined;
    if (this.#isTelling) return;
    this.#isTelling = true;
    queueMicrotask(() => {
      this.#isTelling = false;
      this.dispatchEvent(new Event('list'));
    });
  }
}
