// Tables that sort by a click on a column's head; rows may lead to other files.
import { h, section } from './elements.js';
import { numberText } from './words.js';

const asText = (value) => (typeof value === 'number' ? numberText(value) : value === null || value === undefined ? '–' : String(value));

// Numbers before words, no value last; words as people sort them.
export function compare(a, b) {
  const rank = (value) => (typeof value === 'number' && !Number.isNaN(value) ? 0 : value === null || value === undefined || value === '' ? 2 : 1);
  if (rank(a) !== rank(b)) return rank(a) - rank(b);
  return rank(a) === 0 ? a - b : rank(a) === 1 ? String(a).localeCompare(String(b), 'en', { numeric: true }) : 0;
}

function makeTable({ title, columns, rows, links = [] }, index) {
  const lines = rows.map((row, i) => ({ row, link: links?.[i] ?? null, place: i }));
  let sorted = { column: -1, up: true };
  const body = h('tbody');
  const heads = columns.map((name, column) => h('th', { scope: 'col', 'aria-sort': 'none' }, h('button', { type: 'button', onclick: () => sortBy(column) }, name)));

  function cellOf(value, column, link) {
    const text = asText(value);
    return h('td', { class: typeof value === 'number' ? 'numeric' : null }, column === 0 && link ? h('a', { href: link }, text) : text);
  }
  function fill() {
    body.replaceChildren(...lines.map(({ row, link }) => h('tr', {}, row.map((value, column) => cellOf(value, column, link)))));
  }
  function sortBy(column) {
    sorted = { column, up: sorted.column === column ? !sorted.up : true };
    lines.sort((a, b) => (sorted.up ? 1 : -1) * compare(a.row[column], b.row[column]) || a.place - b.place);
    heads.forEach((head, i) => head.setAttribute('aria-sort', i === column ? (sorted.up ? 'ascending' : 'descending') : 'none'));
    fill();
  }
  fill();
  return section(`table-${index}`, title, h('div', { class: 'table-box' }, h('table', { class: 'data' }, h('thead', {}, h('tr', {}, heads)), body)));
}

export const makeTables = (tables) => tables.map(makeTable);
