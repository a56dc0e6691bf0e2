// Lines of equal value on the part.

/** Levels that share the range evenly, without its ends. */
export function evenLevels({ from, to }, count) {
  return Array.from({ length: count }, (_, i) => from + ((i + 1) * (to - from)) / (count + 1));
}

/**
 * Segments [x, y, z, x, y, z, ...] where the nodes' values, linear on triangles, equal one of the levels. Quads are cut
 * along the diagonal from their first node, as they are drawn.
 */
export function isolines({ cells }, positions, node_values, shown, levels) {
  const points = [];
  const cross = (a, b, level) => {
    const part = (level - node_values[a]) / (node_values[b] - node_values[a]);
    for (let axis = 0; axis < 3; ++axis) points.push(positions[3 * a + axis] + part * (positions[3 * b + axis] - positions[3 * a + axis]));
  };
  const triangle = (a, b, c) => {
    const [va, vb, vc] = [node_values[a], node_values[b], node_values[c]];
    if (Number.isNaN(va + vb + vc)) return;
    for (const level of levels) {
      const above = (va > level) + 2 * (vb > level) + 4 * (vc > level);
      if (above === 0 || above === 7) continue;
      // the node that is alone on its side, and the two others
      const [alone, one, other] = above === 1 || above === 6 ? [a, b, c] : above === 2 || above === 5 ? [b, c, a] : [c, a, b];
      cross(alone, one, level);
      cross(alone, other, level);
    }
  };
  for (const cell of shown) {
    const [a, b, c, d] = cells.subarray(4 * cell, 4 * cell + 4);
    triangle(a, b, c);
    if (d !== c) triangle(a, c, d);
  }
  return new Float32Array(points);
}
