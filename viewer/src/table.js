// SPDX-License-Identifier: MIT
// The table of labels: a dialog whose columns sort, and that copies as CSV.
import { copy } from './clipboard.js';
import { count, number } from './text.js';

const element = (id) => document.getElementById(id);
const { compare } = new Intl.Collator('en', { numeric: true });

// `name` and `unit` for the heading, and `text` for people; in CSV the numbers are as they are, and
// the headings as `loft reconstruct --csv` writes them.
export function columnsIn({ plain, volumeUnit, areaUnit }) {
  return [
    { key: 'label', name: 'Label', csv: 'label', text: (label) => label || 'no label' },
    { key: 'slices', name: 'Slices', csv: 'slices', text: (slices) => count(slices || NaN) },
    { key: 'volume', name: 'Volume', unit: volumeUnit, csv: `volume_${plain}3`, text: number },
    { key: 'area', name: 'Area', unit: areaUnit, csv: `area_${plain}2`, text: number },
    { key: 'faces', name: 'Triangles', csv: 'triangles', text: count },
  ];
}

const heading = ({ name, unit }) => (unit ? `${name} (${unit})` : name);

export function inOrder(rows, { key, isDescending }) {
  const sign = isDescending ? -1 : 1;
  const order = key === 'label' ? (a, b) => compare(a.label, b.label) : (a, b) => a[key] - b[key];
  return [...rows].sort((a, b) => sign * order(a, b) || compare(a.label, b.label));
}

function quoted(value) {
  const text = String(value ?? '');
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

// No number where it is not known in how many slices a label is.
function valueOf(row, { key }) {
  return key === 'slices' ? row[key] || '' : row[key];
}

export function toCsv(rows, columns) {
  const lines = [columns.map(({ csv }) => csv), ...rows.map((row) => columns.map((column) => valueOf(row, column)))];
  return lines.map((line) => `${line.map(quoted).join(',')}\r\n`).join('');
}

export class Table {
  #figures;
  #labels;
  #order = { key: 'label', isDescending: false };
  #rows = [];
  #columns = [];

  constructor(figures, labels) {
    this.#figures = figures;
    this.#labels = labels;
    element('table-open').addEventListener('click', () => this.open());
    element('table-copy').addEventListener('click', () => this.#copy());
    element('table-head').addEventListener('click', ({ target }) => this.#sort(target));
    element('table-body').addEventListener('click', ({ target }) => this.#choose(target));
    figures.addEventListener('known', ({ detail }) => { element('table-open').hidden = !detail; });
  }

  async open() {
    const rows = await this.#figures.list();
    if (!rows || element('table').open) return;
    this.#rows = rows;
    // In how many slices a label is, is not known of a mesh.
    this.#columns = columnsIn(this.#figures.measure).filter(({ key }) =>
      key !== 'slices' || rows.some(({ slices }) => slices > 0));
    this.#show();
    element('table-said').textContent = '';
    element('table').showModal();
  }

  #show() {
    this.#rows = inOrder(this.#rows, this.#order);
    element('table-head').replaceChildren(...this.#columns.map((column) => this.#heading(column)));
    element('table-body').replaceChildren(...this.#rows.map((row) => this.#row(row)));
  }

  #heading(column) {
    const cell = document.createElement('th');
    const isSorted = column.key === this.#order.key;
    cell.scope = 'col';
    if (isSorted) cell.ariaSort = this.#order.isDescending ? 'descending' : 'ascending';
    const button = cell.appendChild(document.createElement('button'));
    button.type = 'button';
    button.dataset.key = column.key;
    button.textContent = heading(column);
    return cell;
  }

  #row(row) {
    const line = document.createElement('tr');
    line.dataset.label = row.label;
    line.classList.toggle('chosen', row.label === this.#labels.chosen);
    for (const { key, text } of this.#columns) {
      const cell = line.appendChild(document.createElement(key === 'label' ? 'th' : 'td'));
      if (key === 'label') {
        cell.scope = 'row';
        cell.appendChild(document.createElement('span')).className = 'swatch';
        cell.firstChild.style.backgroundColor = this.#labels.colour(row.label) ?? row.colour ?? '';
      }
      cell.append(text(row[key]));
    }
    return line;
  }

  #sort(target) {
    const key = target.closest('button')?.dataset.key;
    if (!key) return;
    const isSame = key === this.#order.key;
    // What is largest comes first, of names the first.
    this.#order = { key, isDescending: isSame ? !this.#order.isDescending : key !== 'label' };
    this.#show();
    element('table-head').querySelector(`[data-key="${key}"]`).focus();
  }

  #choose(target) {
    const label = target.closest('tr')?.dataset.label;
    if (label === undefined) return;
    this.#labels.choose(label);
    for (const line of element('table-body').rows)
      line.classList.toggle('chosen', line.dataset.label === label);
  }

  async #copy() {
    const isCopied = await copy(toCsv(this.#rows, this.#columns), element('table'));
    element('table-said').textContent =
      isCopied ? 'Copied as CSV.' : 'This browser does not let a page copy.';
  }
}
