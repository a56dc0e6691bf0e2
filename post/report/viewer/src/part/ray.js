// Which triangle a ray meets first.

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Distance along the ray to the triangle in units of `direction`, or Infinity (T. Möller, B. Trumbore, 1997). */
export function meets(origin, direction, a, b, c) {
  const e1 = minus(b, a);
  const e2 = minus(c, a);
  const p = cross(direction, e2);
  const determinant = dot(e1, p);
  if (determinant === 0) return Infinity;
  const t = minus(origin, a);
  const u = dot(t, p) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const q = cross(t, e1);
  const v = dot(direction, q) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const distance = dot(e2, q) / determinant;
  return distance > 0 ? distance : Infinity;
}

/** The cell of `shown` that the ray from `origin` along `direction` meets first, or -1. */
export function cellOnRay({ cells }, positions, shown, origin, direction) {
  const point = (node) => positions.subarray(3 * node, 3 * node + 3);
  let nearest = Infinity;
  let found = -1;
  for (const cell of shown) {
    const [a, b, c, d] = cells.subarray(4 * cell, 4 * cell + 4);
    let distance = meets(origin, direction, point(a), point(b), point(c));
    if (d !== c) distance = Math.min(distance, meets(origin, direction, point(a), point(c), point(d)));
    if (distance < nearest) {
      nearest = distance;
      found = cell;
    }
  }
  return found;
}
