// The directions of x, y and z in a corner of the picture.
import { s } from '../elements.js';
import { axesOf } from './camera.js';

const arm = 26; // pixels
const middle = 38;

/** {element, draw(camera)}: arms that point towards the reader lie over those that point away. */
export function makeTriad() {
  const element = s('svg', { class: 'triad', width: 2 * middle, height: 2 * middle, 'aria-hidden': 'true' });
  return {
    element,
    draw(camera) {
      const { right, up, back } = axesOf(camera);
      const arms = ['x', 'y', 'z'].map((name, i) => ({ name, x: right[i], y: -up[i], nearness: back[i] }));
      arms.sort((a, b) => a.nearness - b.nearness);
      element.replaceChildren(
        ...arms.flatMap(({ name, x, y, nearness }) => {
          const colour = nearness < -0.01 ? '#9aa3ab' : '#39424a';
          const end = (length) => [middle + length * x, middle + length * y];
          const [x2, y2] = end(arm);
          const [at, down] = end(arm + 8);
          const line = s('line', { x1: middle, y1: middle, x2, y2, stroke: colour, 'stroke-width': 2 });
          // an arm along the line of sight has no length, and its letter would lie on the others
          return Math.hypot(x, y) < 0.15 ? [line] : [line, s('text', { x: at, y: down + 4, fill: colour, 'text-anchor': 'middle' }, name)];
        }),
      );
    },
  };
}
