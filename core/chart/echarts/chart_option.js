// A chart (chart_json.hpp) as an option for ECharts: a pure function, the same on a report's page and for a document.
import { axisOf, labelWidth, scaleOf, squareFrame } from './axes.js';
import { tooltip } from './hover.js';
import { keyOf, legendOf } from './legend.js';
import { markLines } from './marks.js';
import { noteSeries } from './notes.js';
import { isDrawable } from './ranges.js';
import { bandOf, errorBarsOf, isBareLine, seriesOf } from './series.js';
import { ink, looksOf } from './style.js';
import { fitted, font, textWidth } from './text_width.js';

const below = 54; // px: labels and title of the x axis
const beside_labels = 38; // px: title of the y axis

function entriesOf({ bands = [], series }) {
  return [
    ...bands.map(({ name }, i) => ({ key: keyOf('band', i), label: name })),
    ...series.map((each, i) => ({ key: keyOf('series', i), label: each.name, line: isBareLine(each) ? (each.style ?? 'line') : null, is_shape: each.style === 'points' })),
  ];
}

// The title is in the picture of a document; on a page it stands above it.
function titleOf(chart, width, interactive) {
  if (interactive || !chart.title) return { option: { show: false }, height: 0 };
  const { text, size } = fitted(chart.title, width - 40, 15);
  return { option: { text, left: 14, top: 10, padding: 0, textStyle: { fontFamily: font.family, fontSize: size, fontWeight: 'normal', color: '#000' } }, height: 30 };
}

/** Where a value is, px, as long as nobody comes nearer; null where it has no place. */
function pixelOf(scales, { left, top, width, height }) {
  const part = ({ log, min, max }, value) => (log ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min));
  return (x, y) => {
    if (scales.x.categories || !isDrawable(x, scales.x.log) || !isDrawable(y, scales.y.log)) return null;
    const place = [left + width * part(scales.x, x), top + height * (1 - part(scales.y, y))];
    const inside = place[0] >= left - 1 && place[0] <= left + width + 1 && place[1] >= top - 1 && place[1] <= top + height + 1;
    return inside ? place : null;
  };
}

/** Height of what stands above the plot, px. */
export function heightAbove(chart, { width, interactive }) {
  const title = titleOf(chart, width, interactive);
  const legend = legendOf(entriesOf(chart), { top: 0, width, always: !interactive, interactive });
  return 12 + title.height + legend.height;
}

/**
 * The option for a picture of width × height pixels; `interactive` adds hovering and zooming, and leaves the title to the
 * page.
 */
export function chartOption(chart, { width = 560, height = 380, interactive = true } = {}) {
  const title = titleOf(chart, width, interactive);
  const entries = entriesOf(chart);
  const legend = legendOf(entries, { top: 4 + title.height, width, always: !interactive, interactive });
  const top = 12 + title.height + legend.height;
  const y_scale = scaleOf(chart, 'y', { length: height - top - below, room: 40 });
  const label_width = labelWidth(y_scale);
  const left = Math.round(label_width + beside_labels);
  const x_scale = scaleOf(chart, 'x', { length: width - left - 26, room: 60 });
  const last_label = x_scale.ticks?.length ? textWidth(x_scale.text(x_scale.ticks[x_scale.ticks.length - 1])) / 2 : 0;
  const room = { left, top, width: width - left - Math.max(26, Math.ceil(last_label) + 6), height: height - top - below };
  const square = chart.square ? squareFrame(chart, room) : null;
  const scales = { x: { ...x_scale, ...square?.x }, y: { ...y_scale, ...square?.y } };
  const plot = square?.grid ?? room;
  const looks = looksOf(chart);
  const series = chart.series.map((each, i) => seriesOf(each, i, looks.series[i], scales, interactive));
  const lines = markLines(chart, room.width);
  if (lines && series.length) series[0].markLine = lines;
  const axis = (key, options) => ({ ...axisOf(chart, key, scales[key], { interactive: interactive || square, ...options }), ...square?.[key] });
  return {
    animation: false,
    backgroundColor: '#fff',
    textStyle: { fontFamily: font.family, fontSize: font.size, color: ink },
    title: title.option,
    grid: { ...plot, outerBoundsMode: 'none' },
    legend: legend.option,
    xAxis: axis('x', { gap: 30, length: width - 40 }),
    yAxis: axis('y', { gap: Math.round(label_width + 14), length: height - 20 }),
    series: [
      ...(chart.bands ?? []).map((each, i) => bandOf(each, i, looks.bands[i], scales)),
      ...series, // before their error bars, because the legend takes the first of a name
      ...chart.series.map((each, i) => errorBarsOf(each, i, looks.series[i], scales)).filter(Boolean),
      ...noteSeries(chart, plot, pixelOf(scales, plot)),
    ],
    ...(interactive
      ? {
          tooltip: tooltip(chart, new Map(entries.map(({ key, label }) => [key, label]))),
          dataZoom: ['xAxisIndex', 'yAxisIndex'].map((each) => ({ type: 'inside', [each]: 0, filterMode: 'none', zoomOnMouseWheel: 'ctrl', moveOnMouseMove: true, moveOnMouseWheel: false, preventDefaultMouseMove: false })),
        }
      : {}),
  };
}
