// The shaders. Luminances are cd/m2 in linear sRGB until `tone` makes them bytes.
import { scaleHigh, scaleLow } from '../light/colour_map.js';
import { luminanceWeights, luxSteps } from '../light/colours.js';
import { flameShapeTools } from './flame_shape.js';
import { toneTools } from './tone.js';
import { whiteTools } from './white.js';

const [wr, wg, wb] = luminanceWeights;

export const common = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
float luminance(vec3 c) { return dot(c, vec3(${wr}, ${wg}, ${wb})); }
`;

/** Added to the opacity of pixels that show a sign, so that exposure finds the brightest one. */
const signMark = '16.0';
const isMarked = '> 12.0';

/** The largest half float; nothing on a screen needs more. */
export const brightest = '60000.0';

export const surfaceVertex = `${common}
in vec3 position;
in uint texel;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform sampler2D light;
out vec4 front, back;
out float height;
void main() {
  int width = textureSize(light, 0).x;
  int at = int(2u * texel);
  ivec2 place = ivec2(at % width, at / width);
  front = texelFetch(light, place, 0);
  back = texelFetch(light, place + ivec2(1, 0), 0);
  height = position.z;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const surfaceFragment = `${common}
in vec4 front, back;
in float height;
uniform float cut, above;
uniform bool illuminance;
out vec4 colour;
void main() {
  if (height > cut || height < above) discard;
  vec4 c = gl_FrontFacing ? front : back;
  colour = vec4(clamp(illuminance ? c.aaa : c.rgb, 0.0, ${brightest}), 1.0);
}`;

export const signVertex = `${common}
in vec3 position;
in vec2 uv;
uniform mat4 modelViewMatrix, projectionMatrix, modelMatrix;
out vec2 at;
out float height;
void main() {
  at = uv;
  height = (modelMatrix * vec4(position, 1.0)).z;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// The textures hold the shares of each colour in a texel: seen from afar, they give their mean.
export const signFragment = `${common}
in vec2 at;
in float height;
uniform sampler2D shares, moreShares;
uniform vec3 colours[8];
uniform float cut, above;
out vec4 colour;
void main() {
  if (height > cut || height < above) discard;
  vec4 share = texture(shares, at), more = texture(moreShares, at);
  vec3 light = share.r * colours[0] + share.g * colours[1] + share.b * colours[2] +
    share.a * colours[3] + more.r * colours[4] + more.g * colours[5] + more.b * colours[6] +
    more.a * colours[7];
  colour = vec4(clamp(light, 0.0, ${brightest}), ${signMark});
}`;

export const peopleVertex = `${common}
in vec3 position, foot, light;
in float head, eye;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float cut, shouldersBelowEyes;
out vec3 shown;
out float height;
void main() {
  float rise = head > 0.5 ? position.z + eye : position.z * max(eye - shouldersBelowEyes, 0.1);
  vec3 place = foot + vec3(position.xy, rise);
  shown = light;
  height = place.z;
  gl_Position = foot.z > cut ? vec4(0.0, 0.0, 2.0, 1.0)
    : projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}`;

export const peopleFragment = `${common}
in vec3 shown;
in float height;
uniform float above;
out vec4 colour;
void main() {
  if (height < above) discard;
  colour = vec4(clamp(shown, 0.0, ${brightest}), 1.0);
}`;

export const screenVertex = `
in vec3 position;
out vec2 at;
void main() {
  at = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

export const depthTools = `
uniform sampler2D depth;
uniform mat4 clipToWorld;
vec3 world(vec2 at, float d) {
  vec4 p = clipToWorld * vec4(2.0 * vec3(at, d) - 1.0, 1.0);
  return p.xyz / p.w;
}
`;

// Exact within a step of uniform smoke: it emits j (1 - exp(-s t)) / s, attenuated by all steps
// before it. Steps start at an offset that varies by pixel and picture, so that accumulated
// pictures show no layers. Of the light that a voxel scatters, the part in the direction of its net
// flux is scattered by the law of Henyey and Greenstein; the rest comes from all directions. Traced
// pictures use the same two moments.
export const smokeFragment = `${common}${depthTools}
in vec2 at;
uniform sampler3D glow, beam;
uniform vec3 low, size;
uniform float cut, above, shift;
uniform int steps;
uniform bool flamesAlone;
const int flamesMost = 8;
uniform sampler3D flameCells;
uniform int flameCount;
uniform vec3 flameLow[flamesMost], flameSize[flamesMost], flameColour[flamesMost],
  flameOffset[flamesMost], flameScale[flamesMost];
uniform float flameExtinction[flamesMost];
out vec4 colour;
${flameShapeTools('flamesMost')}
float start(vec2 p) {
  float noise = fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
  return fract(noise + shift);
}
/** 4 pi times what a scattering by this cosine sends into a solid angle. */
float turned(float g, float cosine) {
  float d = max(1.0 + g * g - 2.0 * g * cosine, 1e-4);
  return (1.0 - g * g) * inversesqrt(d) / d;
}
/** What a metre sends against the ray. */
vec3 towardsEye(vec3 mean, vec4 along, vec3 ray) {
  mean = max(mean, 0.0);
  float oneWay = length(along.xyz);
  float all = luminance(mean);
  if (oneWay < 1e-9 || all < 1e-9) return mean;
  float share = min(oneWay / all, 1.0);
  return mean * (1.0 + share * (turned(along.a, -dot(along.xyz, ray) / oneWay) - 1.0));
}
/** Where a ray is within a box: from x to y, nothing where y is not above x. */
vec2 within(vec3 from, vec3 inverse, vec3 corner, vec3 across, float reach) {
  vec3 a = (corner - from) * inverse;
  vec3 b = (across - from) * inverse;
  vec3 nearer = min(a, b);
  vec3 farther = max(a, b);
  return vec2(max(0.0, max(nearer.x, max(nearer.y, nearer.z))),
    min(reach, min(farther.x, min(farther.y, farther.z))));
}
/** What a stretch of a flame sends at this moment, without what it takes away of itself. */
vec3 flameAlong(int i, vec3 from, vec3 ray, vec2 part, float first) {
  const int points = 12;
  float step = (part.y - part.x) / float(points);
  float sum = 0.0, within = 0.0, middle = 0.0, radius = 0.0;
  for (int k = 0; k < points; ++k) {
    float t = part.x + (float(k) + first) * step;
    vec3 p = (from + t * ray - flameLow[i]) / flameSize[i];
    vec2 here = texture(flameCells, flameOffset[i] + clamp(p, 0.0, 1.0) * flameScale[i]).rg;
    sum += here.r;
    within += here.r > 0.0 ? 1.0 : 0.0;
    middle += here.r * t;
    radius += here.r * here.g;
  }
  if (sum <= 0.0) return vec3(0.0);
  float wide = max(flameSize[i].x, flameSize[i].y);
  float factor = flamesAlone ? 1.0 : flameFactor(i, from + middle / sum * ray, ray, radius / sum * wide,
    1.0 - exp(-flameExtinction[i] * within * step));
  return flameColour[i] * (factor * sum * step);
}
/** Optical depth of smoke between two places of a ray. */
float depthTo(vec3 from, vec3 ray, float t0, float t1, float first) {
  const int points = 8;
  float sum = 0.0;
  for (int k = 0; k < points; ++k)
    sum += texture(glow, (from + mix(t0, t1, (float(k) + first) / float(points)) * ray - low) / size).a;
  return sum * (t1 - t0) / float(points);
}
void main() {
  vec3 from = world(at, 0.0);
  vec3 along = world(at, texture(depth, at).r) - from;
  float reach = length(along);
  vec3 direction = along / max(reach, 1e-6);
  // The rays of an eye behind a mirror begin at the mirror.
  if (from.z < above) {
    float skipped = direction.z > 0.0 ? min((above - from.z) / direction.z, reach) : reach;
    from += skipped * direction;
    reach -= skipped;
  }
  vec3 top = vec3(low.xy + size.xy, min(low.z + size.z, cut));
  vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
  vec2 air = within(from, inverse, low, top, reach);
  float t0 = air.x;
  vec3 sent = vec3(0.0);
  float through = 1.0;
  float dt = (air.y - air.x) / float(steps);
  if (dt > 0.0) {
    float first = start(gl_FragCoord.xy);
    for (int i = 0; i < steps; ++i) {
      vec3 p = (from + (t0 + (float(i) + first) * dt) * direction - low) / size;
      if (flamesAlone) break;
      vec4 here = texture(glow, p);
      float s = here.a;
      float passes = exp(-s * dt);
      vec3 j = towardsEye(here.rgb, texture(beam, p), direction);
      sent += through * j * (s * dt > 1e-4 ? (1.0 - passes) / s : dt);
      through *= passes;
    }
    // Flames are smaller than steps: each is added up by itself, and attenuated up to its middle.
    for (int i = 0; i < flameCount; ++i) {
      vec3 upper = flameLow[i] + flameSize[i];
      vec2 part = within(from, inverse, flameLow[i], vec3(upper.xy, min(upper.z, cut)), reach);
      if (part.y <= part.x) continue;
      float middle = clamp(0.5 * (part.x + part.y), air.x, air.y);
      sent += exp(-depthTo(from, direction, air.x, middle, first)) *
        flameAlong(i, from, direction, part, first);
    }
  }
  colour = vec4(min(sent, ${brightest}), through);
}`;

// Smoke is marched at a lower resolution; of its four neighbours only those at this pixel's depth
// count, so that no fog spills over edges. Comes after `depthTools`.
export const smokeTools = `
uniform sampler2D smoke;
uniform vec4 unproject;
float far(sampler2D depths, vec2 p) {
  float z = 2.0 * texture(depths, p).r - 1.0;
  return -(unproject.x * z + unproject.y) / (unproject.z * z + unproject.w);
}
vec4 smokeHere(vec2 at) {
  ivec2 size = textureSize(smoke, 0);
  vec2 raster = vec2(size);
  vec2 p = at * raster - 0.5;
  vec2 corner = floor(p);
  vec2 share = p - corner;
  float here = far(depth, at);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 o = vec2(i & 1, i >> 1);
    ivec2 cell = clamp(ivec2(corner + o), ivec2(0), size - 1);
    vec2 q = (corner + o + 0.5) / raster;
    vec2 s = mix(1.0 - share, share, o);
    float w = (s.x * s.y + 1e-4) / (0.02 + abs(far(depth, q) - here) / (1.0 + here));
    sum += w * texelFetch(smoke, cell, 0);
    weights += w;
  }
  return sum / weights;
}
`;

export const composeFragment = `${common}${depthTools}${smokeTools}
in vec2 at;
uniform sampler2D surfaces, before;
uniform float weight;
uniform bool smoky;
out vec4 colour;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(surfaces, pixel, 0);
  vec3 c = surface.rgb;
  if (smoky) {
    vec4 s = smokeHere(at);
    c = c * s.a + s.rgb;
  }
  vec3 old = weight < 1.0 ? texelFetch(before, pixel, 0).rgb : vec3(0.0);
  colour = vec4(mix(old, c, weight), surface.a ${isMarked} ? ${signMark} : 1.0);
}`;

/**
 * Of the pixels with light in a cell: the sum of log2 luminance, their number, the sum of the
 * largest luminances that a screen shows of their colours; and the brightest pixel of a sign, or of
 * the means of steady flames, whose moments are brighter.
 */
export const meterFragment = `${common}
in vec2 at;
uniform sampler2D picture, flames;
uniform float brighterThanMean;
out vec4 colour;
float brightestShown(vec3 c) {
  return clamp(luminance(c) / max(max(c.r, max(c.g, c.b)), 1e-12), 0.0, 1.0);
}
void main() {
  vec2 cell = 1.0 / vec2(32.0);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 16; ++i) {
    vec2 o = (vec2(i & 3, i >> 2) + 0.5) / 4.0 - 0.5;
    vec4 c = texture(picture, at + o * cell);
    float y = luminance(c.rgb);
    if (y > 1e-5) sum += vec4(log2(y), 1.0, brightestShown(c.rgb), 0.0);
    if (c.a ${isMarked}) sum.a = max(sum.a, y);
    sum.a = max(sum.a, brighterThanMean * luminance(texture(flames, at + o * cell).rgb));
  }
  colour = sum;
}`;

// CIE 191 (MES2) with scotopic luminance estimated from three colours (Larson, Rushmeier and Piatko
// 1997); brightness by Ward's contrast-based scale factor (1994), passed as `scale`.
const eye = `
vec3 toXyz(vec3 c) {
  return mat3(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505) * c;
}
// balanced: the colour as it looks on the monitor.
vec3 eyeSees(vec3 c, vec3 balanced) {
  vec3 xyz = max(toXyz(c), 1e-9);
  float photopic = xyz.y;
  float scotopic = photopic * clamp(1.33 * (1.0 + (xyz.y + xyz.z) / xyz.x) - 1.68, 0.1, 8.0);
  float m = 0.5;
  float seen = photopic;
  const float rods = 683.0 / 1699.0;
  for (int i = 0; i < 6; ++i) {
    seen = (m * photopic + (1.0 - m) * scotopic * rods) / (m + (1.0 - m) * rods);
    m = clamp(0.767 + 0.3334 * log(max(seen, 1e-6)) / log(10.0), 0.0, 1.0);
  }
  vec3 grey = vec3(0.94, 0.99, 1.14);
  return mix(grey / luminance(grey), balanced / photopic, m) * seen;
}
`;

export const toneFragment = `${common}${eye}${toneTools}${whiteTools}
in vec2 at;
uniform sampler2D picture, scaleColours;
uniform int mode;
uniform float scale, fade, seed;
out vec4 colour;
vec3 encode(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
vec3 falseColour(float y) {
  const float decades = ${Math.log10(scaleHigh / scaleLow).toFixed(4)};
  float t = log(max(y, 1e-12) / ${scaleLow.toExponential(3)}) / log(10.0) / decades;
  return texture(scaleColours, vec2(clamp(t, 0.002, 0.998), 0.5)).rgb;
}
const float luxSteps[${luxSteps.length}] = float[](${luxSteps.map((e) => e.toFixed(2)).join(', ')});
/** One colour from each step to the next, so that their edges are lines of equal illuminance. */
vec3 luxColour(float lux) {
  int above = 0;
  for (int i = 0; i < luxSteps.length(); ++i) above += lux >= luxSteps[i] ? 1 : 0;
  float t = (float(above) + 0.5) / float(luxSteps.length() + 1);
  return texture(scaleColours, vec2(t, 0.5)).rgb;
}
float grain(vec2 p) {
  return fract(52.9829189 * fract(dot(p + seed, vec2(0.06711056, 0.00583715)))) - 0.5;
}
void main() {
  vec3 c = max(texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb, 0.0);
  vec3 shown;
  if (mode == 2) shown = falseColour(luminance(c));
  else if (mode == 3) shown = luxColour(c.g);
  else {
    vec3 balanced = onMonitor(c);
    c = mode == 1 ? eyeSees(c, balanced) : balanced;
    shown = encode(displayColour(c, shownOf(luminance(c) * scale)));
  }
  shown = mix(shown, vec3(0.35 * dot(shown, vec3(0.3, 0.6, 0.1)) + 0.06), 0.75 * fade);
  colour = vec4(shown + grain(gl_FragCoord.xy) / 255.0, 1.0);
}`;

export const markVertex = `
precision highp float;
in vec3 position;
in vec3 tint;
in float kind;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform float size;
out vec3 ink;
out float shape, nearDepth;
// What is mounted on a wall or recessed in a ceiling is not behind it.
const float mounted_m = 0.3;
void main() {
  ink = tint;
  shape = kind;
  vec4 place = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * place;
  float far = length(place.xyz);
  place.xyz *= max(far - mounted_m, 0.1 * far) / max(far, 1e-6);
  vec4 nearer = projectionMatrix * place;
  nearDepth = 0.5 + 0.5 * nearer.z / nearer.w;
  gl_PointSize = size * (kind > 2.5 ? 1.8 : 1.0);
}`;

// Rings for luminaires, drops for flames, squares for signs, a disc for the walker; walls hide
// marks.
export const markFragment = `${common}
in vec3 ink;
in float shape, nearDepth;
uniform sampler2D depth;
uniform vec2 raster;
uniform bool plan;
out vec4 colour;
void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float r = length(p);
  float edge = shape < 0.5 ? abs(r - 0.62) - 0.2
             : shape < 1.5 ? r - 0.55
             : shape < 2.5 ? abs(max(abs(p.x), abs(p.y)) - 0.55) - 0.18
             : r - 0.5;
  float cover = 1.0 - smoothstep(-0.06, 0.1, edge);
  float wall = texture(depth, gl_FragCoord.xy / raster).r;
  if (!plan && nearDepth > wall + 1e-5) discard;
  colour = vec4(ink, cover * 0.9);
  if (colour.a < 0.01) discard;
}`;

export const pictureVertex = `
precision highp float;
in vec3 position;
in vec2 uv;
out vec2 at;
uniform mat4 modelViewMatrix, projectionMatrix;
void main() {
  at = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

export const pictureFragment = `
precision highp float;
in vec2 at;
uniform sampler2D picture;
uniform float faint;
out vec4 colour;
void main() { colour = vec4(texture(picture, at).rgb, faint); }`;

export const lineVertex = `
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

export const lineFragment = `
precision highp float;
uniform vec4 ink;
out vec4 colour;
void main() { colour = ink; }`;
