// Turns the program's messages about the building into what is drawn and walked through: triangles,
// signs, voxels of smoke, marks and outlines. Light belongs to light_display.js.
import { toast } from '../panel/toasts.js';
import { Building } from '../walk/building.js';
import { peopleAt } from '../walk/people_at.js';

export class SceneBuilding {
  constructor(picture, live, walk) {
    Object.assign(this, { picture, live, walk });
    /** The triangles that one walks through. */
    this.building = null;
    this.walkers = { step: 1, people: [] };
  }

  scene({ signs, flames, lamps, lampTables, gloss }) {
    this.picture.signs.build(signs);
    this.picture.lamps.build(lamps, lampTables);
    this.picture.gloss.kinds(gloss);
    this.picture.smoke.flames.build(flames);
    this.placeMarks();
  }

  geometry(geometry) {
    this.picture.surfaces.build(geometry);
    this.building = new Building(geometry);
    this.picture.gloss.build(this.building, geometry);
    this.walk.enter(this.building);
  }

  smoke({ scene, smoke }) {
    const held = this.picture.smoke.build(
      scene.voxels, smoke?.halves ?? null, this.picture.voxelsMost);
    if (!held) toast('This graphics card cannot hold so many voxels: the smoke is not drawn.');
  }

  /** Marks of luminaires and flames. */
  showMarks(on) {
    this.picture.marks.wanted = on;
    this.placeMarks();
  }

  /** Marks of suggested luminaires, and of places coloured by how much one would help there. */
  showSuggestion(answer) {
    this.picture.marks.suggestion = answer;
    this.placeMarks();
  }

  placeMarks() {
    if (!this.live.scene) return;
    const { inPlan, motion } = this.walk;
    this.picture.marks.place(this.live.scene, inPlan, motion.eye, motion.plan.cut);
    this.picture.untoned = true;
  }

  /** People who walk: as of decodePeople. */
  setWalkers(walkers) {
    this.walkers = walkers;
    this.picture.people.build(walkers.people.length);
  }

  /** Puts people where they are at a time; returns how many there are. */
  placePeople(time) {
    const people = peopleAt(this.walkers, time);
    this.picture.people.place(people, this.building);
    this.picture.people.shine(this.live.shown?.surfaces ?? null);
    this.picture.again();
    return people.length;
  }

  /** Drawings under plans. */
  backdrops(drawings) {
    this.picture.marks.backdrops.build(drawings, () => (this.picture.untoned = true));
  }

  outline(corners) {
    this.picture.marks.setOutline(corners);
    this.picture.untoned = true;
  }
}
