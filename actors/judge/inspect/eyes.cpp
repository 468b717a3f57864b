// Inspects observers, cameras and probes: whether anything is visible from where they are, with and
// without smoke.
#include <algorithm>
#include <cmath>

#include "actors/judge/inspect/site.hpp"
#include "scenes/emergency/sign_geometry.hpp"
#include "scenes/light/transport/emitted_light.hpp"

namespace luxodus {

namespace {

constexpr Real sight_m = 1e5_r;
/// With a lower transmission, the brightest lamp is invisible beside the darkest wall.
constexpr double min_transmission = 1e-4;
/// Rays across and down a camera's picture.
constexpr int rays_across = 16;
constexpr int rays_down = 9;
constexpr int rays_around = 128;
/// A probe on a surface is tested from this far in front of it [m].
constexpr double before_probe_m = 1e-3;
/// A probe with a surface this close in front of it measures that surface [m].
constexpr Real shut_probe_m = 0.05_r;

struct EyePlace {
  std::string name;  // camera "hall"
  SourcePlace place;
  glm::dvec3 at{0};
  std::vector<Vec3> directions{};  // of its gaze
  Vec3 ahead{0, 0, 1};             // mean of the directions
  Real min_cosine = -1;            // between `ahead` and what it sees
  bool is_camera = false, is_probe = false;
};

EyePlace eye_of(const Camera& c) {
  EyePlace eye{"camera \"" + c.name + "\"", c.place, c.eye};
  eye.is_camera = true;
  const glm::dvec3 ahead = glm::normalize(c.target - c.eye);
  const glm::dvec3 across = glm::cross(ahead, c.up);
  const glm::dvec3 right =
      glm::length(across) > 1e-9 ? glm::normalize(across) : glm::dvec3(1, 0, 0);
  const glm::dvec3 up = glm::cross(right, ahead);
  const double high = std::tan(glm::radians(c.vertical_fov_deg) / 2);
  const double wide = high * c.width / std::max(c.height, 1);
  eye.ahead = Vec3(ahead);
  eye.min_cosine = static_cast<Real>(1 / std::sqrt(1 + high * high + wide * wide));
  for (int j = 0; j < rays_down; ++j)
    for (int i = 0; i < rays_across; ++i) {
      const double u = 2 * (i + 0.5) / rays_across - 1, v = 2 * (j + 0.5) / rays_down - 1;
      eye.directions.emplace_back(glm::normalize(ahead + right * (u * wide) + up * (v * high)));
    }
  return eye;
}

EyePlace eye_of(const Observer& o) {
  return {"observer \"" + o.name + "\"", o.place, o.eye, sphere_directions(rays_around)};
}

EyePlace eye_of(const ProbeMeasure& p) {
  EyePlace eye{"probe \"" + p.name + "\"", p.place, p.position + p.normal * before_probe_m};
  eye.ahead = Vec3(p.normal);
  eye.is_probe = true;
  eye.min_cosine = 0;
  for (const Vec3& d : sphere_directions(rays_around))
    if (glm::dot(d, Vec3(p.normal)) > 0) eye.directions.push_back(d);
  return eye;
}

std::vector<EyePlace> eyes_of(const SceneDescription& scene, bool probes) {
  std::vector<EyePlace> out;
  for (const Observer& o : scene.observers) out.push_back(eye_of(o));
  // A camera that cuts stands outside and looks past what is in its way.
  for (const Camera& c : scene.cameras)
    if (!c.cut_m) out.push_back(eye_of(c));
  if (probes)
    for (const ProbeMeasure& p : scene.probes) out.push_back(eye_of(p));
  return out;
}

bool is_open(const FacedSurface& facing) {
  return facing.kind == MaterialKind::open;
}

/// Counts surfaces and lamps; where no surface is, nothing hides a lamp.
bool sees_anything(const Site& site, const GeometryAccess& access, const EyePlace& eye) {
  const CompiledScene& scene = site.building.scene();
  const Vec3 at = site.building.local(eye.at);
  const bool surface =
      std::any_of(eye.directions.begin(), eye.directions.end(), [&](const Vec3& d) {
        return first_stop(scene, access, at, d, sight_m, is_open).has_value();
      });
  return surface ||
         std::any_of(site.scene.emitters.begin(), site.scene.emitters.end(), [&](const Emitter& e) {
           const Vec3 way = Vec3(e.frame.origin - eye.at);
           return glm::dot(way, eye.ahead) >= eye.min_cosine * glm::length(way);
         });
}

/// Whether all rays hit backs: then it is under the floor or behind a wall.
bool sees_backs_alone(const Site& site, const GeometryAccess& access, const EyePlace& eye) {
  const Vec3 at = site.building.local(eye.at);
  bool any = false;
  for (const Vec3& d : eye.directions) {
    const auto met = first_stop(site.building.scene(), access, at, d, sight_m, is_open);
    if (!met) continue;
    if (!site.is_back(*met)) return false;
    any = true;
  }
  return any;
}

/// Whether it sees one of the signs that concern this observer.
bool sees_a_sign(const Site& site, const GeometryAccess& access, const Observer& observer) {
  const auto& signs = site.scene.signs;
  for (uint32_t i = 0; i < signs.size(); ++i) {
    const auto& asked = observer.signs;
    if (asked && std::find(asked->begin(), asked->end(), i) == asked->end()) continue;
    const SignView view = view_of_sign(signs[i], observer.eye);
    if (!view.behind && site.building.seen_share(access, signs[i], view, observer.eye) > 0)
      return true;
  }
  return false;
}

std::optional<Finding> wrong_eye(const Site& site, const GeometryAccess& access,
                                 const EyePlace& eye) {
  if (auto far = site.remote.told(eye.name, eye.at))
    return Finding{Severity::error, "far", {eye.place, *far}};
  if (site.in_body(access, eye.at))
    return Finding{Severity::error,
                   "inside",
                   {eye.place, eye.name + " is inside a wall or body, at " + place_text(eye.at) +
                                   ": move it out"}};
  if (!sees_anything(site, access, eye))
    return Finding{Severity::warning,
                   "sees nothing",
                   {eye.place, eye.name + " sees nothing: no surface and no lamp lies where it "
                                          "looks; turn it round, or move it"}};
  if (eye.is_camera && sees_backs_alone(site, access, eye))
    return Finding{
        Severity::warning,
        "sees nothing",
        {eye.place, eye.name + " sees the backs of surfaces alone, from " + place_text(eye.at) +
                        ": is it under the floor, above the ceiling or behind a wall? "
                        "Move it into the room"}};
  if (!eye.is_probe) return std::nullopt;
  const auto shut =
      first_stop(site.building.scene(), access, site.building.local(eye.at), eye.ahead,
                 shut_probe_m, [&](const FacedSurface& f) {
                   return f.surface >= site.scene.objects.size() || lets_light_through(f.kind);
                 });
  if (shut)
    return Finding{Severity::warning,
                   "sees nothing",
                   {eye.place, fmt::format("{} looks at {}, {} before it: turn its normal round",
                                           eye.name, object_text(site.scene.objects[shut->surface]),
                                           length_text(static_cast<double>(shut->distance_m)))}};
  return std::nullopt;
}

/// The highest transmittance of smoke from an eye to a surface [1].
double best_transmission(const Building& smoky, const GeometryAccess& access, const EyePlace& eye) {
  const CompiledScene& scene = smoky.scene();
  const Vec3 at = smoky.local(eye.at);
  double best = 0;
  for (const Vec3& d : eye.directions) {
    const auto met = first_stop(scene, access, at, d, sight_m,
                                [](const FacedSurface& f) { return lets_light_through(f.kind); });
    const Real length = met ? met->distance_m : sight_m;
    best = std::max(best, media_share(scene, access, at, d, length));
    if (best >= min_transmission) break;
  }
  return best;
}

}  // namespace

void inspect_eyes(const Site& site, Findings& out) {
  const std::vector<EyePlace> eyes = eyes_of(site.scene, true);
  std::vector<std::optional<Finding>> found(eyes.size());
  site.building.each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
    found[i] = wrong_eye(site, access, eyes[i]);
    const auto& observers = site.scene.observers;  // observers come first among the eyes
    if (found[i] || i >= observers.size() || site.scene.signs.empty()) return;
    if (!sees_a_sign(site, access, observers[i]))
      found[i] = Finding{Severity::warning,
                         "sees nothing",
                         {eyes[i].place, eyes[i].name + " sees no sign: each of them is hidden or "
                                                        "seen from behind; move it"}};
  });
  for (auto& finding : found)
    if (finding) out.push_back(std::move(*finding));
}

void inspect_smoke(const SceneDescription& scene, const Building& smoky, Findings& out) {
  if (smoky.scene().features.media == MediaNeed::none) return;
  const std::vector<EyePlace> eyes = eyes_of(scene, false);
  std::vector<char> blind(eyes.size(), 0);
  smoky.each(eyes.size(), [&](const GeometryAccess& access, size_t i) {
    blind[i] = best_transmission(smoky, access, eyes[i]) < min_transmission ? 1 : 0;
  });
  for (size_t i = 0; i < eyes.size(); ++i)
    if (blind[i] != 0)
      out.push_back({Severity::note,
                     "smoke",
                     {eyes[i].place, eyes[i].name + " stands in smoke that passes less than 1e-4 "
                                                    "of the light of anything it looks at: it "
                                                    "sees scattered light alone"}});
}

}  // namespace luxodus
