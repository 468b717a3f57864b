#include "scenes/emergency/sign_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/emergency/sign_face.hpp"

namespace luxodus {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double arcmin = 60.0 * degrees;

/// Angle between two directions; the form with atan2 keeps its digits for small and for flat
/// angles, where acos loses half of them.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Angle that a segment around a centre takes up for the eye.
double extent(const glm::dvec3& eye, const glm::dvec3& centre, const glm::dvec3& half) {
  return angle_between(centre - half - eye, centre + half - eye);
}

double lerp_between(const glm::dvec2& a, const glm::dvec2& b, double seconds) {
  const bool powers = a.x > 0 && a.y > 0 && b.y > 0;
  if (!powers) return a.y + (b.y - a.y) * (seconds - a.x) / (b.x - a.x);
  const double t = std::log(seconds / a.x) / std::log(b.x / a.x);
  return a.y * std::pow(b.y / a.y, t);
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
  // A detail may lie in the plane of the tilt, where it shrinks most.
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

double decay_share(const std::vector<glm::dvec2>& decay, double seconds) {
  if (decay.empty()) return 1;
  if (seconds <= decay.front().x || decay.size() == 1) return decay.front().y;
  const auto next = std::find_if(decay.begin(), decay.end(),
                                 [&](const glm::dvec2& point) { return point.x >= seconds; });
  if (next != decay.end()) return lerp_between(*(next - 1), *next, seconds);
  const double beyond = lerp_between(decay[decay.size() - 2], decay.back(), seconds);
  return std::clamp(beyond, 0.0, decay.back().y);
}

double sign_luminance(const Sign& sign, SignColour colour, Operation operation,
                      double seconds_after_failure, double cos_from_normal) {
  if (colour == SignColour::other || !(cos_from_normal > 0)) return 0;
  if (sign.lighting == SignLighting::external) return 0;
  const bool glows = sign.lighting == SignLighting::photoluminescent;
  if (operation == Operation::dark && !glows) return 0;
  const bool mains = operation == Operation::mains;
  const SignState& state = mains ? sign.mains : sign.emergency;
  const double normal_cd_m2 = colour == SignColour::white ? state.white_cd_m2 : state.green_cd_m2;
  const double left = glows && !mains ? decay_share(sign.decay, seconds_after_failure) : 1.0;
  return normal_cd_m2 * left * std::pow(std::min(cos_from_normal, 1.0), sign.angular_exponent);
}

}  // namespace luxodus
