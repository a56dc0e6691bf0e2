// Draws charts as SVG by ECharts' server-side rendering: the same chart gives the same bytes, whatever was drawn before it.
// Packed into one script that needs nothing else; a line that calls drawCharts follows it on node's standard input.
import { writeFileSync } from 'node:fs';
import { getECData } from 'echarts/lib/util/innerStore.js';
import { createHashMap } from 'zrender/lib/core/util.js';
import { registerSSRDataGetter } from 'zrender/lib/zrender.js';
import { chartOption, heightAbove } from './chart_option.js';
import { init, setPlatformAPI } from './echarts_parts.js';
import { textWidth } from './text_width.js';

// By which a later run knows that the file may be overwritten.
const own_mark = '<!-- Written by weaveform -->';

const escaped = (text) => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');

// ECharts keeps texts as keys of plain objects; without this the key "__proto__" is one like others.
delete Object.prototype.__proto__;

// Without a screen nothing measures text.
setPlatformAPI({ measureText: (text, font) => ({ width: textWidth(text ?? '', parseFloat(font?.match(/([\d.]+)px/)?.[1] ?? '12')) }) });

// What is there to be pointed at only.
const is_unseen = (line) => /^<path .*fill="none" pointer-events="visible"/.test(line) && !/ stroke="/.test(line);
const is_cover = (line) => /^<path .*fill-opacity="0".*stroke-width="0"/.test(line);

/**
 * ECharts' SVG, one element a line, without its bookkeeping for pages; elements of one series are a group, told by its
 * label when pointed at. Identifiers, which ECharts counts by charts drawn so far, begin with `prefix`. Texts have their
 * quotes escaped, so that what looks like an attribute is one.
 */
function plainSvg(svg, title, labels, prefix) {
  const lines = [];
  let open = null;
  const close = (next) => {
    if (open !== null && open !== next) lines.push('</g>');
    if (next !== null && open !== next) lines.push('<g>', `<title>${escaped(labels[next])}</title>`);
    open = next;
  };
  for (const line of svg.replace(/<style[^>]*>[^]*?<\/style>\n?/g, '').split('\n')) {
    if (is_unseen(line) || is_cover(line)) continue;
    const series = /^<(path|polygon|polyline) /.test(line) ? (line.match(/ ecmeta_series="(\d+)"/)?.[1] ?? null) : null;
    close(series !== null && labels[series] ? series : null);
    lines.push(line.replace(/ (ecmeta_[a-z_]+|class|pointer-events|version|baseProfile|xmlns:xlink)="[^"]*"/g, '').replace(/( id="|="url\(#)zr\d+-/g, `$1${prefix}`));
    if (line.startsWith('<svg')) lines.push(`<title>${escaped(title)}</title>`);
  }
  close(null);
  return `${own_mark}\n${lines.filter((line) => line).join('\n')}\n`;
}

/** Charts as chart_json.hpp has them, with `width` and `height` of the plot's share (px); a legend comes on top of the height. */
function svgOf(chart) {
  const width = chart.width;
  const height = chart.height + Math.max(0, heightAbove(chart, { width, interactive: false }) - 42);
  const drawn = init(null, null, { renderer: 'svg', ssr: true, width, height });
  const option = chartOption(chart, { width, height, interactive: false });
  drawn.setOption(option);
  const names = new Map([...(chart.bands ?? []).map(({ name }, i) => [`band${i}`, name]), ...chart.series.map(({ name }, i) => [`series${i}`, name])]);
  registerSSRDataGetter((element) => {
    const series = getECData(element).seriesIndex;
    return series === undefined || getECData(element).ssrType === 'legend' ? null : createHashMap({ series });
  });
  const svg = plainSvg(drawn.renderToSVGString(), chart.title ?? '', option.series.map(({ name }) => names.get(name) ?? ''), `${chart.id}_`);
  drawn.dispose(); // its clock would keep the process alive
  return svg;
}

/** Writes the charts' SVGs as a list in JSON to standard output; what is wrong as one line to standard error. */
globalThis.drawCharts = (charts) => {
  try {
    writeFileSync(1, JSON.stringify(charts.map(svgOf)));
  } catch (error) {
    writeFileSync(2, `${error.message}\n`);
    process.exit(1); // a chart that was begun keeps its clock
  }
};
