// The turbulent shape of a steady flame at a moment. A scene says the mean of a flame: a body that
// glows and absorbs evenly. A moment multiplies what a line through it gives and takes by a random
// factor, whose mean over time is 1 on every line. So mean emission and mean transmittance are
// those of the scene; a field of densities with the right mean would be too transparent (Jensen).
// For pictures alone: light, verdicts and signs stay with the mean. Design:
// docs/decisions/0096-flames-at-a-moment.md. Immutable once made; any thread.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "scenes/light/optics/quadric_body.hpp"

namespace luxodus {

class FlameShape {
 public:
  /// `seed`: flames of different seeds move independently. Requires: `body` outlives this.
  FlameShape(const QuadricBody& body, uint32_t seed);

  /// Factor on the light that the flame sends along a line, and on the share of light from behind
  /// that it takes away. From 0 to 1 / `opacity`, continuous in place and time; its mean over time
  /// is 1. `o`, `d`: the line, `d` of unit length. `chord`: the line's interval in the body.
  /// `opacity`: the largest share that the mean flame takes away in any band, 0 to 1.
  double factor(const glm::dvec3& o, const glm::dvec3& d, const RayInterval& chord, double opacity,
                double time_s) const;

  /// The field that moves the flame at a place: standard normal over time, and over seeds.
  double field(const glm::dvec3& place, double time_s) const;

 private:
  double off_axis(const glm::dvec3& place, const glm::dvec3& d) const;

  const QuadricBody& body_;
  uint32_t seed_;
  glm::dvec3 base_{0};  // middle of its lowest level
  double height_m_ = 1, width_m_ = 1;
};

}  // namespace luxodus
