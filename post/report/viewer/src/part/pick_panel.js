// What the picked cell has: number, place, every field's value.
import { h } from '../elements.js';
import { numberText, withUnit } from '../words.js';
import { categoryOfCell, centreOf, cornersOf } from './model.js';

/**
 * Value of a field in a cell at a frame; of a node field the mean of the cell's corners, or their most frequent
 * category. NaN: none. */
export function valueInCell(model, field, frame, cell) {
  const values = model.values(field, frame);
  if (!values) return NaN;
  if (field.association !== 'nodes') return values[cell];
  if (field.scale === 'categories') return categoryOfCell(model.cells, values, cell);
  const corners = Array.from({ length: cornersOf(model.cells, cell) }, (_, i) => values[model.cells[4 * cell + i]]);
  return corners.reduce((sum, value) => sum + value, 0) / corners.length;
}

function valueText(field, value) {
  if (field.scale === 'categories' && !Number.isNaN(value)) return field.category_names?.[Math.round(value)] ?? numberText(value);
  return withUnit(value, field.unit);
}

/** {cell, number, centre, values: [{name, title, unit, value, text}]} */
export function describeCell(model, cell, frame) {
  return {
    cell,
    number: model.numberOf(cell),
    ply: model.cell_plies ? model.plyName(model.cell_plies[cell]) : null,
    centre: centreOf(model.cells, model.positions(frame), cell),
    values: model.fields.map((field) => {
      const value = valueInCell(model, field, frame, cell);
      return { name: field.name, title: field.title, unit: field.unit, value, text: valueText(field, value) };
    }),
  };
}

export function drawPick(element, model, { picked, frame }, forget) {
  element.replaceChildren();
  element.classList.toggle('empty', picked < 0);
  if (picked < 0) {
    element.append(h('p', { class: 'hint' }, 'Click a cell of the part to read its values.'));
    return;
  }
  const { centre, number, ply, values } = describeCell(model, picked, frame);
  const row = (name, text) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, text));
  element.append(
    h('div', { class: 'pick-title' }, h('strong', {}, `Cell ${number}`), h('button', { type: 'button', class: 'no-print', onclick: forget, 'aria-label': 'forget the cell' }, '×')),
    h('table', {}, h('tbody', {},
      ply !== null && model.plies.length > 1 && row('ply', ply),
      row('centre (mm)', centre.map((x) => numberText(Number(x.toFixed(2)))).join(', ')),
      values.map(({ title, text }) => row(title, text)))),
  );
}

