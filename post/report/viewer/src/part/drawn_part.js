// The part on the stage: its surface in the field's colours, cell edges, yarns, isolines, the picked cell.
import { colouring } from '../colour_maps.js';
import { isolines } from './isolines.js';
import { categoryOfCell, centreOf, cornersOf, nodeMeans, nodeNormals } from './model.js';
import { makeLines, makeSurface, polygonsOf } from './shapes.js';

/** Seen on every colour of the field's map. */
export function yarnColours(field) {
  return { warp: [213, 94, 0], weft: field?.scale === 'sequential' ? [255, 255, 255] : [0, 0, 0] };
}

const plain = [222, 218, 208];
const mark_colour = [255, 0, 140];

function edgePairs(cells, shown) {
  const seen = new Set();
  const pairs = [];
  for (const cell of shown) {
    const corners = cornersOf(cells, cell);
    for (let i = 0; i < corners; ++i) {
      const a = cells[4 * cell + i];
      const b = cells[4 * cell + ((i + 1) % corners)];
      const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
      if (seen.has(key)) continue;
      seen.add(key);
      pairs.push(a, b);
    }
  }
  return Uint32Array.from(pairs);
}

// Yarn segments with both nodes on a shown cell.
function shownPairs(pairs, cells, shown, node_count) {
  const visible = new Uint8Array(node_count);
  for (const cell of shown) for (let i = 0; i < 4; ++i) visible[cells[4 * cell + i]] = 1;
  const kept = [];
  for (let i = 0; i < pairs.length; i += 2) if (visible[pairs[i]] && visible[pairs[i + 1]]) kept.push(pairs[i], pairs[i + 1]);
  return Uint32Array.from(kept);
}

function coloursOf(values, ids, field, range) {
  const colour = colouring(field, range);
  const bytes = new Uint8Array(3 * ids.length);
  ids.forEach((id, i) => bytes.set(colour(values ? values[id] : NaN), 3 * i));
  return bytes;
}

/** draw(state) shows the state {frame, field (or null), range, levels, edges, warp, weft, hidden_plies, picked}. */
export function drawPart(stage, model) {
  const surface = makeSurface();
  const lines = {
    edges: makeLines([60, 60, 60]),
    warp: makeLines([0, 0, 0]),
    weft: makeLines([0, 0, 0]),
    levels: makeLines([10, 10, 10], 2),
    mark: makeLines(mark_colour, 3),
  };
  surface.setColour(plain);
  stage.add(surface.actor);
  Object.values(lines).forEach((shape) => stage.add(shape.actor));

  let shown = [];
  let shown_key = null;
  let edges_known = false; // of the shown cells; found when they are first asked for
  const all_nodes = Uint32Array.from({ length: model.node_count }, (_, i) => i);

  function choosePlies(hidden) {
    const key = [...hidden].sort().join();
    if (key === shown_key) return;
    shown_key = key;
    const list = [];
    for (let cell = 0; cell < model.cell_count; ++cell) if (!model.cell_plies || !hidden.has(model.cell_plies[cell])) list.push(cell);
    shown = Uint32Array.from(list);
    surface.setPolygons(polygonsOf(model.cells, shown));
    edges_known = false;
    for (const name of ['warp', 'weft']) lines[name].setPairs(shownPairs(model.yarns[name], model.cells, shown, model.node_count));
  }

  // Names are not mixed between nodes, as colours of numbers are: a mixture might look like a third name.
  function paint(field, { frame, range }) {
    if (!field) return surface.setColours(null, { per_point: false });
    const values = model.values(field, frame);
    const on_nodes = field.association === 'nodes';
    if (on_nodes && values && field.scale === 'categories') {
      const of_cells = new Float32Array(model.cell_count);
      for (const cell of shown) of_cells[cell] = categoryOfCell(model.cells, values, cell);
      return surface.setColours(coloursOf(of_cells, shown, field, range), { per_point: false });
    }
    return surface.setColours(coloursOf(values, on_nodes ? all_nodes : shown, field, range), { per_point: on_nodes });
  }

  function drawLevels({ field, frame, levels }, positions) {
    const values = field && levels.length ? model.values(field, frame) : null;
    lines.levels.actor.setVisibility(Boolean(values));
    if (!values) return;
    const node_values = field.association === 'nodes' ? values : nodeMeans(model, values, shown);
    lines.levels.setSegments(isolines(model, positions, node_values, shown, levels));
  }

  function drawMark(picked, positions) {
    lines.mark.actor.setVisibility(picked >= 0);
    if (picked < 0) return;
    const corners = cornersOf(model.cells, picked);
    const segments = [];
    for (let i = 0; i < corners; ++i) {
      for (const k of [i, (i + 1) % corners]) {
        const node = model.cells[4 * picked + k];
        segments.push(...positions.subarray(3 * node, 3 * node + 3));
      }
    }
    lines.mark.setSegments(new Float32Array(segments));
  }

  return {
    shown: () => shown,
    draw(state) {
      choosePlies(state.hidden_plies);
      const positions = model.positions(state.frame);
      surface.setPositions(positions, nodeNormals(model, positions, shown));
      const { field } = state;
      paint(field, state);
      if (state.edges && !edges_known) {
        lines.edges.setPairs(edgePairs(model.cells, shown));
        edges_known = true;
      }
      for (const name of ['edges', 'warp', 'weft']) {
        lines[name].actor.setVisibility(Boolean(state[name]));
        if (state[name]) lines[name].setPositions(positions);
      }
      for (const [name, colour] of Object.entries(yarnColours(field))) lines[name].setColour(colour);
      drawLevels(state, positions);
      drawMark(state.picked, positions);
    },
    centre: (cell, frame) => centreOf(model.cells, model.positions(frame), cell),
  };
}
