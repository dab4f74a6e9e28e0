// SPDX-License-Identifier: MIT
// Elements, and numbers for people.

// make('button', { id: 'go', onclick: () => ... }, 'Go')
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element && name !== 'list') element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export function section(title, ...children) {
  return make('section', {}, make('h2', {}, title), ...children);
}

export function button(words, title, onclick) {
  return make('button', { type: 'button', title, onclick }, words);
}

// A list of names and values; the values are returned by name.
export function figures(...names) {
  const list = make('dl');
  const values = {};
  for (const name of names) {
    values[name] = make('dd', {}, '–');
    list.append(make('dt', {}, name), values[name]);
  }
  return { list, values };
}

export function slider(words, most, step, oninput) {
  const value = make('span', { className: 'value' });
  const range = make('input', { type: 'range', min: '0', max: String(most), step: String(step), 'aria-label': words });
  range.addEventListener('input', () => oninput(Number(range.value)));
  const element = make('label', { className: 'slider' }, make('span', {}, words), value, range);
  return { element, set(number, text = short(number)) {
    if (!range.matches(':active')) range.value = String(number);
    value.textContent = text;
  } };
}

const counting = new Intl.NumberFormat('en');
export const counted = (number) => counting.format(number);

// Some digits of it.
export function short(number, digits = 4) {
  if (number === 0 || !Number.isFinite(number)) return String(number);
  return String(Number(number.toPrecision(digits)));
}

export function microseconds(number) {
  return number < 10_000 ? `${short(number, 3)} µs` : `${short(number / 1000, 3)} ms`;
}
