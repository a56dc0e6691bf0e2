// The report's page from the data in it.
import { makeBackground } from './background.js';
import { makeCharts } from './charts.js';
import { DataError, readPage } from './data.js';
import { h, section } from './elements.js';
import { makePartView } from './part/part_view.js';
import { makeTables } from './tables.js';
import { makeVerdict } from './verdict.js';

const troubles = []; // what went wrong, in words, as the page shows it

function tell(error, where) {
  const text = error instanceof DataError ? error.message : `${where} cannot be shown: ${error.message}`;
  troubles.push(text);
  return h('p', { class: 'trouble', role: 'alert' }, text);
}

// One broken section leaves the others readable.
function attempt(where, make) {
  try {
    return make();
  } catch (error) {
    return { element: section(`trouble-${troubles.length}`, where, tell(error, where)), start() {}, handle: null };
  }
}

function build(data) {
  const part = data.part ? attempt('The part', () => makePartView(data)) : null;
  const charts = data.charts?.length ? attempt('Charts', () => makeCharts(data.charts)) : null;
  const show = part?.handle?.webgl
    ? (number) => {
        part.handle.pickCell(part.handle.cellOf(number));
        part.element.scrollIntoView({ behavior: 'smooth' });
      }
    : null;
  const verdict = data.verdict ? attempt('Verdict', () => ({ element: makeVerdict(data.verdict, show) })) : null;
  const tables = data.tables?.length ? attempt('Tables', () => ({ elements: makeTables(data.tables) })) : null;
  const texts = data.texts ?? [];
  const facts = data.facts ?? [];
  const background = texts.length + facts.length ? attempt('Where it comes from', () => ({ element: makeBackground(texts, facts) })) : null;
  return { parts: [verdict, part, charts, tables, background].filter(Boolean), part, charts };
}

function main() {
  const page = document.getElementById('report') ?? document.body.appendChild(h('main', { id: 'report' }));
  let data;
  try {
    data = readPage(document);
  } catch (error) {
    page.append(tell(error, 'This report'));
    window.weaveformReport = { ready: true, troubles };
    return;
  }
  page.append(h('header', {}, h('p', { class: 'brand' }, data.kind === 'study' ? 'Weaveform study' : 'Weaveform result'), h('h1', {}, data.title), data.subtitle && h('p', { class: 'subtitle' }, data.subtitle)));
  const { parts, part, charts } = build(data);
  for (const each of parts) page.append(...(each.elements ?? [each.element]));

  // What starts needs its place on the page; a failure there takes the place of its section.
  for (const [each, where] of [[part, 'The part'], [charts, 'Charts']]) {
    try {
      each?.start();
    } catch (error) {
      each.element.replaceChildren(h('h2', {}, where), tell(error, where));
      each.handle = null;
    }
  }
  // The texts are printed opened.
  window.addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((each) => (each.open = true)));
  window.weaveformReport = {
    ready: true,
    troubles,
    first_picture_ms: performance.now(),
    ...(part?.handle ?? {}),
    chart: (id) => charts?.handle?.(id) ?? null,
    charts: () => charts?.ids?.() ?? [],
  };
}

main();
