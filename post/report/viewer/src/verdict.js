// The first thing to read: what came out, in words and numbers.
import { h, section } from './elements.js';

/** `show(cell)` leads to a cell of the part, or is null where there is none. */
export function makeVerdict({ headline, rows = [], warnings = [], trust = [] }, show) {
  return section(
    'verdict',
    'Verdict',
    headline && h('p', { class: 'headline' }, headline),
    rows.length > 0 &&
      h('dl', { class: 'numbers' }, rows.map(({ name, value, note, cell }) =>
        h('div', { class: 'number' },
          h('dt', {}, name),
          h('dd', { class: 'value' }, value),
          note && h('dd', { class: 'of' }, note),
          show && Number.isInteger(cell) && h('dd', { class: 'of no-print' }, h('button', { type: 'button', onclick: () => show(cell) }, 'show it'))))),
    warnings.length > 0 && h('div', { class: 'warnings' }, h('h3', {}, warnings.length === 1 ? 'A warning of the run' : 'Warnings of the run'), h('ul', {}, warnings.map((text) => h('li', {}, text)))),
    trust.length > 0 && h('div', { class: 'trust' }, h('h3', {}, 'What to trust it for'), h('ul', {}, trust.map((text) => h('li', {}, text)))),
  );
}
