// The part as the page's data has it: cells, yarns, fields and frames, decoded when they are first asked for.
import { checkIndices, DataError, decode, positionsOf, valuesOf } from '../data.js';

/**
 * From the "part" of the data: {node_count, cell_count, cells (4 nodes each), numberOf(cell) as the mesh counts and
 * cellOf(number), the first that is drawn of it or -1, cell_plies (or null), plies (sorted), plyName(ply), yarns
 * {warp, weft}, fields, frames [{label}], positions(frame), values(field, frame)}. Throws DataError.
 */
export function makeModel(part) {
  const { node_count, cell_count } = part;
  if (!part.frames?.length) throw new DataError('The part has no frames.');
  const cells = decode(part.cells, Uint32Array, 'cells of the part', 4 * cell_count);
  checkIndices(cells, node_count, 'cells of the part');
  const yarns = {};
  for (const name of ['warp', 'weft']) {
    yarns[name] = decode(part.yarns?.[name] ?? '', Uint32Array, `${name} yarns`);
    checkIndices(yarns[name], node_count, `${name} yarns`);
  }
  const numbers = part.cell_numbers ? decode(part.cell_numbers, Uint32Array, 'numbers of the cells', cell_count) : null;
  const cell_plies = part.plies ? decode(part.plies, Uint8Array, 'plies of the cells', cell_count) : null;
  const position_cache = new Map();
  const value_cache = new Map();

  function positions(frame) {
    if (!position_cache.has(frame)) {
      position_cache.set(frame, positionsOf(part.frames[frame].position, part.position, node_count, `positions of frame ${frame}`));
    }
    return position_cache.get(frame);
  }

  /** Values per cell or node, or null where the frame has none of this field. */
  function values(field, frame) {
    const key = `${frame} ${field.name}`;
    if (!value_cache.has(key)) {
      const coded = part.frames[frame].fields?.[field.name];
      const count = field.association === 'nodes' ? node_count : cell_count;
      value_cache.set(key, coded ? valuesOf(coded, field, count, `${field.title} of frame ${frame}`) : null);
    }
    return value_cache.get(key);
  }

  return {
    node_count,
    cell_count,
    cells,
    numberOf: (cell) => (numbers ? numbers[cell] : cell),
    cellOf: (number) => (numbers ? numbers.indexOf(number) : number),
    cell_plies,
    plyName: (ply) => part.ply_names?.[ply] ?? String(ply + 1),
    plies: cell_plies ? [...new Set(cell_plies)].sort((a, b) => a - b) : [],
    yarns,
    fields: part.fields ?? [],
    frames: part.frames.map(({ label }) => ({ label })),
    positions,
    values,
  };
}

/** How many different nodes a cell has: 3 or 4. */
export const cornersOf = (cells, cell) => (cells[4 * cell + 3] === cells[4 * cell + 2] ? 3 : 4);

/** The middle of a cell's corners. */
export function centreOf(cells, positions, cell) {
  const corners = cornersOf(cells, cell);
  const centre = [0, 0, 0];
  for (let i = 0; i < corners; ++i) {
    for (let axis = 0; axis < 3; ++axis) centre[axis] += positions[3 * cells[4 * cell + i] + axis] / corners;
  }
  return centre;
}

/** The category that most corners of a cell have; of as many the later one. NaN where none has any. */
export function categoryOfCell(cells, values, cell) {
  const counts = new Map();
  for (let i = 0; i < cornersOf(cells, cell); ++i) {
    const value = Math.round(values[cells[4 * cell + i]]);
    if (!Number.isNaN(value)) counts.set(value, (counts.get(value) ?? 0) + 1);
  }
  let best = NaN;
  for (const [value, count] of counts) {
    const most = counts.get(best) ?? 0;
    if (count > most || (count === most && value > best)) best = value;
  }
  return best;
}

/** Values of the nodes from those of the cells: the mean over a node's cells that have one, of `shown` cells only. */
export function nodeMeans({ cells, node_count }, values, shown) {
  const sums = new Float32Array(node_count);
  const counts = new Uint16Array(node_count);
  for (const cell of shown) {
    if (Number.isNaN(values[cell])) continue;
    for (let i = 0; i < cornersOf(cells, cell); ++i) {
      sums[cells[4 * cell + i]] += values[cell];
      ++counts[cells[4 * cell + i]];
    }
  }
  return sums.map((sum, i) => (counts[i] ? sum / counts[i] : NaN));
}

/** Smooth normals of the nodes, by the area of the cells around them. */
export function nodeNormals({ cells, node_count }, positions, shown) {
  const normals = new Float32Array(3 * node_count);
  for (const cell of shown) {
    const a = 3 * cells[4 * cell];
    const b = 3 * cells[4 * cell + 1];
    const c = 3 * cells[4 * cell + 2];
    const d = 3 * cells[4 * cell + 3];
    // half the cross product of the diagonals is a quad's vector area; of a triangle (d = c) it is the triangle's
    const ux = positions[c] - positions[a];
    const uy = positions[c + 1] - positions[a + 1];
    const uz = positions[c + 2] - positions[a + 2];
    const vx = positions[d] - positions[b];
    const vy = positions[d + 1] - positions[b + 1];
    const vz = positions[d + 2] - positions[b + 2];
    for (let corner = 0; corner < cornersOf(cells, cell); ++corner) {
      const at = 3 * cells[4 * cell + corner];
      normals[at] += uy * vz - uz * vy;
      normals[at + 1] += uz * vx - ux * vz;
      normals[at + 2] += ux * vy - uy * vx;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let axis = 0; axis < 3; ++axis) normals[i + axis] /= size;
  }
  return normals;
}
