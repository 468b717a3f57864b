// Which emitters light a place, as far as the cell of space around it and the side of its surface
// tell: learned by a few shadow rays from places there (sight_places.hpp) to points of each
// emitter, which know walls, the directions in which luminaires send their light, and smoke on the
// way. Pictures choose emitters (emitter_choice.hpp) and aim turns (glow_guide.hpp) by it; what it
// errs by costs paths, never truth. A side of a cell is learned when somebody first asks, from
// random numbers of its own, so it is the same whoever asks and when. Any thread; suspends where
// the resolver does.
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
/// Emitters that are asked from a cell: those of the most power over squared distance.
inline constexpr size_t asked_emitters = 256;
/// An emitter that no ray has met may still be seen from somewhere in the cell: it counts as so
/// much of the light that would arrive without walls, through smoke as it is.
inline constexpr double unseen_share = 0.1;
/// The same of one that has sent nothing towards them, as of light that goes everywhere [1/sr].
inline constexpr double least_arriving = 0.03 / (4 * 3.14159265358979324);
/// What is seen of the glow of an emitter that sends nothing towards the cell, as of light that
/// goes everywhere [1/sr].
inline constexpr double glow_arriving = 1 / (4 * 3.14159265358979324);
/// Light of an emitter, of that of all, below which nobody asks whether it is hidden.
inline constexpr double looked_at_share = 1e-3;
/// Emitters of a cell that are weighed at each place of it: those of more than a share, and at most
/// so many.
inline constexpr size_t bright_emitters = 32;
inline constexpr double bright_share = 3e-3;
/// Share of the choices in a cell, as a whole, that go by what arrives there; the rest go by power.
inline constexpr double cell_choice = 0.9;
/// Memory of all cells when each has been learned [bytes]: where it would be more, cells are
/// larger. All count from the start, since which are learned first depends on the order of threads.
inline constexpr uint64_t sight_bytes = uint64_t{256} << 20;
}  // namespace limits

/// What is known of all emitters from the places of a cell on one of its sides.
struct CellSight {
  struct Bright {
    uint32_t emitter = 0;
    /// Root mean square over the cell of what arrives of a watt, without the inverse square [1/sr].
    double arriving = 0;
    /// The same by which turns are aimed at its glow, which sends light wherever it is seen.
    double glowing = 0;
  };
  std::vector<Bright> bright;  // by number
  std::vector<EmitterImage> images;
  /// Of all emitters asked, by number, what arrives in the cell: sums up to each, the last is 1.
  std::vector<uint32_t> asked;
  std::vector<float> cumulative;
  double by_cell = 1;  // share of the choices by `cumulative`; the rest are by power alone

  /// What arrives of a watt of an emitter, as of `Bright`; 0 of one that is not bright here.
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

  /// Memory that it takes at most, when every cell has been learned [bytes].
  static uint64_t most_bytes(const CompiledScene& scene);

  /// `normal`: of the surface that the place is on; zero in the air.
  template <class Resolver>
  const CellSight& at(const Vec3& place, const Vec3& normal, Resolver& resolver) const {
    const size_t side = cell_side(normal);
    return cells_.at(place, side, [&](size_t cell) { return learn(cell, side, resolver); });
  }

 private:
  /// Of the random numbers of pictures: their paths have part 0.
  static constexpr uint32_t sight_part = 1;

  /// Of one emitter, over the places of a cell.
  struct Asked {
    uint32_t emitter = 0;
    double over_square = 0;  // power over squared distance, as from the cell's middle
    double open = 0;         // root mean square of what would arrive of a watt
    double arriving = 0;     // of what arrives
    double glowing = 0;      // see CellSight::Bright
    double light(double of) const { return over_square * of; }
  };

  /// Where a cell is learned from: a side of it, and random numbers.
  struct Learning {
    std::vector<SightPlace> places;
    Random random;
    uint64_t numbers;  // the first of them

    /// Those of an emitter, from their first on.
    void start(uint32_t emitter) { random.start(numbers + 1 + emitter); }
  };

  std::vector<Asked> candidates(const Vec3& middle) const;
  CellSight conclude(std::vector<Asked> asked) const;
  /// Before the emitter, where its light comes from that smoke sends on.
  Vec3 glow_place(uint32_t emitter) const;

  template <class Resolver>
  CellSight learn(size_t cell, size_t side, Resolver& resolver) const {
    Learning from{{}, Random(0, RandomStream::picture, sight_part), 0};
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

  /// Calls ray(connection, density, weight) for rays from the places to an emitter.
  template <class Resolver, class OfRay>
  void for_each_ray(Learning& from, uint32_t emitter, Resolver& resolver, OfRay&& of_ray) const {
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
  void look_openly(Learning& from, Asked& a, Resolver& resolver) const {
    double squares = 0;
    for_each_ray(from, a.emitter, resolver, [&](const ShadowRay&, double density, double weight) {
      squares += weight * density * density;
    });
    a.open = std::max(limits::least_arriving, root_mean(squares, from.places));
  }

  template <class Resolver>
  void look(Learning& from, Asked& a, Resolver& resolver) const {
    double squares = 0, unseen = 0;
    for_each_ray(from, a.emitter, resolver, [&](const ShadowRay& c, double density, double weight) {
      const double sent =
          density * medium_transmittance(scene_, c.ray, c.distance, band_, resolver);
      unseen += weight * sent * sent;
      if (sent > 0 && passes(c, resolver)) squares += weight * sent * sent;
    });
    const double least = limits::unseen_share * limits::unseen_share * unseen;
    a.arriving = std::max(limits::unseen_share * limits::least_arriving,
                          root_mean(std::max(squares, least), from.places));
  }

  /// What is seen of the emitter's glow, wherever it sends its light; 0: not worth looking.
  template <class Resolver>
  double glowing(const Learning& from, const Asked& a, double all, Resolver& resolver) const {
    const bool worth = a.light(limits::glow_arriving) > limits::min_glow_seen * all;
    if (scene_.features.media == MediaNeed::none || !worth) return 0;
    double squares = 0;
    for (const SightPlace& place : from.places) {
      const ShadowRay c = connect(scene_, place.at, glow_place(a.emitter), Vec3(0), false);
      if (!(c.distance > 0) || !place.faces(c.ray.direction) || !passes(c, resolver)) continue;
      const double seen = medium_transmittance(scene_, c.ray, c.distance, band_, resolver);
      squares += place.weight * seen * seen;
    }
    return limits::glow_arriving * root_mean(squares, from.places);
  }

  template <class Resolver>
  bool passes(const ShadowRay& c, Resolver& resolver) const {
    return passes_solids(scene_, c.ray, c.ray.length, resolver,
                         [](const CompiledMaterial&, Real) {});
  }

  template <class Resolver>
  std::vector<EmitterImage> images_from(Learning& from, const std::vector<Asked>& asked,
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
  int band_ = 0;               // of the most lumens a watt
  std::vector<double> power_;  // of each emitter, in all bands, by how they look
  std::vector<EmitterBound> bounds_;
  LearnedCells<CellSight> cells_;
};

}  // namespace luxodus
