// The selection in the picture: a surface, a sign or a luminaire; how it is picked, dragged, and
// found again in the next generation.
import { byId } from '../panel/dom.js';
import { add, cross, scale, unit } from '../walk/vectors.js';
import { Mover } from './mover.js';
import { placeOf } from './placing.js';

const markReach_px = 14;
const probe_m = 0.05;
const farthest_m = 1e3;

/** A small mark on a surface. */
export function diamond(point, normal) {
  const side = unit(cross(normal, Math.abs(normal[2]) > 0.9 ? [1, 0, 0] : [0, 0, 1]));
  const other = cross(normal, side);
  return [side, other, scale(side, -1), scale(other, -1)].map((v) => add(point, scale(v, probe_m)));
}

export class Selection {
  constructor({ picture, live, walk, building, edits, panels }) {
    Object.assign(this, { picture, live, walk, building, panels });
    this.inspect = panels.inspect;
    this.say = (message, key) => edits.say(message, key);
    this.probes = 0;
    this.judged = 0;
    /** A copy requested here is selected when it arrives. */
    this.awaited = null;
    this.mover = new Mover({
      say: this.say,
      outline: (corners) => building.outline(corners),
      moved: (position) => this.inspect.moved(position),
      yaw: () => (walk.inPlan ? Math.PI / 2 : walk.yaw),
      others: (kind, name) => live.scene[kind === 'sign' ? 'signs' : 'luminaires']
        .filter((thing) => thing.name !== name).map(({ position }) => position),
    });
  }

  click(x, y) {
    if (!this.live.scene) return;
    const { origin, direction } = this.walk.ray(x, y);
    const hit =
      this.walk.building?.nearest(origin, direction, this.walk.cut ?? Infinity) ?? null;
    const sign = this.signAt(x, y, hit?.distance ?? farthest_m);
    const luminaire = sign ? null : this.luminaireAt(x, y);
    if (sign) this.choose('sign', sign);
    else if (luminaire) this.choose('luminaire', luminaire);
    else if (hit)
      this.probe(hit, this.picture.surfacesAlone ? null : this.picture.luminanceAt(x, y));
    else this.clear();
  }

  /** Selects the next of all signs and luminaires, the nearest to the viewer first. */
  next() {
    const { scene } = this.live;
    if (!scene) return;
    const { eye } = this.walk.motion;
    const away = ({ position }) => Math.hypot(...position.map((x, k) => x - eye[k]));
    const all = ['signs', 'luminaires'].flatMap((list) =>
      scene[list].map((thing) => ({ kind: list.slice(0, -1), thing })));
    all.sort((a, b) => away(a.thing) - away(b.thing));
    const subject = this.inspect.subject ?? {};
    const now = all.findIndex(({ kind, thing }) =>
      kind === subject.kind && thing.name === subject.name);
    const chosen = all[(now + 1) % all.length];
    if (chosen) this.choose(chosen.kind, chosen.thing);
  }

  signAt(x, y, distance) {
    if (this.walk.inPlan) return this.markAt(x, y, this.live.scene.signs);
    const { origin, direction } = this.walk.ray(x, y);
    return this.picture.signs.pointedAt(origin, direction, distance);
  }

  luminaireAt(x, y) {
    return this.panels.marks.checked ? this.markAt(x, y, this.live.scene.luminaires) : null;
  }

  /** The thing with the nearest mark in the picture, if it is near. */
  markAt(x, y, things) {
    const box = byId('picture').getBoundingClientRect();
    let best = { apart: markReach_px, thing: null };
    for (const thing of things) {
      const [px, py, ahead] = this.panels.labels.project(thing.position, this.picture.camera);
      const apart = Math.hypot(((px - x) * box.width) / 2, ((py - y) * box.height) / 2);
      if (ahead && apart < best.apart) best = { apart, thing };
    }
    return best.thing;
  }

  sign(sign) {
    this.inspect.sign(sign);
    this.mover.hold('sign', sign);
    this.inspect.asked = ++this.judged;
    this.say({ type: 'judge', sign: sign.name, id: this.judged }, 'judge');
  }

  /** Selects what the viewer has asked for. */
  choose(kind, thing) {
    this[kind](thing);
    this.reveal();
  }

  luminaire(luminaire) {
    this.inspect.luminaire(luminaire);
    this.mover.hold('luminaire', luminaire);
  }

  /** Requests the light at a point of a surface. */
  probe({ triangle, front, point, normal }, seen) {
    const id = ++this.probes;
    this.mover.release();
    this.building.outline(diamond(point, normal));
    this.inspect.surface({ id, point, seen });
    this.say({ type: 'probe', id, triangle, front, point }, 'probe');
    this.reveal();
  }

  reveal() {
    this.inspect.element.scrollIntoView({ block: 'nearest' });
  }

  /** Adds one of a kind of the library, where the viewer looks. */
  addKind({ kind, of, ofType }) {
    const { walk } = this;
    if (!walk.building) return;
    const { mode, eye, plan, orbit } = walk.motion;
    const centre = mode === 'orbit' ? orbit.centre : [...plan.centre, plan.cut];
    const { position, facing } = placeOf(kind, walk.building, { eye, ray: walk.ray(0, 0), mode,
      centre, cut: walk.cut ?? Infinity });
    this.say({ type: 'add', kind, of, position: position.map((x) => Number(x.toFixed(3))),
      ...(facing && { facing }), ...(ofType && { of_type: true }) });
  }

  remove() {
    this.say({ type: 'remove', name: this.inspect.subject.name });
  }

  clear() {
    this.mover.release();
    this.inspect.clear();
  }

  /** A new generation may have moved or reassessed the selection. */
  keep(scene) {
    if (this.mover.pending) return;
    const lists = { sign: scene.signs, luminaire: scene.luminaires };
    const found = (wanted) => lists[wanted?.kind]?.find(({ name }) => name === wanted.name);
    const copy = found(this.awaited);
    const { kind } = copy ? this.awaited : this.inspect.subject ?? {};
    const thing = copy ?? found(this.inspect.subject);
    if (copy) this.awaited = null;
    if (copy) this.choose(kind, copy);
    else if (thing) this[kind](thing);
    else if (lists[kind]) this.clear();
  }

  /** Starts dragging the selection if the pointer is on it; returns whether it did. */
  grab(x, y) {
    const { thing, kind } = this.mover;
    if (!thing || !this.panels.editor) return false;
    const { origin, direction } = this.walk.ray(x, y);
    const { inPlan } = this.walk;
    const onIt = kind === 'sign' && !inPlan
      ? this.picture.signs.pointedAt(origin, direction, farthest_m)?.name === thing.name
      : this.markAt(x, y, [thing]) !== null;
    return onIt && this.mover.grab(origin, direction, inPlan);
  }

  drag(x, y) {
    const { origin, direction } = this.walk.ray(x, y);
    this.mover.drag(origin, direction);
  }
}
