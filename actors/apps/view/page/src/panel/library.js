// What can be added: kinds of luminaires and signs, with a search, and a preview of their curves
// and faces.
import { words } from '../light/colours.js';
import { button, el, middle, section } from './dom.js';

const size_px = 54;
const shownMost = 40;

/** Texts by which a kind is found. */
const soughtIn = ({ kind, of, product, maker, file, text }) =>
  [kind, of, product, maker, file, text].filter(Boolean).join(' ').toLowerCase();

/** What a kind is, in a line. */
export function figuresOf(kind) {
  if (kind.kind === 'sign')
    return `${words(kind.width, 2)} × ${words(kind.height, 2)} m`;
  const of = (value, when) => (value > 0 ? `${words(value)} ${kind.unit} ${when}` : null);
  return [of(kind.mains, 'on mains'), of(kind.emergency, 'in emergency')].filter(Boolean)
    .join(', ') || 'dark';
}

/** Points of a polar curve in a square from -1 to 1, straight down downwards. */
export function polarPoints(curve, step, peak) {
  return curve.map((cd, i) => {
    const gamma = ((i * step - 180) * Math.PI) / 180;
    const r = peak > 0 ? cd / peak : 0;
    return [r * Math.sin(gamma), r * Math.cos(gamma)];
  });
}

const svg = (tag, attributes, ...children) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

/** C0-C180 as a line, C90-C270 dashed, over the luminaire's downward axis. */
function curvePicture({ curves }, step) {
  const peak = Math.max(...curves.flat());
  const lines = curves.map((curve, plane) => svg('polyline', {
    points: polarPoints(curve, step, peak).map((p) => p.map((x) => x.toFixed(3)).join(','))
      .join(' '),
    class: plane ? 'across' : 'along',
  }));
  const title = svg('title', {}, `C0-C180 (line), C90-C270 (dashed); peak ${words(peak)} cd/klm`);
  return svg('svg', { viewBox: '-1.05 -1.05 2.1 2.1', width: size_px, height: size_px,
    class: 'curve', role: 'img' }, title, svg('circle', { r: 1 }), svg('circle', { r: 0.5 }),
  svg('path', { d: 'M-1 0H1M0 -1V1' }), ...lines);
}

function facePicture({ face: { columns, rows, texels }, colours }) {
  const canvas = el('canvas', { width: columns, height: rows, className: 'face' });
  const image = new ImageData(columns, rows);
  texels.forEach((texel, i) =>
    image.data.set([...(colours[texel] ?? [128, 128, 128]), 255], 4 * i));
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

export class Library {
  /** `add(kind)` adds one where the viewer looks. */
  constructor({ add }) {
    this.add = add;
    this.kinds = [];
    this.search = el('input', { type: 'search', placeholder: 'Find a luminaire or sign',
      aria: { label: 'Find a luminaire or sign to add' }, on: { input: () => this.list() } });
    this.items = el('ul', { className: 'library' });
    this.element = section('Add', this.search, this.items);
    this.element.hidden = true;
  }

  set({ step, kinds }) {
    Object.assign(this, { step, kinds });
    this.element.hidden = kinds.length === 0;
    this.list();
  }

  list() {
    const sought = this.search.value.trim().toLowerCase().split(/\s+/);
    const found = this.kinds.filter((kind) => sought.every((w) => soughtIn(kind).includes(w)));
    const rest = found.length - shownMost;
    this.items.replaceChildren(...found.slice(0, shownMost).map((kind) => this.item(kind)),
      ...(rest > 0 ? [el('li', { textContent: `and ${rest} more: search for them` })] : []),
      ...(found.length ? [] : [el('li', { textContent: 'Nothing is called so.' })]));
    this.edits(this.editor);
  }

  item(kind) {
    const picture = kind.kind === 'sign' ? facePicture(kind)
      : kind.curves ? curvePicture(kind, this.step) : el('span', { className: 'curve' });
    const from = kind.product || kind.text || kind.file.split('/').pop();
    const lines = [[kind.maker, from].filter(Boolean).join(' '), figuresOf(kind)].filter(Boolean)
      .map((textContent) => el('small', { textContent }));
    return el('li', {}, picture, el('div', {}, middle(kind.of), ...lines),
      button('Add', () => this.add(kind), { aria: { label: `Add ${kind.of}` } }));
  }

  edits(editor) {
    this.editor = editor;
    for (const b of this.items.querySelectorAll('button')) b.disabled = !editor;
  }
}
