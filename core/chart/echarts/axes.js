// The two axes: ranges, ticks, titles, and the room that their labels take.
import { powerText, numberText, stepText } from './number_text.js';
import { extentOf, linearRange, logRange, niceStep, valuesOf } from './ranges.js';
import { ink, quiet } from './style.js';
import { fitted, font, textWidth } from './text_width.js';

// Names where the x values are words, null where they are numbers.
function categoriesOf(chart) {
  const xs = chart.series.flatMap((series) => series.x ?? []);
  return xs.some((x) => typeof x === 'string') ? [...new Set(xs.map(String))] : null;
}

/**
 * What an axis shows: {categories} or {log, min, max, ticks, text}, `text` writing a tick. `room`: px from label to label
 * along the axis.
 */
export function scaleOf(chart, key, { length, room }) {
  const axis = chart[key];
  const categories = key === 'x' ? categoriesOf(chart) : null;
  if (categories) return { categories };
  const values = valuesOf(chart, key);
  if (axis.log) {
    const range = logRange(axis, values);
    const powers = range.min < 0.999e-4 || range.max > 1.001e5;
    return { log: true, ...range, text: (value) => (range.step ? stepText(value, range.step) : powerText(value, powers)) };
  }
  if (chart.series.some(({ style }) => style === 'bars') && key === 'y') values.push(0);
  if (key === 'x') values.push(...(chart.marks ?? []).map(({ x }) => x)); // a mark beyond the data is still to be seen
  for (let count = Math.max(2, Math.min(9, Math.floor(length / room))); ; --count) {
    const range = linearRange(axis, values, count);
    const text = (value) => stepText(value, range.step);
    const widest = Math.max(...range.ticks.map((tick) => textWidth(text(tick))));
    const apart = (length * range.step) / (range.max - range.min);
    if (key === 'y' || count <= 2 || widest + 14 <= apart) return { log: false, ...range, text };
  }
}

/** Width of the widest label at the y axis, px. */
export const labelWidth = ({ ticks, text }) => Math.max(24, ...ticks.map((tick) => textWidth(text(tick))));

/** One scale for both axes: the ranges with a common step, and the box they get within `room`. */
export function squareFrame(chart, room) {
  const ranges = ['x', 'y'].map((key) => extentOf(valuesOf(chart, key)) ?? [0, 1]);
  const step = niceStep(Math.max(...ranges.map(([low, high]) => high - low)), 8);
  const axes = ranges.map(([low, high]) => ({ min: Math.floor(low / step + 1e-9) * step, max: Math.ceil(high / step - 1e-9) * step }));
  for (const axis of axes) if (axis.max <= axis.min) axis.max = axis.min + step;
  const [width, height] = axes.map(({ min, max }) => max - min);
  const scale = Math.min(room.width / width, room.height / height);
  return {
    x: { ...axes[0], interval: step },
    y: { ...axes[1], interval: step },
    grid: { left: room.left + (room.width - scale * width) / 2, top: room.top, width: scale * width, height: scale * height },
  };
}

/** ECharts' axis; `length` px is what its title may take, `gap` px how far from the axis that stands. */
export function axisOf(chart, key, scale, { gap, length, interactive }) {
  const name = fitted(chart[key].title ?? '', length, font.size);
  const label_style = { color: ink, fontSize: font.size, fontFamily: font.family };
  const { categories, log, min, max, ticks } = scale;
  // Who comes nearer wants ticks between those: on the page ECharts chooses them on a plain axis.
  const at_ticks = (values) => (categories || (interactive && !log) ? {} : { customValues: values });
  return {
    type: categories ? 'category' : log ? 'log' : 'value',
    ...(categories ? { data: categories } : { min, max }),
    name: name.text,
    nameLocation: 'middle',
    nameGap: gap,
    nameTextStyle: { color: ink, fontSize: name.size, fontFamily: font.family },
    axisLine: { show: true, onZero: false, lineStyle: { color: '#888' } },
    axisTick: { show: true, ...at_ticks(ticks) },
    axisLabel: { ...at_ticks(ticks), ...label_style, hideOverlap: true, ...(categories ? {} : { formatter: log || !interactive ? (value) => scale.text(value) : (value) => numberText(value, 10) }) },
    splitLine: { ...at_ticks(ticks), show: !categories, lineStyle: { color: quiet } },
  };
}
