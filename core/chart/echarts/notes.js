// Words beside points, kept off one another and, where there is room, off the data.
import { isNumber } from './ranges.js';
import { ink } from './style.js';
import { font, shortened } from './text_width.js';

export const note_size = 11; // px
const square = 4; // px of the grid that knows where data are
const step = 6; // px along a line; no text slips between

/** A count of the places with data in a box {x, y, width, height} about its middle; `pixel(x, y)` is null for no place. */
function inkOf(chart, pixel) {
  const taken = new Set();
  const add = ([x, y]) => taken.add(`${Math.floor(x / square)},${Math.floor(y / square)}`);
  const run = (xs, ys, joined) => {
    let last = null;
    for (let i = 0; i < Math.min(xs.length, ys.length); ++i) {
      const here = pixel(xs[i], ys[i]);
      if (here && joined && last) {
        const steps = Math.min(400, Math.hypot(here[0] - last[0], here[1] - last[1]) / step);
        for (let k = 1; k < steps; ++k) add([0, 1].map((c) => last[c] + (k / steps) * (here[c] - last[c])));
      }
      if (here) add(here);
      last = here;
    }
  };
  for (const { x, low, high } of chart.bands ?? []) for (const end of [low, high]) run(x, end, true);
  for (const { x = [], y = [], y_low = [], y_high = [], style } of chart.series) {
    run(x, y, style !== 'points');
    for (const end of [y_low, y_high]) run(x, end, false);
  }
  return ({ x, y, width, height }) => {
    let count = 0;
    for (let column = Math.floor((x - width / 2) / square); column <= (x + width / 2) / square; ++column) {
      for (let row = Math.floor((y - height / 2) / square); row <= (y + height / 2) / square; ++row) count += taken.has(`${column},${row}`);
    }
    return count;
  };
}

// Right, left, above or below the point, and further off.
const places = [0, 1, 2, 3, 4, 5].flatMap((far) => [[1, -far], [-1, -far], [1, far], [-1, far], [0, -far - 1], [0, far + 1]]);

// In the order of badness: beyond the plot, over another note, over data, far off.
function placeNotes(room, ink_in) {
  let placed = [], last = -1;
  const meet = (a, b) => Math.abs(a.x - b.x) < (a.width + b.width) / 2 && Math.abs(a.y - b.y) < (a.height + b.height) / 2;
  const beyond = ({ x, y, width, height }) =>
    x - width / 2 < room.left || x + width / 2 > room.left + room.width || y - height / 2 < room.top || y + height / 2 > room.top + room.height;
  return ({ dataIndex, rect, labelRect }) => {
    if (dataIndex <= last) placed = [];
    last = dataIndex;
    const { width, height } = labelRect, x = rect.x + rect.width / 2, y = rect.y + rect.height / 2;
    let best = null, least = Infinity;
    places.forEach(([side, down], i) => {
      const box = { x: x + side * (width / 2 + 8), y: y + down * (height + 2), width: width + 2, height: height + 1 };
      const cost = 1e5 * beyond(box) + 1e4 * placed.filter((each) => meet(each, box)).length + 20 * Math.min(400, ink_in(box)) + i;
      if (cost < least) [best, least] = [box, cost];
    });
    placed.push(best);
    return { x: best.x, y: best.y, align: 'center', verticalAlign: 'middle' };
  };
}

/** Series of ECharts with the notes, empty for none. */
export function noteSeries(chart, room, pixel) {
  const data = (chart.notes ?? []).filter(({ x, y }) => isNumber(x) && isNumber(y) && pixel(x, y)).map(({ x, y, text }) => ({ value: [x, y], name: shortened(text, 0.7 * room.width, note_size) }));
  if (!data.length) return [];
  const label = { show: true, formatter: ({ name }) => name, color: ink, opacity: 1, fontSize: note_size, fontFamily: font.family };
  return [{ type: 'scatter', name: '', data, z: 5, symbolSize: 1, itemStyle: { color: 'transparent', opacity: 1 }, silent: true, animation: false, tooltip: { show: false }, label, labelLayout: placeNotes(room, inkOf(chart, pixel)) }];
}
