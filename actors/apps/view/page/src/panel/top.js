// The upper edge: the building's name, the connection, who edits; and the progress.
import { count, words } from '../light/colours.js';
import { byId, el } from './dom.js';

/** The bar is full at this relative error; tracing may go on beyond it. */
const good = 0.01;

export class Top {
  constructor({ edit }) {
    this.editButton = byId('edit');
    this.editButton.addEventListener('click', () => edit(!this.editor));
    byId('fold').addEventListener('click', () => this.fold());
    if (matchMedia('(max-width: 760px)').matches) this.fold();
    // What stands beside the buttons of both edges keeps off them, however many lines they take.
    const [top, views] = [byId('top'), byId('views')];
    const set = (name, pixels) => document.body.style.setProperty(name, `${pixels}px`);
    const edges = new ResizeObserver(() => {
      set('--under-top', top.offsetTop + top.offsetHeight + 6);
      set('--over-views', Math.max(64, views.offsetHeight + 16));
    });
    edges.observe(top);
    edges.observe(views);
    this.bar = el('div', { className: 'bar' }, el('span'));
    this.figures = el('p', { textContent: 'Waiting for the first light …' });
    byId('progress').append(this.bar, this.figures);
  }

  fold() {
    const folded = document.body.classList.toggle('folded');
    byId('fold').setAttribute('aria-expanded', String(!folded));
  }

  scene({ title, name, scenario, smoke }) {
    byId('title').textContent = title || name || 'Luxodus';
    const air = smoke === 0 ? 'clear air' : `smoke × ${words(smoke, 2)}`;
    byId('subtitle').textContent = [scenario, air].filter(Boolean).join(' · ');
    document.title = `${title || name} · Luxodus`;
  }

  link(state, sentence) {
    const link = byId('link');
    link.dataset.state = state;
    link.textContent = state === 'open' ? 'live' : sentence;
    if (state !== 'open') this.editButton.hidden = true;
  }

  edits(editor) {
    this.editor = editor;
    this.editButton.hidden = false;
    this.editButton.textContent = editor ? 'You edit · leave' : 'Read-only · take over';
    this.editButton.title = editor
      ? 'Let somebody else change lights, smoke and places'
      : 'Become the one who changes lights, smoke and places';
    document.body.classList.toggle('editor', editor);
  }

  fading(now) {
    const banner = byId('banner');
    banner.hidden = !now;
    banner.textContent = now
      ? 'Tracing anew. Until its first light is here you see the state before the change.'
      : '';
  }

  progress({ particles, relativeError, seconds, groupsOfBefore, done }) {
    const share = relativeError > 0 ? Math.log(relativeError) / Math.log(good) : 0;
    const width = done ? 1 : Math.min(0.98, Math.max(0.02, share));
    this.bar.firstElementChild.style.width = `${100 * width}%`;
    this.bar.classList.toggle('done', done);
    const many = particles >= 1e6 ? `${words(particles / 1e6)} M` : count(particles);
    const error = relativeError === null ? null : `± ${words(100 * relativeError, 2)} %`;
    const state = done ? 'finished' : 'refining';
    const old = groupsOfBefore ? `${groupsOfBefore} lights still as before the move` : null;
    this.figures.textContent = [`${many} particles`, error, `${words(seconds, 2)} s`, state, old]
      .filter(Boolean).join(' · ');
  }
}
