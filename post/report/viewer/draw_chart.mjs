// node draw_chart.mjs FILE.json FILE.svg [WIDTH HEIGHT]: a chart of the report's data (README.md, "charts") as an SVG for the
// documents, by the ECharts of node_modules; the same file gives the same bytes. WIDTH and HEIGHT are pixels (640 400).
// Exit codes: 2 wrong input, 4 a file cannot be read or written.
import { readFileSync, writeFileSync } from 'node:fs';
import { chartOption, textWidth } from './src/chart_option.js';
import { init, setPlatformAPI } from './src/echarts_parts.js';

function fail(message, code) {
  console.error(`error: ${message}`);
  process.exit(code);
}

function readChart(file) {
  let text;
  try {
    text = readFileSync(file, 'utf8');
  } catch (error) {
    fail(`${file} cannot be read: ${error.message}`, 4);
  }
  let chart;
  try {
    chart = JSON.parse(text);
  } catch (error) {
    fail(`${file} is no JSON: ${error.message}`, 2);
  }
  for (const key of ['x', 'y', 'series']) if (!chart[key]) fail(`${file} has no "${key}"; see "charts" in README.md`, 2);
  return chart;
}

// ECharts numbers its identifiers by charts drawn so far; one chart of a process has always the same. What is left of
// its own bookkeeping (what to do when hovered) is of no use in a document.
function plainSvg(svg, title) {
  const escaped = (title ?? '').replace(/&/g, '&amp;').replace(/</g, '&lt;');
  const bare = svg
    .replace(/ (ecmeta_[a-z_]+|class|pointer-events)="[^"]*"/g, '')
    .replace(/<style[^>]*>[^]*?<\/style>\n?/g, '');
  return `${bare.replace(/<svg[^>]*>/, (head) => `${head}\n<title>${escaped}</title>`)}\n`;
}

const [input, output, width = '640', height = '400'] = process.argv.slice(2);
if (!output || !(Number(width) > 0) || !(Number(height) > 0)) fail('usage: node draw_chart.mjs FILE.json FILE.svg [WIDTH HEIGHT]', 2);
const chart = readChart(input);
const size = { width: Number(width), height: Number(height) };
// without a screen nothing measures text; a guess on the safe side keeps labels apart in any reader's font
setPlatformAPI({ measureText: (text, font) => ({ width: textWidth(text ?? '', parseFloat(font?.match(/([\d.]+)px/)?.[1] ?? '12')) }) });
const drawn = init(null, null, { renderer: 'svg', ssr: true, ...size });
drawn.setOption(chartOption(chart, { ...size, interactive: false }));
const svg = plainSvg(drawn.renderToSVGString(), chart.title);
drawn.dispose(); // its clock would keep the process alive
try {
  writeFileSync(output, svg);
} catch (error) {
  fail(`${output} cannot be written: ${error.message}`, 4);
}
