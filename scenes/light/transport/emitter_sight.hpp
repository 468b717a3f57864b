// The emitters that light a place, approximately: learned for the cell of space around it and the
// side that its surface faces, by a few shadow rays from places there (sight_places.hpp) to points
// of each emitter. The rays account for walls, for luminaires' directions and for smoke on the way.
// Pictures use it for the light sampler (emitter_choice.hpp) and for path guiding (glow_guide.hpp);
// its errors cost variance but cause no bias. A side of a cell is learned at its first use, from
// random numbers of its own, so the result does not depend on who uses it first. Any thread;
// suspends where the resolver does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/core/random.hpp"
#include "scenes/light/transport/connect.hpp"
#include "scenes/light/transport/emission.hpp"
#include "scenes/light/transport/emitter_images.hpp"
#include "scenes/light/transport/glow_guide.hpp"
#include "scenes/light/transport/learned_cells.hpp"
#include "scenes/light/transport/sight_places.hpp"

namespace luxodus {

namespace limits {
/// Emitters that are tested from a cell: those with the most power over squared distance.
inline constexpr size_t asked_emitters = 256;
/// An emitter that no shadow ray has reached may still be visible from a part of the cell: it
/// counts with this share of its unoccluded light, attenuated by smoke.
inline constexpr double unseen_share = 0.1;
/// Least light of an emitter that sends none towards the places, as for isotropic emission [1/sr].
inline constexpr double min_arriving = 0.03 / (4 * 3.14159265358979324);
/// Visible glow of an emitter that sends nothing towards the cell, as for isotropic emission
/// [1/sr].
inline constexpr double glow_arriving = 1 / (4 * 3.14159265358979324);
/// Emitters with less than this share of all light are not tested for visibility.
inline constexpr double looked_at_share = 1e-3;
/// Emitters that are weighted individually at each place of a cell: those above this share, at most
/// so many.
inline constexpr size_t bright_emitters = 32;
inline constexpr double bright_share = 3e-3;
/// Probability of choosing by the light that arrives in the cell as a whole; the rest is by power.
inline constexpr double cell_choice = 0.9;
/// Limit for the memory of all cells once learned [bytes]; if it were more, cells are made larger.
/// All cells count from the start, since the order of threads decides which are learned first.
inline constexpr uint64_t sight_bytes = uint64_t{256} << 20;
}  // namespace limits

/// Knowledge of all emitters at the places of one side of a cell.
struct CellSight {
  struct Bright {
    uint32_t emitter = 0;
    /// Root mean square over the cell of the light that arrives per watt, without the inverse
    /// square [1/sr].
    double arriving = 0;
    /// Likewise for guiding paths to its glow, which sends light wherever it is visible.
    double glowing = 0;
  };
  std::vector<Bright> bright;  // ascending by number
  std::vector<EmitterImage> images;
  /// All tested emitters by number, and the running sum of their arriving light; the last is 1.
  std::vector<uint32_t> asked;
  std::vector<float> cumulative;
  double by_cell = 1;  // probability of choosing by `cumulative`; the rest is by power alone

  /// Light that arrives per watt of an emitter, as in `Bright`; 0 for one that is not bright here.
  double arriving_of(uint32_t emitter) const {
    for (const Bright& b : bright)
      if (b.emitter == emitter) return b.arriving;
    return 0;
  }
};

class EmitterSight {
 public:
  /// Requires: the scene outlives this.
  explicit EmitterSight(const CompiledScene& scene);

  /// Memory once every cell has been learned [bytes].
  static uint64_t max_bytes(const CompiledScene& scene);

  /// `normal`: of the place's surface; zero in the air.
  template <class Resolver>
  const CellSight& at(const Vec3& place, const Vec3& normal, Resolver& resolver) const {
    const size_t side = cell_side(normal);
    return cells_.at(place, side, [&](size_t cell) { return learn(cell, side, resolver); });
  }

 private:
  /// Separate random numbers: paths of pictures have part 0.
  static constexpr uint32_t sight_part = 1;

  /// Measured for one emitter over the places of a cell.
  struct Asked {
    uint32_t emitter = 0;
    double over_square = 0;  // power over squared distance from the cell's middle
    double open = 0;         // root mean square of the unoccluded light per watt
    double arriving = 0;     // root mean square of the light that arrives
    double glowing = 0;      // see CellSight::Bright
    double light(double of) const { return over_square * of; }
  };

  /// The places of a side of a cell, and random numbers for learning it.
  struct SightSampler {
    std::vector<SightPlace> places;
    Random random;
    uint64_t numbers;  // index of the first

    /// Starts the random numbers of an emitter.
    void start(uint32_t emitter) { random.start(numbers + 1 + emitter); }
  };

  std::vector<Asked> candidates(const Vec3& middle) const;
  CellSight conclude(std::vector<Asked> asked) const;
  /// A point in front of the emitter, where smoke scatters its light.
  Vec3 glow_place(uint32_t emitter) const;

  template <class Resolver>
  CellSight learn(size_t cell, size_t side, Resolver& resolver) const {
    SightSampler from{{}, Random(0, RandomStream::picture, sight_part), 0};
    from.numbers = (uint64_t{cell} * cell_sides + side) * (scene_.emitters.size() + 1);
    from.random.start(from.numbers);
    from.places = sight_places(scene_, cells_.grid(), cell, side, from.random, resolver);
    std::vector<Asked> asked =
        candidates(cells_.grid().low_of(cell) + Vec3(0.5_r * cells_.grid().edge()));
    double all = 0;
    for (Asked& a : asked) {
      from.start(a.emitter);
      look_openly(from, a, resolver);
      all += a.light(a.open);
    }
    for (Asked& a : asked) {
      a.arriving = limits::unseen_share * a.open;
      if (!(a.light(a.open) > limits::looked_at_share * all)) continue;
      from.start(a.emitter);
      look(from, a, resolver);
    }
    for (Asked& a : asked) a.glowing = std::max(a.arriving, glowing(from, a, all, resolver));
    std::vector<EmitterImage> images = images_from(from, asked, resolver);
    CellSight out = conclude(std::move(asked));
    out.images = std::move(images);
    return out;
  }

  /// Calls ray(connection, density, weight) for shadow rays from the places to an emitter.
  template <class Resolver, class OfRay>
  void for_each_ray(SightSampler& from, uint32_t emitter, Resolver& resolver,
                    OfRay&& of_ray) const {
    const CompiledEmitter& e = scene_.emitters[emitter];
    for (const SightPlace& place : from.places) {
      const EmissionPoint point = emission_point(scene_, e, from.random, resolver);
      const ShadowRay c =
          connect(scene_, place.at, point.position, point.axis, e.kind != EmitterKind::volume);
      if (!(c.distance > 0) || !place.faces(c.ray.direction)) continue;
      const auto density =
          static_cast<double>(directional_density(e, point, -c.ray.direction, resolver));
      if (density > 0) of_ray(c, density, place.weight);
    }
  }

  template <class Resolver>
  void look_openly(SightSampler& from, Asked& a, Resolver& resolver) const {
    double squares = 0;
    for_each_ray(from, a.emitter, resolver, [&](const ShadowRay&, double density, double weight) {
      squares += weight * density * density;
    });
    a.open = std::max(limits::min_arriving, root_mean(squares, from.places));
  }

  template <class Resolver>
  void look(SightSampler& from, Asked& a, Resolver& resolver) const {
    double squares = 0, unseen = 0;
    for_each_ray(from, a.emitter, resolver, [&](const ShadowRay& c, double density, double weight) {
      const double sent =
          density * medium_transmittance(scene_, c.ray, c.distance, band_, resolver);
      unseen += weight * sent * sent;
      if (sent > 0 && passes(c, scene_.emitters[a.emitter].body, resolver))
        squares += weight * sent * sent;
    });
    const double least = limits::unseen_share * limits::unseen_share * unseen;
    a.arriving = std::max(limits::unseen_share * limits::min_arriving,
                          root_mean(std::max(squares, least), from.places));
  }

  /// The visible glow of the emitter, in any direction of emission; 0: not worth testing.
  template <class Resolver>
  double glowing(const SightSampler& from, const Asked& a, double all, Resolver& resolver) const {
    const bool worth = a.light(limits::glow_arriving) > limits::min_glow_seen * all;
    if (scene_.features.media == MediaNeed::none || !worth) return 0;
    double squares = 0;
    for (const SightPlace& place : from.places) {
      const ShadowRay c = connect(scene_, place.at, glow_place(a.emitter), Vec3(0), false);
      if (!(c.distance > 0) || !place.faces(c.ray.direction) || !passes(c, 0, resolver)) continue;
      const double seen = medium_transmittance(scene_, c.ray, c.distance, band_, resolver);
      squares += place.weight * seen * seen;
    }
    return limits::glow_arriving * root_mean(squares, from.places);
  }

  template <class Resolver>
  bool passes(const ShadowRay& c, int body, Resolver& resolver) const {
    OwnBody own{body};
    return passes_solids(scene_, c.ray, c.ray.length, resolver, own,
                         [](const CompiledMaterial&, Real) {});
  }

  template <class Resolver>
  std::vector<EmitterImage> images_from(SightSampler& from, const std::vector<Asked>& asked,
                                        Resolver& resolver) const {
    if (!aims_at_mirrors(scene_)) return {};
    std::vector<MirroredEmitter> emitters;
    double straight = 0;
    for (const Asked& a : asked) {
      emitters.push_back({a.emitter, power_[a.emitter]});
      straight += a.light(a.arriving);
    }
    from.random.start(from.numbers | uint64_t{1} << 63);
    return EmitterImages(scene_, band_, from.places, from.random, resolver)
        .find(emitters, straight);
  }

  const CompiledScene& scene_;
  int band_ = 0;               // band with the most lumens per watt
  std::vector<double> power_;  // of each emitter, in all bands, weighted by luminance and colour
  std::vector<EmitterBound> bounds_;
  LearnedCells<CellSight> cells_;
};

}  // namespace luxodus
