// What was measured, in the second viewport and in the same colours.
import { colouring } from '../colour_maps.js';
import { checkIndices, decode } from '../data.js';
import { counted, makePoints, makeSurface } from './shapes.js';

/** From the "measured" of the data; draw({field, range}) colours it while its own field is chosen, else leaves it grey. */
export function drawMeasured(stage, measured, viewport) {
  const points = decode(measured.points, Float32Array, 'measured points');
  const count = points.length / 3;
  const values = decode(measured.values, Float32Array, 'measured values', count);
  let shape;
  if (measured.triangles) {
    const triangles = decode(measured.triangles, Uint32Array, 'measured triangles');
    checkIndices(triangles, count, 'measured triangles');
    shape = makeSurface();
    shape.setPolygons(counted(triangles, 3));
    shape.setPositions(points, null);
  } else {
    shape = makePoints(points, 5);
  }
  stage.add(shape.actor, viewport);
  return {
    points,
    values,
    draw({ field, range }) {
      const colour = field?.name === measured.field ? colouring(field, range) : () => [205, 205, 205];
      const bytes = new Uint8Array(3 * count);
      for (let i = 0; i < count; ++i) bytes.set(colour(values[i]), 3 * i);
      shape.setColours(bytes, { per_point: true });
    },
  };
}
