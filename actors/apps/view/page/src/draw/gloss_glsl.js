// The shaders of glossy floors and of the luminous faces of lamps.
import { brightest, common, depthTools, smokeTools } from './glsl.js';

export const lampVertex = `${common}
in vec3 position, normal;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 place, axis;
void main() {
  place = position;
  axis = normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// A table has the density of light by direction [1/sr] divided by the cosine to its axis: times
// flux by area, that is luminance. For curved faces that shine like a luminaire it has the density
// alone, and each point uses its own cosine. Faces have too few triangles to resolve small cosines.
export const lampFragment = `${common}
in vec3 place, axis;
uniform sampler2D table;
uniform mat3 frame;
uniform bool ofLuminaire, byOwnCosine;
uniform vec3 light, cameraPosition;
uniform float cut, above;
out vec4 colour;
const float pi = 3.14159265, leastCosine = 0.05;
void main() {
  if (place.z > cut || place.z < above) discard;
  vec3 to = normalize(cameraPosition - place);
  vec3 local = ofLuminaire ? to * frame : vec3(0.0, 0.0, -dot(normalize(axis), to));
  float polar = acos(clamp(-local.z, -1.0, 1.0)) / pi;
  float azimuth = abs(local.x) + abs(local.y) > 1e-6 ? atan(local.y, local.x) / (2.0 * pi) : 0.0;
  float value = texture(table, vec2(azimuth, polar)).r;
  if (byOwnCosine) value /= max(leastCosine, dot(normalize(axis), to));
  colour = vec4(clamp(light * value, 0.0, ${brightest}), 1.0);
}`;

// The picture behind the mirror, with the smoke between the mirror and what is seen in it. Where a
// wall hides the mirror from the eye, the picture has weight 0 (its fourth channel): light from
// behind the wall must not leak into its blurred neighbourhood.
export const behindFragment = `${common}${depthTools}${smokeTools}
in vec2 at;
uniform sampler2D surfaces, eyeDepth;
uniform mat4 toEye;
uniform float above;
uniform bool smoky;
out vec4 colour;
void main() {
  vec3 c = texelFetch(surfaces, ivec2(gl_FragCoord.xy), 0).rgb;
  if (smoky) {
    vec4 s = smokeHere(at);
    c = c * s.a + s.rgb;
  }
  vec3 from = world(at, 0.0);
  vec3 along = world(at, 1.0) - from;
  bool upwards = along.z > 0.0;
  vec4 p = toEye * vec4(from + along * ((above - from.z) / (upwards ? along.z : 1.0)), 1.0);
  vec3 mirror = 0.5 + 0.5 * p.xyz / p.w;
  bool outside = any(lessThan(mirror, vec3(0.0))) || any(greaterThan(mirror, vec3(1.0)));
  bool hidden = !outside && far(eyeDepth, mirror.xy) < 0.99 * p.w - 0.05;
  float weight = upwards && p.w > 0.0 && !hidden ? 1.0 : 0.0;
  colour = weight * vec4(c, 1.0);
}`;

export const glossVertex = `${common}
in vec3 position;
uniform mat4 modelViewMatrix, projectionMatrix;
out vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// The tracer's GGX lobe (scenes/light/optics/surface.hpp): visible normals sampled after Heitz
// 2018, masked after Heitz 2014. Each sample follows its ray until it is behind what the mirrored
// eye sees there, so that no light comes from behind a wall. It reads the picture blurred by the
// solid angle of the sample (Krivanek and Colbert 2008, filtered importance sampling).
export const glossFragment = `${common}
in vec3 place;
uniform sampler2D behind, mirrorDepth;
uniform mat4 toMirror;
uniform vec3 cameraPosition, share;
uniform float roughness, pixel;
uniform int samples, first;
out vec4 colour;
const float pi = 3.14159265;
float noise(vec2 p) {
  return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715))));
}
vec3 visibleNormal(vec3 wo, float u, float v) {
  vec3 view = normalize(vec3(roughness * wo.xy, wo.z));
  float level = dot(view.xy, view.xy);
  vec3 t1 = level > 1e-12 ? vec3(-view.y, view.x, 0.0) * inversesqrt(level) : vec3(1.0, 0.0, 0.0);
  vec3 t2 = cross(view, t1);
  float r = sqrt(u);
  vec2 disc = r * vec2(cos(2.0 * pi * v), sin(2.0 * pi * v));
  float visible = 0.5 * (1.0 + view.z);
  float y = (1.0 - visible) * sqrt(max(0.0, 1.0 - disc.x * disc.x)) + visible * disc.y;
  float z = sqrt(max(0.0, 1.0 - disc.x * disc.x - y * y));
  vec3 h = t1 * disc.x + t2 * y + view * z;
  return normalize(vec3(roughness * h.xy, max(1e-6, h.z)));
}
float stretch(float cosine) {
  float square = cosine * cosine;
  return sqrt(square + roughness * roughness * max(0.0, 1.0 - square));
}
/** Where a place is in the picture, and how deep. */
vec3 seenAt(vec3 point) {
  vec4 p = toMirror * vec4(point, 1.0);
  return clamp(0.5 + 0.5 * p.xyz / max(p.w, 1e-3), 0.0, 1.0);
}
/** How far a ray from here goes until it is behind what is seen [m]. */
float reachOf(vec3 wi, float jitter) {
  const int doublings = 8, halvings = 3;
  float before = 0.0;
  float t = 0.15 * exp2(jitter);
  for (int i = 0; i < doublings; ++i) {
    vec3 there = seenAt(place + t * wi);
    if (there.z > texture(mirrorDepth, there.xy).r) break;
    before = t;
    t *= 2.0;
  }
  for (int i = 0; i < halvings; ++i) {
    float middle = 0.5 * (before + t);
    vec3 there = seenAt(place + middle * wi);
    if (there.z > texture(mirrorDepth, there.xy).r) t = middle;
    else before = middle;
  }
  return 0.5 * (before + t);
}
/** The picture there, of what has a weight. */
vec3 pictureAt(vec2 there, float blur, vec3 otherwise) {
  vec4 c = textureLod(behind, there, blur);
  return c.a > 1e-3 ? c.rgb / c.a : otherwise;
}
void main() {
  vec3 wo = cameraPosition - place;
  float away = length(wo);
  wo /= away;
  wo.z = max(wo.z, 1e-4);
  vec3 straight = vec3(-wo.xy, wo.z);
  vec2 here = seenAt(place + straight).xy;
  vec3 sharp = pictureAt(here, 0.0, vec3(0.0));
  if (roughness < 1e-3) {
    colour = vec4(share * sharp, 1.0);
    return;
  }
  vec2 turn = vec2(noise(gl_FragCoord.xy), noise(gl_FragCoord.yx + 47.0));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < samples; ++i) {
    vec2 u = fract(turn + float(first + i) * vec2(0.7548777, 0.5698403));
    vec3 h = visibleNormal(wo, u.x, u.y);
    vec3 wi = 2.0 * dot(wo, h) * h - wo;
    if (wi.z <= 0.0) continue;
    float d = h.z * h.z * roughness * roughness + max(0.0, 1.0 - h.z * h.z);
    d = roughness * roughness / (pi * d * d);
    float so = stretch(wo.z);
    float si = stretch(wi.z);
    float density = 0.5 * d / (wo.z + so);
    float far = reachOf(wi, fract(u.x + 7.0 * u.y));
    float nearer = far / (away + far);
    float cells = nearer * nearer / (float(samples) * density * pixel);
    float masked = min(1.0, wi.z * (wo.z + so) / (wi.z * so + wo.z * si));
    float blur = max(0.0, 0.5 * log2(cells) + 1.0);
    sum += masked * pictureAt(seenAt(place + far * wi).xy, blur, sharp);
  }
  colour = vec4(min(share * sum / float(samples), vec3(${brightest})), 1.0);
}`;
