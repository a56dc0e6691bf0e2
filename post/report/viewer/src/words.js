// Numbers as people write them.

/** Four significant digits, no trailing zeros, a true minus; '–' for no value. */
export function numberText(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  const size = Math.abs(value);
  const text =
    size !== 0 && (size >= 1e6 || size < 1e-4)
      ? value.toExponential(digits - 1).replace(/\.?0+e/, 'e').replace('e+', 'e')
      : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, '−');
}

/** With its unit; degrees and nothing stand without a space. */
export function withUnit(value, unit, digits = 4) {
  const text = numberText(value, digits);
  if (!unit || text === '–') return text;
  return unit === '°' ? `${text}°` : `${text} ${unit}`;
}

/** "shear angle (°)", or the title alone for what has no unit. */
export function titleWithUnit({ title, unit }) {
  return unit ? `${title} (${unit})` : title;
}
