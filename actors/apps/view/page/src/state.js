// The state received from the program: the generation that is shown, and the next one while its
// light is awaited. Pure: uses no screen and no socket, and only the clock that it is given.
import { kinds, ProtocolError } from './protocol/decode_frame.js';
import { smokeSum, surfaceSum } from './light/sum.js';

/** After a new generation's first light, how long to wait for the other groups. */
const gatherMs = 250;

/** The factor of a group's traced light: the viewers' dimming, times the share at this time. */
export const weightOf = ({ factor, share }) => factor * share;

const demand = (condition, what) => {
  if (!condition) throw new ProtocolError(what);
};

class Generation {
  constructor(scene) {
    this.scene = scene;
    this.number = scene.generation;
    this.geometry = null;
    this.smoke = null;
    this.frames = new Map();
    /** Whether its triangles differ: then all light comes with it, and none is carried over. */
    this.relaid = scene.relaid;
  }
}

/**
 * Calls `tell(event, detail)` for 'scene', 'geometry', 'smoke', 'light', 'fading' (true, false),
 * and passes on messages that do not concern the picture under their type.
 */
export class Live {
  constructor(tell, later = (f, ms) => setTimeout(f, ms)) {
    this.tell = tell;
    this.later = later;
    /** Groups that this viewer is dimming: values received for them are older echoes. */
    this.held = () => false;
    this.forget();
  }

  /** A new connection may lead to a new program, which counts generations from its own start. */
  forget() {
    this.next = null;
    this.number = -1;
    this.fresh = true;
  }

  get scene() {
    return this.shown?.scene ?? null;
  }

  get newest() {
    return this.next?.number ?? this.number;
  }

  hear(heard) {
    if (!heard.type) this.frame(heard);
    else if (heard.type === 'scene') this.announced(heard);
    else if (heard.type === 'factors') this.factors(heard.factors);
    else if (heard.type === 'time') this.time(heard);
    else if (heard.type !== 'progress' || heard.generation === this.newest)
      this.tell(heard.type, heard);
  }

  announced(scene) {
    if (scene.generation < this.newest) return;
    if (!this.fresh && scene.generation === this.number && !this.next) {
      this.shown.scene = scene;
      this.refactor();
      this.tell('scene', scene);
      return;
    }
    if (this.next?.number === scene.generation) {
      this.next.scene = scene;
      return;
    }
    const waited = this.next;
    this.next = new Generation(scene);
    if (waited) this.carry(waited, this.next);
    const anew = scene.groups.every(({ light }) => light === 'new');
    if (!this.shown || this.lit(this.next)) this.promote();
    else this.tell('fading', anew);
    this.tell('editor', { editor: scene.editor });
  }

  /** Data sent for a generation that was never shown, and that are not sent again. */
  carry(waited, next) {
    next.smoke = waited.smoke;
    if (next.relaid) return;
    next.geometry = waited.geometry;
    next.relaid = waited.relaid;
    for (const frame of waited.frames.values()) {
      const { name } = waited.scene.groups[frame.group];
      const group = next.scene.groups.findIndex((g) => g.name === name && g.light !== 'new');
      if (group >= 0) next.frames.set(`${frame.kind} ${group}`, { ...frame, group });
    }
  }

  /** Whether each group has light that cannot be carried over. */
  lit({ scene, frames, relaid }) {
    return scene.groups.every(({ light }, group) =>
      (light !== 'new' && !relaid) || frames.has(`${kinds.surfaceLight} ${group}`));
  }

  frame(frame) {
    if (frame.generation < this.newest) return;
    demand(frame.generation === this.newest, 'a frame before its scene');
    const target = this.next ?? this.shown;
    if (frame.kind === kinds.geometry) target.geometry = frame;
    if (frame.kind === kinds.smoke) {
      demand(frame.halves.length === 2 * (target.scene.voxels?.total ?? 0),
        'smoke of another size');
      target.smoke = frame;
    }
    if (frame.group !== undefined) this.checkLight(frame, target);
    if (this.next) this.stash(frame);
    else this.apply(frame);
  }

  checkLight({ kind, group, halves }, { scene, geometry }) {
    const triangles = (geometry ?? this.shown?.geometry)?.triangles ?? 0;
    const expected =
      kind === kinds.surfaceLight ? 8 * triangles : 6 * (scene.voxels?.total ?? 0);
    demand(halves.length === expected, `light of ${halves.length} numbers, not ${expected}`);
    demand(group < scene.groups.length, `light of group ${group} of ${scene.groups.length}`);
  }

  stash(frame) {
    if (frame.group === undefined) return;
    const { next } = this;
    next.frames.set(`${frame.kind} ${frame.group}`, frame);
    if (this.lit(next)) return this.promote();
    if (next.gathers || next.scene.groups[frame.group].light !== 'new') return;
    next.gathers = true;
    this.later(() => this.next === next && this.promote(), gatherMs);
  }

  /** Shows the next generation; keeps the old one's light where it still applies. */
  promote() {
    const { next } = this;
    const old = this.shown;
    this.next = null;
    this.fresh = false;
    this.number = next.number;
    this.shown = next;
    const rebuilt = next.geometry !== null;
    next.geometry ??= old?.geometry ?? null;
    next.smoke ??= sameVoxels(old?.scene.voxels, next.scene.voxels) ? old?.smoke ?? null : null;
    next.surfaces = this.inherit(old, next, 'surfaces', next.geometry?.triangles, surfaceSum);
    next.air = this.inherit(old, next, 'air', next.scene.voxels?.total, smokeSum);
    this.tell('scene', next.scene);
    if (rebuilt) this.tell('geometry', next.geometry);
    this.tell('smoke', next);
    for (const frame of next.frames.values()) this.put(frame);
    next.frames.clear();
    this.tell('light', null);
    this.tell('fading', false);
  }

  inherit(old, next, which, cells, make) {
    if (!cells) return null;
    const light = make(cells);
    const kept = old?.[which]?.cells === cells ? old[which] : null;
    const oldNames = old?.scene.groups.map((g) => g.name) ?? [];
    next.scene.groups.forEach((group, i) => {
      const entry = kept?.groups.get(oldNames.indexOf(group.name));
      if (entry) light.set(i, entry.halves, weightOf(group), entry.white);
    });
    return light;
  }

  apply(frame) {
    if (frame.kind === kinds.geometry) {
      const { shown } = this;
      shown.surfaces = this.inherit(shown, shown, 'surfaces', frame.triangles, surfaceSum);
      this.tell('geometry', frame);
    } else if (frame.kind === kinds.smoke) {
      this.tell('smoke', this.shown);
    } else {
      this.put(frame);
      this.tell('light', frame.group);
    }
  }

  put({ kind, group, halves, white }) {
    const light = kind === kinds.surfaceLight ? this.shown.surfaces : this.shown.air;
    light?.set(group, halves, weightOf(this.shown.scene.groups[group]), white);
  }

  /** A white surface in the light of all groups but flames, as linear sRGB [cd/m2]. */
  get white() {
    const sum = [0, 0, 0];
    this.shown?.scene.groups.forEach((group, i) => {
      const own = group.kind === 'flame' ? null : this.shown.surfaces?.groups.get(i)?.white;
      own?.forEach((value, c) => (sum[c] += weightOf(group) * value));
    });
    return sum;
  }

  factors(all) {
    const changes = all.filter(({ name }) => !this.held(name));
    for (const { name, factor } of changes) this.setFactor(name, factor);
    this.tell('factors', changes);
  }

  /** Dims a group, in the shown and in the awaited generation. */
  setFactor(name, factor) {
    for (const generation of [this.shown, this.next]) {
      const group = generation?.scene.groups.find((g) => g.name === name);
      if (group) group.factor = factor;
    }
    this.refactor();
  }

  /** Sets the time since the mains failure, in the shown and in the awaited generation. */
  time({ seconds, shares }) {
    const byName = new Map(shares.map(({ name, share }) => [name, share]));
    for (const generation of [this.shown, this.next]) {
      if (!generation) continue;
      generation.scene.seconds = seconds;
      for (const group of generation.scene.groups) group.share = byName.get(group.name) ?? 1;
    }
    this.refactor();
    this.tell('time', { seconds });
  }

  refactor() {
    if (!this.shown) return;
    let changed = false;
    this.shown.scene.groups.forEach((group, i) => {
      changed = this.shown.surfaces?.dim(i, weightOf(group)) || changed;
      changed = this.shown.air?.dim(i, weightOf(group)) || changed;
    });
    if (changed) this.tell('light', null);
  }

  /** Removes rounding errors from the sums, some groups at a time; true when done. */
  settle(most) {
    const sums = [this.shown?.surfaces, this.shown?.air].filter((sum) => sum?.rounded);
    if (!sums.every((sum) => sum.settle(most))) return false;
    if (sums.length) this.tell('light', null);
    return true;
  }
}

function sameVoxels(a, b) {
  return Boolean(a && b) && a.total === b.total && a.edge === b.edge;
}
