// A chart of the report's data as an option for ECharts: a pure function, the same on the page and for the documents.
import { numberText } from './words.js';

/** Okabe and Ito's colours, the dark ones first. */
export const series_colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#000000', '#7a6a00'];
// without quotes: ECharts does not escape them in its SVG
const font = { family: 'system-ui, Helvetica, Arial, sans-serif', size: 12 };
const ink = '#333';
const quiet = '#e6e6e6';
// as paths, because ECharts stretches its own shapes to the legend's width
const symbols = ['circle', 'path://M0,0H9V9H0Z', 'path://M5,0L10,9H0Z', 'path://M5,0L10,5L5,10L0,5Z', 'emptyCircle'];

// what a line without symbols looks like in the legend: ECharts would put a circle on it
const line_icons = { line: 'path://M0,0H24V2H0Z', dashed: 'path://M0,0H9V2H0ZM15,0H24V2H15Z' };
const few = 12; // points of a line up to which each has a symbol

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

// Wide enough for most letters of the font: labels may get too much room, not too little.
export const textWidth = (text, size = font.size) => 0.58 * size * text.length;

/** Rows that a legend of these names takes in `width` pixels. */
function legendRows(names, width) {
  let rows = 1;
  let used = 0;
  for (const name of names) {
    const item = 25 + 5 + textWidth(name) + 14;
    if (used > 0 && used + item > width) {
      ++rows;
      used = 0;
    }
    used += item;
  }
  return rows;
}

// Names where the x values are words, null where they are numbers.
function categoriesOf(chart) {
  const xs = chart.series.flatMap((series) => series.x ?? []);
  return xs.some((x) => typeof x === 'string') ? [...new Set(xs.map(String))] : null;
}

function extent(chart, key) {
  const values = chart.series.flatMap((series) => series[key] ?? []).filter(isNumber);
  return values.length ? [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))] : [0, 1];
}

function niceStep(width, count) {
  const rough = width / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((m) => m >= 0.999 * rough);
}

/** One scale for both axes: the ranges with a common step, and the box they get within `room`. */
function squareFrame(chart, room) {
  const ranges = [extent(chart, 'x'), extent(chart, 'y')];
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

// The digits times the powers of ten from the last one below to the first one above [low, high].
function logSteps(low, high, digits) {
  const steps = [];
  const first = Math.floor(Math.log10(low) + 1e-9);
  const last = Math.ceil(Math.log10(high) - 1e-9);
  for (let power = first; power <= Math.max(last, first + 1); ++power) {
    for (const digit of digits) steps.push(Number(`${digit}e${power}`));
  }
  const begin = steps.findLastIndex((step) => step <= low * (1 + 1e-9));
  const end = steps.findIndex((step) => step >= high * (1 - 1e-9));
  return steps.slice(begin, Math.max(end, begin + 1) + 1);
}

// Powers of ten only where there are several: within one or two the axis is divided more finely, and ends sooner.
function logRange(values) {
  const positive = values.filter((value) => isNumber(value) && value > 0);
  if (!positive.length) return {};
  const low = positive.reduce((a, b) => Math.min(a, b));
  const high = positive.reduce((a, b) => Math.max(a, b));
  const digits = high / low > 300 ? [1] : high / low > 5 ? [1, 2, 5] : [1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9];
  const steps = logSteps(low, high, digits);
  return { min: steps[0], max: steps[steps.length - 1], steps };
}

function axisOf(chart, key, gap) {
  const { title, log } = chart[key];
  const categories = key === 'x' ? categoriesOf(chart) : null;
  const { steps, ...ends } = log ? logRange(chart.series.flatMap((series) => series[key] ?? [])) : {};
  const at_steps = steps ? { customValues: steps } : {};
  const has_bars = chart.series.some(({ style }) => style === 'bars');
  return {
    type: categories ? 'category' : log ? 'log' : 'value',
    ...(categories ? { data: categories } : {}),
    ...ends,
    name: title,
    nameLocation: 'middle',
    nameGap: gap,
    nameTextStyle: { color: ink, fontSize: font.size, fontFamily: font.family },
    scale: !(key === 'y' && has_bars),
    axisLine: { show: true, onZero: false, lineStyle: { color: '#888' } },
    axisTick: { show: true, ...at_steps },
    axisLabel: { ...at_steps, color: ink, fontSize: font.size, fontFamily: font.family, hideOverlap: true, ...(categories ? {} : { formatter: (value) => numberText(value) }) },
    splitLine: { ...at_steps, show: !categories, lineStyle: { color: quiet } },
  };
}

// Widest number that may stand at the y axis.
function yLabelWidth(chart) {
  const [low, high] = extent(chart, 'y');
  const step = niceStep(high - low || Math.abs(high) || 1, 5);
  const values = chart.y.log
    ? (logRange(chart.series.flatMap((series) => series.y ?? [])).steps ?? [])
    : [low, high, high - step, low + step].map((value) => Number((Math.round(value / step) * step).toPrecision(6)));
  const texts = values.map((value) => numberText(value));
  return Math.max(24, ...texts.map((text) => textWidth(text)));
}

/** Labels of marks whose places are near stand one below the other. */
function markHeights(marks, [low, high], width) {
  const place = (mark) => ((mark.x - low) / (high - low || 1)) * width;
  const rows = [];
  return marks.map((mark) => {
    const [left, right] = [place(mark), place(mark) + textWidth(mark.label) + 10];
    let row = rows.findIndex((taken) => taken.every(([l, r]) => right < l || left > r));
    if (row < 0) row = rows.push([]) - 1;
    rows[row].push([left, right]);
    return row;
  });
}

function markLines(chart, width) {
  const marks = (chart.marks ?? []).filter(({ x }) => isNumber(x));
  if (!marks.length) return null;
  const range = extent(chart, 'x');
  const heights = markHeights(marks, range, width);
  return {
    silent: true,
    symbol: 'none',
    animation: false,
    lineStyle: { color: '#c0005a', type: 'dashed', width: 1.2 },
    data: marks.map((mark, i) => {
      // in the right half the label stands to the left of its line, so that it is not cut off
      const right_half = (mark.x - range[0]) / (range[1] - range[0] || 1) > 0.6;
      return {
        xAxis: mark.x,
        label: {
          formatter: mark.label, position: 'insideEndTop', rotate: 0, color: '#c0005a', fontSize: font.size, fontFamily: font.family,
          align: right_half ? 'right' : 'left', verticalAlign: 'top', distance: [0, 0], offset: [right_half ? -5 : 5, 2 + 16 * heights[i]],
          backgroundColor: 'rgba(255,255,255,0.8)', padding: [1, 3],
        },
      };
    }),
  };
}

function seriesOf(series, index, chart, interactive) {
  const colour = series_colours[index % series_colours.length];
  const usable = (value, log) => value === null || value === undefined || !(isNumber(value) || typeof value === 'string') || (log && value <= 0) ? null : value;
  // what rounding left of a zero must not give the axis a negative part
  const rounding = 1e-9 * (series.y ?? []).reduce((most, y) => (isNumber(y) ? Math.max(most, Math.abs(y)) : most), 0);
  const cleaned = (y) => (isNumber(y) && Math.abs(y) < rounding ? 0 : y);
  const data = (series.x ?? []).map((x, i) => [usable(x, chart.x.log), usable(chart.y.log ? series.y[i] : cleaned(series.y[i]), chart.y.log)]).filter(([x]) => x !== null);
  const common = { name: series.name, data, color: colour, animation: false, emphasis: { focus: 'none' } };
  if (series.style === 'bars') return { ...common, type: 'bar', barCategoryGap: '8%', itemStyle: { color: colour } };
  if (series.style === 'points') {
    return { ...common, type: 'scatter', symbol: symbols[index % symbols.length], symbolSize: data.length > 400 ? 3 : 8, itemStyle: { color: colour, opacity: data.length > 400 ? 0.6 : 1 } };
  }
  return {
    ...common,
    type: 'line',
    showSymbol: data.length <= few,
    symbol: data.length <= few ? symbols[index % symbols.length] : 'none',
    symbolSize: 7,
    connectNulls: false,
    lineStyle: { width: 1.8, type: series.style === 'dashed' ? 'dashed' : 'solid', color: colour },
    ...(interactive && data.length > 3000 ? { sampling: 'lttb' } : {}),
  };
}

// Words beside points, each at the first place, right, left, above or below its point and further off, that lies within the
// axes and on no earlier one.
function placeNotes(room) {
  let placed = [], last = -1;
  const free = (box) => !placed.some((each) => Math.abs(each.x - box.x) < (each.width + box.width) / 2 && Math.abs(each.y - box.y) < (each.height + box.height) / 2);
  const within = ({ x, y, width, height }) =>
    x - width / 2 >= room.left && x + width / 2 <= room.left + room.width && y - height / 2 >= room.top && y + height / 2 <= room.top + room.height;
  return ({ dataIndex, rect, labelRect }) => {
    if (dataIndex <= last) placed = [];
    last = dataIndex;
    const { width, height } = labelRect, x = rect.x + rect.width / 2, y = rect.y + rect.height / 2, aside = width / 2 + 7, gap = height + 2;
    const places = [0, 1, 2, 3].flatMap((far) => [[aside, -far * gap], [-aside, -far * gap], [aside, far * gap], [-aside, far * gap], [0, -(far + 1) * gap], [0, (far + 1) * gap]])
      .map(([right, down]) => ({ x: x + right, y: y + down, width, height }));
    const place = places.find((each) => free(each) && within(each)) ?? places.find(free) ?? places[0];
    placed.push(place);
    return { x: place.x, y: place.y, align: 'center', verticalAlign: 'middle' };
  };
}

function noteSeries({ notes = [] }, room) {
  const data = notes.filter(({ x, y }) => isNumber(x) && isNumber(y)).map(({ x, y, text }) => ({ value: [x, y], name: text }));
  if (!data.length) return [];
  const label = { show: true, formatter: ({ name }) => name, color: ink, fontSize: 11, fontFamily: font.family };
  return [{ type: 'scatter', name: '', data, symbolSize: 1, itemStyle: { color: 'transparent' }, silent: true, animation: false, tooltip: { show: false }, label, labelLayout: placeNotes(room) }];
}

// A legend entry; lines with symbols are drawn by ECharts as they are.
function legendEntry({ name, style, x }) {
  const plain_line = style !== 'bars' && style !== 'points' && (x?.length ?? 0) > few;
  return plain_line ? { name, icon: line_icons[style] ?? line_icons.line } : { name };
}

// Titles by themselves name the axes; a hover says the number and what it is of.
function tooltip(chart) {
  const points_only = chart.square || chart.series.every(({ style }) => style === 'points');
  const escape = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;');
  const value = (v) => (typeof v === 'string' ? escape(v) : numberText(v, 5));
  const row = (item) => `${item.marker}${escape(item.seriesName)}: <b>${value(item.value[1])}</b>`;
  const head = (x) => `${escape(chart.x.title)}: <b>${value(x)}</b>`;
  return {
    trigger: points_only ? 'item' : 'axis',
    confine: true,
    axisPointer: { type: 'line', snap: true, lineStyle: { color: '#999' } },
    textStyle: { fontSize: font.size, fontFamily: font.family, color: ink },
    formatter: (items) => {
      const list = (Array.isArray(items) ? items : [items]).filter((item) => item.value && item.value[1] !== null);
      if (!list.length) return '';
      const own = list[0].data?.[2];
      return [own ? escape(own) : null, head(list[0].value[0]), `${escape(chart.y.title)}`, ...list.map(row)].filter(Boolean).join('<br>');
    },
  };
}

/**
 * The option of ECharts for a chart of the report's data, for a picture of width × height pixels; `interactive` adds
 * hovering and zooming.
 */
export function chartOption(chart, { width = 560, height = 380, interactive = true } = {}) {
  const names = chart.series.map(({ name }) => name);
  const has_legend = names.length > 1;
  const rows = has_legend ? legendRows(names, width - 30) : 0;
  const top = 12 + 26 * rows;
  const label_width = yLabelWidth(chart);
  const left = Math.round(label_width + 38);
  const room = { left, top, width: width - left - 26, height: height - top - 54 };
  const square = chart.square ? squareFrame(chart, room) : null;
  const lines = markLines(chart, room.width);
  const series = [...chart.series.map((each, i) => seriesOf(each, i, chart, interactive)), ...noteSeries(chart, room)];
  if (lines && series.length) series[0].markLine = lines;
  const x = { ...axisOf(chart, 'x', 30), ...square?.x };
  // a mark beyond the data is still to be seen
  if (x.type === 'value' && !square && lines) {
    const ends = [...extent(chart, 'x'), ...lines.data.map(({ xAxis }) => xAxis)];
    const [low, high] = [Math.min(...ends), Math.max(...ends)];
    const step = niceStep(high - low, 6);
    Object.assign(x, { min: Math.floor(low / step + 1e-9) * step, max: Math.ceil(high / step - 1e-9) * step, interval: step });
  }
  return {
    animation: false,
    backgroundColor: '#fff',
    textStyle: { fontFamily: font.family, fontSize: font.size, color: ink },
    grid: { ...(square?.grid ?? room), outerBoundsMode: 'none' },
    legend: has_legend ? { show: true, data: chart.series.map(legendEntry), top: 4, left: 'center', width: width - 30, itemGap: 12, textStyle: { fontFamily: font.family, fontSize: font.size, color: ink } } : { show: false },
    xAxis: x,
    yAxis: { ...axisOf(chart, 'y', Math.round(label_width + 14)), ...square?.y },
    series,
    ...(interactive
      ? {
          tooltip: tooltip(chart),
          dataZoom: ['xAxisIndex', 'yAxisIndex'].map((axis) => ({ type: 'inside', [axis]: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl', moveOnMouseMove: true, moveOnMouseWheel: false, preventDefaultMouseMove: false })),
        }
      : {}),
  };
}
