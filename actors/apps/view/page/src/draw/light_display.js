// Light on its way to the screen: when what the program has sent, and what hands have dimmed, is
// summed and drawn.
import { weightOf } from '../state.js';

/** After the last dimming the sums are made afresh [ms]. */
const settle_ms = 400;
/** Refined light comes group by group, many times: so often is it brought to the screen [ms]. */
const gather_ms = 250;

export class LightDisplay {
  constructor(picture, live) {
    Object.assign(this, { picture, live });
    this.awaited = { now: false, soon: false };
    this.drawnAt = 0;
    this.settleAt = Infinity;
  }

  /** All of it is to be drawn with the next picture. */
  changed() {
    this.awaited.now = true;
  }

  /** New light of one group is one of many: it waits a little for the others. */
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

  /** Whether the light shown is that of before a change. */
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
    picture.smoke.shine(live.shown?.air ?? null);
    for (const shining of [picture.signs, picture.lamps, picture.smoke.flames])
      shining.shine((name) => weights.get(name) ?? 1);
    picture.again();
  }
}
