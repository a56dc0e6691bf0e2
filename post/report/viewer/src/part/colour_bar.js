// The colour bar: title with unit, numbers, the limit's mark, and the range to edit.
import { categoryColour, colourAt, css, no_value_colour } from '../colour_maps.js';
import { h, s } from '../elements.js';
import { numberText, titleWithUnit, withUnit } from '../words.js';

/** About `count` round numbers within [from, to]. */
export function roundSteps(from, to, count = 6) {
  const width = to - from;
  if (!(width > 0)) return [from];
  const rough = width / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((m) => m * power).find((m) => m >= rough * 0.999);
  const first = Math.ceil(from / step - 1e-9);
  const last = Math.floor(to / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

const bar = { width: 18, height: 240, left: 2, top: 8 };

function gradientBar(field, range, levels) {
  const y = (value) => bar.top + bar.height * (1 - (value - range.from) / (range.to - range.from || 1));
  const stops = 32; // twice as fine as the maps' own
  const picture = s('svg', { width: 92, height: bar.height + 16, class: 'colour-bar', role: 'img', 'aria-label': `colours from ${numberText(range.from)} to ${withUnit(range.to, field.unit)}` });
  const colours = Array.from({ length: stops + 1 }, (_, i) => s('stop', { offset: i / stops, 'stop-color': css(colourAt(field.scale, 1 - i / stops)) }));
  picture.append(
    s('linearGradient', { id: 'bar-colours', x1: 0, x2: 0, y1: 0, y2: 1 }, ...colours),
    s('rect', { x: bar.left, y: bar.top, width: bar.width, height: bar.height, fill: 'url(#bar-colours)' }),
  );
  const line = (value, attributes) => picture.append(s('line', { x1: bar.left, x2: bar.left + bar.width, y1: y(value), y2: y(value), ...attributes }));
  for (const level of levels.filter((value) => value >= range.from && value <= range.to)) line(level, { stroke: '#111', 'stroke-width': 1 });
  const limits = field.limit === null || field.limit === undefined ? [] : field.scale === 'diverging' ? [-field.limit, field.limit] : [field.limit];
  const shown_limits = limits.filter((value) => value >= range.from && value <= range.to);
  const right = bar.left + bar.width;
  for (const value of roundSteps(range.from, range.to)) {
    picture.append(s('line', { x1: right, x2: right + 4, y1: y(value), y2: y(value), stroke: '#555' }));
    if (shown_limits.some((limit) => Math.abs(y(limit) - y(value)) < 12)) continue; // the limit's own label stands there
    picture.append(s('text', { x: right + 8, y: y(value) + 4 }, numberText(value)));
  }
  for (const limit of shown_limits) {
    line(limit, { stroke: '#c0005a', 'stroke-width': 2.5 });
    picture.append(s('text', { x: right + 8, y: y(limit) + 4, class: 'limit' }, `limit ${numberText(limit)}`));
  }
  return picture;
}

// A limit that the colours do not reach is said in words.
function limitNote(field, range) {
  if (field.limit === null || field.limit === undefined || field.limit <= Math.max(range.to, -range.from)) return null;
  return h('div', { class: 'limit-note' }, `limit ${withUnit(field.limit, field.unit)}, beyond these colours`);
}

function categoryList(field) {
  const names = field.category_names ?? [];
  return h(
    'ul',
    { class: 'categories' },
    names.map((name, i) => h('li', {}, h('span', { class: 'swatch', style: `background:${css(categoryColour(i))}` }), name)),
  );
}

function rangeInputs(field, range, changed, reset) {
  const input = (end, label) =>
    h('label', {}, label, h('input', {
      type: 'number', step: 'any', value: Number(range[end].toPrecision(4)), 'aria-label': `${label} of the colours (${field.unit || 'no unit'})`,
      onchange: (event) => {
        const value = event.target.valueAsNumber;
        const next = { ...range, [end]: value };
        if (Number.isFinite(value) && next.to > next.from) changed(next);
        else event.target.value = Number(range[end].toPrecision(4));
      },
    }));
  return h('div', { class: 'range no-print' }, input('to', 'to'), input('from', 'from'), h('button', { type: 'button', onclick: reset, title: 'Colours over all values of all frames' }, 'whole range'));
}

/** Draws the bar for the field into `element`; field null: none. */
export function drawColourBar(element, { field, range, levels, changed, reset }) {
  element.replaceChildren();
  if (!field) return;
  element.append(h('div', { class: 'bar-title' }, titleWithUnit(field)));
  if (field.scale === 'categories') element.append(categoryList(field));
  else element.append(gradientBar(field, range, levels), limitNote(field, range) ?? '', rangeInputs(field, range, changed, reset));
  element.append(h('div', { class: 'no-value' }, h('span', { class: 'swatch', style: `background:${css(no_value_colour)}` }), 'no value'));
}
