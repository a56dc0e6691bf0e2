// The switches over the picture and the time slider under it. Each changes the state and says so.
import { h } from '../elements.js';
import { titleWithUnit } from '../words.js';
import { css } from '../colour_maps.js';
import { yarnColours } from './drawn_part.js';
import { view_names } from './camera.js';

// A checkbox; `isOn` tells its state, which update() of all checkboxes asks again.
function check(boxes, label, isOn, changed, swatch = null) {
  const box = h('input', { type: 'checkbox', onchange: (event) => changed(event.target.checked) });
  boxes.push(() => (box.checked = isOn()));
  return h('label', { class: 'check' }, box, swatch, label);
}

const group = (title, ...children) => h('div', { class: 'group', role: 'group', 'aria-label': title }, h('span', { class: 'group-title' }, title), ...children);

/** The row of switches. `actions`: setField(name), set({...}). */
export function makeControls({ model, tool_names, state }, actions) {
  const fields = h(
    'select',
    { 'aria-label': 'field shown in colours', id: 'field', onchange: (event) => actions.setField(event.target.value) },
    model.fields.map((field) => h('option', { value: field.name }, titleWithUnit(field))),
    h('option', { value: '' }, 'no field, plain fabric'),
  );
  const lines = h('select', { 'aria-label': 'isolines', onchange: (event) => actions.set({ isolines: event.target.value }) });

  function offerLines(field) {
    const offers = [['0', 'none']];
    if (field && field.scale !== 'categories') {
      if (field.limit !== null && field.limit !== undefined) offers.push(['limit', 'at the limit']);
      for (const count of [5, 10, 20]) offers.push([String(count), `${count} lines`]);
    }
    if (!offers.some(([value]) => value === state.isolines)) state.isolines = '0';
    lines.replaceChildren(...offers.map(([value, text]) => h('option', { value, selected: value === state.isolines }, text)));
  }

  const boxes = [];
  const swatches = { warp: h('span', { class: 'swatch line' }), weft: h('span', { class: 'swatch line' }) };
  const toggle = (key, label) => check(boxes, label, () => state[key], (on) => actions.set({ [key]: on }), swatches[key]);
  const withMember = (set, member, on) => {
    const next = new Set(set);
    on ? next.add(member) : next.delete(member);
    return next;
  };
  const has_yarns = model.yarns.warp.length + model.yarns.weft.length > 0;
  const element = h(
    'div',
    { class: 'controls no-print' },
    group('Colours', fields),
    group('Isolines', lines),
    group(
      'Lines',
      has_yarns && toggle('warp', 'warp'),
      has_yarns && toggle('weft', 'weft'),
      toggle('edges', 'cell edges'),
    ),
    tool_names.length > 0 &&
      group('Tools', tool_names.map((name) => check(boxes, name, () => state.tools.has(name), (on) => actions.set({ tools: withMember(state.tools, name, on) })))),
    model.plies.length > 1 &&
      group('Plies', model.plies.map((ply) => check(boxes, model.plyName(ply), () => !state.hidden_plies.has(ply), (on) => actions.set({ hidden_plies: withMember(state.hidden_plies, ply, !on) })))),
  );
  return {
    element,
    update() {
      fields.value = state.field?.name ?? '';
      boxes.forEach((ask) => ask());
      offerLines(state.field);
      for (const [name, colour] of Object.entries(yarnColours(state.field))) swatches[name].style.background = css(colour);
    },
  };
}

/** The buttons of the standing views. */
export function makeViewButtons(look) {
  const what = (name) => (name === 'fit' ? 'The whole part, from where it is seen now' : `The whole part, ${name} view`);
  return h('div', { class: 'views no-print', role: 'group', 'aria-label': 'View' }, [...view_names, 'fit'].map((name) => h('button', { type: 'button', title: what(name), onclick: () => look(name) }, name)));
}

/** Slider, play button and the frame's label. */
export function makeTimeline({ frames, state }, setFrame) {
  const slider = h('input', { type: 'range', id: 'time', min: 0, max: frames.length - 1, step: 1, 'aria-label': 'time', oninput: (event) => setFrame(Number(event.target.value)) });
  const label = h('output', { for: 'time', class: 'frame-label', 'aria-live': 'polite' });
  const play = h('button', { type: 'button', class: 'play no-print', onclick: () => (timer ? stop() : start()) }, 'play');
  let timer = null;

  function stop() {
    clearInterval(timer);
    timer = null;
    play.textContent = 'play';
  }
  // Long results pass in some eight seconds, short ones at four frames a second.
  function start() {
    if (state.frame === frames.length - 1) setFrame(0);
    play.textContent = 'pause';
    timer = setInterval(() => {
      if (state.frame >= frames.length - 1) stop();
      else setFrame(state.frame + 1);
    }, Math.min(250, Math.max(60, 8000 / frames.length)));
  }

  return {
    element: h('div', { class: 'timeline', hidden: frames.length < 2 }, play, slider, label),
    update() {
      slider.value = state.frame;
      slider.setAttribute('aria-valuetext', frames[state.frame].label);
      label.textContent = frames[state.frame].label;
    },
  };
}
