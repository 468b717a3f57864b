// The state of the building: scenario, density of smoke; and saving it to a file.
import { words } from '../light/colours.js';
import { button, choice, el, section } from './dom.js';

const none = -2.1;
const most = 2;

const densityOf = (place) => (place <= none + 0.05 ? 0 : 10 ** place);
const placeOf = (density) => (density <= 0 ? none : Math.log10(density));
const wordsFor = (density) => (density === 0 ? 'none' : `× ${words(density, 2)}`);

/** A name with line breaks allowed after its underscores. */
const breakable = (name) => el('span', {},
  ...name.split(/(?<=_)/).flatMap((part, i) => (i > 0 ? [el('wbr'), part] : [part])));

/** The times by which EN 1838 requires light: half of it by 5 s, all of it by 60 s. */
const times = [[0, '0 s'], [5, '5 s'], [60, '60 s'], [null, 'full']];

export class StatePanel {
  constructor({ say }) {
    this.say = say;
    this.scenarios = el('div', { className: 'scenarios' });
    this.value = el('output', { textContent: '–' });
    this.slider = el('input', {
      type: 'range', id: 'smoke', min: none, max: most, step: 0.05, value: 0,
      on: {
        input: () => (this.value.textContent = wordsFor(this.density)),
        change: () => say({ type: 'smoke', factor: this.density }, 'smoke'),
      },
    });
    const smoke = el('div', { className: 'line' },
      el('label', { htmlFor: 'smoke', textContent: 'Smoke' }), this.slider, this.value);
    this.controls = el('fieldset', {}, this.scenarios, smoke, this.makeTime());
    this.element = section('Scenario', this.controls);
    this.saveControls = this.makeSave();
    this.saveElement = section('Keep', this.saveControls);
  }

  get density() {
    return Number(densityOf(Number(this.slider.value)).toPrecision(3));
  }

  /** Time since the mains failure, which determines onsets and decays. */
  makeTime() {
    const ask = (seconds) => this.say({ type: 'time', seconds }, 'time');
    this.times = choice('Seconds after the mains have failed', times, ask);
    this.seconds = el('input', {
      type: 'number', id: 'seconds', min: 0, max: 1e6, step: 'any', placeholder: 's',
      on: { change: () => this.seconds.reportValidity() && this.seconds.value !== '' &&
        ask(Number(this.seconds.value)) },
    });
    this.timeControls = el('fieldset', { hidden: true },
      el('label', { htmlFor: 'seconds', textContent: 'After the mains have failed' }),
      el('div', { className: 'line' }, this.times.element, this.seconds));
    return this.timeControls;
  }

  time(seconds) {
    this.times.press(seconds);
    this.seconds.value = seconds ?? '';
  }

  makeSave() {
    const name = el('input', {
      type: 'text', maxLength: 80, placeholder: 'variant', aria: { label: 'Name of the variant' },
    });
    const save = (event) => {
      event.preventDefault();
      this.say({ type: 'save', name: name.value.trim() || 'variant' });
    };
    const submit = el('button', { textContent: 'Save as' });
    return el('fieldset', {},
      el('form', { className: 'line', on: { submit: save } }, name, submit));
  }

  scene({ scenarios, scenario, smoke, seconds }) {
    const now = scenarios.find(({ name }) => name === scenario);
    this.timeControls.hidden = !now || now.operation === 'mains';
    this.time(seconds);
    const buttons = scenarios.map(({ name, operation }) => {
      const chosen = () => this.say({ type: 'scenario', name }, 'scenario');
      const b = button('', chosen, { aria: { pressed: String(name === scenario) } });
      b.append(breakable(name), el('small', { textContent: operation }));
      return b;
    });
    this.scenarios.replaceChildren(...buttons);
    this.slider.value = placeOf(smoke);
    this.value.textContent = wordsFor(smoke);
  }

  edits(editor) {
    this.controls.disabled = this.saveControls.disabled = !editor;
  }
}
