// Scale bar and north arrow of the plan.
import { byId, el } from './dom.js';

const longest_px = 140;

/** The longest of 1, 2, 5, 10, ... metres that fits. */
export function barOf(metresPerPixel) {
  const most = longest_px * metresPerPixel;
  const decade = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map((n) => n * decade).find((n) => n <= most);
  return { metres, pixels: metres / metresPerPixel };
}

export class PlanKey {
  constructor() {
    this.bar = el('span', { className: 'scalebar' });
    this.length = el('small');
    this.north = el('span', { className: 'north', textContent: '↑' });
    this.element = byId('plan-key');
    this.element.append(el('small', { textContent: 'N' }), this.north, this.bar, this.length);
  }

  /** `north` counts from +y towards +x, seen from above [degrees]. */
  scene({ north }) {
    this.north.style.transform = `rotate(${north}deg)`;
  }

  show(motion, height) {
    this.element.hidden = motion.mode !== 'plan';
    if (this.element.hidden || !(height > 0)) return;
    const { metres, pixels } = barOf(motion.plan.span / height);
    this.bar.style.width = `${pixels.toFixed(1)}px`;
    this.length.textContent = metres < 1 ? `${Math.round(100 * metres)} cm` : `${metres} m`;
  }
}
