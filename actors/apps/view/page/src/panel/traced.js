// A traced picture of the current view, over the page's own: its progress, and saving it.
import { count, words } from '../light/colours.js';
import { button, byId, el } from './dom.js';

/** Limit on pixels that the program traces (PROTOCOL.md), and the smallest edge. */
const pixelsMost = 1 << 19;
const edgeLeast = 16;

/** As large as the picture on the screen, up to the limit; with the same aspect ratio. */
export function sizeOf(width, height) {
  const scale = Math.min(1, Math.sqrt(pixelsMost / (width * height)));
  return [width, height].map((n) => Math.max(edgeLeast, Math.floor(scale * n)));
}

/** The progress of a picture, as text. */
export function stateOf({ particles, paths, relativeError, seconds, done }) {
  const flux = particles >= 1e6 ? `${words(particles / 1e6)} M` : count(particles);
  return [
    paths ? `${paths} paths a pixel` : null,
    relativeError === null ? null : `± ${words(100 * relativeError, 2)} %`,
    `${flux} particles`,
    `${words(seconds, 2)} s`,
    done ? 'finished' : paths ? 'growing' : 'begun',
  ].filter(Boolean).join(' · ');
}

export class Traced {
  /** `say(message)` sends to the program. */
  constructor(say) {
    this.say = say;
    this.id = 0;
    this.growing = false;
    this.image = el('img', { alt: 'Traced picture of the view', hidden: true });
    this.state = el('p', { role: 'status' });
    this.stop = button('Stop', () => this.end('stopped'));
    this.link = el('a', { textContent: 'Download', hidden: true });
    this.close = button('×', () => this.hide(), { aria: { label: 'Close the traced picture' } });
    this.element = byId('traced');
    this.element.append(this.image,
      el('figcaption', {}, this.state, this.stop, this.link, this.close));
  }

  /** `view` is a perspective one: eye, target, up, fov. */
  ask(view, [width, height], human, name) {
    const { eye, target, up, fov } = view;
    this.id += 1;
    this.growing = true;
    this.name = name;
    this.element.hidden = this.stop.hidden = false;
    this.image.hidden = this.link.hidden = true;
    this.state.textContent = 'The program traces this view …';
    this.say({ type: 'render', id: this.id, eye, target, up, fov, width, height, human });
  }

  show(picture) {
    if (picture.id !== this.id || !this.growing) return;
    this.state.textContent = stateOf(picture);
    if (picture.png !== null) {
      this.image.src = this.link.href = `data:image/png;base64,${picture.png}`;
      this.link.download = `${this.name || 'view'} ${picture.paths} paths.png`;
      this.image.hidden = this.link.hidden = false;
    }
    if (picture.done) this.rest();
  }

  rest() {
    this.growing = false;
    this.stop.hidden = true;
  }

  /** No more passes will come; the present one stays. */
  end(words_) {
    if (!this.growing) return;
    this.rest();
    this.say({ type: 'stop_render' });
    this.state.textContent += ` · ${words_}`;
  }

  /** The program refuses a picture, possibly an earlier one. */
  refused(id) {
    if (id === this.id) this.fail();
  }

  /** The program has refused it, or is disconnected. */
  fail() {
    if (!this.growing) return;
    this.rest();
    if (this.image.hidden) this.element.hidden = true;
    else this.state.textContent += ' · ended';
  }

  hide() {
    this.end('stopped');
    this.element.hidden = true;
  }
}
