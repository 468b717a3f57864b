// Next-event estimation: which emitter is sampled directly from a place of a path, and with which
// probability. One emitter is chosen, by its power and by how near it is. In smoke a second one is
// chosen for a whole stretch of the path: a collision is seldom just where a small emitter is near
// (equiangular.hpp). One thread or fiber at a time.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "scenes/light/transport/compiled_scene.hpp"
#include "scenes/light/transport/emitter_sight.hpp"
#include "scenes/light/transport/sphere_set.hpp"

namespace luxodus {

namespace limits {
inline constexpr size_t nearby_emitters = 256;  // up to here distance decides which is chosen
/// An emitter is near where it is closer to the stretch than this share of its length and half its
/// own size: collisions, which are spread over all of it, would seldom come as close.
inline constexpr Real near_line = 0.125_r;
/// Share of the choice that goes to emitters by what is known of them at a place; the rest goes by
/// what is known of the cell around it, which has all emitters.
inline constexpr double bright_choice = 0.9;
}  // namespace limits

/// Of the light of all bands together, as a path that carries them all asks.
inline constexpr int all_bands = -1;

struct EmitterSample {
  size_t emitter = 0;
  double probability = 0;  // 0: there is none to choose
};

class EmitterChoice {
 public:
  explicit EmitterChoice(const CompiledScene& scene);

  /// Weighs emitters as seen from a place: those that `seen` knows to be bright by what arrives
  /// from there, or without it all by squared distance where they are few. `normal` is that of a
  /// surface, and zero in a medium. False where none shines in this band, or with `all_bands` in
  /// any.
  bool weigh_at(const Vec3& place, const Vec3& normal, int band, const CellSight* seen);
  /// Of the last weigh_at, by a uniform number u in [0, 1).
  EmitterSample choose_at(double u) const;
  double probability_at(size_t emitter) const;

  /// Weighs emitters by what each sends to the first `end` of a ray, nearly: the angle at
  /// which it sees it, over its distance. False where none is near, so that none need be chosen so.
  bool weigh_along(const Ray& ray, Real end, int band);
  /// The same of the near emitters alone: each by what `seen_at(place)` knows to arrive at the
  /// place of the line that is nearest to it. One that is not bright there is left out: a collision
  /// may still ask it.
  template <class SeenAt>
  bool weigh_near(const Ray& ray, Real end, int band, SeenAt&& seen_at);
  /// Of the last weigh_along or weigh_near.
  EmitterSample choose_along(double u) const;
  double probability_along(size_t emitter) const;

 private:
  /// Sums of the weights of the emitters up to each.
  using Cumulative = std::vector<double>;
  double power_of(size_t emitter, int band) const {
    const CompiledEmitter& e = scene_.emitters[emitter];
    if (e.distribution == Distribution::collimated) return 0;
    return band == all_bands ? seen_power_[emitter]
                             : e.wanted * e.power_w[static_cast<size_t>(band)];
  }
  bool weigh_bright(const Vec3& place, const Vec3& normal, int band);
  template <class WeightOf>
  double weigh(Cumulative& cumulative, int band, WeightOf&& weight) const;
  /// The angle at which an emitter sees a line that passes it so far away, over that distance,
  /// nearly.
  static double seen_along(Real distance, Real half, Real end) {
    const Real least = distance + half + 1e-4_r * end;
    return static_cast<double>(end / (least * (least + end / 3)));
  }
  static EmitterSample choose(const Cumulative& cumulative, double u);
  static double share_of(size_t emitter, const Cumulative& cumulative);

  const CompiledScene& scene_;
  std::vector<double> seen_power_;  // of each emitter, in all bands, by how they look
  Cumulative by_power_;             // of all emitters
  SphereSet bounds_;
  const CellSight* seen_ = nullptr;  // of the last weigh_at
  double bright_ = 0;                // the share of the choice that its bright emitters have
  Cumulative at_, along_;            // at_: of the bright ones, or of all
  bool near_alone_ = false;          // along_ is of these:
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
    total += power * arriving * seen_along(std::sqrt(square), bounds_.radius(i), end);
    near_.push_back(i);
    along_.push_back(total);
  });
  return total > 0;
}

}  // namespace luxodus
