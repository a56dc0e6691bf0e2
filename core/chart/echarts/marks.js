// Upright lines across the chart, with their labels: "the card's range ends".
import { extentOf, isNumber, valuesOf } from './ranges.js';
import { mark_colour } from './style.js';
import { font, textWidth } from './text_width.js';

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

/** ECharts' markLine for a plot of `width` px, null for no marks. */
export function markLines(chart, width) {
  const marks = (chart.marks ?? []).filter(({ x }) => isNumber(x));
  if (!marks.length) return null;
  const range = extentOf(valuesOf(chart, 'x')) ?? [0, 1];
  const heights = markHeights(marks, range, width);
  return {
    silent: true,
    symbol: 'none',
    animation: false,
    lineStyle: { color: mark_colour, type: 'dashed', width: 1.2 },
    data: marks.map((mark, i) => {
      // in the right half the label stands to the left of its line, so that it is not cut off
      const right_half = (mark.x - range[0]) / (range[1] - range[0] || 1) > 0.6;
      return {
        xAxis: mark.x,
        label: {
          formatter: () => mark.label, position: 'insideEndTop', rotate: 0, color: mark_colour, fontSize: font.size, fontFamily: font.family,
          align: right_half ? 'right' : 'left', verticalAlign: 'top', distance: [0, 0], offset: [right_half ? -5 : 5, 2 + 16 * heights[i]],
          backgroundColor: 'rgba(255,255,255,0.8)', padding: [1, 3],
        },
      };
    }),
  };
}
