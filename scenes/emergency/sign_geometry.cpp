#include "scenes/emergency/sign_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxodus {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double arcmin = 60.0 * degrees;
/// A face whose normal has a horizontal part shorter than this lies on the floor or under the
/// ceiling.
constexpr double level_normal = 1e-3;
/// Lines to a face end at this distance before it [m].
constexpr double before_face_m = 1e-3;

/// Angle between two directions. With atan2 small and nearly flat angles keep all digits; with acos
/// they would lose half of them.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Angle that a segment subtends at the eye; `half` reaches from its centre to one end.
double extent(const glm::dvec3& eye, const glm::dvec3& centre, const glm::dvec3& half) {
  return angle_between(centre - half - eye, centre + half - eye);
}

}  // namespace

SignView view_of_sign(const Sign& sign, const glm::dvec3& eye) {
  SignView view;
  view.centre = sign.frame.origin;
  view.normal = sign.frame.axes[2];
  const glm::dvec3 back = sign.frame.origin - sign.thickness_m * sign.frame.axes[2];
  if (sign.double_sided && glm::dot(eye - back, view.normal) < 0) {
    view.back_face = true;
    view.centre = back;
    view.normal = -view.normal;
  }
  const glm::dvec3 to_eye = eye - view.centre;
  view.distance_m = glm::length(to_eye);
  view.angle_deg = angle_between(view.normal, to_eye) * degrees;
  view.behind = !(glm::dot(view.normal, to_eye) > 0);
  if (view.behind) return view;
  const glm::dvec3 half_width = 0.5 * sign.width_m * sign.frame.axes[0];
  const glm::dvec3 half_height = 0.5 * sign.height_m * sign.frame.axes[1];
  view.width_arcmin = extent(eye, view.centre, half_width) * arcmin;
  view.height_arcmin = extent(eye, view.centre, half_height) * arcmin;
  // A detail may lie in the plane of the tilt, where foreshortening is largest.
  const double seen_m = sign.smallest_detail_m * glm::dot(view.normal, to_eye) / view.distance_m;
  view.detail_arcmin = 2 * std::atan2(seen_m / 2, view.distance_m) * arcmin;
  return view;
}

ViewingDistance viewing_distance(const Sign& sign, const SignView& view) {
  ViewingDistance rule;
  rule.factor = sign.lighting == SignLighting::internal ? 200 : 100;
  rule.allowed_m = rule.factor * sign.height_m;
  rule.allowed_oblique_m = rule.allowed_m * std::max(0.0, std::cos(view.angle_deg / degrees));
  rule.within = !view.behind && view.distance_m <= rule.allowed_oblique_m;
  return rule;
}

PlanLine plan_line(const SignView& view, const glm::dvec3& eye) {
  PlanLine line;
  const glm::dvec2 normal(view.normal), to_eye(glm::dvec2(eye) - glm::dvec2(view.centre));
  const bool lies_level = glm::length(normal) < level_normal;
  // The end is moved off the face, so that the wall behind it does not hide it.
  const glm::dvec2 off = lies_level ? glm::dvec2(0) : before_face_m * glm::normalize(normal);
  line.to = {glm::dvec2(view.centre) + off, eye.z};
  line.distance_m = glm::length(line.to - eye);
  const bool turned = !lies_level && glm::length(to_eye) > before_face_m;
  line.cosine =
      turned ? std::max(0.0, glm::dot(glm::normalize(normal), glm::normalize(to_eye))) : 1;
  return line;
}

}  // namespace luxodus
