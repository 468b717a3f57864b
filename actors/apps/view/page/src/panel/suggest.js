// Suggests places for further luminaires: asks the program, shows its answer as marks and text, and
// adds the suggestions.
import { button, el, section } from './dom.js';

const percent = (share) => `${(100 * share).toFixed(1)} %`;

export class Suggest {
  /** `say` sends a message, `show` draws an answer or, given null, removes it. */
  constructor({ say, show }) {
    Object.assign(this, { say, show });
    this.answer = null;
    this.free = el('input', { type: 'checkbox' });
    this.ask = button('Suggest luminaires', () => this.asks());
    this.take = button('Add them', () => this.takes(), { hidden: true });
    this.clear = button('Clear', () => this.suggested(null), { hidden: true });
    this.words = el('p', { className: 'note', role: 'status' });
    this.element = section('Suggest', el('label', {}, this.free, ' instead of those added here'),
      el('div', { className: 'both' }, this.ask, this.take, this.clear), this.words);
  }

  scene(scene) {
    this.added = scene.luminaires.filter((l) => l.added).map((l) => l.name);
  }

  asks() {
    this.suggested(null);
    this.words.textContent = 'Looking for places …';
    this.say({ type: 'suggest', free: this.free.checked ? this.added : [] }, 'suggest');
  }

  /** An answer of the program; null: it is no longer valid. */
  suggested(answer) {
    this.answer = answer;
    const some = answer !== null && answer.luminaires.length > 0;
    this.take.hidden = !some;
    this.clear.hidden = answer === null;
    this.words.textContent = answer === null ? '' : `${answer.words}. ` +
      (answer.missing > 0
        ? `Now ${percent(answer.missing)} of what is asked for is missing; the worst place has ` +
          `${percent(answer.least)}. Red marks help most. Save and assess a variant to be sure.`
        : '');
    this.show(answer);
  }

  takes() {
    const { luminaires, insteadOf } = this.answer;
    this.suggested(null);
    for (const name of insteadOf) this.say({ type: 'remove', name });
    for (const { of, position, facing } of luminaires)
      this.say({ type: 'add', kind: 'luminaire', of, position, facing });
  }

  refused() {
    if (this.answer === null) this.words.textContent = '';
  }

  edits(editor) {
    this.take.disabled = !editor;
  }
}
