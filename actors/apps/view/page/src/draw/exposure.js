// Exposure of the picture. Pure: takes meter readings, returns a scale.
export const renditions = { camera: 0, eye: 1, luminance: 2 };

/** Mid grey of a camera; and the smallest luminance that automatic exposure raises to it. */
const key = 0.18;
const darkest_cd_m2 = 1e-4;
/** White point: this multiple of the luminance that is shown as half of full white. */
export const whitePoint = 6;
/** A typical monitor, for the eye's rendition [cd/m2]. */
const displayMost_cd_m2 = 250;
const seconds = { camera: 0.35, eye: 1.2 };
/**
 * Speeds of the eye's adaptation, in the logarithm of luminance: nerves adapt to more light at
 * once; in the dark the pigment of cones regenerates with a time constant of two minutes (Rushton
 * and Henry 1968).
 */
const eyeSeconds = { brighter: 1, darker: 120 };

/** Log-average luminance of meter cells: sum of log2 luminance, pixels, and two unused. */
export function readMeter(cells) {
  let log = 0;
  let count = 0;
  for (let i = 0; i < cells.length; i += 4) {
    log += cells[i];
    count += cells[i + 1];
  }
  return count > 0 ? Math.max(darkest_cd_m2, 2 ** (log / count)) : darkest_cd_m2;
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
  }

  meter(cells) {
    this.target = readMeter(cells);
  }

  /** Adapts for a while, or `atOnce`; returns true if the picture must be shown again. */
  adapt(elapsed, atOnce = false) {
    if (this.target === null || !this.moves) return false;
    const first = this.adapted === null;
    const apart = first ? 0 : Math.log(this.target / this.adapted);
    const share = atOnce && !this.slow ? 1 : 1 - Math.exp(-elapsed / this.secondsFor(apart));
    this.adapted = first ? this.target : this.adapted * Math.exp(share * apart);
    return first || Math.abs(apart) > 0.005;
  }

  secondsFor(apart) {
    if (!this.slow) return seconds[this.rendition];
    return apart > 0 ? eyeSeconds.brighter : eyeSeconds.darker;
  }

  get moves() {
    return this.automatic && this.rendition !== 'luminance';
  }

  /** The luminance shown as mid grey, or to which the eye is adapted [cd/m2]. */
  get level() {
    return this.automatic ? this.adapted ?? this.fixed_cd_m2 : this.fixed_cd_m2;
  }

  get scale() {
    return this.rendition === 'eye' ? eyeScale(this.level) : key / this.level;
  }
}
