// The section with the part: picture, switches, colour bar, time, picked cell.
import { naturalRange } from '../colour_maps.js';
import { h, section } from '../elements.js';
import { look, rayThrough, seenAt, watch } from './camera.js';
import { drawColourBar } from './colour_bar.js';
import { makeControls, makeTimeline, makeViewButtons } from './controls.js';
import { drawPart } from './drawn_part.js';
import { evenLevels } from './isolines.js';
import { drawMeasured } from './measured.js';
import { makeModel } from './model.js';
import { describeCell, drawPick } from './pick_panel.js';
import { cellOnRay } from './ray.js';
import { canDraw, makeStage } from './stage.js';
import { drawTools } from './tools.js';
import { makeTriad } from './triad.js';

function firstState(model) {
  const field = model.fields[0] ?? null;
  return {
    frame: model.frames.length - 1,
    field,
    ranges: new Map(model.fields.map((each) => [each.name, naturalRange(each)])),
    isolines: field?.limit !== null && field?.limit !== undefined ? 'limit' : '0',
    warp: false,
    weft: false,
    edges: false,
    tools: new Set(),
    hidden_plies: new Set(),
    picked: -1,
  };
}

function levelsOf({ field, isolines }, range) {
  if (!field || isolines === '0' || field.scale === 'categories') return [];
  if (isolines !== 'limit') return evenLevels(range, Number(isolines));
  if (field.limit === null || field.limit === undefined) return [];
  return field.scale === 'diverging' ? [-field.limit, field.limit] : [field.limit];
}

// The ball around everything that may ever be seen, for the depth of the picture.
function ballAround(arrays) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const points of arrays) {
    for (let i = 0; i < points.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], points[i]);
      high[i % 3] = Math.max(high[i % 3], points[i]);
    }
  }
  const centre = low.map((x, axis) => (x + high[axis]) / 2);
  return { centre, radius: Math.hypot(...low.map((x, axis) => high[axis] - x)) / 2 || 1 };
}

function joined(arrays) {
  const all = new Float32Array(arrays.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const array of arrays) {
    all.set(array, at);
    at += array.length;
  }
  return all;
}

// A part that stays in its plane is best seen from above.
function isFlat(positions) {
  const sizes = [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    return high - low;
  });
  return sizes[2] < 0.02 * Math.max(sizes[0], sizes[1]);
}

/** Builds the section; returns {element, start(), handle}: start() draws once the element is in the page. */
export function makePartView(data) {
  const model = makeModel(data.part);
  const state = firstState(model);
  const title = data.measured ? 'The part, simulated and measured' : 'The part';
  if (!canDraw()) {
    const words = 'This browser cannot draw in 3-D (WebGL 2 is missing or switched off), so that the part is not shown. All else of this report is below.';
    return { element: section('part', title, h('p', { class: 'trouble', role: 'alert' }, words)), start() {}, handle: { webgl: false } };
  }
  const parts = layOut(data, model, title);
  return { element: parts.element, ...run(data, model, state, parts) };
}

function layOut(data, model, title) {
  const canvas_box = h('div', {
    class: 'canvas-box', tabindex: 0, role: 'application',
    'aria-label': 'The part in 3-D. Arrow keys turn it, with shift they move it, plus and minus come nearer and go away.',
  });
  const ring = h('div', { class: 'pick-ring', hidden: true });
  const labels = data.measured ? [h('span', { class: 'viewport-label left' }, 'simulated'), h('span', { class: 'viewport-label right' }, data.measured.title || 'measured')] : [];
  const still = h('img', { class: 'still', alt: 'the part as it was seen when the page was printed' });
  const picture = h('div', { class: `picture${data.measured ? ' two' : ''}` }, canvas_box, ...labels, ring, still);
  const bar = h('div', { class: 'bar' });
  const panel = h('div', { class: 'pick', 'aria-live': 'polite' });
  const note = h('p', { class: 'note' });
  const slots = { controls: h('div'), timeline: h('div'), views: h('div') };
  const element = section('part', title,
    slots.controls,
    h('div', { class: 'stage' }, picture, h('div', { class: 'side' }, bar, panel)),
    h('div', { class: 'below' }, slots.timeline, slots.views),
    note,
    h('p', { class: 'note' }, data.part.thinned ? `Thinned, so that the file stays small: ${data.part.thinned}.` : ''),
    h('p', { class: 'hint no-print' }, 'Drag turns, shift and drag moves, the wheel comes nearer once the picture was clicked.'),
  );
  return { element, canvas_box, ring, picture, still, bar, panel, note, slots };
}

function run(data, model, state, parts) {
  const { canvas_box, ring, picture, still, bar, panel, note, slots } = parts;
  const count = data.measured ? 2 : 1;
  const stage = makeStage(canvas_box, count);
  const part = drawPart(stage, model);
  const tools = drawTools(stage, data.tools ?? []);
  const measured = data.measured ? drawMeasured(stage, data.measured, 1) : null;
  const sizes = [model.positions(0), model.positions(model.frames.length - 1)];
  const ball = ballAround(measured ? [...sizes, measured.points] : sizes);
  const aspect = () => stage.size()[0] / stage.size()[1];
  const range = () => (state.field ? state.ranges.get(state.field.name) : null);

  const controls = makeControls({ model, tool_names: tools.names, state }, { setField, set });
  const timeline = makeTimeline({ frames: model.frames, state }, setFrame);
  slots.controls.replaceWith(controls.element);
  const triad = makeTriad();
  slots.views.replaceWith(makeViewButtons(lookFrom));
  picture.append(triad.element);
  slots.timeline.replaceWith(timeline.element);

  function update() {
    const shown = { ...state, range: range(), levels: levelsOf(state, range()) };
    part.draw(shown);
    tools.draw(shown);
    measured?.draw(shown);
    drawColourBar(bar, { ...shown, changed: setRange, reset: () => setRange(naturalRange(state.field)) });
    drawPick(panel, model, state, () => pickCell(-1));
    controls.update();
    timeline.update();
    note.textContent = measuredNote();
    stage.ask();
  }

  function measuredNote() {
    if (!measured) return '';
    const { field, frame, title } = data.measured;
    const own = model.fields.find((each) => each.name === field);
    const words = [];
    if (state.field?.name !== field && own) words.push(`Only the ${own.title} was measured; the ${title || 'measured'} part is grey.`);
    if (state.frame !== frame && model.frames[frame]) words.push(`What was measured belongs to the frame “${model.frames[frame].label}”.`);
    return words.join(' ');
  }

  function set(changes) {
    Object.assign(state, changes);
    update();
  }
  function setField(name) {
    set({ field: model.fields.find((field) => field.name === name) ?? null });
  }
  function setFrame(frame) {
    set({ frame: Math.min(Math.max(Math.round(frame), 0), model.frames.length - 1) });
  }
  function setRange(next) {
    if (state.field) state.ranges.set(state.field.name, next);
    update();
  }
  function pickCell(cell) {
    set({ picked: cell >= 0 && cell < model.cell_count ? cell : -1 });
    return state.picked >= 0 ? describeCell(model, state.picked, state.frame) : null;
  }

  function lookFrom(name) {
    // a standing view has room for the flat blank too, so that it stays in the picture while time passes
    const points = name === 'fit' ? model.positions(state.frame) : joined([model.positions(0), model.positions(state.frame), model.positions(model.frames.length - 1)]);
    look(stage.camera, name === 'fit' ? null : name, points, aspect(), ball.centre);
    seen();
  }
  function seen() {
    stage.setDepth(ball);
    stage.ask();
  }

  // Client coordinates to a viewport and −1..1 in it.
  function placeIn(x, y) {
    const box = canvas_box.getBoundingClientRect();
    const [width, height] = stage.size();
    const viewport = Math.min(count - 1, Math.max(0, Math.floor((x - box.left) / width)));
    return { viewport, at: [(2 * (x - box.left - viewport * width)) / width - 1, 1 - (2 * (y - box.top)) / height] };
  }
  function clicked(x, y) {
    const { viewport, at } = placeIn(x, y);
    if (viewport !== 0) return;
    const { origin, direction } = rayThrough(stage.camera, ...at, aspect());
    pickCell(cellOnRay(model, model.positions(state.frame), part.shown(), origin, direction));
  }
  function pointOnScreen(point) {
    const at = seenAt(stage.camera, point, aspect());
    if (!at) return null;
    const box = canvas_box.getBoundingClientRect();
    const [width, height] = stage.size();
    return { x: box.left + ((at[0] + 1) / 2) * width, y: box.top + ((1 - at[1]) / 2) * height };
  }
  function placeRing() {
    const place = state.picked >= 0 ? pointOnScreen(part.centre(state.picked, state.frame)) : null;
    const box = picture.getBoundingClientRect();
    const inside = place && place.x >= box.left && place.x <= box.left + stage.size()[0] && place.y >= box.top && place.y <= box.bottom;
    ring.hidden = !inside;
    if (inside) ring.style.transform = `translate(${place.x - box.left}px, ${place.y - box.top}px)`;
  }
  stage.drawn.push(placeRing, () => triad.draw(stage.camera));

  function start() {
    new ResizeObserver(() => {
      stage.resize();
      seen();
    }).observe(canvas_box);
    stage.resize();
    watch(canvas_box, stage.camera, { changed: seen, clicked });
    update();
    lookFrom(isFlat(model.positions(state.frame)) ? 'top' : 'slant');
    stage.render();
    window.addEventListener('beforeprint', () => (still.src = stage.picture()));
  }

  const { camera } = stage;
  const handle = {
    webgl: true,
    frame: () => state.frame,
    frames: () => model.frames.map(({ label }) => label),
    setFrame,
    field: () => state.field?.name ?? null,
    fields: () => model.fields.map(({ name }) => name),
    setField,
    range,
    setRange,
    set,
    pickCell,
    picked: () => (state.picked >= 0 ? describeCell(model, state.picked, state.frame) : null),
    cellOf: model.cellOf,
    cellCount: () => model.cell_count,
    cell: (cell) => describeCell(model, cell, state.frame),
    cellOnScreen: (cell) => pointOnScreen(part.centre(cell, state.frame)),
    look: lookFrom,
    camera: () => ({ position: camera.getPosition(), focal_point: camera.getFocalPoint(), view_up: camera.getViewUp() }),
    picture: () => stage.picture(),
  };
  return { start, handle };
}
