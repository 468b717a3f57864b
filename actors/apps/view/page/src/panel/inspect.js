// Details of what was clicked: the light on a surface, a sign's verdicts, a luminaire's place; and
// handles to move it.
import { words, wordsWithError } from '../light/colours.js';
import { button, el, section } from './dom.js';

const arrows = [['←', 'left', 'Left'], ['→', 'right', 'Right'], ['↑', 'up', 'Up'],
  ['↓', 'down', 'Down'], ['⇤', 'back', 'Towards the wall'], ['⇥', 'ahead', 'Off the wall']];

const tones = [[/^legible/, 'good'], [/^visible/, 'fair'], [/^(invisible|hidden)/, 'bad']];
const toneOf = (verdict) => tones.find(([pattern]) => pattern.test(verdict))?.[1] ?? 'open';

const figures = (pairs) => el('dl', {}, ...pairs.flatMap(([term, value]) =>
  [el('dt', { textContent: term }), el('dd', { textContent: value })]));

const placeWords = (p) => `${p.map((x) => x.toFixed(2)).join(', ')} m`;

export class Inspect {
  constructor({ nudge, copy, remove, close }) {
    this.nudge = nudge;
    this.copy = copy;
    this.remove = remove;
    this.close = close;
    this.body = el('div', { aria: { live: 'polite' } });
    this.element = section('Selection', this.body);
    this.clear();
  }

  clear() {
    this.subject = null;
    this.body.replaceChildren(el('p', { className: 'note', textContent:
      'Click a surface for its light, a sign for its verdicts, a luminaire to move it.' }));
  }

  /** A surface: first what the picture knows, then the program's answer. */
  surface({ id, point, seen }) {
    this.subject = { kind: 'surface', id };
    this.seen = ['Arrives at the eye', `${words(seen)} cd/m²`];
    this.at = ['Place', placeWords(point)];
    this.put('Surface', figures([this.seen, this.at]),
      el('p', { className: 'note', textContent: 'Asking the program …' }));
  }

  probe(answer) {
    if (this.subject?.id !== answer.id) return;
    const lux = `${wordsWithError(answer.illuminance, answer.illuminanceError)} lx`;
    const nits = `${wordsWithError(answer.luminance, answer.luminanceError)} cd/m²`;
    const rows = [['Illuminance', lux], ['Luminance', nits], this.seen, this.at];
    if (answer.direct !== null) rows.splice(1, 0, ['of it direct', `${words(answer.direct)} lx`]);
    this.put(answer.surface || 'Surface', figures(rows),
      el('p', { className: 'note', textContent: '± is one standard error of the particles.' }));
  }

  sign(sign) {
    this.subject = { kind: 'sign', name: sign.name };
    this.verdicts = el('div', {},
      el('p', { className: 'note', textContent: 'Asking for verdicts …' }));
    this.place = el('p', { className: 'note', textContent: placeWords(sign.position) });
    this.put(sign.name, this.handles(sign), this.place, this.verdicts);
  }

  judged({ name, rows, note }) {
    if (this.subject?.kind !== 'sign' || this.subject.name !== name) return;
    const head = el('tr', {}, ...['From', 'Distance', 'Verdict'].map((t) =>
      el('th', { textContent: t, scope: 'col' })));
    const body = rows.map((row) => el('tr', {},
      el('td', { textContent: row.from }),
      el('td', { textContent: `${row.distance.toFixed(1)} m` }),
      el('td', { className: toneOf(row.verdict) },
        el('b', { textContent: row.verdict }), el('small', { textContent: row.reason }))));
    const table = el('table', {}, el('thead', {}, head), el('tbody', {}, ...body));
    this.verdicts.replaceChildren(el('p', { className: 'note', textContent: note }),
      rows.length ? table
        : el('p', { className: 'note', textContent: 'No observers: nothing to judge from.' }));
  }

  luminaire(luminaire) {
    this.subject = { kind: 'luminaire', name: luminaire.name };
    this.place = el('p', { className: 'note', textContent: placeWords(luminaire.position) });
    this.put(luminaire.name, this.handles(luminaire), this.place);
  }

  /** Things of the scene file stay; those added here may be removed. */
  handles({ added }) {
    const step = el('select', { aria: { label: 'Step' } });
    for (const metres of [0.05, 0.25, 1]) step.append(new Option(`${metres} m`, metres));
    step.value = 0.25;
    const keys = arrows.map(([label, way, title]) =>
      button(label, () => this.nudge(way, Number(step.value)), { title, aria: { label: title } }));
    const more = el('div', { className: 'both' }, button('Add a copy', this.copy),
      added ? button('Remove', this.remove) : null);
    this.moveControls = el('fieldset', { className: 'handles', disabled: !this.editor },
      el('legend', { textContent: 'Move' }), ...keys, step, more);
    return this.moveControls;
  }

  moved(position) {
    if (this.place) this.place.textContent = placeWords(position);
  }

  put(title, ...children) {
    const bar = el('header', {}, el('h3', { textContent: title }),
      button('×', this.close, { aria: { label: 'End the selection' } }));
    this.body.replaceChildren(bar, ...children);
  }

  edits(editor) {
    this.editor = editor;
    if (this.moveControls) this.moveControls.disabled = !editor;
  }
}
