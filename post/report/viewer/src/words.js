// Numbers with their units and titles as people write them.
import { numberText } from '../../../../core/chart/echarts/number_text.js';

export { numberText };

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
