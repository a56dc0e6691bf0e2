// Colours and shapes by which series are told apart, also in print.

/** Okabe and Ito's colours (2008), the dark ones first, a dark yellow for theirs, which is lost on white. */
export const series_colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#000000', '#7a6a00'];
export const ink = '#333';
export const quiet = '#e6e6e6';
export const mark_colour = '#c0005a';

// as paths, because ECharts stretches its own shapes to the legend's width; those with a hole run round it the other way
const square = 'M0,0H9V9H0Z', triangle = 'M5,0L10,9H0Z', diamond = 'M5,0L10,5L5,10L0,5Z', downwards = 'M0,0H10L5,9Z';
const shapes = [
  'circle', `path://${square}`, `path://${triangle}`, `path://${diamond}`, 'path://M10,5A5,5 0 1 1 0,5A5,5 0 1 1 10,5ZM8,5A3,3 0 1 0 2,5A3,3 0 1 0 8,5Z', `path://${downwards}`,
  `path://${square}M2,2V7H7V2Z`, `path://${triangle}M5,3.4L2.7,7.5H7.3Z`, `path://${diamond}M5,2.5L2.5,5L5,7.5L7.5,5Z`,
];

// One more than there are colours, or a number prime to theirs: in turn the pairs repeat late.
export const shapeOf = (index) => shapes[index % shapes.length];
export const colourOf = (index) => series_colours[index % series_colours.length];

/** Numbers of colours and shapes for bands and series: those that were asked for, else the next colour in turn. */
export function looksOf({ bands = [], series }) {
  let next = 0;
  const turn = ({ colour, shape }) => {
    const own = colour ?? next++;
    return { colour: own, shape: shape ?? own };
  };
  return { bands: bands.map(turn), series: series.map(turn) };
}
