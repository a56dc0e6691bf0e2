// Where it comes from: the scene and card as they were, versions and digests.
import { h, section } from './elements.js';

export function makeBackground(texts, facts) {
  return section(
    'background',
    'Where it comes from',
    facts.length > 0 && h('table', { class: 'facts' }, h('tbody', {}, facts.map(([name, value]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, value))))),
    texts.map(({ title, text }) => h('details', {}, h('summary', {}, title), h('pre', {}, text))),
  );
}
