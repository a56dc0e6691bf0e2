// What a page says beside the pointer: the numbers and what they are of.
import { numberText } from './number_text.js';
import { ink } from './style.js';
import { font } from './text_width.js';

const escaped = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;');
const valueText = (value) => (typeof value === 'string' ? escaped(value) : numberText(value, 5));

export function tooltip(chart, labels) {
  const points_only = chart.square || chart.series.every(({ style }) => style === 'points');
  const range = (low, high) => `${valueText(low)} … ${valueText(high)}`;
  const number = (item) => {
    if (item.seriesId.startsWith('band')) return range(item.value[1], item.value[2]);
    const series = chart.series[Number(item.seriesId.slice('series'.length))];
    const [low, high] = [series?.y_low?.[item.dataIndex], series?.y_high?.[item.dataIndex]];
    return valueText(item.value[1]) + (typeof low === 'number' && typeof high === 'number' ? `</b> (${range(low, high)})<b>` : '');
  };
  const row = (item) => `${item.marker}${escaped(labels.get(item.seriesName) ?? '')}: <b>${number(item)}</b>`;
  // Titles by themselves name the axes.
  const head = (x) => `${escaped(chart.x.title)}: <b>${valueText(x)}</b>`;
  return {
    trigger: points_only ? 'item' : 'axis',
    confine: true,
    axisPointer: { type: 'line', snap: true, lineStyle: { color: '#999' } },
    textStyle: { fontSize: font.size, fontFamily: font.family, color: ink },
    formatter: (items) => {
      const list = (Array.isArray(items) ? items : [items]).filter((item) => item.value && Number.isNaN(item.value[1]) === false && item.value[1] !== null && !item.seriesId.startsWith('error') && labels.has(item.seriesName));
      if (!list.length) return '';
      return [head(list[0].value[0]), escaped(chart.y.title), ...list.map(row)].join('<br>');
    },
  };
}
