// The veil of one lamp over a line of sight through thin smoke, scattered once, so that an integral
// along the line is exact. For cases of lamps and of luminaires. Pure; any thread.
#pragma once

#include <functional>
#include <memory>

#include "actors/judge/validate/case.hpp"

namespace luxodus::light {

/// The line of sight is the x axis, from 0 to 4 m.
inline constexpr glm::dvec3 veil_lamp{1.2, 0.35, 1.1};

struct VeilCase {
  Phase phase;
  std::function<double(double cosine)> density;  // phase function [1/sr]
  double flux_lm = 0;
  std::function<double(const glm::dvec3&)> candela;  // by the direction of emission
  std::shared_ptr<const PhotometricWeb> web;         // none: uniform
  bool sheet = false;                                // hides the lamp from half of the line
  double bias = 0;                                   // relative
};

PreparedCase veil_plan(const VeilCase& veil);

}  // namespace luxodus::light
