// All panels around the picture: makes them, and passes on what all need.
import { Checks } from './checks.js';
import { Clock } from './clock.js';
import { byId } from './dom.js';
import { Groups } from './groups.js';
import { History } from './history.js';
import { Inspect } from './inspect.js';
import { Labels } from './labels.js';
import { Library } from './library.js';
import { PlanKey } from './plan_key.js';
import { Rendition } from './rendition.js';
import { StatePanel } from './state_panel.js';
import { Suggest } from './suggest.js';
import { Top } from './top.js';
import { Traced } from './traced.js';
import { Views } from './views.js';

export class Panels {
  /** `wants`: the handlers of each panel's actions. */
  constructor(picture, wants) {
    this.top = new Top({ edit: (wanted) => wants.say({ type: 'edit', wanted }) });
    this.state = new StatePanel({ say: wants.say });
    this.clock = new Clock({ say: wants.say, placed: wants.placed });
    this.groups = new Groups({ dim: wants.dim });
    this.checks = new Checks({ say: wants.say, show: wants.point });
    this.library = new Library({ add: wants.addKind });
    this.history = new History({ goTo: wants.goTo });
    this.suggest = new Suggest({ say: wants.say, show: wants.suggest });
    this.rendition = new Rendition(picture.exposure, (rendition) => {
      if (rendition) picture.setRendition(rendition);
      picture.untoned = true;
    });
    this.rendition.check('collide with walls', true, wants.solid);
    this.rendition.check('smooth light', true, wants.smooth);
    this.rendition.check('moving flames', picture.liveFlames, wants.flames,
      'Steady flames are shown at a moment. Their light, and verdicts, are those of the mean.');
    this.marks = this.rendition.check('marks', true, wants.marks);
    this.inspect = new Inspect(wants.selection);
    this.views = new Views(wants.views);
    this.traced = new Traced(wants.say);
    this.labels = new Labels(byId('labels'));
    this.planKey = new PlanKey();
    const parts = [this.inspect, this.state, this.clock, this.groups, this.library, this.checks,
      this.suggest, this.rendition, this.history];
    byId('panel').append(...parts.map(({ element }) => element), this.state.saveElement);
    this.edits(false);
  }

  scene(scene) {
    for (const part of [this.top, this.state, this.clock, this.groups, this.suggest, this.views,
      this.labels, this.planKey])
      part.scene(scene);
    this.edits(scene.editor);
  }

  /** Whether this viewer may change the building. */
  edits(editor) {
    this.editor = editor;
    for (const part of [this.top, this.state, this.clock, this.groups, this.library, this.history,
      this.suggest, this.inspect])
      part.edits(editor);
  }
}
