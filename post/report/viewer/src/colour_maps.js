// Colour maps: even in lightness and safe for the colour-blind.
// Sequential: viridis (N. Smith, S. van der Walt, 2015, CC0), every sixteenth of its table. Of two signs: blue, white and
// brown, whose CIELAB lightness rises evenly from 22 to 95 and falls evenly again. Categories: M. Okabe, K. Ito, Color
// Universal Design (2008), after a quiet grey.

const viridis = '440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1f9f88 27ad81 3dbc74 5cc863 81d34d ' +
  'aadc32 d5e21a fde725';
const two_signs = '00396c 004f8d 0065ac 007cc6 2d93db 66aaea 95c1f2 c3d9f5 f1f1f1 f4cfc0 ecb095 de9371 ca7752 b25f38 ' +
  '974824 7a3515 5b2409';
const categories = 'd9d9d9 0072b2 e69f00 009e73 cc79a7 56b4e9 d55e00 f0e442 000000';

const table = (text) => text.split(' ').map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));
const tables = { sequential: table(viridis), diverging: table(two_signs) };
const category_table = table(categories);

export const no_value_colour = [168, 168, 168];

/** Colour [r, g, b] (0..255) of a place 0..1 in the map for 'sequential' or 'diverging'. */
export function colourAt(scale, place) {
  const stops = tables[scale] ?? tables.sequential;
  const at = Math.min(Math.max(place, 0), 1) * (stops.length - 1);
  const below = Math.min(Math.floor(at), stops.length - 2);
  const part = at - below;
  return stops[below].map((value, i) => Math.round(value + part * (stops[below + 1][i] - value)));
}

/** Colour of a category: the first is the quiet one ("none"); past the ninth they repeat. */
export function categoryColour(index) {
  return category_table[((index % category_table.length) + category_table.length) % category_table.length];
}

/**
 * A function from value to [r, g, b] for a field and the range {from, to} it is shown over. Values beyond the range have
 * the colour of its end.
 */
export function colouring(field, range) {
  if (field.scale === 'categories') {
    return (value) => (Number.isNaN(value) ? no_value_colour : categoryColour(Math.round(value)));
  }
  const steps = 1024;
  const colours = Array.from({ length: steps + 1 }, (_, i) => colourAt(field.scale, i / steps));
  const width = range.to - range.from || 1;
  return (value) => {
    if (Number.isNaN(value)) return no_value_colour;
    return colours[Math.round(Math.min(Math.max((value - range.from) / width, 0), 1) * steps)];
  };
}

/** The range a field is first shown over: of two signs, zero has the middle colour. */
export function naturalRange(field) {
  if (field.scale !== 'diverging') return { from: field.from, to: field.to };
  const size = Math.max(Math.abs(field.from), Math.abs(field.to));
  return { from: -size, to: size };
}

export const css = ([r, g, b]) => `rgb(${r} ${g} ${b})`;
