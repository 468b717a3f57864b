// How luminances become a picture, and the legend for it.
import { scaleHigh, scaleLow } from '../light/colour_map.js';
import { luxSteps, scaleColour, words } from '../light/colours.js';
import { isMap } from '../draw/exposure.js';
import { byId, choice, el, section } from './dom.js';

const explained = {
  camera: 'One exposure for the whole picture; highlights roll off.',
  eye: 'A simple dark-adapted eye: mesopic luminance (CIE 191, scotopic part estimated from ' +
    'colour), brightness by Ward 1994 on a 250 cd/m² screen. No glare veil, no loss of acuity.',
  luminance: 'False colours of luminance as it arrives at the eye.',
  illuminance: 'Illuminance of surfaces, without lamps, signs, people and smoke. Where colours ' +
    'meet, it has the value of the key.',
};
const modes = [['camera', 'Camera'], ['eye', 'Eye'], ['luminance', 'Luminance'],
  ['illuminance', 'Lux']];

export class Rendition {
  constructor(exposure, changed) {
    this.exposure = exposure;
    this.changed = changed;
    this.choice = choice('Rendition', modes, (mode) => this.set(mode));
    this.note = el('p', { className: 'note' });
    this.value = el('output');
    this.automatic = el('input', {
      type: 'checkbox', id: 'automatic', checked: true, on: { change: () => this.expose() },
    });
    this.slow = el('input', {
      type: 'checkbox', id: 'slow', checked: exposure.slow,
      on: { change: () => (exposure.slow = this.slow.checked) },
    });
    this.slider = el('input', {
      type: 'range', id: 'exposure', min: -3, max: 3.5, step: 0.02,
      on: { input: () => this.fix() },
    });
    this.exposureLine = el('div', { className: 'exposure' },
      el('div', { className: 'line' },
        el('label', { htmlFor: 'exposure', textContent: 'Exposure' }), this.slider, this.value),
      el('div', { className: 'checks' },
        el('label', { className: 'check' }, this.automatic, ' automatic'),
        el('label', { className: 'check', title: 'Brighter within seconds, darker within minutes' },
          this.slow, ' as slowly as eyes adapt')));
    this.extras = el('div', { className: 'checks' });
    this.element = section(
      'Picture', this.choice.element, this.note, this.exposureLine, this.extras);
    this.set(exposure.rendition);
  }

  /** Another check box. */
  check(label, checked, ticked, title = '') {
    const box = el('input', { type: 'checkbox', checked,
      on: { change: () => ticked(box.checked) } });
    this.extras.append(el('label', { className: 'check', title }, box, ` ${label}`));
    return box;
  }

  set(mode) {
    this.exposure.rendition = mode;
    this.choice.press(mode);
    this.note.textContent = explained[mode];
    this.exposureLine.hidden = isMap(mode);
    byId('legend').hidden = !isMap(mode);
    if (isMap(mode)) byId('legend').replaceChildren(...legends[mode]());
    this.show();
    this.changed(mode);
  }

  next() {
    const names = modes.map(([name]) => name);
    this.set(names[(names.indexOf(this.exposure.rendition) + 1) % names.length]);
  }

  expose() {
    this.exposure.automatic = this.automatic.checked;
    if (!this.exposure.automatic) this.exposure.fixed_cd_m2 = this.exposure.adapted ?? 10;
    this.show();
    this.changed();
  }

  fix() {
    this.automatic.checked = this.exposure.automatic = false;
    this.exposure.fixed_cd_m2 = 10 ** Number(this.slider.value);
    this.show();
    this.changed();
  }

  show() {
    this.value.textContent = `${words(this.exposure.level, 2)} cd/m²`;
    this.slider.value = Math.log10(this.exposure.level);
    this.slider.title = this.exposure.rendition === 'eye'
      ? 'Luminance to which the eye is adapted' : 'Luminance shown as mid grey';
  }
}

/** A bar of colours, each at `t` from 0 to 1 along the scale. */
function colourBar(places) {
  const bar = el('canvas', { width: places.length, height: 1, className: 'scale' });
  const context = bar.getContext('2d');
  places.forEach((t, i) => {
    context.fillStyle = `rgb(${scaleColour(t).join(' ')})`;
    context.fillRect(i, 0, 1, 1);
  });
  return bar;
}

const tickBar = (...labels) =>
  el('div', { className: 'ticks' }, ...labels.map((textContent) => el('span', { textContent })));

const legends = {
  luminance: () => {
    const decades = Math.round(Math.log10(scaleHigh / scaleLow));
    const labels = Array.from({ length: decades + 1 }, (_, d) => words(scaleLow * 10 ** d, 1));
    return [el('p', { textContent: 'Luminance [cd/m²]' }),
      colourBar(Array.from({ length: 256 }, (_, i) => i / 255)), tickBar(...labels)];
  },
  // A colour from each step to the next; steps of 2 have no room for their numbers.
  illuminance: () => {
    const bands = luxSteps.length + 1;
    const short = (step) => (step < 1000 ? words(step, 1) : `${step / 1000}k`);
    const labels = luxSteps.map((step) => (String(step).includes('2') ? '' : short(step)));
    return [el('p', { textContent: 'Illuminance [lx]' }),
      colourBar(Array.from({ length: bands }, (_, i) => (i + 0.5) / bands)),
      tickBar('', ...labels, '')];
  },
};
