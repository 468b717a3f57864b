// Points of view: walking, orbit, plan; eye height; and places to jump to.
import { eyeHeights } from '../walk/motion.js';
import { button, byId, choice, el } from './dom.js';

const modes = [['walk', 'Walk'], ['orbit', 'Orbit'], ['plan', 'Plan']];

export class Views {
  constructor({ mode, height, jump, cut, help, render }) {
    this.modes = choice('Way of looking', modes, mode);
    this.heights = el('select', {
      aria: { label: 'Eye height' },
      on: { change: () => height(Number(this.heights.value)) },
    });
    for (const [name, metres] of Object.entries(eyeHeights))
      this.heights.append(new Option(`${metres} m ${name}`, metres));
    this.places = el('select', {
      aria: { label: 'Go to an observer or a camera' },
      on: { change: () => this.go(jump) },
    });
    this.cut = el('input', {
      type: 'range', step: 0.05, hidden: true, title: 'Height of the cut',
      aria: { label: 'Height at which plan and orbit cut the building' },
      on: { input: () => cut(Number(this.cut.value)) },
    });
    this.help = el('button', {
      type: 'button', textContent: '?', title: 'Keys and gestures', on: { click: help },
      aria: { label: 'Help: keys and gestures' },
    });
    this.render = button('Render', render, {
      title: 'Have the program trace a picture of this view',
      aria: { label: 'Render this view' },
    });
    byId('views').append(this.modes.element, this.heights, this.cut, this.places, this.render,
      this.help);
  }

  go(jump) {
    const [kind, index] = this.places.value.split(' ');
    if (index !== undefined) jump(this.scene_[kind][Number(index)]);
    this.places.value = '';
    this.places.blur();
  }

  scene(scene) {
    this.scene_ = scene;
    this.places.replaceChildren(new Option('Go to …', ''));
    for (const [kind, title] of [['observers', 'Observers'], ['cameras', 'Cameras']]) {
      if (!scene[kind].length) continue;
      const group = el('optgroup', { label: title });
      scene[kind].forEach(({ name }, i) => group.append(new Option(name, `${kind} ${i}`)));
      this.places.append(group);
    }
    this.cut.min = scene.low[2] + 0.1;
    this.cut.max = scene.high[2] + 0.1;
  }

  show(motion) {
    this.modes.press(motion.mode);
    const walking = motion.mode === 'walk';
    this.heights.hidden = !walking;
    this.cut.hidden = walking;
    this.render.disabled = motion.mode === 'plan';
    this.cut.value = motion.plan.cut;
    const known = Object.values(eyeHeights).find((h) => Math.abs(h - motion.height) < 0.005);
    this.heights.value = known ?? '';
  }
}
