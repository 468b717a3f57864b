// Exposure of the picture. Pure: takes meter readings, returns a scale and a curve.
import { cameraCurve } from './tone.js';

export const renditions = { camera: 0, eye: 1, luminance: 2, illuminance: 3 };
/** Whether it is a map of values, which no exposure changes. */
export const isMap = (rendition) => renditions[rendition] >= 2;

/** Mid grey of a camera; and the smallest luminance that automatic exposure raises to it. */
const key = 0.18;
const darkest_cd_m2 = 1e-4;
/** White without brighter signs, as a multiple of the exposed value 1. */
const whitePoint = 6;
/** A typical monitor, for the eye's rendition [cd/m2]. */
const displayMost_cd_m2 = 250;
const seconds = { camera: 0.35, eye: 1.2 };
/**
 * Speeds of the eye's adaptation, in the logarithm of luminance: nerves adapt to more light at
 * once; in the dark the pigment of cones regenerates with a time constant of two minutes (Rushton
 * and Henry 1968).
 */
const eyeSeconds = { brighter: 1, darker: 120 };

/**
 * What the cells of the meter say: whether there is light (`lit`); the log-average luminance
 * `level`; `shown`, the mean of the largest luminances that a screen shows of the colours in view;
 * `sign`, the luminance of the brightest sign or steady flame, 0 without any.
 */
export function readMeter(cells) {
  let log = 0;
  let count = 0;
  let shown = 0;
  let sign = 0;
  for (let i = 0; i < cells.length; i += 4) {
    log += cells[i];
    count += cells[i + 1];
    shown += cells[i + 2];
    sign = Math.max(sign, cells[i + 3]);
  }
  if (count === 0) return { lit: false, level: darkest_cd_m2, shown: 1, sign };
  const level = Math.max(darkest_cd_m2, 2 ** (log / count));
  return { lit: true, level, shown: shown / count, sign };
}

/**
 * Ward 1994: equal contrast thresholds for the viewer of the screen and a person in the building.
 */
export function eyeScale(adapted) {
  const screen = 1.219 + (displayMost_cd_m2 / 2) ** 0.4;
  return (screen / (1.219 + adapted ** 0.4)) ** 2.5 / displayMost_cd_m2;
}

export class Exposure {
  constructor() {
    this.rendition = 'camera';
    this.automatic = true;
    /** Whether it adapts only as fast as eyes do. */
    this.slow = false;
    this.fixed_cd_m2 = 10;
    this.adapted = null;
    this.target = null;
    /** The colours and signs that the camera is set for. */
    this.shown = 1;
    this.sign = 0;
    this.metered = { shown: 1, sign: 0 };
  }

  /**
   * A picture without any light, as before the first light has come, is nothing to adapt to at
   * first: what follows would be white until exposure has come back.
   */
  meter(cells) {
    const metered = readMeter(cells);
    if (this.adapted === null && !metered.lit) return;
    this.metered = metered;
    this.target = this.metered.level;
  }

  /** Adapts for a while, or `atOnce`; returns true if the picture must be shown again. */
  adapt(elapsed, atOnce = false) {
    if (this.target === null) return false;
    const first = this.adapted === null;
    const set = this.setFor(first || atOnce ? 1 : 1 - Math.exp(-elapsed / seconds.camera));
    if (!this.moves) return set;
    const apart = first ? 0 : Math.log(this.target / this.adapted);
    const share = atOnce && !this.slow ? 1 : 1 - Math.exp(-elapsed / this.secondsFor(apart));
    this.adapted = first ? this.target : this.adapted * Math.exp(share * apart);
    return first || set || Math.abs(apart) > 0.005;
  }

  /** Moves to the colours and signs in view by this share; returns true while it moves. */
  setFor(share) {
    const { shown, sign } = this.metered;
    const signApart = Math.abs(sign - this.sign) / Math.max(sign, this.sign, darkest_cd_m2);
    const apart = Math.max(Math.abs(shown - this.shown), signApart);
    this.shown += share * (shown - this.shown);
    this.sign += share * (sign - this.sign);
    return apart > 0.005;
  }

  secondsFor(apart) {
    if (!this.slow) return seconds[this.rendition];
    return apart > 0 ? eyeSeconds.brighter : eyeSeconds.darker;
  }

  get moves() {
    return this.automatic && !isMap(this.rendition);
  }

  /** The luminance shown as mid grey, or to which the eye is adapted [cd/m2]. */
  get level() {
    return this.automatic ? this.adapted ?? this.fixed_cd_m2 : this.fixed_cd_m2;
  }

  get scale() {
    return this.rendition === 'eye' ? eyeScale(this.level) : (key * this.shown) / this.level;
  }

  /** How exposed values are shown. */
  get curve() {
    return cameraCurve(whitePoint, this.scale * this.sign);
  }
}
