// The checks of the codes, which follow every edit while the list is open: what fails first, with
// margin and place.
import { words } from '../light/colours.js';
import { button, el, keepFocus, section } from './dom.js';

/** Edits that follow each other sooner are checked together [ms]. */
const patience_ms = 150;

const titles = { fail: 'Fail', 'not verified': 'Not verified', 'not assessed': 'Not assessed',
  pass: 'Pass', information: 'For information' };
const tones = { fail: 'bad', pass: 'good' };
/** A click shows what a verdict is made of; only failures are unfolded from the start. */
const unfolded = new Set(['fail']);

const scope = 'By direct light of the emergency luminaires in clear air, as placed and dimmed ' +
  'here and at this time. Reflected light, smoke and what people read are not in it: click a ' +
  'sign for its verdicts, and assess a saved variant to be sure.';

/** "0.84 lx, at least 1 lx: −16 %". */
export function figuresOf({ value, limit, atLeast, unit, margin }) {
  if (value === null) return '';
  const of = unit ? ` ${unit}` : '';
  const had = `${words(value)}${of}`;
  if (limit === null) return had;
  const share = margin === null ? ''
    : `: ${margin < 0 ? '−' : '+'}${Math.abs(100 * margin).toFixed(0)} %`;
  return `${had}, ${atLeast ? 'at least' : 'at most'} ${words(limit)}${of}${share}`;
}

export class Checks {
  /** `say` sends a message, `show` shows a place in the building. */
  constructor({ say, show }) {
    Object.assign(this, { say, show });
    this.open = new Set(unfolded);
    this.asked = 0;
    this.toggle = button('Check the codes', () => this.follow(!this.follows),
      { aria: { pressed: 'false' } });
    this.words = el('p', { className: 'note', role: 'status' });
    this.lists = el('div', { className: 'checklist' });
    this.element = section('Checks', el('div', { className: 'both' }, this.toggle), this.words,
      this.lists);
    this.clear();
  }

  clear() {
    this.words.textContent = 'What the codes ask, after each edit.';
    this.lists.replaceChildren();
    this.lists.removeAttribute('aria-busy');
  }

  follow(on) {
    this.follows = on;
    this.toggle.setAttribute('aria-pressed', String(on));
    if (on) this.ask();
    else this.clear();
  }

  /** The building has changed, so what is listed is that of before. */
  changed() {
    if (!this.follows) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.ask(), patience_ms);
    this.lists.setAttribute('aria-busy', 'true');
  }

  ask() {
    if (!this.follows) return;
    this.lists.setAttribute('aria-busy', 'true');
    this.words.textContent = 'Checking …';
    this.say({ type: 'checks', id: ++this.asked }, 'checks');
  }

  checked({ id, rows, words: summary, counts, seconds }) {
    if (!this.follows || id !== this.asked) return;
    this.lists.removeAttribute('aria-busy');
    this.words.textContent = `${summary} (${words(seconds, 2)} s). ${scope}`;
    const groups = Object.keys(titles).map((verdict) =>
      this.group(verdict, rows.filter((row) => row.verdict === verdict), counts[verdict] ?? 0));
    keepFocus(this.lists, () => this.lists.replaceChildren(...groups.filter(Boolean)));
  }

  group(verdict, rows, count) {
    if (count === 0) return null;
    const more = count - rows.length;
    const list = el('ul', {}, ...rows.map((row) => this.row(row)),
      more > 0 ? el('li', {}, el('small', { textContent: `and ${more} more` })) : null);
    const details = el('details', { open: this.open.has(verdict) },
      el('summary', { className: tones[verdict] ?? '' },
        el('b', { textContent: titles[verdict] }), ' ',
        el('small', { textContent: String(count) })),
      list);
    details.addEventListener('toggle', () =>
      (details.open ? this.open.add(verdict) : this.open.delete(verdict)));
    return details;
  }

  row(check) {
    const { rule, title, clause, subject, conditions, reasons, place } = check;
    const head = place
      ? button(`${rule} ${title}`, () => this.show(place), { title: 'Show the worst place' })
      : el('span', { textContent: `${rule} ${title}` });
    const lines = [subject, figuresOf(check), conditions, reasons].filter(Boolean)
      .map((textContent) => el('small', { textContent }));
    return el('li', { title: clause }, head, ...lines);
  }

  refused(why) {
    this.lists.removeAttribute('aria-busy');
    this.lists.replaceChildren();
    this.words.textContent = `Nothing is checked: ${why}`;
  }
}
