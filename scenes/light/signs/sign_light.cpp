#include "scenes/light/signs/sign_light.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/light/signs/onset.hpp"

namespace luxodus {
namespace {

double lerp_between(const glm::dvec2& a, const glm::dvec2& b, double seconds) {
  const bool powers = a.x > 0 && a.y > 0 && b.y > 0;
  if (!powers) return a.y + (b.y - a.y) * (seconds - a.x) / (b.x - a.x);
  const double t = std::log(seconds / a.x) / std::log(b.x / a.x);
  return a.y * std::pow(b.y / a.y, t);
}

}  // namespace

double decay_share(const std::vector<glm::dvec2>& decay, double seconds) {
  if (decay.empty()) return 1;
  if (seconds <= decay.front().x || decay.size() == 1) return decay.front().y;
  const auto next = std::find_if(decay.begin(), decay.end(),
                                 [&](const glm::dvec2& point) { return point.x >= seconds; });
  if (next != decay.end()) return lerp_between(*(next - 1), *next, seconds);
  const double beyond = lerp_between(decay[decay.size() - 2], decay.back(), seconds);
  return std::clamp(beyond, 0.0, decay.back().y);
}

double sign_luminance(const Sign& sign, ColourIndex colour, Operation operation,
                      double seconds_after_failure, double cos_from_normal) {
  if (colour >= sign.colours.size() || !(cos_from_normal > 0)) return 0;
  if (sign.lighting == SignLighting::external) return 0;
  const bool glows = sign.lighting == SignLighting::photoluminescent;
  if (operation == Operation::dark && !glows) return 0;
  const bool mains = operation == Operation::mains;
  if (!mains && !glows && is_exhausted(sign.duration_s, seconds_after_failure)) return 0;
  const FaceColour& own = sign.colours[colour];
  const double normal_cd_m2 = mains ? own.mains_cd_m2 : own.emergency_cd_m2;
  const double left = glows && !mains ? decay_share(sign.decay, seconds_after_failure) : 1.0;
  return normal_cd_m2 * left * std::pow(std::min(cos_from_normal, 1.0), sign.angular_exponent);
}

}  // namespace luxodus
