// What was changed in this view, as a list of steps; undone and redone by buttons, keys or a click
// on the step.
import { words } from '../light/colours.js';
import { button, el, keepFocus, middle, section } from './dom.js';

const plural = { factor: 'lights', add: 'additions', move: 'places', remove: 'removals' };

/** A step in words. */
export function wordsOf({ kind, name, count, value }) {
  const what = count > 1 ? `${count} ${plural[kind] ?? 'changes'}` : name;
  switch (kind) {
    case 'factor': return `${what}: ${Math.round(100 * value)} %`;
    case 'scenario': return `Scenario ${what}`;
    case 'smoke': return value === 0 ? 'No smoke' : `Smoke × ${words(value, 2)}`;
    case 'move': return `Moved ${what}`;
    case 'add': return `Added ${what}`;
    default: return `Removed ${what}`;
  }
}

export class History {
  /** `goTo(done)` asks for the building after the first `done` steps. */
  constructor({ goTo }) {
    this.goTo = goTo;
    this.undo = button('Undo', () => this.back(), { title: 'Ctrl+Z' });
    this.redo = button('Redo', () => this.again(), { title: 'Ctrl+Y or Ctrl+Shift+Z' });
    this.list = el('ol', { className: 'steps' });
    this.element = section('Edits', el('div', { className: 'both' }, this.undo, this.redo),
      this.list);
    this.set({ steps: [], done: 0 });
  }

  set({ steps, done }) {
    this.steps = steps;
    this.done = this.told = done;
    const items = steps.map((step, i) => {
      const go = button('', () => this.go(i + 1));
      go.append(middle(wordsOf(step)));
      return el('li', { className: i < done ? '' : 'undone' }, go);
    });
    const opened = button('As opened', () => this.go(0));
    keepFocus(this.list, () =>
      this.list.replaceChildren(...(items.length ? [el('li', {}, opened), ...items] : [])));
    this.present(this.list.children[done]);
    this.enable();
  }

  /** The last step goes on: a slider is being dragged. */
  goesOn(last) {
    if (this.steps.length === 0) return;
    this.steps[this.steps.length - 1] = last;
    this.list.lastElementChild?.firstChild.replaceChildren(middle(wordsOf(last)));
  }

  /** Marks the present step, and scrolls the list alone to it. */
  present(item) {
    if (!item) return;
    item.firstChild.setAttribute('aria-current', 'step');
    const { list } = this;
    list.scrollTop = item.offsetTop - list.offsetTop - list.clientHeight / 2;
  }

  /** What was asked for may not have happened. */
  refused() {
    this.done = this.told;
    this.enable();
  }

  back() {
    this.go(this.done - 1);
  }

  again() {
    this.go(this.done + 1);
  }

  /** The count changes at once, so that two quick presses undo two steps. */
  go(done) {
    if (!this.editor || done < 0 || done > this.steps.length) return;
    this.done = done;
    this.enable();
    this.goTo(done);
  }

  enable() {
    this.undo.disabled = !this.editor || this.done === 0;
    this.redo.disabled = !this.editor || this.done === this.steps.length;
  }

  edits(editor) {
    this.editor = editor;
    this.done = this.told;
    for (const { firstChild } of this.list.children) firstChild.disabled = !editor;
    this.enable();
  }
}
