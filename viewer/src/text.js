// SPDX-License-Identifier: MIT
// Numbers as people read them.

const plain = new Intl.NumberFormat('en', { maximumSignificantDigits: 5 });
const tiny = new Intl.NumberFormat('en', { notation: 'scientific', maximumSignificantDigits: 5 });

// By digits behind the point: making one costs a tenth of a millisecond.
const formats = new Map();
function formatOf(maximumFractionDigits) {
  if (!formats.has(maximumFractionDigits))
    formats.set(maximumFractionDigits, new Intl.NumberFormat('en', { maximumFractionDigits }));
  return formats.get(maximumFractionDigits);
}

// A measured quantity, to five digits.
export function number(value) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  return (size !== 0 && size < 1e-4 || size >= 1e9 ? tiny : plain).format(value);
}

// A place in something of that size: as many digits as tell its parts from one another.
export function coordinate(value, size) {
  const digits = 4 - Math.floor(Math.log10(size > 0 ? size : 1));
  return formatOf(Math.min(Math.max(digits, 0), 20)).format(value);
}

export function count(value) {
  return Number.isFinite(value) ? value.toLocaleString('en') : '–';
}

// `1 slab`, `2 slabs`
export function counted(value, thing) {
  return `${count(value)} ${thing}${value === 1 ? '' : 's'}`;
}

// A coordinate exactly as it came in.
export function exact(value) {
  return String(value);
}
