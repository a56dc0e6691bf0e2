// Lines, points and bars, the bands below them and their error bars, as ECharts draws them.
import { keyOf } from './legend.js';
import { isDrawable } from './ranges.js';
import { colourOf, shapeOf } from './style.js';

const few = 12; // points of a line up to which each has a symbol
const many = 400; // points of a cloud from which they are small

/** Whether the legend has to draw a line's icon itself. */
export const isBareLine = ({ style, x = [] }) => style !== 'bars' && style !== 'points' && x.length > few;

// A pixel far beyond the plot is as good as one further off, and can be written.
function within(value, { log, min, max }) {
  if (log || !(max > min)) return value;
  const far = 1e4 * (max - min);
  return Math.min(max + far, Math.max(min - far, value));
}

/** Pairs of ECharts; what cannot be drawn is a pair of nulls, which interrupts a line. */
function pairsOf({ x = [], y = [] }, scales) {
  const largest = y.reduce((most, value) => (isDrawable(value) ? Math.max(most, Math.abs(value)) : most), 0);
  return x.slice(0, y.length).map((x_value, i) => {
    const y_value = !scales.y.log && isDrawable(y[i]) && Math.abs(y[i]) < 1e-9 * largest ? 0 : y[i]; // what rounding left of a zero
    const has_x = scales.x.categories ? x_value !== null : isDrawable(x_value, scales.x.log);
    if (!has_x) return [null, null];
    return [scales.x.categories ? x_value : within(x_value, scales.x), isDrawable(y_value, scales.y.log) ? within(y_value, scales.y) : null];
  });
}

export function seriesOf(series, index, look, scales, interactive) {
  const colour = colourOf(look.colour);
  const data = pairsOf(series, scales);
  const common = { id: keyOf('series', index), name: keyOf('series', index), data, color: colour, animation: false, progressive: 0, emphasis: { disabled: true } };
  if (series.style === 'bars') return { ...common, type: 'bar', barCategoryGap: '8%', itemStyle: { color: colour } };
  if (series.style === 'points') {
    const crowd = data.length > many;
    return { ...common, type: 'scatter', symbol: shapeOf(look.shape), symbolSize: crowd ? 3 : 8, itemStyle: { color: colour, opacity: crowd ? 0.6 : 1 } };
  }
  return {
    ...common,
    type: 'line',
    showSymbol: data.length <= few,
    showAllSymbol: true,
    symbol: data.length <= few ? shapeOf(look.shape) : 'none',
    symbolSize: 7,
    connectNulls: false,
    lineStyle: { width: 1.8, type: series.style === 'dashed' ? 'dashed' : 'solid', color: colour },
    ...(interactive && data.length > 3000 ? { sampling: 'lttb' } : {}),
  };
}

// Runs of neighbours of which `place(i)` has places for all, as lists of those.
function runsOf(count, place) {
  const runs = [];
  let open = false;
  for (let i = 0; i < count; ++i) {
    const found = place(i);
    if (found && !open) runs.push([]);
    if (found) runs[runs.length - 1].push(found);
    open = Boolean(found);
  }
  return runs;
}

// A low that is not positive reaches the lower end of a logarithmic axis.
function span(low, high, { log }) {
  const to_the_end = log && typeof low === 'number' && low <= 0;
  if (!(to_the_end || isDrawable(low, log)) || !isDrawable(high, log)) return null;
  return { low: to_the_end ? null : low, high };
}

const custom = (key, data) => ({
  id: key, name: key, type: 'custom', data, clip: true, animation: false, progressive: 0, silent: true,
  encode: { x: 0, y: [1, 2] }, dimensions: ['x', 'low', 'high'], emphasis: { disabled: true },
});

/** The area between low and high, one polygon for each uninterrupted piece. */
export function bandOf(band, index, look, scales) {
  const spans = band.x.map((x, i) => (isDrawable(x, scales.x.log) ? span(band.low[i], band.high[i], scales.y) : null));
  const rows = band.x.map((x, i) => (spans[i] ? [within(x, scales.x), spans[i].low === null ? null : within(spans[i].low, scales.y), within(spans[i].high, scales.y)] : [null, null, null]));
  const colour = colourOf(look.colour);
  return {
    ...custom(keyOf('band', index), rows),
    z: 1,
    color: colour,
    itemStyle: { color: colour, opacity: 0.22 },
    renderItem: (params, api) => {
      if (params.dataIndexInside > 0) return null; // all of it is drawn with the first
      const bottom = params.coordSys.y + params.coordSys.height;
      const runs = runsOf(rows.length, (i) => {
        if (!spans[i]) return null;
        const [x, low, high] = rows[i];
        const [right, top] = api.coord([x, high]);
        return { right, top, bottom: low === null ? bottom : api.coord([x, low])[1] };
      });
      const polygon = (run) => [...run.map(({ right, top }) => [right, top]), ...[...run].reverse().map((each) => [each.right, each.bottom])];
      return { type: 'group', children: runs.filter((run) => run.length > 1).map((run) => ({ type: 'polygon', shape: { points: polygon(run) }, style: { fill: colour, opacity: 0.22 } })) };
    },
  };
}

/** Upright bars with flat ends from y_low to y_high, null for a series without. */
export function errorBarsOf(series, index, look, scales) {
  if (!series.y_low?.length || !series.y_high?.length) return null;
  const drawn = (i) => isDrawable(series.x[i], scales.x.log) && isDrawable(series.y[i], scales.y.log);
  const spans = series.x.map((_, i) => (drawn(i) ? span(series.y_low[i], series.y_high[i], scales.y) : null));
  const rows = series.x.map((x, i) => (spans[i] ? [within(x, scales.x), spans[i].low === null ? null : within(spans[i].low, scales.y), within(spans[i].high, scales.y)] : [null, null, null]));
  const colour = colourOf(look.colour);
  return {
    ...custom(keyOf('series', index), rows),
    id: keyOf('error', index),
    z: 1,
    color: colour,
    tooltip: { show: false },
    renderItem: (params, api) => {
      const [x, low, high] = rows[params.dataIndex];
      if (!spans[params.dataIndex]) return null;
      const [middle, top] = api.coord([x, high]);
      const bottom = low === null ? params.coordSys.y + params.coordSys.height : api.coord([x, low])[1];
      const line = (x1, y1, x2, y2) => ({ type: 'line', shape: { x1, y1, x2, y2 }, style: { stroke: colour, lineWidth: 1 } });
      return { type: 'group', children: [line(middle, bottom, middle, top), line(middle - 3.5, top, middle + 3.5, top), line(middle - 3.5, bottom, middle + 3.5, bottom)] };
    },
  };
}
