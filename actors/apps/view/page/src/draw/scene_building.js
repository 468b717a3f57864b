// Turns the program's messages about the building into what is drawn and walked through: triangles,
// signs, voxels of smoke, marks and outlines. Light belongs to light_display.js.
import { toast } from '../panel/toasts.js';
import { Building } from '../walk/building.js';

export class SceneBuilding {
  constructor(picture, live, walk) {
    Object.assign(this, { picture, live, walk });
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
    const building = new Building(geometry);
    this.picture.gloss.build(building, geometry);
    this.walk.enter(building);
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
    this.picture.marks.place(this.live.scene, this.walk.inPlan, this.walk.motion.eye);
    this.picture.untoned = true;
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
