// Which values an axis spans, and at which of them it has ticks.

// Beyond this the span of two values is no number any more.
export const isNumber = (value) => typeof value === 'number' && Math.abs(value) <= 1e300;
export const isDrawable = (value, log) => isNumber(value) && (!log || value > 0);

/** All values of a chart along 'x' or 'y', with those of bands and error bars. */
export function valuesOf(chart, key) {
  const of_series = chart.series.flatMap((series) => [series[key] ?? [], ...(key === 'y' ? [series.y_low ?? [], series.y_high ?? []] : [])]);
  const of_bands = (chart.bands ?? []).flatMap((band) => (key === 'x' ? [band.x] : [band.low, band.high]));
  return [...of_series, ...of_bands].flat();
}

export function extentOf(values, log = false) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!isDrawable(value, log)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return low <= high ? [low, high] : null;
}

export function niceStep(width, count) {
  const rough = width / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((m) => m >= 0.999 * rough);
}

// The range that was asked for, which may lie beyond all data.
function asked({ from, to, log }, [low, high]) {
  const [has_from, has_to] = [isDrawable(from, log), isDrawable(to, log)];
  let [min, max] = [has_from ? from : low, has_to ? to : high];
  if (min >= max && has_to) min = log ? max / 10 : max - 1;
  if (min >= max) max = log ? min * 10 : min + 1;
  return { min, max, has_from: has_from && min === from, has_to: has_to && max === to };
}

function multiples(step, min, max) {
  const ticks = [];
  const first = Math.ceil(min / step - 1e-6);
  for (let n = first; n * step <= max + 1e-6 * step && ticks.length < 60; ++n) ticks.push(Number((n * step).toPrecision(14)));
  return ticks;
}

/** {min, max, step, ticks} with some `count` ticks: round ends, but for those that were asked for. */
export function linearRange(axis, values, count) {
  const found = extentOf(values) ?? [0, 1];
  const size = Math.max(...found.map(Math.abs));
  // what rounding left of a zero must not give the axis a negative part
  let [low, high] = found.map((end) => (Math.abs(end) < 1e-9 * size ? 0 : end));
  if (high - low <= 1e-9 * size) [low, high] = size > 0 ? [low - 0.5 * size, high + 0.5 * size] : [-1, 1];
  const { min, max, has_from, has_to } = asked(axis, [low, high]);
  const step = niceStep(max - min, count);
  const ends = { min: has_from ? min : Math.floor(min / step + 1e-6) * step, max: has_to ? max : Math.ceil(max / step - 1e-6) * step };
  return { ...ends, step, ticks: multiples(step, ends.min, ends.max) };
}

// The digits times the powers of ten from the last one below to the first one above [low, high].
function logSteps(low, high, digits) {
  const steps = [];
  const first = Math.floor(Math.log10(low) + 1e-9);
  const last = Math.ceil(Math.log10(high) - 1e-9);
  for (let power = first; power <= Math.max(last, first + 1); ++power) {
    for (const digit of digits) steps.push(Number(`${digit}e${power}`));
  }
  const begin = steps.findLastIndex((step) => step <= low * (1 + 1e-9));
  const end = steps.findIndex((step) => step >= high * (1 - 1e-9));
  return steps.slice(begin, Math.max(end, begin + 1) + 1);
}

/**
 * {min, max, ticks}: powers of ten only where there are several; within one or two the axis is divided more
 * finely, and ends sooner; within a part of one it has round steps.
 */
export function logRange(axis, values) {
  let [low, high] = extentOf(values, true) ?? [1, 10];
  if (high / low < 1 + 1e-9) [low, high] = [low / 2, high * 2];
  const { min, max, has_from, has_to } = asked({ ...axis, log: true }, [low, high]);
  const ratio = max / min;
  if (ratio < 2) {
    const step = niceStep(max - min, 5);
    const ends = { min: has_from ? min : Math.floor(min / step + 1e-6) * step || min, max: has_to ? max : Math.ceil(max / step - 1e-6) * step };
    return { ...ends, ticks: multiples(step, ends.min, ends.max), step };
  }
  const digits = ratio > 300 ? [1] : ratio > 5 ? [1, 2, 5] : [1, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9];
  const steps = logSteps(min, max, digits);
  const ends = { min: has_from ? min : steps[0], max: has_to ? max : steps[steps.length - 1] };
  const every = Math.ceil(Math.log10(ratio) / 10); // decades from label to label
  const inside = steps.filter((tick) => tick >= ends.min * (1 - 1e-9) && tick <= ends.max * (1 + 1e-9))
    .filter((tick) => every < 2 || Math.round(Math.log10(tick)) % every === 0);
  const ticks = inside.length >= 2 ? inside : [ends.min, ends.max];
  return { ...ends, ticks };
}
