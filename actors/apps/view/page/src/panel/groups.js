// Light sources and their dimming: a switch and a slider for each group.
import { button, el, middle, section } from './dom.js';

const titles = { luminaire: 'Luminaires', sign: 'Signs', flame: 'Flames' };
const most = 2;
const percent = (factor) => `${Math.round(100 * factor)} %`;

class Row {
  constructor({ name, factor }, index, dim) {
    this.name = name;
    this.last = factor || 1;
    this.dim = dim;
    const set = (f) => this.set(f);
    this.toggle = el('input', {
      type: 'checkbox', role: 'switch', aria: { label: `${name} on` },
      on: { change: () => set(this.toggle.checked ? this.last : 0) },
    });
    this.slider = el('input', {
      type: 'range', min: 0, max: most, step: 0.01, id: `group-${index}`,
      on: { input: () => set(Number(this.slider.value)) },
    });
    this.value = el('output');
    const label = el('label', { htmlFor: `group-${index}` }, middle(name));
    this.element = el('li', { data: { name } }, this.toggle, label, this.slider, this.value);
    this.show(factor);
  }

  set(factor) {
    this.show(factor);
    this.dim(this.name, factor);
  }

  show(factor) {
    if (factor > 0) this.last = factor;
    this.toggle.checked = factor > 0;
    this.slider.value = factor;
    this.value.textContent = percent(factor);
  }
}

export class Groups {
  constructor({ dim }) {
    this.dim = dim;
    this.rows = new Map();
    this.search = el('input', {
      type: 'search', placeholder: 'Find a light', aria: { label: 'Find a light' },
      on: { input: () => this.filter() },
    });
    this.lists = el('fieldset');
    this.element = section('Lights', this.search, this.lists);
  }

  scene({ groups }) {
    const same = groups.length === this.rows.size && groups.every((g) => this.rows.has(g.name));
    if (same) this.factors(groups);
    else this.build(groups);
  }

  build(groups) {
    this.rows.clear();
    const parts = Object.entries(titles).map(([kind, title]) => {
      const members = groups.filter((g) => g.kind === kind);
      return members.length ? this.part(title, members) : null;
    });
    this.lists.replaceChildren(...parts.filter(Boolean));
    this.filter();
  }

  part(title, members) {
    const rows = members.map((g) => {
      const row = new Row(g, this.rows.size, this.dim);
      this.rows.set(g.name, row);
      return row;
    });
    const all = (factor) => () => rows.forEach((row) => row.element.hidden || row.set(factor));
    const summary = el('summary', {}, `${title} `,
      el('small', { textContent: String(rows.length) }));
    const both = el('div', { className: 'both' },
      button('all on', all(1)), button('all off', all(0)));
    const list = el('ul', {}, ...rows.map((row) => row.element));
    return el('details', { open: true }, summary, both, list);
  }

  factors(changes) {
    for (const { name, factor } of changes) this.rows.get(name)?.show(factor);
  }

  filter() {
    const sought = this.search.value.trim().toLowerCase();
    for (const { element, name } of this.rows.values())
      element.hidden = !name.toLowerCase().includes(sought);
  }

  edits(editor) {
    this.lists.disabled = !editor;
  }
}
