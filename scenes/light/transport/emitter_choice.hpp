// The light sampler of next-event estimation: chooses the emitter to be sampled at a place of a
// path, and gives the probability. At an event one emitter is chosen, by its power and its
// distance. In smoke a second one is chosen for a whole ray segment, with equiangular sampling,
// because collisions rarely happen close to a small emitter (equiangular.hpp). One thread or fiber
// at a time.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/emitter_sight.hpp"
#include "scenes/light/transport/sphere_set.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t nearby_emitters = 256;  // up to this number the distance affects the choice
/// An emitter is near a segment if its distance is below this share of the segment's length plus
/// half its own size: collisions, which are spread over the whole segment, would rarely come as
/// close.
inline constexpr Real near_line = 0.125_r;
/// Probability of choosing by what is known about emitters at a place; the rest uses what is known
/// for the cell around it, which includes all emitters.
inline constexpr double bright_choice = 0.9;
}  // namespace limits

/// For the light of all bands together, as for a path that carries them all.
inline constexpr int all_bands = -1;

struct EmitterSample {
  size_t emitter = 0;
  double probability = 0;  // 0: no emitter to choose
};

class EmitterChoice {
 public:
  explicit EmitterChoice(const CompiledScene& scene);

  /// Weights emitters as seen from a place: those that `seen` lists as bright, by the light that
  /// arrives; without `seen`, all emitters, by inverse squared distance if they are few. `normal`
  /// is that of a surface, or zero in a medium. False if none emits in this band, or with
  /// `all_bands` in any.
  bool weigh_at(const Vec3& place, const Vec3& normal, int band, const CellSight* seen);
  /// Chooses by the last weigh_at, with a uniform number u in [0, 1).
  EmitterSample choose_at(double u) const;
  double probability_at(size_t emitter) const;

  /// Weights emitters by their approximate contribution to the first `end` of a ray: the angle that
  /// the segment subtends at the emitter, over the distance. False if none is near: then none need
  /// be chosen along the segment.
  bool weigh_along(const Ray& ray, Real end, int band);
  /// Variant of weigh_along for near emitters only, each weighted by the light that
  /// `seen_at(place)` reports at the closest point of the line. An emitter that is not bright there
  /// is left out; it can still be sampled at collisions.
  template <class SeenAt>
  bool weigh_near(const Ray& ray, Real end, int band, SeenAt&& seen_at);
  /// Chooses by the last weigh_along or weigh_near.
  EmitterSample choose_along(double u) const;
  double probability_along(size_t emitter) const;

 private:
  /// Running sums of the emitters' weights.
  using Cumulative = std::vector<double>;
  double power_of(size_t emitter, int band) const {
    const CompiledEmitter& e = scene_.emitters[emitter];
    if (e.distribution == Distribution::collimated) return 0;
    return band == all_bands ? seen_power_[emitter]
                             : e.wanted * e.power_w[static_cast<size_t>(band)];
  }
  /// What weights of few emitters follow from, number by number, so that the compiler computes
  /// several at once.
  struct SideBySide {
    std::vector<Real> x, y, z, half_size, quarter_square;  // of centres and sizes
    /// By band, and then of all bands together: 0 for collimated emitters.
    std::vector<std::vector<double>> power;
    const double* power_in(int band) const {
      return (band == all_bands ? power.back() : power[static_cast<size_t>(band)]).data();
    }
  };
  void set_side_by_side();
  bool has_few() const { return !few_.x.empty(); }
  bool weigh_bright(const Vec3& place, const Vec3& normal, int band);
  bool weigh_few_at(const Vec3& place, int band);
  bool weigh_few_along(const Ray& ray, Real end, int band);
  /// Weights each emitter by its power alone: false if none has any.
  bool weigh_powers(Cumulative& cumulative, int band) const;
  /// Approximate angle that a line passing at this distance subtends at an emitter, over that
  /// distance.
  static Real seen_along(Real distance, Real half, Real end) {
    const Real least = distance + half + 1e-4_r * end;
    return end / (least * (least + end / 3));
  }
  static EmitterSample choose(const Cumulative& cumulative, double u);
  static double share_of(size_t emitter, const Cumulative& cumulative);

  const CompiledScene& scene_;
  std::vector<double> seen_power_;  // in all bands, by luminance and colour
  SideBySide few_;                  // empty where there are more than limits::nearby_emitters
  Cumulative by_power_;             // of all emitters
  SphereSet bounds_;
  const CellSight* seen_ = nullptr;  // of the last weigh_at
  double bright_ = 0;                // probability of choosing among its bright emitters
  Cumulative at_, along_;            // at_: of the bright emitters, or of all
  std::vector<Real> weight_;         // scratch of weigh_few_along
  std::vector<int32_t> is_near_;     // likewise
  bool near_alone_ = false;          // along_ refers to these:
  std::vector<uint32_t> near_;
};

template <class SeenAt>
bool EmitterChoice::weigh_near(const Ray& ray, Real end, int band, SeenAt&& seen_at) {
  near_alone_ = true;
  near_.clear();
  along_.clear();
  double total = 0;
  bounds_.for_each_near(ray, end, limits::near_line * end, [&](uint32_t i, Real t, Real square) {
    const double power = power_of(i, band);
    if (!(power > 0)) return;
    const double arriving = seen_at(ray.origin + ray.direction * t).arriving_of(i);
    if (!(arriving > 0)) return;
    total += power * arriving *
             static_cast<double>(seen_along(std::sqrt(square), bounds_.radius(i), end));
    near_.push_back(i);
    along_.push_back(total);
  });
  return total > 0;
}

}  // namespace luxodus
