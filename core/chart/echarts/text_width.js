// How much room a text takes: a guess on the safe side, for nobody knows which font the reader has.

// without quotes: ECharts does not escape them in its SVG
export const font = { family: 'system-ui, Helvetica, Arial, sans-serif', size: 12 };

// Letters of East Asia, and pictures, are as wide as they are high.
const is_wide = (letter) => letter.codePointAt(0) >= 0x1100 && /\p{Script=Han}|\p{Script=Hangul}|\p{Script=Hiragana}|\p{Script=Katakana}|\p{Emoji_Presentation}/u.test(letter);

/** Wide enough for most letters of the font (px): labels may get too much room, not too little. */
export function textWidth(text, size = font.size) {
  let letters = 0;
  for (const letter of text) letters += is_wide(letter) ? 1.8 : 1;
  return 0.58 * size * letters;
}

/** The text, or what of it and '…' is no wider than `width` px. */
export function shortened(text, width, size = font.size) {
  if (textWidth(text, size) <= width) return text;
  let kept = '';
  for (const letter of text) {
    if (textWidth(`${kept}${letter}…`, size) > width) break;
    kept += letter;
  }
  return `${kept.trimEnd()}…`;
}

/** {text, size}: set smaller where it is long, at 9 px shortened. */
export function fitted(text, width, size) {
  const smaller = Math.max(9, Math.min(size, Math.floor((10 * size * width) / Math.max(1, textWidth(text, size))) / 10));
  return { text: shortened(text, width, smaller), size: smaller };
}
