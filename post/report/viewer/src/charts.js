// The section with the charts.
import { chartOption } from '../../../../core/chart/echarts/chart_option.js';
import { saveText, savePngOfSvg } from './download.js';
import { h, section } from './elements.js';
import { init } from './moving_charts.js';

/** The chart's series as a table: x and y of each beside one another. */
export function chartCsv(chart) {
  const quote = (text) => (/[",\n]/.test(text) ? `"${String(text).replace(/"/g, '""')}"` : String(text));
  const head = chart.series.flatMap((series) => [`${series.name}: ${chart.x.title}`, `${series.name}: ${chart.y.title}`]);
  const length = Math.max(0, ...chart.series.map((series) => series.x.length));
  const rows = Array.from({ length }, (_, i) => chart.series.flatMap((series) => [series.x[i] ?? '', series.y[i] ?? '']));
  return [head, ...rows].map((row) => row.map(quote).join(',')).join('\n') + '\n';
}

function makeChart(chart) {
  const box = h('div', { class: 'chart-box', role: 'img', 'aria-label': `${chart.title}: ${chart.y.title} over ${chart.x.title}` });
  let drawn = null;
  let size = [0, 0];
  const svg = () => box.querySelector('svg')?.outerHTML ?? '';
  const draw = (force) => {
    const [width, height] = [box.clientWidth, box.clientHeight];
    if (!width || (!force && width === size[0] && height === size[1])) return;
    size = [width, height];
    drawn ??= init(box, null, { renderer: 'svg' });
    drawn.resize({ width, height });
    drawn.setOption(chartOption(chart, { width, height }), { notMerge: true });
  };
  const button = (text, title, onclick) => h('button', { type: 'button', title, onclick }, text);
  const element = h(
    'figure',
    { class: `chart${chart.square ? ' square' : ''}`, id: `chart-${chart.id}` },
    h('figcaption', {}, chart.title),
    box,
    h('div', { class: 'chart-buttons no-print' },
      button('whole', 'Undo the zoom', () => draw(true)),
      button('PNG', 'Save as a picture', () => savePngOfSvg(svg(), size, `${chart.id}.png`)),
      button('SVG', 'Save as a vector picture', () => saveText(svg(), 'image/svg+xml', `${chart.id}.svg`)),
      button('CSV', 'Save the numbers', () => saveText(chartCsv(chart), 'text/csv', `${chart.id}.csv`))),
  );
  return {
    element,
    start() {
      draw(true);
      box.addEventListener('dblclick', () => draw(true));
      // ECharts would keep every turn of the wheel; without Ctrl it scrolls the page
      box.addEventListener('wheel', (event) => event.ctrlKey || event.stopPropagation(), { capture: true, passive: true });
      new ResizeObserver(() => draw(false)).observe(box);
    },
    handle: {
      title: chart.title,
      series: chart.series.map(({ name, x, y }) => ({ name, x, y })),
      /** Client coordinates of a value of a series. */
      onScreen(series, index) {
        const { x, y } = chart.series[series];
        const [left, top] = drawn.convertToPixel({ xAxisIndex: 0, yAxisIndex: 0 }, [x[index], y[index]]);
        const place = box.getBoundingClientRect();
        return { x: place.left + left, y: place.top + top };
      },
      /** The words shown while hovering, or ''. */
      hover: () => [...box.querySelectorAll(':scope > div')].filter((each) => !each.querySelector('svg') && getComputedStyle(each).visibility !== 'hidden').map((each) => each.innerText).join('\n').trim(),
    },
  };
}

/** {element, start(), handle(id)} for the charts of the data. */
export function makeCharts(charts) {
  const made = new Map(charts.map((chart) => [chart.id, makeChart(chart)]));
  return {
    element: section('charts', 'Charts', h('p', { class: 'hint no-print' }, 'Hover to read values; Ctrl and the wheel zoom, dragging moves, a double click shows all; a click on a name in the legend hides its line.'), h('div', { class: 'charts' }, [...made.values()].map(({ element }) => element))),
    start: () => made.forEach((chart) => chart.start()),
    handle: (id) => made.get(id)?.handle ?? null,
    ids: () => [...made.keys()],
  };
}
