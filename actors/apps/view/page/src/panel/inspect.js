// Details of what was clicked: the light on a surface, a sign's verdicts, a luminaire's place; and
// handles to move it.
import { words, wordsWithError } from '../light/colours.js';
import { button, el, section } from './dom.js';

/** Ways of the mover: signs slide along their wall, luminaires move as the view looks. */
const arrows = {
  sign: [['←', 'left', 'Left'], ['→', 'right', 'Right'], ['↑', 'up', 'Up'], ['↓', 'down', 'Down'],
    ['⇤', 'back', 'Towards the wall'], ['⇥', 'ahead', 'Off the wall']],
  luminaire: [['←', 'left', 'Left'], ['→', 'right', 'Right'], ['↑', 'up', 'Farther away'],
    ['↓', 'down', 'Nearer'], ['⤒', 'back', 'Up'], ['⤓', 'ahead', 'Down']],
};

const tones = [[/^legible/, 'good'], [/^visible/, 'fair'], [/^(invisible|hidden)/, 'bad']];
const toneOf = (verdict) => tones.find(([pattern]) => pattern.test(verdict))?.[1] ?? 'open';

const figures = (pairs) => el('dl', {}, ...pairs.flatMap(([term, value]) =>
  [el('dt', { textContent: term }), el('dd', { textContent: value })]));

const placeWords = (p) => `${p.map((x) => x.toFixed(2)).join(', ')} m`;

/** Where on the way, and at which height, the eye is; observers say it by their place. */
function standingOf({ along, eyeHeight }) {
  const parts = [along > 0 && `${along.toFixed(1)} m along`,
    eyeHeight !== null && `eye at ${eyeHeight.toFixed(2)} m`].filter(Boolean);
  return parts.length ? el('small', { textContent: parts.join(', ') }) : null;
}

export class Inspect {
  constructor({ nudge, place, snap, copy, remove, close }) {
    Object.assign(this, { moveTo: place, snap });
    this.snaps = true;
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

  /**
   * A surface: first what the picture knows, then the program's answer. `seen`: its luminance, null
   * if the picture shows something else.
   */
  surface({ id, point, seen }) {
    this.subject = { kind: 'surface', id };
    this.seen = ['Arrives at the eye', seen === null ? '–' : `${words(seen)} cd/m²`];
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
    if (this.holds('sign', sign)) return this.verdicts.setAttribute('aria-busy', 'true');
    this.verdicts = el('div', { className: 'verdicts' },
      el('p', { className: 'note', textContent: 'Asking for verdicts …' }));
    this.put(sign.name, this.handles(sign), this.verdicts);
  }

  /** Takes another subject, or the present one at another place: then its handles stay in use. */
  holds(kind, { name, position }) {
    const same = this.subject?.kind === kind && this.subject.name === name;
    this.subject = { kind, name };
    if (same) this.moved(position);
    return same;
  }

  judged({ id, name, rows, note, provisional }) {
    if (id !== this.asked || this.subject?.kind !== 'sign' || this.subject.name !== name) return;
    this.verdicts.removeAttribute('aria-busy');
    const head = el('tr', {}, ...['From', 'Distance', 'Verdict'].map((t) =>
      el('th', { textContent: t, scope: 'col' })));
    const body = rows.map((row) => el('tr', {},
      el('td', { textContent: row.from }, standingOf(row)),
      el('td', { textContent: `${row.distance.toFixed(1)} m` }),
      el('td', { className: toneOf(row.verdict) },
        el('b', { textContent: row.verdict }), el('small', { textContent: row.reason }))));
    const table = el('table', {}, el('thead', {}, head), el('tbody', {}, ...body));
    const state = provisional ? `Provisional, while more paths are traced. ${note}` : note;
    this.verdicts.replaceChildren(el('p', { className: 'note', textContent: state }),
      rows.length ? table
        : el('p', { className: 'note', textContent: 'No observers: nothing to judge from.' }));
  }

  /** The sign is not judged. */
  refused(name, why) {
    if (this.subject?.kind !== 'sign' || this.subject.name !== name) return;
    this.verdicts.removeAttribute('aria-busy');
    this.verdicts.replaceChildren(
      el('p', { className: 'note', textContent: `Nothing is judged: ${why}` }));
  }

  luminaire(luminaire) {
    if (this.holds('luminaire', luminaire)) return;
    this.put(luminaire.name, this.handles(luminaire));
  }

  /** Things of the scene file stay; those added here may be removed. */
  handles({ added, position }) {
    const step = el('select', { aria: { label: 'Step' } });
    for (const metres of [0.05, 0.25, 1]) step.append(new Option(`${metres} m`, metres));
    step.value = 0.25;
    const keys = arrows[this.subject.kind].map(([label, way, title]) =>
      button(label, () => this.nudge(way, Number(step.value)), { title, aria: { label: title } }));
    const more = el('div', { className: 'both' }, button('Add a copy', this.copy),
      added ? button('Remove', this.remove) : null);
    this.moveControls = el('fieldset', { className: 'handles', disabled: !this.editor },
      el('legend', { textContent: 'Move' }), ...keys, step, this.makePlace(), more);
    this.moved(position);
    return this.moveControls;
  }

  /** Coordinates to read and to type, and whether drags come to rest in line with others. */
  makePlace() {
    this.coordinates = ['x', 'y', 'z'].map((axis, k) => el('input', {
      type: 'number', step: 0.05, title: `${axis} [m]`, aria: { label: `${axis} in metres` },
      on: { change: ({ target }) => this.moveTo(k, target.valueAsNumber) },
    }));
    const snap = el('input', {
      type: 'checkbox', checked: this.snaps,
      on: { change: () => this.snap(this.snaps = snap.checked) },
    });
    const box = el('label', { className: 'check',
      title: 'A drag comes to rest in line with other things, else on a grid of 5 cm' },
    snap, ' snap');
    return el('div', { className: 'place' }, ...this.coordinates, box);
  }

  moved(position) {
    this.coordinates?.forEach((input, k) => {
      if (input !== document.activeElement) input.value = position[k].toFixed(3);
    });
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
