// The clock of a scene that changes: a time to choose, and playing. People move with it at once;
// the light of its states is traced, and follows as fast as that goes.
import { spanOf, stateAt, stepsIn } from '../walk/clock_time.js';
import { button, el, section } from './dom.js';

const speeds = [0.5, 1, 2, 5, 10, 30];
/** Step of the slider where people walk [s]. */
const peopleStep_s = 0.1;
const secondsWords = (seconds) => `${Number(seconds.toFixed(1))} s`;

export class Clock {
  /** `say` sends a message; `placed(time)` puts people there and returns how many there are. */
  constructor({ say, placed }) {
    Object.assign(this, { say, placed });
    this.states = null;
    this.presence = null;
    this.time = null;
    this.light = null;
    this.playing = false;
    this.editor = false;
    /** The state that was asked for and is not announced yet. */
    this.asked = null;
    this.value = el('output', { textContent: '–' });
    this.slider = el('input', {
      type: 'range', id: 'clock', min: 0, max: 1, step: 1, value: 0,
      on: {
        input: () => this.go(Math.min(this.span.to, Number(this.slider.value))),
        change: () => this.askState(true),
      },
    });
    this.play = button('Play', () => this.toggle(), { aria: { pressed: 'false' }, id: 'play' });
    this.speed = el('select', { aria: { label: 'Speed of the clock' } },
      ...speeds.map((speed) => new Option(`× ${speed}`, speed, speed === 1, speed === 1)));
    this.words = el('p', { className: 'note' });
    this.failure = button('', () => this.jumpTo(this.states.mainsFailAt), { hidden: true,
      title: 'Go to the failure of the mains' });
    this.ticks = el('datalist', { id: 'clock-ticks' });
    this.slider.setAttribute('list', this.ticks.id);
    this.controls = el('fieldset', {},
      el('div', { className: 'line' },
        el('label', { htmlFor: 'clock', textContent: 'Time' }), this.slider, this.value),
      this.ticks, el('div', { className: 'line' }, this.play, this.speed, this.failure));
    this.element = section('Clock', this.controls, this.words);
    this.element.hidden = true;
  }

  /** The times of people who walk, or null. */
  people(presence) {
    this.presence = presence;
    this.lay();
    this.edits(this.editor);
  }

  scene({ states }) {
    this.states = states;
    const light = states?.at ?? null;
    const arrived = this.asked !== null && this.asked === light;
    if (arrived) this.asked = null;
    // Somebody else has chosen another time.
    else if (this.asked === null && !this.playing && light !== this.light) this.time = null;
    this.light = light;
    this.lay();
    if (arrived) this.askState();
  }

  lay() {
    this.span = spanOf(this.states, this.presence);
    this.element.hidden = !this.span;
    if (!this.span) return;
    const { from, to } = this.span;
    const step = this.presence ? peopleStep_s : this.states.step;
    // A slider reaches whole steps only: its last one may lie beyond the end.
    Object.assign(this.slider, { min: from, max: from + step * stepsIn(to - from, step), step });
    this.layTicks(from, to);
    this.go(this.time ?? this.light ?? from);
  }

  /** The failure of the mains as a tick of the slider, and as a button that leads there. */
  layTicks(from, to) {
    const at = this.states?.mainsFailAt ?? null;
    const within = at !== null && at >= from && at <= to;
    this.failure.hidden = !within;
    this.ticks.replaceChildren(...(within ? [new Option('mains fail', at)] : []));
    if (within) this.failure.textContent = `Mains fail ${secondsWords(at)}`;
  }

  jumpTo(time) {
    this.go(Math.min(this.span.to, Math.max(this.span.from, time)));
    this.askState(true);
  }

  go(time) {
    this.time = time;
    this.slider.value = time;
    this.value.textContent = secondsWords(time);
    const many = this.presence ? this.placed(time) : null;
    this.words.textContent = [
      many === null ? null : `${many} ${many === 1 ? 'person' : 'people'}`,
      `light and smoke ${this.light === null ? 'stay' : `of ${secondsWords(this.light)}`}`,
    ].filter(Boolean).join(' · ');
  }

  /**
   * Has the light of the state nearest to this time traced, unless it is shown or awaited. While
   * other light is awaited, only `urgent` requests are sent.
   */
  askState(urgent = false) {
    if (!this.states || !this.editor || (this.asked !== null && !urgent)) return;
    const at = stateAt(this.states, this.time);
    if (at === (this.asked ?? this.light)) return;
    this.asked = at;
    this.say({ type: 'state', at }, 'state');
  }

  /** Whether people move. */
  get moving() {
    return this.playing && this.presence !== null;
  }

  toggle() {
    if (this.time === null || this.controls.disabled) return;
    this.playing = !this.playing;
    if (this.playing && this.time >= this.span.to) this.go(this.span.from);
    this.showPlaying();
  }

  showPlaying() {
    this.play.textContent = this.playing ? 'Pause' : 'Play';
    this.play.setAttribute('aria-pressed', String(this.playing));
  }

  /** Goes on by this many seconds of the viewer's. */
  tick(elapsed) {
    if (!this.playing) return;
    this.go(Math.min(this.span.to, this.time + elapsed * Number(this.speed.value)));
    this.askState();
    if (this.time < this.span.to) return;
    this.playing = false;
    this.showPlaying();
  }

  /** What was asked for does not come: it was refused, or the connection was lost. */
  forget() {
    this.asked = null;
    this.playing = false;
    this.showPlaying();
    if (this.states && !this.presence) this.time = null;
    this.lay();
  }

  /** Without people, the clock changes nothing but the building, which only the editor may. */
  edits(editor) {
    this.editor = editor;
    this.controls.disabled = !editor && !this.presence;
  }
}
