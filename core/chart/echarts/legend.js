// The legend above the plot, and the names by which ECharts keeps series.
import { font, shortened, textWidth } from './text_width.js';
import { ink } from './style.js';

// what a line without symbols looks like in the legend: ECharts would put a circle on it
const line_icons = { line: 'path://M0,0H24V2H0Z', dashed: 'path://M0,0H9V2H0ZM15,0H24V2H15Z' };
const icon = { width: 25, height: 10, gap: 5 };
const between = 14;
const row_height = 26;

/** Names are ECharts' keys: two series of one label stay two. */
export const keyOf = (kind, index) => `${kind}${index}`;

// ECharts leaves out what is left of a shape.
const iconWidth = ({ is_shape }) => icon.gap + (is_shape ? (icon.width + icon.height) / 2 : icon.width + 1);

/** Rows that a legend of these entries takes in `width` px. */
function rowsOf(entries, width) {
  let rows = 1;
  let used = 0;
  for (const entry of entries) {
    const item = iconWidth(entry) + textWidth(entry.text) + between;
    if (used > 0 && used + item > width) {
      ++rows;
      used = 0;
    }
    used += item;
  }
  return rows;
}

/**
 * {option, height} for entries {key, label, line, is_shape}, `line` being 'line' or 'dashed' of a line without symbols and
 * `is_shape` true for points. A single entry needs no legend where the title says what is drawn; `always` shows it.
 */
export function legendOf(entries, { top, width, always, interactive }) {
  const shown = entries.filter(({ label }) => label);
  if (!shown.length || (shown.length < 2 && !always)) return { option: { show: false }, height: 0 };
  const room = width - 30;
  const lines = shown.map((entry) => ({ ...entry, text: shortened(entry.label, room - iconWidth(entry) - between) }));
  const texts = new Map(lines.map(({ key, text }) => [key, text]));
  const option = {
    show: true,
    data: shown.map(({ key, line }) => (line ? { name: key, icon: line_icons[line] } : { name: key })),
    formatter: (key) => texts.get(key) ?? '',
    ...(interactive ? {} : { selectedMode: false }),
    top, left: 'center', width: room, itemGap: between, itemWidth: icon.width, itemHeight: icon.height, padding: [5, 5],
    textStyle: { fontFamily: font.family, fontSize: font.size, color: ink },
  };
  return { option, height: row_height * rowsOf(lines, room) };
}
