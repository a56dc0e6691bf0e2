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

/** As many digits as tell numbers `step` apart. */
export function stepText(value, step) {
  const digits = Math.ceil(Math.log10((Math.abs(value) + step) / step) + 1e-9) + 1;
  return numberText(Math.abs(value) < 1e-9 * step ? 0 : value, Math.min(15, Math.max(2, digits)));
}

const superscript = (exponent) => [...String(exponent)].map((c) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[c] ?? '⁻').join('');

/** A tick of a logarithmic axis, as a power of ten where the axis has such as have many digits. */
export function powerText(value, powers) {
  if (!powers || value === 1) return numberText(value, 6);
  const [mantissa, exponent] = value.toExponential(5).split('e');
  const factor = Number(mantissa);
  return `${factor === 1 ? '' : `${numberText(factor, 6)}×`}10${superscript(Number(exponent))}`;
}
