// The section with the charts.
import { chartOption } from '../../../../core/chart/echarts/chart_option.js';
import { saveText, savePngOfSvg } from './download.js';
import { h, section } from './elements.js';
import { init } from './moving_charts.js';

/** The chart's series and bands as a table: the columns of each beside one another. */
export function chartCsv(chart) {
  const quote = (text) => (/[",\n]/.test(text) ? `"${String(text).replace(/"/g, '""')}"` : String(text));
  const [x_title, y_title] = [chart.x.title, chart.y.title];
  const titles = { x: x_title, y: y_title, y_low: `least ${y_title}`, y_high: `greatest ${y_title}`, low: `least ${y_title}`, high: `greatest ${y_title}` };
  const columns = [...chart.series, ...(chart.bands ?? [])].flatMap((each) =>
    Object.keys(titles).filter((key) => each[key]).map((key) => ({ title: `${each.name}: ${titles[key]}`, values: each[key] })));
  const length = Math.max(0, ...columns.map(({ values }) => values.length));
  const rows = Array.from({ length }, (_, i) => columns.map(({ values }) => values[i] ?? ''));
  return [columns.map(({ title }) => title), ...rows].map((row) => row.map(quote).join(',')).join('\n') + '\n';
}

const paper = { width: 430, height: 290 }; // px

function makeChart(chart) {
  const box = h('div', { class: 'chart-box', role: 'img', 'aria-label': `${chart.title}: ${chart.y.title} over ${chart.x.title}` });
  let drawn = null;
  let size = [0, 0];
  const svg = () => box.querySelector('svg')?.outerHTML ?? '';
  const drawAs = (width, height) => {
    size = [width, height];
    drawn ??= init(box, null, { renderer: 'svg' });
    drawn.resize({ width, height });
    drawn.setOption(chartOption(chart, { width, height }), { notMerge: true });
  };
  const draw = (force) => {
    const [width, height] = [box.clientWidth, box.clientHeight];
    if (width && (force || width !== size[0] || height !== size[1])) drawAs(width, height);
  };
  // Paper is narrower than a screen: the style sheet fits the picture into its column, whatever that is.
  const drawForPaper = () => {
    if (!box.clientWidth) return;
    drawAs(paper.width, chart.square ? paper.width : paper.height);
    drawn.getZr().flush();
    box.querySelector('svg').setAttribute('viewBox', `0 0 ${size[0]} ${size[1]}`);
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
      window.addEventListener('beforeprint', drawForPaper);
      window.addEventListener('afterprint', () => {
        box.querySelector('svg')?.removeAttribute('viewBox');
        draw(true);
      });
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
