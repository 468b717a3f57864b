// A traced picture of what one looks at, over the page's own: how far it is, and a file of it.
import { count, words } from '../light/colours.js';
import { button, byId, el } from './dom.js';

/** Most pixels that the program traces (PROTOCOL.md), and the least edge. */
const pixelsMost = 1 << 19;
const edgeLeast = 16;

/** As large as the picture on the screen, or as may be; of the same shape. */
export function sizeOf(width, height) {
  const scale = Math.min(1, Math.sqrt(pixelsMost / (width * height)));
  return [width, height].map((n) => Math.max(edgeLeast, Math.floor(scale * n)));
}

/** How far a picture is, in words. */
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
  /** `say(message)` to the program. */
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

  /** No more comes of it; what is there stays. */
  end(words_) {
    if (!this.growing) return;
    this.rest();
    this.say({ type: 'stop_render' });
    this.state.textContent += ` · ${words_}`;
  }

  /** The program refuses a picture, which may be one of before. */
  refused(id) {
    if (id === this.id) this.fail();
  }

  /** The program has refused it, or is gone. */
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
