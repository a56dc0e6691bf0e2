// The legend above the plot, and the names by which ECharts keeps series.
import { font, shortened, textWidth } from './text_width.js';
import { ink } from './style.js';

// what a line without symbols looks like in the legend: ECharts would put a circle on it
const line_icons = { line: 'path://M0,0H24V2H0Z', dashed: 'path://M0,0H9V2H0ZM15,0H24V2H15Z' };
const icon = { width: 25, gap: 5 };
const between = 12;
const row_height = 26;

/** Names are ECharts' keys: two series of one label stay two. */
export const keyOf = (kind, index) => `${kind}${index}`;

/** Rows that a legend of these labels takes in `width` px. */
function rowsOf(labels, width) {
  let rows = 1;
  let used = 0;
  for (const label of labels) {
    const item = icon.width + icon.gap + textWidth(label) + between + 2;
    if (used > 0 && used + item > width) {
      ++rows;
      used = 0;
    }
    used += item;
  }
  return rows;
}

/**
 * {option, height} for entries {key, label, line}, `line` being 'line' or 'dashed' of a line without symbols. A single
 * entry needs no legend where the title says what is drawn; `always` shows it.
 */
export function legendOf(entries, { top, width, always, interactive }) {
  const shown = entries.filter(({ label }) => label);
  if (!shown.length || (shown.length < 2 && !always)) return { option: { show: false }, height: 0 };
  const room = width - 30;
  const texts = new Map(shown.map(({ key, label }) => [key, shortened(label, room - icon.width - icon.gap - between - 2)]));
  const option = {
    show: true,
    data: shown.map(({ key, line }) => (line ? { name: key, icon: line_icons[line] } : { name: key })),
    formatter: (key) => texts.get(key) ?? '',
    ...(interactive ? {} : { selectedMode: false }),
    top, left: 'center', width: room, itemGap: between, itemWidth: icon.width, padding: [5, 5],
    textStyle: { fontFamily: font.family, fontSize: font.size, color: ink },
  };
  return { option, height: row_height * rowsOf([...texts.values()], room) };
}
