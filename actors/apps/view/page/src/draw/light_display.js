// Brings light to the screen: decides when received light and the viewer's dimming are summed and
// drawn.
import { weightOf } from '../state.js';

/** Delay after the last dimming until the sums are recomputed [ms]. */
const settle_ms = 400;
/**
 * Refined light arrives group by group, many times: the screen is updated at this interval [ms].
 */
const gather_ms = 250;

export class LightDisplay {
  constructor(picture, live) {
    Object.assign(this, { picture, live });
    this.awaited = { now: false, soon: false };
    this.drawnAt = 0;
    this.settleAt = Infinity;
  }

  /** Everything is to be drawn with the next picture. */
  changed() {
    this.awaited.now = true;
  }

  /** New light of one group waits a little for that of the others. */
  arrived(group) {
    if (group === null) this.changed();
    else this.awaited.soon = true;
  }

  dimmed() {
    this.changed();
    this.settleLater();
  }

  settleLater() {
    this.settleAt = performance.now() + settle_ms;
  }

  smooth(on) {
    this.picture.surfaces.setSmooth(on);
    this.changed();
  }

  /** Whether the shown light is from before a change. */
  fading(now) {
    this.picture.fade.wanted = now ? 1 : 0;
  }

  get settled() {
    return !this.awaited.now && !this.awaited.soon && this.settleAt === Infinity;
  }

  update(now) {
    if (now > this.settleAt && this.live.settle(1)) this.settleAt = Infinity;
    const gathered = this.awaited.soon && now - this.drawnAt > gather_ms;
    if (!this.awaited.now && !gathered) return;
    this.drawnAt = now;
    this.awaited = { now: false, soon: false };
    this.shine();
  }

  shine() {
    const { live, picture } = this;
    const weights = new Map((live.scene?.groups ?? []).map((g) => [g.name, weightOf(g)]));
    picture.surfaces.shine(live.shown?.surfaces ?? null);
    picture.people.shine(live.shown?.surfaces ?? null);
    picture.smoke.shine(live.shown?.air ?? null);
    for (const shining of [picture.signs, picture.lamps, picture.smoke.flames])
      shining.shine((name) => weights.get(name) ?? 1);
    picture.setWhite(live.white);
    picture.again();
  }
}
