// Directions towards the glow around emitters in smoke. Near an emitter smoke is bright, and a path
// that is turned by a phase function or a surface alone seldom goes there, but brings much when it
// does. So a part of the turns are aimed at spheres around emitters. Whoever turns a path weights
// both ways by the balance heuristic: `density` is that of aimed turns. Not here: light that
// emitters send straight (next_event.hpp). One thread or fiber at a time.
#pragma once

#include <cmath>
#include <vector>

#include "scenes/geometry/real.hpp"
#include "scenes/transport/emission.hpp"

namespace luxodus {

namespace limits {
/// Emitters that are aimed at, those of the most glow: each costs time at every turn of a path.
inline constexpr size_t glows = 16;
/// Of the turns at a place, those that are aimed at most.
inline constexpr double max_aimed = 0.5;
/// Events of a path that may be aimed.
inline constexpr int aimed_events = 8;
/// Share of an emitter's light: less is left to chance. Aimed at, it gained less than it cost.
inline constexpr double min_glow = 0.25;
}  // namespace limits

/// A sphere around an emitter, and how much it glows.
struct Glow {
  Vec3 centre{0};
  Real radius = 0;
  double power = 0;  // of the emitter, in all bands, by how they look
  double share = 0;  // of its light that smoke in the sphere scatters
};

class GlowGuide {
 public:
  GlowGuide() = default;
  explicit GlowGuide(std::vector<Glow> glows) : glows_(std::move(glows)) {}

  /// Nothing glows: every turn is as it was.
  bool empty() const { return glows_.empty(); }

  /// Turns after so many events are left as they are: weights of many aimed ones would multiply.
  void start_event(int event) { aims_ = event < limits::aimed_events; }
  /// For turns at a place: until the next call.
  void stand_at(const Vec3& place);
  /// Share of the turns there that are aimed.
  double aimed() const { return aimed_; }
  /// A direction of an aimed turn, by uniform numbers; `choice` in [0, aimed()).
  Vec3 direction(double choice, Real u, Real v) const;
  /// Density [1/sr] of directions drawn by both ways, where a turn has `own` alone.
  double density(const Vec3& direction, double own) const;

 private:
  struct Cone {
    Vec3 axis{0};
    Real one_minus_cosine = 0;  // of its half angle
    double share = 0;           // of the turns
  };

  std::vector<Glow> glows_;
  std::vector<Cone> cones_;
  double aimed_ = 0;
  bool aims_ = true;
};

/// How far from an emitter smoke counts as its glow: as far as voxels do not know it.
Real glow_reach_m(const CompiledScene& scene);
/// Power of all bands, by how they look.
double power_seen(const CompiledScene& scene, const CompiledEmitter& emitter);
/// Leaves limits::glows.
void keep_brightest(std::vector<Glow>& glows);

/// The glows of a scene: of emitters in smoke, those of the most light. Suspends: where the
/// resolver does.
template <class Resolver>
std::vector<Glow> glows_of(const CompiledScene& scene, Resolver& resolver) {
  std::vector<Glow> out;
  if (scene.features.media == MediaNeed::none) return out;
  for (uint32_t i = 0; i < scene.emitters.size(); ++i) {
    const CompiledEmitter& e = scene.emitters[i];
    if (e.distribution == Distribution::collimated) continue;
    const EmitterBound bound = emitter_bound(scene, i);
    Glow glow{bound.centre, bound.radius + glow_reach_m(scene), power_seen(scene, e), 0};
    // Before its face: the face itself may be a boundary of the smoke.
    const Vec3 before = bound.centre - e.axes[2] * (0.5_r * glow.radius);
    double scattering = 0;
    for_each_medium_at(
        scene.media, scene.bands.count() / 2, before, resolver,
        [&](int, int, double sigma, double albedo) { scattering += sigma * albedo; });
    glow.share = -std::expm1(-scattering * static_cast<double>(glow.radius));
    if (glow.power > 0 && glow.share > limits::min_glow) out.push_back(glow);
  }
  keep_brightest(out);
  return out;
}

}  // namespace luxodus
