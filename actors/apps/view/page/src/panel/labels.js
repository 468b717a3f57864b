// Names beside marks, in plan and in orbit.
import { Vector3 } from 'three';
import { isBelow } from '../draw/escape_lines.js';
import { el } from './dom.js';

const shownMost = 80;
const apart_px = { x: 70, y: 15 };

/** Named where the middle one of its places is. */
const inMiddle = ({ name, path }) =>
  ({ kind: 'route', name, position: path[Math.floor(path.length / 2)], onPlan: true });
const inCorner = ({ name, outline, z }) =>
  ({ kind: 'area', name, position: [...outline[0], z], onPlan: true });

export class Labels {
  constructor(parent) {
    this.parent = parent;
    this.things = [];
    this.point = new Vector3();
  }

  scene({ signs, observers, groups, routes, areas }) {
    const of = (kind, list, place) =>
      list.map((thing) => ({ kind, name: thing.name, position: thing[place] }));
    const flames = groups.filter((g) => g.kind === 'flame');
    this.things = [...routes.map(inMiddle), ...areas.map(inCorner),
      ...of('sign', signs, 'position'), ...of('observer', observers, 'eye'),
      ...of('flame', flames, 'position')].slice(0, shownMost);
    for (const thing of this.things)
      thing.element = el('span', { className: thing.kind, textContent: thing.name });
    this.parent.replaceChildren(...this.things.map((t) => t.element));
  }

  /** Position of a point in the picture from -1 to 1, and whether it is in front of the camera. */
  project(position, camera) {
    this.point.set(...position).project(camera);
    return [this.point.x, this.point.y, this.point.z > -1 && this.point.z < 1];
  }

  draw(camera, { mode, plan: { cut } }) {
    this.parent.hidden = mode === 'walk';
    if (this.parent.hidden) return;
    const { clientWidth, clientHeight } = this.parent;
    const taken = [];
    for (const { element, position, onPlan } of this.things) {
      const [x, y, ahead] = this.project(position, camera);
      const at = [(0.5 + 0.5 * x) * clientWidth, (0.5 - 0.5 * y) * clientHeight];
      const free = taken.every(([tx, ty]) =>
        Math.abs(tx - at[0]) > apart_px.x || Math.abs(ty - at[1]) > apart_px.y);
      const inside = ahead && Math.abs(x) < 1 && Math.abs(y) < 1;
      const absent = onPlan && (mode !== 'plan' || !isBelow(position[2], cut));
      element.hidden = !free || !inside || absent || (mode === 'orbit' && position[2] > cut + 0.5);
      if (element.hidden) continue;
      taken.push(at);
      element.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px)`;
    }
  }
}
